"""Events of contacts on courses whose turning points and zeros are known, in all formulations that look for them.

Every finder is driven as its integrator drives it: steps that are too long are made again shorter, and grow again.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st
from numpy.polynomial import Polynomial

from support_exudyn.compiled import plain
from support_exudyn.reduced import events, layout
from support_exudyn.reduced.plain_run import PARTS_CLOSED
from support_exudyn.tree.events import Kind, event
from support_exudyn.tree.loose import Place

C = 1e-3  # clearance [m]
DEPTH = 1e-4  # [m], of the order of all depths
LENGTH = 1.0  # of a course [s]
FIRST, SHORTEN, GROWTH = LENGTH / 16.0, 0.25, 4.0  # step at first [s] and at most, and its changes
NOTHING, TOUCH, PARTING, RETURN, UNCLEAR = "nothing", "touch", "parting", "return", "unclear"
NAMES = {
    events.NOTHING: NOTHING,
    events.TOUCH: TOUCH,
    events.PARTING: PARTING,
    events.RETURN: RETURN,
    events.CUT: "cut",
    events.TOO_LONG: UNCLEAR,
}
Seen = tuple[str, float, float]  # what, between which times [s]


class Course(NamedTuple):
    """A depth over time, and whether it begins in contact."""

    depth: Polynomial
    closed: bool

    @property
    def rate(self) -> Polynomial:
        return self.depth.deriv()

    def first(self) -> tuple[str, float]:
        """What happens first, and when [s]."""
        found = [(t, PARTING) for t in crossings(self.depth, -1.0)]
        found += [(t, RETURN) for t in crossings(self.rate, 1.0)]
        if not self.closed:
            found = [(t, TOUCH) for t in crossings(self.depth, 1.0)]
        t, what = min(found, default=(np.inf, NOTHING))
        return what, t


def crossings(curve: Polynomial, sign: float) -> list[float]:
    """Times within the course at which a curve passes zero with a slope of this sign."""
    roots = curve.roots()
    real = np.sort(roots.real[np.abs(roots.imag) < 1e-9])
    slope = curve.deriv()
    return [float(t) for t in real if 0.0 < t < LENGTH and sign * slope(t) > 0.0]


Finder = Callable[[Course, float, float], Seen]


def reduced(parts: int, cut_samples: int) -> Finder:
    """The finder of the reduced formulation with so many parts of a step in contact."""

    def find(course: Course, t: float, h: float) -> Seen:
        def contact(time: float) -> list[float]:
            found = [0.0] * layout.CONTACT
            found[layout.DEPTH], found[layout.RATE] = float(course.depth(time)), float(course.rate(time))
            found[layout.PUSH] = 1.0
            return found

        def look(p: object, segment: object, memory: object, begin: float, step: float, x: float, *rest: list) -> None:
            rest[-1][:] = contact(begin + x * step)

        p = [0.0] * layout.PARAMETERS
        p[layout.BY_DEPTH], p[layout.CLEARANCE] = 1.0, 1.0  # no way is too long
        memory = [0.0] * layout.MEMORY
        memory[layout.TOUCHING] = float(course.closed)
        look_for = plain(events.event, look=look, PARTS_CLOSED=parts, CUT_SAMPLES=cut_samples)
        scratch = [0.0] * layout.STATES, [0.0] * layout.CONTACT
        what, low, high = look_for(p, [], memory, t, h, contact(t), contact(t + h), None, *scratch)
        return NAMES[what], t + low * h, t + high * h

    return find


def in_tree(course: Course, t: float, h: float) -> Seen:
    """The finder of the tree; the journal moves along one axis."""

    def place(time: float) -> Place:
        depth, rate = float(course.depth(time)), float(course.rate(time))
        return Place(C + depth, 0.0, rate, 0.0, depth, rate)

    found = event(course.closed, True, place(t), place(t + h), h, C)
    if found is None:
        return NOTHING, t, t + h
    kinds = {Kind.TOUCH: TOUCH, Kind.PARTING: PARTING, Kind.RETURN: RETURN, Kind.UNCLEAR: UNCLEAR}
    return kinds[found.kind], t + found.fraction * h, t + found.fraction * h


FINDERS = {"compiled": reduced(1, events.CUT_SAMPLES), "python": reduced(PARTS_CLOSED, 1), "tree": in_tree}


def driven(find: Finder, course: Course) -> tuple[Seen, float]:
    """What is found first over a whole course, and the length of the step in which it was."""
    t, h = 0.0, FIRST
    while t < LENGTH:
        h = min(h, LENGTH - t)
        seen = find(course, t, h)
        if seen[0] == UNCLEAR:
            h *= SHORTEN
            assert h > 1e-12, "it shortens for ever"
            continue
        if seen[0] != NOTHING:
            return seen, h
        t, h = t + h, min(GROWTH * h, FIRST)
    return (NOTHING, LENGTH, LENGTH), h


def course_of(turns: list[float], sign: float, lowest: float, closed: bool) -> Course:
    """A depth whose rate passes zero at these times, and whose extreme in the midst is at a share of its range."""
    rate = Polynomial.fromroots(turns) * sign
    depth = rate.integ()
    t = np.linspace(0.0, LENGTH, 401)
    size = float(np.ptp(depth(t)))
    depth = depth / size
    inner = depth(np.array(turns))
    level = float(inner.min()) - lowest if closed else float(inner.max()) + lowest
    return Course((depth - level) * DEPTH, closed)


# far enough from each other for rounding of the roots; a dip may be a thousandth of a step
times = st.lists(st.floats(0.02, 0.98), min_size=2, max_size=4).filter(
    lambda found: bool((np.diff(sorted(found)) > 1e-4 * LENGTH).all())
)
# of the range: how far the depth's extremes stay from zero, or pass it
margins = st.floats(0.01, 0.5) | st.floats(-0.5, -0.01)


def check(find: Finder, course: Course) -> None:
    what, when = course.first()
    (seen, low, high), h = driven(find, course)
    assert seen == what
    if what != NOTHING:
        # by the cubic of the step; a tenth of it is what integrators allow when they end a step there. A depth
        # that passes zero where it is about to turn is met, its time is not
        met = what != RETURN and abs(course.depth(low)) < 1e-2 * DEPTH
        assert met or low - 0.1 * h <= when <= high + 0.1 * h
        assert high - low <= h


@pytest.mark.parametrize("finder", FINDERS)
@given(turns=times, sign=st.sampled_from([1.0, -1.0]), lowest=margins)
@example(turns=[0.4, 0.4002], sign=1.0, lowest=0.2)  # a dip between two rising ends of a step
@example(turns=[0.5, 0.75, 0.625, 0.875], sign=-1.0, lowest=0.5)  # turns where steps end
@example(turns=[0.55, 0.5502], sign=-1.0, lowest=0.2)  # a bump between two falling ones
def test_the_first_that_happens_to_a_contact_is_found(
    finder: str, turns: list[float], sign: float, lowest: float
) -> None:
    course = course_of(turns, sign, lowest, closed=True)
    assume(course.depth(0.0) > 1e-3 * DEPTH)
    assume(all(abs(course.depth(t)) > 1e-3 * DEPTH for t in turns))
    check(FINDERS[finder], course)


@pytest.mark.parametrize("finder", FINDERS)
@given(turns=times, sign=st.sampled_from([1.0, -1.0]), highest=margins)
def test_the_first_touch_of_a_flight_is_found(
    finder: str, turns: list[float], sign: float, highest: float
) -> None:
    course = course_of(turns, sign, highest, closed=False)
    assume(course.depth(0.0) < -1e-3 * DEPTH)
    assume(all(abs(course.depth(t)) > 1e-3 * DEPTH for t in turns))
    check(FINDERS[finder], course)
