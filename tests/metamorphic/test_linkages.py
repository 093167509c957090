"""Drawn linkages: every formulation moves them alike, and they move alike wherever and however they lie."""

from __future__ import annotations

from dataclasses import replace

from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import CubicStep, Onset, Scenario, Steady
from support_exudyn.machines.check.statics import mobility
from tests.metamorphic import drawn, drawn_linkages
from tests.metamorphic.moving import MIRROR, UPSIDE_DOWN, Move, context, moved, turn
from tests.metamorphic.same import certain, plain, run, scenes, told
from tests.metamorphic.scaling import Scale
from tests.metamorphic.test_delay import after, later
from tests.metamorphic.test_rescale import rescaled, scales

BETWEEN = 2e-3  # of the largest value in a unit: what two formulations may differ by besides their errors
GRAZE = 0.05  # of the fastest impact
CHANCE = 2.0  # times the error told: in two of 1000 scenes it was too small, by 1.003 and 1.66
PLACES = st.tuples(drawn.between(-5.0, 5.0), drawn.between(-5.0, 5.0))  # [m]


def faster(onsets: tuple[Onset, ...], speed: float) -> int:
    """How many impacts are faster [m/s]."""
    return sum(onset.speed > speed for onset in onsets)


@given(scene=drawn_linkages.opened())
@scenes(60)  # 20 of them by hand
def test_tree_and_redundant_move_a_linkage_alike(scene: Scenario) -> None:
    assert mobility(scene.linkage).free == 1
    # steps as fine as this tell their own error also where a record lies just behind an impact
    one = run(replace(scene, formulation="redundant").refined())
    other = told(scene)
    # the impact velocity jumps to 0 at a separation, which may lie on either side of a record
    others = {name: values for name, values in plain(other).items() if not name.endswith("impact_velocity")}
    one.check(others, rounding=BETWEEN, chance=CHANCE, certain=certain(one.result, other))
    fastest = max((onset.speed for onsets in other.onsets.values() for onset in onsets), default=0.0)
    for pin, theirs in other.onsets.items():
        mine = one.result.onsets[pin]
        # rounding decides whether there is a graze, and on which side of the threshold an impact lies
        assert faster(theirs, GRAZE * fastest) <= faster(mine, 0.5 * GRAZE * fastest), pin
        assert faster(mine, GRAZE * fastest) <= faster(theirs, 0.5 * GRAZE * fastest), pin


@given(scene=drawn_linkages.driven())
@scenes(8)
def test_a_linkage_in_a_mirror_moves_alike(scene: Scenario) -> None:
    for mirror in (MIRROR, UPSIDE_DOWN):
        one, other = run(scene), told(moved(scene, mirror))
        one.check(context(other, mirror.back))
        one.check_touches(other)


@given(scene=drawn_linkages.driven(), degrees=drawn.between(-180.0, 180.0))
@scenes(8)
def test_a_linkage_that_is_turned_moves_alike(scene: Scenario, degrees: float) -> None:
    way = turn(degrees)
    one, other = run(scene), told(moved(scene, way))
    one.check(context(other, way.back))
    one.check_touches(other)


@given(scene=drawn_linkages.driven(), place=PLACES)
@scenes(8)
def test_a_linkage_elsewhere_moves_alike(scene: Scenario, place: tuple[float, float]) -> None:
    way = Move(shift=place)
    one, other = run(scene), told(moved(scene, way))
    one.check(context(other, way.back))
    one.check_touches(other)


@given(
    scene=drawn_linkages.sprung(),
    way=st.sampled_from((MIRROR, UPSIDE_DOWN, turn(130.0), Move(shift=(2.0, -1.0)))),
)
@scenes(8)
def test_a_linkage_with_springs_and_torques_moves_alike(scene: Scenario, way: Move) -> None:
    one, other = run(scene), told(moved(scene, way))
    one.check(context(other, way.back))
    one.check_touches(other)


def steadily(scene: Scenario) -> Scenario:
    """The scene without strokes, whose unit is the metre, also where a crank makes them."""
    return replace(scene, drive=Steady(rate=15.0)) if isinstance(scene.drive, CubicStep) else scene


@given(scene=drawn_linkages.driven().map(steadily), scale=scales)
@scenes(8)
def test_a_linkage_of_another_size_moves_alike(scene: Scenario, scale: Scale) -> None:
    rescaled(scene, scale)


@given(scene=drawn_linkages.driven(from_rest=True), milliseconds=st.integers(1, 12))
@scenes(6)
def test_a_linkage_whose_drive_begins_later_moves_alike(scene: Scenario, milliseconds: int) -> None:
    dwell = milliseconds * drawn.MS
    one, other = run(scene), told(later(scene, dwell))
    one.check(after(plain(other), milliseconds, dwell))
