"""A step made again to end where something happens to a contact, and what that changes."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from support_exudyn.formulations.compiled import events, landing
from support_exudyn.formulations.compiled.integrate import StepEvents, land_on_first
from support_exudyn.formulations.compiled.oil_events import NONE
from support_exudyn.scene.arrays import CONTACT, IMPACTS, REPORT
from tests.formulations.plain import plain

STEP = 0.125


class Turning:
    """A rate that rises over a step, steeply first or last, and passes zero at a share of it."""

    def __init__(self, turn: float, flat: float, late: bool) -> None:
        self.turn, self.flat, self.late = turn, flat, late
        self.looked: list[float] = []

    def rate(self, x: float) -> float:
        if self.late:
            return x**self.flat - self.turn**self.flat
        return (1.0 - self.turn) ** self.flat - (1.0 - x) ** self.flat

    def look(self, length: float) -> float:
        self.looked.append(length / STEP)
        return self.rate(length / STEP)

    def check(self, length: float) -> None:
        assert length / STEP == self.looked[-1]  # where it ends is what was made last
        for n, x in enumerate(self.looked[1:], 1):
            low = max([0.0, *(other for other in self.looked[:n] if self.rate(other) < 0.0)])
            high = min([1.0, *(other for other in self.looked[:n] if self.rate(other) >= 0.0)])
            # rounding
            assert low - 1e-9 <= x <= high + 1e-9


def landed(turning: Turning) -> float:
    def advance(scene: SimpleNamespace, t: float, length: float, *rest: object) -> None:
        scene.contacts[0].push = turning.look(length)

    start, now = (np.zeros(1, CONTACT).view(np.recarray) for _ in range(2))
    start[0].push, now[0].push = turning.rate(0.0), turning.rate(1.0)
    scene, report = SimpleNamespace(contacts=now), [0.0] * REPORT
    land = plain(landing.land, advance=advance)
    length: float = land(scene, 0, 0.0, STEP, events.CUT, 0.5, start, None, None, None, None, None, report)
    return length


@given(turn=st.floats(0.05, 0.95), flat=st.floats(1.0, 8.0), late=st.booleans())
@example(turn=0.16, flat=8.0, late=False)
@example(turn=0.84, flat=8.0, late=True)
def test_a_turn_is_sought_between_the_nearest_looks_on_either_side(
    turn: float, flat: float, late: bool
) -> None:
    turning = Turning(turn, flat, late)
    turning.check(landed(turning))


@pytest.mark.parametrize("what", [events.IMPACT, events.SEPARATION])
def test_contacts_that_meet_or_part_at_the_same_instant_do_so_together(what: int) -> None:
    meets = what == events.IMPACT
    contacts = np.zeros(3, CONTACT).view(np.recarray)
    contacts.state, contacts.rate, contacts.closed = -1, 0.3 if meets else -0.3, 0.0 if meets else 1.0
    contacts.depth = 0.0, 0.5 * events.TOGETHER, 2.0 * events.TOGETHER  # the last does so at another instant
    onsets, report = np.zeros((3, 5)), np.zeros(REPORT)
    scene = SimpleNamespace(contacts=contacts)
    assert plain(landing.happen)(scene, 0, what, 1.0, np.zeros(1), onsets, report)
    np.testing.assert_array_equal(contacts.closed, [1.0, 1.0, 0.0] if meets else [0.0, 0.0, 1.0])
    assert report[IMPACTS] == (2 if meets else 0)


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
    room = SimpleNamespace(now=contacts(0.0), then=contacts(STEP), report=[0.0] * REPORT)
    room.rates = room.end = room.weights = room.right = None
    expected = StepEvents(0, events.IMPACT, 0.9, NONE, 0)
    length, contact, what, _ = plain(land_on_first, advance=advance)(
        scene, room, expected, 0.0, STEP, False, None
    )
    assert (contact, what) == (1, other)
    assert length == pytest.approx(times[1], abs=1e-12)
