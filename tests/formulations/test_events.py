"""Events of contacts on courses whose turning points and zeros are known, and the steps that land on them."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from types import SimpleNamespace
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st
from numpy.polynomial import Polynomial

from support_exudyn.formulations.compiled import events
from support_exudyn.formulations.compiled.integrate import StepEvents, land_on_first
from support_exudyn.formulations.compiled.oil_events import NONE
from support_exudyn.scene.arrays import CONTACT, REPORT
from tests.formulations.plain import plain

C = 10.0  # clearance [m], large: dips of a thousandth of a step are then far above what is called still
DEPTH = 1.0  # [m], of the order of all depths
LENGTH = 1.0  # of a course [s]
FIRST, SHORTEN, GROWTH = LENGTH / 16.0, 0.25, 4.0  # step at first [s] and at most, and its changes
NOTHING, IMPACT, SEPARATION, UNCLEAR = "nothing", "impact", "separation", "unclear"
NAMES = {
    events.NOTHING: NOTHING,
    events.IMPACT: IMPACT,
    events.SEPARATION: SEPARATION,
    events.CUT: "cut",
    events.TOO_LONG: UNCLEAR,
}
Event = tuple[str, float]  # what, and when [s]


class Course(NamedTuple):
    """A depth over time, and whether it begins in contact."""

    depth: Polynomial
    closed: bool

    @property
    def rate(self) -> Polynomial:
        return self.depth.deriv()

    def first(self) -> tuple[str, float]:
        """What happens first, and when [s]."""
        found = [(t, SEPARATION) for t in crossings(self.depth, -1.0)]
        if not self.closed:
            found = [(t, IMPACT) for t in crossings(self.depth, 1.0)]
        t, what = min(found, default=(np.inf, NOTHING))
        return what, t


def crossings(curve: Polynomial, sign: float) -> list[float]:
    """Times within the course at which a curve passes zero with a slope of this sign."""
    roots = curve.roots()
    real = np.sort(roots.real[np.abs(roots.imag) < 1e-9])
    slope = curve.deriv()
    return [float(t) for t in real if 0.0 < t < LENGTH and sign * slope(t) > 0.0]


class Fake(NamedTuple):
    """What the general finder takes of a scene."""

    contacts: np.recarray


def contacts(depth: float, rate: float, push: float = 1.0, closed: bool = True) -> np.recarray:
    """The one contact of a scene, which moves along one axis."""
    found = np.zeros(1, CONTACT).view(np.recarray)
    one = found[0]
    one.depth, one.rate, one.push, one.closed, one.clearance = depth, rate, push, closed, C
    one.x, one.vx, one.nx = C + depth, rate, 1.0
    return found


def found_in_general(at: Callable[[float], np.recarray], t: float, h: float) -> Event:
    """What the general finder sees of a contact over time."""
    scene = Fake(at(t + h))

    def look(scene: Fake, n: int, x: float, path: object, y: object, slope: object, forced: bool) -> None:
        scene.contacts[:] = at(t + x * h)

    first_event = plain(events.first_event, look=look)
    n, what, x = first_event(scene, h, at(t), at(t + h), None, None, None)
    return (NAMES[what], t + x * h) if n >= 0 else (NOTHING, t + h)


def find(course: Course, t: float, h: float) -> Event:
    """The finder of the compiled formulation."""

    def at(time: float) -> np.recarray:
        return contacts(float(course.depth(time)), float(course.rate(time)), closed=course.closed)

    return found_in_general(at, t, h)


def driven(course: Course) -> tuple[Event, float]:
    """What is found first over a whole course, and the length of the step in which it was."""
    t, h = 0.0, FIRST
    while t < LENGTH:
        h = min(h, LENGTH - t)
        event = find(course, t, h)
        if event[0] == UNCLEAR:
            h *= SHORTEN
            assert h > 1e-12, "it shortens for ever"
            continue
        if event[0] != NOTHING:
            return event, h
        t, h = t + h, min(GROWTH * h, FIRST)
    return (NOTHING, LENGTH), h


def course_of(turns: list[float], sign: float, lowest: float, closed: bool) -> Course:
    """A depth whose rate passes zero at these times; its extreme in the midst is at a share of its range."""
    rate = Polynomial.fromroots(turns) * sign
    depth = rate.integ()
    t = np.linspace(0.0, LENGTH, 401)
    size = float(np.ptp(depth(t)))
    depth = depth / size
    inner = depth(np.array(turns))
    level = float(inner.min()) - lowest if closed else float(inner.max()) + lowest
    return Course((depth - level) * DEPTH, closed)


def can_be_told(turns: list[float]) -> bool:
    """Whether a swing, from turn to turn and back, takes three steps; a dip may be a thousandth of a step."""
    turns = sorted(turns)
    return all(b - a > 1e-4 for a, b in pairwise(turns)) and all(
        b - a > 3.0 * FIRST for a, b in zip(turns, turns[2:], strict=False)
    )


times = st.lists(st.floats(0.02, 0.98), min_size=2, max_size=4).filter(can_be_told)
# of the range: how far the depth's extremes stay from zero, or pass it
margins = st.floats(0.01, 0.5) | st.floats(-0.5, -0.01)


def check(course: Course) -> None:
    what, when = course.first()
    (event, at), h = driven(course)
    assert event == what
    if what != NOTHING:
        # by the cubic of the step. A depth that passes zero where it is about to turn is met, its time is not
        assert abs(course.depth(at)) < 1e-2 * DEPTH or abs(at - when) <= 0.1 * h


@given(turns=times, sign=st.sampled_from([1.0, -1.0]), lowest=margins)
@example(turns=[0.4, 0.4002], sign=1.0, lowest=0.2)  # a dip between two rising ends of a step
@example(turns=[0.5, 0.75, 0.625, 0.875], sign=-1.0, lowest=0.5)  # turns where steps end
@example(turns=[0.55, 0.5502], sign=-1.0, lowest=0.2)  # a bump between two falling ones
def test_the_first_that_happens_to_a_contact_is_found(turns: list[float], sign: float, lowest: float) -> None:
    course = course_of(turns, sign, lowest, closed=True)
    assume(course.depth(0.0) > 1e-3 * DEPTH)
    assume(all(abs(course.depth(t)) > 1e-3 * DEPTH for t in turns))
    check(course)


@given(turns=times, sign=st.sampled_from([1.0, -1.0]), highest=margins)
def test_the_first_touch_of_a_flight_is_found(turns: list[float], sign: float, highest: float) -> None:
    course = course_of(turns, sign, highest, closed=False)
    assume(course.depth(0.0) < -1e-3 * DEPTH)
    assume(all(abs(course.depth(t)) > 1e-3 * DEPTH for t in turns))
    check(course)


# --- tension that is cut ---


def cut(push: Callable[[float], float], depth: Polynomial, h: float = 0.125, start: float = 0.0) -> Event:
    """What is seen in a step of a contact that asks for tension where `push` is below zero."""

    def at(time: float) -> np.recarray:
        return contacts(float(depth(time)), float(depth.deriv()(time)), push(time))

    return found_in_general(at, start, h)


SOME = (0.3, 0.5, 0.7)
DEEP = Polynomial([5e-4, -1e-3])  # on its way out, still closed after a tenth of a second
PARTS_EARLY = Polynomial([5e-5, -1e-3])  # parts at 0.05 s


CUTS: dict[str, tuple[Callable[[float], float], str]] = {
    "tension begins": (lambda t: 0.1 - t, "cut"),
    "tension ends": (lambda t: t - 0.1, "cut"),
    "tension begins later": (lambda t: 0.2 - t, NOTHING),
    **{
        f"tension within the step at {m}": (lambda t, m=m: 0.4 * ((8.0 * t - m) ** 2 - 0.035), UNCLEAR)
        for m in SOME
    },
    **{
        f"none within the step at {m}": (lambda t, m=m: -0.4 * ((8.0 * t - m) ** 2 - 0.035), UNCLEAR)
        for m in SOME
    },
    "nearly tension": (lambda t: 0.4 * ((8.0 * t - 0.5) ** 2 + 0.04), NOTHING),
    "far from a cut nothing is looked at": (lambda t: 0.6 if t in (0.0, 0.125) else -1.0, NOTHING),
    # where a cut is met a step begins on neither side
    "just met from below": (lambda t: -1e-12 + t, NOTHING),
    "just met from above": (lambda t: 1e-12 - t, NOTHING),
}


@pytest.mark.parametrize("case", CUTS)
def test_cuts_within_a_step_are_seen(case: str) -> None:
    push, what = CUTS[case]
    event, at = cut(push, DEEP)
    assert event == what
    assert at == pytest.approx(0.1, rel=1e-12) if what == "cut" else at >= 0.0  # straight lines


def test_a_cut_and_a_parting_in_one_step_are_told_apart_by_shorter_ones() -> None:
    assert cut(lambda t: 0.07 - t, PARTS_EARLY)[0] == UNCLEAR
    assert cut(lambda t: 0.04 - t, PARTS_EARLY, h=0.045) == ("cut", pytest.approx(0.04, rel=1e-12))
    assert cut(lambda t: 0.07 - t, PARTS_EARLY, h=0.06) == (SEPARATION, pytest.approx(0.05, rel=1e-12))
    # in so short a step the separation counts
    tiny = Polynomial([5e-14, -1e-3])
    assert cut(lambda t: 2e-11 - t, tiny, h=1e-10)[0] == SEPARATION


# --- at the ends of steps ---


@pytest.mark.parametrize(
    ("closed", "size", "bend"),
    [(True, 1.0, 0.03), (True, 1.0, -0.03), (False, -0.1, 0.02), (False, -0.1, -0.02)],
)
def test_what_a_cubic_cannot_tell_is_looked_at_more_closely(closed: bool, size: float, bend: float) -> None:
    # s^2 + bend s^4 has the same values and slopes at -1 and 1 as a parabola that is lower by `bend` at 0; of a
    # flight the first quarter of the step is looked at
    s = Polynomial([-1.0, 16.0 if closed else 64.0])
    close = size * DEPTH * (s**2 + bend * s**4 + 0.5 * bend)
    assert find(Course(close, closed=closed), 0.0, 0.125)[0] == UNCLEAR


def test_a_bump_between_two_falling_ends_is_a_touch() -> None:
    rate = -Polynomial.fromroots([0.002, 0.009])
    depth = rate.integ()
    bump = depth - (0.3 * depth(0.0) + 0.7 * depth(0.009))
    assert bump(0.0) < 0.0 < bump(0.009)
    assert driven(Course(1e7 * DEPTH * bump, closed=False))[0][0] == IMPACT
    # it lies within the first part of a step
    assert find(Course(1e5 * DEPTH * bump, closed=False), 0.0, 0.05)[0] == UNCLEAR


# --- landing ---


STEP = 0.125


@pytest.mark.parametrize("what", [events.IMPACT, events.SEPARATION])
def test_contacts_that_meet_or_part_at_the_same_instant_do_so_together(what: int) -> None:
    meets = what == events.IMPACT
    contacts = np.zeros(3, CONTACT).view(np.recarray)
    contacts.state, contacts.rate, contacts.closed = -1, 0.3 if meets else -0.3, 0.0 if meets else 1.0
    contacts.depth = 0.0, 0.5 * events.TOGETHER, 2.0 * events.TOGETHER  # the last does so at another instant
    report = np.zeros(1, REPORT).view(np.recarray)
    room = SimpleNamespace(onsets=np.zeros((3, 5)), report=report)
    scene = SimpleNamespace(contacts=contacts)
    assert plain(events.happen)(scene, room, 0, what, 1.0, np.zeros(1))
    np.testing.assert_array_equal(contacts.closed, [1.0, 1.0, 0.0] if meets else [0.0, 0.0, 1.0])
    assert report[0].impacts == (2 if meets else 0)


@pytest.mark.parametrize("other", [events.IMPACT, events.SEPARATION])
def test_a_contact_that_was_expected_later_is_landed_on_if_it_comes_first(other: int) -> None:
    times, rates = (0.08, 0.05), (1.0, 1.0 if other == events.IMPACT else -1.0)

    def contacts(t: float) -> np.recarray:
        found = np.zeros(2, CONTACT).view(np.recarray)
        found.rate, found.depth = rates, [rate * (t - at) for rate, at in zip(rates, times, strict=True)]
        found.closed = 0.0, float(other == events.SEPARATION)
        return found

    def advance(scene: SimpleNamespace, t: float, length: float, *rest: object) -> None:
        scene.contacts[:] = contacts(t + length)

    scene = SimpleNamespace(contacts=contacts(STEP))
    report = np.zeros(1, REPORT).view(np.recarray)
    room = SimpleNamespace(now=contacts(0.0), then=contacts(STEP), report=report)
    room.rates = room.end = room.weights = room.right = None
    expected = StepEvents(0, events.IMPACT, 0.9, NONE, 0)
    length, contact, what, _ = plain(land_on_first, advance=advance)(
        scene, room, expected, 0.0, STEP, False, None
    )
    assert (contact, what) == (1, other)
    assert length == pytest.approx(times[1], abs=1e-12)
