"""A scene elsewhere, some metres or 300 m away, moves as it did."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import Scenario
from tests.metamorphic import drawn
from tests.metamorphic.moving import Move, context, moved
from tests.metamorphic.same import run, scenes, told

WAYS = st.sampled_from(
    ((3.0, 2.0), (-7.0, 5.0), (0.0, 1.0), (300.0, 300.0), (-300.0, 0.5), (0.0, 300.0))
)  # [m]
NEAR = st.sampled_from(((3.0, 2.0), (-7.0, 5.0), (0.0, 1.0)))
# By metre. Of the largest value in a unit: 3e-14 m at 300 m are 1e-2 m/s^2 in steps of an impact of 1 us, and
# measured 8e-3 of the accelerations there; formulations with error control compute motions from the start
ROUNDING = {"compiled": 1e-7, "exudyn": 1e-4}


def shifted(scene: Scenario, way: tuple[float, float]) -> None:
    move = Move(shift=way)
    one, other = run(scene), told(moved(scene, move))
    one.check(context(other, move.back), rounding=max(map(abs, way)) * ROUNDING[scene.formulation])
    one.check_touches(other)


@given(scene=drawn.in_general(), way=WAYS)
@scenes(8)
def test_a_support_in_general(scene: Scenario, way: tuple[float, float]) -> None:
    shifted(scene, way)


@given(scene=drawn.in_bodies(), way=WAYS)
@scenes(6)
def test_a_support_of_bodies(scene: Scenario, way: tuple[float, float]) -> None:
    shifted(scene, way)


@pytest.mark.slow
@given(scene=drawn.cranks(free=False), way=NEAR)
@scenes(2)
def test_a_slider_crank_of_bodies(scene: Scenario, way: tuple[float, float]) -> None:
    shifted(scene, way)
