"""Failures are clear, and can be had as a value."""

from __future__ import annotations

from dataclasses import replace

import pytest

from support_exudyn import ClearancePin, Failure, Held, Scenario, SimulationError, simulate
from tests.cases.run_cases import loose_support, paper_contact
from user_forces import FrictionLaw, LankaraniNikravesh, LoadError, value
from user_forces.lawful import UNLAWFUL


@value
class Breaking(FrictionLaw):
    """Works until it is pressed with 10 kN, more than laws are called with before a run."""

    kind: str

    def __call__(self, slip: float, normal_force: float, deflection: float = 0.0) -> float:
        if normal_force < 1e4:
            return 0.0
        if self.kind == "nan":
            return float("nan")
        if self.kind == "overflow":
            raise OverflowError("force out of range")
        raise LookupError("a bug in the law")


@value
class Thin(LankaraniNikravesh):
    """Is not valid below 10 micrometres."""

    def __call__(self, depth: float, rate: float, impact_velocity: float) -> float:
        if depth > 1e-5:
            raise LoadError(f"Thin: depth = {depth} m: allowed: up to 1e-05 m")
        return super().__call__(depth, rate, impact_velocity)


def breaking(kind: str) -> Scenario:
    good = paper_contact(1.5, 0.0)
    contact = type(good)(bearing=good.bearing, normal=good.normal, friction=Breaking(kind=kind))
    return _with(contact)


def _with(contact: object) -> Scenario:
    scenario = loose_support(drive=Held(), duration=0.05)
    return replace(scenario, pins={"rear_base": ClearancePin(contact=contact)})


@pytest.mark.parametrize(
    ("kind", "words"),
    [
        ("nan", "rear_base: Breaking gives a force of nan N at a slip of "),  # no step mends it
        ("overflow", "Try a smaller step"),
    ],
)
def test_a_failure_says_when_and_in_what_state(kind: str, words: str) -> None:
    with pytest.raises(SimulationError) as caught:
        simulate(breaking(kind))
    failure = caught.value.failure
    assert 0.017 < failure.time < 0.05  # the first impact is at 17.4 ms
    assert failure.state["pin.rear_base.impact_velocity"] == pytest.approx(0.17, abs=0.01)
    assert "step" in failure.state
    assert words in str(caught.value)
    assert (UNLAWFUL in str(caught.value)) == (kind == "nan")


def test_a_failure_can_be_had_as_a_value() -> None:
    failure = simulate(breaking("overflow"), throw=False)
    assert isinstance(failure, Failure)
    assert "force out of range" in failure.reason


def test_a_contact_that_is_overloaded_says_what_the_law_takes() -> None:
    good = paper_contact(1.5, 0.0)
    thin = Thin(stiffness=good.normal.stiffness, restitution=0.9)
    failure = simulate(_with(type(good)(bearing=good.bearing, normal=thin)), throw=False)
    assert isinstance(failure, Failure)
    assert failure.reason == "a contact is overloaded"
    # the law's own words in place of advice on steps
    assert "allowed: up to 1e-05 m" in failure.advice
    assert "step" not in failure.advice
    assert 0.017 < failure.time < 0.02  # the first impact is at 17.4 ms


def test_a_bug_in_a_law_is_not_taken_for_a_failed_run() -> None:
    with pytest.raises(LookupError, match="a bug in the law"):
        simulate(breaking("bug"), throw=False)
