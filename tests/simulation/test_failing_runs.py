"""Failures are clear, and can be had as a value."""

from __future__ import annotations

import pickle
from dataclasses import replace

import pytest

from support_exudyn import ClearancePin, Failure, Held, Scenario, SimulationError, simulate
from support_exudyn.formulations.contract import UNSOLVABLE, explained
from support_exudyn.formulations.limits import past_ends
from support_exudyn.model.hydraulics.motion import SealFriction
from support_exudyn.sweeps.parallel_runs import run_all
from tests.cases.cylinder_cases import CYLINDER
from tests.cases.run_cases import Pair, loose_support, paper_contact
from tests.formulations.test_momentum import ONE, TWO
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


def test_pistons_are_checked_as_far_as_lengths_are_known() -> None:
    leg = replace(CYLINDER, seal_friction=SealFriction(coulomb=1e3, static=1e3))
    scenario = loose_support(drive=Held(), actuators={"front_column": leg, "rear_column": leg})
    assert past_ends(scenario, {}) == ""  # the engine's scene tells none of legs
    start = scenario.linkage.actuators["rear_column"].start_length
    assert "rear_column is extended by 2 m" in past_ends(scenario, {"rear_column": start + 2.0})


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


def test_other_words_of_the_engine_follow_ours() -> None:
    said = "=====\nCSystem::Assemble: no such node [file 'a.cpp', line 3]\nmore"
    assert explained(RuntimeError(said)) == "the engine gave up (engine: CSystem::Assemble: no such node)"
    assert explained(RuntimeError("Solve(...): matrix is not factorized!")).startswith(UNSOLVABLE)
    assert explained(RuntimeError("")) == "the engine gave up (engine: RuntimeError)"


def test_a_bug_in_a_law_is_not_taken_for_a_failed_run() -> None:
    with pytest.raises(LookupError, match="a bug in the law"):
        simulate(breaking("bug"), throw=False)


def test_a_failure_comes_back_whole_from_another_process() -> None:
    error = SimulationError(Failure("reason", "advice.", 1.5, {"x": 2.0}))
    assert pickle.loads(pickle.dumps(error)).failure == error.failure


def test_a_sweep_goes_on_after_a_failure() -> None:
    machine = Pair(one=ONE, two=TWO, one_point=(0.2, 0.25), two_point=(0.2, 0.25))
    pins = {"pin": ClearancePin(contact=paper_contact(1.5, 0.0))}
    scenarios = {
        "bad": Scenario(machine=machine, pins=pins, duration=0.01, start="settled"),
        "good": Scenario(machine=machine, pins=pins, duration=0.01),
    }
    context: list[dict[str, float]] = []
    results = run_all(scenarios, workers=1, progress=lambda shares: context.append(dict(shares)))
    assert isinstance(results["bad"], Failure)
    assert not isinstance(results["good"], Failure)
    assert context[-1]["good"] == 1.0
    # the same as in this process, to the bit
    here = simulate(scenarios["good"])
    assert (here["one.x"] == results["good"]["one.x"]).all()
