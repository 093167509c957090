"""Lumps of parts, and the elements of a linkage: inertias, references to bodies, data."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import Body, Crank, LinearActuator, Linkage, Part, Slide, TracePoint
from support_exudyn.model.linkage import bar, lumped, pinned
from user_forces import InputError

coordinates = st.floats(-10.0, 10.0)
points = st.tuples(coordinates, coordinates)
masses = st.floats(0.1, 1000.0)
parts = st.builds(Part, mass=masses, centre=points, inertia=st.floats(0.0, 1000.0))
BODY = Body(mass=2.0, inertia=0.1, centre=(0.0, 0.0))


def test_bar_has_the_inertia_of_a_slender_rod() -> None:
    rod = bar(12.0, (1.0, 1.0), (4.0, 5.0))
    assert rod.centre == (2.5, 3.0)
    # m l^2 / 12 with l = 5; rounding
    assert rod.inertia == pytest.approx(25.0, rel=1e-15)


@given(mass=masses, a=points, b=points, share=st.floats(0.05, 0.95))
def test_a_bar_cut_in_two_is_the_same_lump(
    mass: float, a: tuple[float, float], b: tuple[float, float], share: float
) -> None:
    cut = (a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]))
    whole, halves = bar(mass, a, b), lumped([bar(share * mass, a, cut), bar((1 - share) * mass, cut, b)])
    # rounding of sums of coordinates up to 10 and of their squares
    assert halves.mass == pytest.approx(mass, rel=1e-14)
    assert halves.centre == pytest.approx(whole.centre, abs=1e-13)
    assert halves.inertia == pytest.approx(whole.inertia, abs=1e-12 * mass)


ORIGIN = (0.0, 0.0)
ENDS = {"foot_point": ORIGIN, "head_point": (1.0, 0.0)}


@pytest.mark.parametrize(
    ("elements", "said"),
    [
        ({"pins": {"p": pinned("a", "b", ORIGIN)}}, r"pins\.p = 'b': no such body; allowed: ground, a"),
        ({"pins": {"p": pinned("a", "a", ORIGIN)}}, r"pins\.p = 'a' twice"),
        ({"actuators": {"c": LinearActuator(foot="b", head="a", **ENDS)}}, r"actuators\.c = 'b': no such body"),
        ({"points": {"t": TracePoint(body="b", point=ORIGIN)}}, r"points\.t = 'b': no such body"),
        ({"cranks": {"c": Crank(body="b")}}, r"cranks\.c = 'b': no such moving body; allowed: a"),
        ({"cranks": {"c": Crank(body="ground")}}, r"cranks\.c = 'ground': no such moving body; allowed: a"),
        ({"slides": {"s": Slide(body="ground", point=ORIGIN)}}, r"slides\.s = 'ground': no such moving body"),
        ({"slides": {"s": Slide(body="a", point=ORIGIN, against="b")}}, r"slides\.s\.against = 'b'"),
        ({"slides": {"s": Slide(body="a", point=ORIGIN, against="a")}}, r"slides\.s = 'a' twice"),
        ({"bodies": {"ground": BODY}}, "ground"),
    ],
)
def test_elements_of_bodies_that_cannot_be_are_refused(elements: dict[str, Any], said: str) -> None:
    with pytest.raises(InputError, match=said):
        Linkage(**({"bodies": {"a": BODY}} | elements))
