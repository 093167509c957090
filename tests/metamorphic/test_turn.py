"""A scene that is turned as a whole, with the gravity, moves as it did."""

from __future__ import annotations

from hypothesis import given

from support_exudyn import Scenario
from tests.metamorphic import drawn
from tests.metamorphic.moving import Move, context, moved, turn
from tests.metamorphic.same import run, scenes, told

ANY_WAY = drawn.between(-180.0, 180.0)  # [degrees]
LEANING = drawn.between(-50.0, 50.0)  # so that the hinge of a support still goes up, by which its start is told


def turned(scene: Scenario, way: Move) -> None:
    one, other = run(scene), told(moved(scene, way))
    one.check(context(other, way.back))
    one.check_touches(other)


@given(scene=drawn.in_general(level=False), degrees=ANY_WAY)
@scenes(8)
def test_a_support_in_general(scene: Scenario, degrees: float) -> None:
    turned(scene, turn(degrees))


@given(scene=drawn.in_bodies(level=False), degrees=ANY_WAY)
@scenes(6)
def test_a_support_of_bodies(scene: Scenario, degrees: float) -> None:
    turned(scene, turn(degrees))


@given(scene=drawn.cranks(free=False), degrees=ANY_WAY)
@scenes(2)
def test_a_slider_crank_of_bodies(scene: Scenario, degrees: float) -> None:
    turned(scene, turn(degrees))
