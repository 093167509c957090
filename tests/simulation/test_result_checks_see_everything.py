"""Whether a run is believed does not depend on what it records."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from support_exudyn import ClearancePin, Failure, Held, Scenario, simulate
from support_exudyn.simulation import result_checks as looking
from tests.cases.run_cases import PIN, loose_support, support
from user_forces import JournalBearing, JournalContact, LankaraniNikravesh

BEARING = JournalBearing(bore_radius=0.0655, clearance=0.0005)


def soft(**changes: Any) -> Scenario:
    """A contact so soft that the journal goes through its bore."""
    contact = JournalContact(bearing=BEARING, normal=LankaraniNikravesh(stiffness=1e6, restitution=0.5))
    return support(pins={PIN: ClearancePin(contact=contact)}, drive=Held(), duration=0.2, **changes)


def test_a_point_alone_does_not_hide_a_journal_far_outside_its_bore() -> None:
    found = simulate(replace(soft(formulation="compiled"), channels=("tip.x",)), throw=False)
    assert isinstance(found, Failure)
    assert f"the journal of {PIN} is" in found.reason


PLANTED: dict[str, Callable[[Any], Any]] = {
    "energy_open": lambda real: lambda *a: (real(*a)[0] + 2.0 * real(*a)[1], real(*a)[1]),
    "joints_apart": lambda real: lambda *a: real(*a) + 2.0 * looking.APART,
}


@pytest.mark.parametrize("formulation", ["exudyn", "compiled"])
@pytest.mark.parametrize("asked", [("*",), ("tip.x",), ()])
@pytest.mark.parametrize("what", ["energy_open", "joints_apart"])
def test_every_look_is_taken_whatever_is_recorded(
    what: str, asked: tuple[str, ...], formulation: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    scenario = loose_support(0.5, 0.25, drive=Held(), duration=0.01, formulation=formulation, channels=asked)
    assert not isinstance(simulate(scenario, throw=False), Failure)
    monkeypatch.setattr(looking, what, PLANTED[what](getattr(looking, what)))
    assert isinstance(simulate(scenario, throw=False), Failure)
