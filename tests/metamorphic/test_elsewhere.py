"""A scene in a mirror, turned together with its gravity, or some metres or 300 m away moves as it did."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.metamorphic import drawn, drawn_linkages
from tests.metamorphic.moving import MIRROR, UPSIDE_DOWN, Move, context, moved, turn
from tests.metamorphic.same import run, scenes, told


def shift(place: tuple[float, float]) -> Move:
    return Move(shift=place)


TURNS = drawn.between(-180.0, 180.0).map(turn)
NEAR = ((3.0, 2.0), (-7.0, 5.0), (0.0, 1.0))  # [m]
FAR = (*NEAR, (300.0, 300.0), (-300.0, 0.5), (0.0, 300.0))
# By metre. Of the largest value in a unit: 3e-14 m at 300 m are 1e-2 m/s^2 in steps of an impact of 1 us, and
# measured 8e-3 of the accelerations there; formulations with error control compute motions from the start
ROUNDING = {"compiled": 1e-7, "exudyn": 1e-4}
PLACES = st.tuples(drawn.between(-5.0, 5.0), drawn.between(-5.0, 5.0))  # [m], of linkages
KINDS = {
    "support in general, mirror": (drawn.in_general(), st.just(MIRROR)),
    "support in general, turn": (drawn.in_general(level=False), TURNS),
    "support in general, shift": (drawn.in_general(), st.sampled_from(FAR).map(shift)),
    "support of bodies, mirror": (drawn.in_bodies(), st.just(MIRROR)),
    "support of bodies, turn": (drawn.in_bodies(level=False), TURNS),
    "support of bodies, shift": (drawn.in_bodies(), st.sampled_from(FAR).map(shift)),
    "slider-crank in general, mirror": (drawn.cranks(free=True), st.just(UPSIDE_DOWN)),
    "slider-crank of bodies, mirror": (drawn.cranks(free=False), st.just(MIRROR)),
    "slider-crank of bodies, turn": (drawn.cranks(free=False), TURNS),
    "slider-crank of bodies, shift": (drawn.cranks(free=False), st.sampled_from(NEAR).map(shift)),
    "linkage, mirror": (drawn_linkages.driven(), st.sampled_from((MIRROR, UPSIDE_DOWN))),
    "linkage, turn": (drawn_linkages.driven(), TURNS),
    "linkage, shift": (drawn_linkages.driven(), PLACES.map(shift)),
    "linkage with springs": (
        drawn_linkages.sprung(),
        st.sampled_from((MIRROR, UPSIDE_DOWN, turn(130.0), shift((2.0, -1.0)))),
    ),
}
SLOW = "slider-crank of bodies, shift"


@pytest.mark.parametrize(
    "kind", [pytest.param(kind, marks=[pytest.mark.slow] if kind == SLOW else []) for kind in KINDS]
)
@given(data=st.data())
@scenes(8)
def test_a_scene_elsewhere_moves_alike(kind: str, data: st.DataObject) -> None:
    drawn_scenes, moves = KINDS[kind]
    scene, move = data.draw(drawn_scenes, label="scene"), data.draw(moves, label="move")
    one, other = run(scene), told(moved(scene, move))
    rounding = 0.0 if kind.startswith("linkage") else max(map(abs, move.shift)) * ROUNDING[scene.formulation]
    one.check(context(other, move.back), rounding=rounding)
    one.check_touches(other)
