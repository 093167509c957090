"""The largest force of a clearance pin is that inside steps, where a law may have a corner."""

from __future__ import annotations

from dataclasses import replace

import pytest

from support_exudyn import ClearancePin, Held, Scenario, SimulationError
from tests.cases.run_cases import PIN, paper_contact, support
from tests.compiled_runs import simulate_on_exudyn
from user_forces import Flores
from user_forces.connector.contact_connector import ContactConnector
from user_forces.contact import ContactForce
from user_forces.lawful import LawError
from user_forces.roots import has_a_top, peak

LAW = Flores(restitution=0.485, stiffness=5.7e8, exponent=1.167)


def dropping() -> Scenario:
    contact = replace(paper_contact(0.5, 0.0), normal=LAW)
    pins = {PIN: ClearancePin(contact=contact)}
    return support(drive=Held(), duration=0.032, pins=pins, channels=("tip.x",))


def test_a_law_that_gives_no_force_inside_a_step_is_told_with_its_pin(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(pin: ContactConnector, x: float) -> ContactForce:
        raise LawError(f"no force at {x:g} of a step")

    monkeypatch.setattr(ContactConnector, "force_within", fail)
    with pytest.raises(SimulationError, match=f"{PIN}: no force at "):
        simulate_on_exudyn(dropping())


@pytest.mark.parametrize("top", [0.01, 0.3, 0.5, 0.93, 0.99])
def test_a_corner_is_found_wherever_it_lies_in_a_step(top: float) -> None:
    assert peak(lambda x: 1.0 - abs(x - top), 0.0) == pytest.approx(1.0, abs=1e-4)
    assert peak(lambda x: 1.0 - abs(x - top), 10.0) == 10.0
    assert has_a_top(lambda x: 1.0 - abs(x - top), 1.0 - top, top)


@pytest.mark.parametrize("slope", [-1.0, 0.0, 1.0])
def test_a_force_that_rises_or_falls_throughout_has_no_top_inside(slope: float) -> None:
    assert not has_a_top(lambda x: 5.0 + slope * x, 5.0, 5.0 + slope)
