"""A scene seen in a mirror moves as one sees it there."""

from __future__ import annotations

from hypothesis import given

from support_exudyn import Scenario
from tests.metamorphic import drawn
from tests.metamorphic.moving import MIRROR, UPSIDE_DOWN, Move, context, moved
from tests.metamorphic.same import run, scenes, told


def mirrored(scene: Scenario, mirror: Move = MIRROR) -> None:
    one, other = run(scene), told(moved(scene, mirror))
    one.check(context(other, mirror.back))
    one.check_touches(other)


@given(scene=drawn.in_general())
@scenes(8)
def test_a_support_in_general(scene: Scenario) -> None:
    mirrored(scene)


@given(scene=drawn.in_bodies())
@scenes(6)
def test_a_support_of_bodies(scene: Scenario) -> None:
    mirrored(scene)


@given(scene=drawn.cranks(free=True))
@scenes(6)
def test_a_slider_crank_in_free_coordinates(scene: Scenario) -> None:
    mirrored(scene, UPSIDE_DOWN)


@given(scene=drawn.cranks(free=False))
@scenes(2)
def test_a_slider_crank_of_bodies(scene: Scenario) -> None:
    mirrored(scene)
