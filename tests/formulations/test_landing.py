"""A step made again to end where something happens to a contact, and what that changes."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from support_exudyn.formulations.compiled import events, landing
from support_exudyn.formulations.compiled.integrate import StepEvents, land_on_first
from support_exudyn.formulations.compiled.oil_events import NONE
from support_exudyn.scene.arrays import CONTACT, IMPACTS, REPORT
from tests.formulations.plain import plain

STEP = 0.125


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
