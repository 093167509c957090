"""What a finished run is looked at for: each fault planted in a good one, and what is still let pass."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from support_exudyn import (
    ClearancePin,
    Failure,
    Held,
    Scenario,
    SimulationError,
    SolverSettings,
    Steady,
    simulate,
)
from support_exudyn.formulations.exudyn.run import run
from support_exudyn.mechanics.observed_run import Outcome
from support_exudyn.scenario.recorded_channels import Channel, channels
from support_exudyn.scene.limits import DEEPEST
from support_exudyn.simulation import result_checks as looking
from support_exudyn.simulation.result_checks import (
    APART,
    GIVEN_BACK,
    energy_open,
    joints_apart,
    result_checks,
    rounding_of_energy,
    turned_over,
)
from tests.cases.run_cases import PIN, loose_support, support
from user_forces import JournalBearing, JournalContact, LankaraniNikravesh, LuGre

SCENARIO = loose_support(1.5, 0.25, drive=Held(), duration=0.05)
DEPTH = f"pin.{PIN}.depth"
Found = Mapping[str, Channel]


@pytest.fixture(scope="module")
def outcome() -> Outcome:
    return run(SCENARIO, lambda share: None)


@pytest.fixture(scope="module")
def found(outcome: Outcome) -> Found:
    return channels(SCENARIO, outcome.trajectory)


def changed(found: Found, name: str, place: int, value: float) -> Found:
    """The channels with one number of one of them replaced."""
    values = found[name].values.copy()
    values[place] = value
    return {**found, name: replace(found[name], values=values)}


def opened(found: Found, by: float) -> Found:
    """The channels with an energy balance that is open by so much [J] from the 30th record on."""
    values = found["energy.balance"].values.copy()
    values[30:] += by
    return {**found, "energy.balance": replace(found["energy.balance"], values=values)}


def moved(outcome: Outcome, place: int, by: float) -> Outcome:
    """The same with the first body moved by so much [m] at one record."""
    motion = outcome.trajectory.motion
    position = motion.position.copy()
    position[place, 0] += by
    return replace(outcome, trajectory=replace(outcome.trajectory, motion=replace(motion, position=position)))


def refused(failure: Failure | None, reason: str, record: int) -> None:
    """The failure says this, and when."""
    assert failure is not None
    assert reason in failure.reason
    assert failure.time == pytest.approx(1e-3 * record, rel=1e-12)  # rounding of the records' times
    assert failure.advice


def test_a_good_run_passes(outcome: Outcome, found: Found) -> None:
    assert result_checks(SCENARIO, outcome, found) is None
    open_by, allowed = energy_open(SCENARIO, found)
    assert open_by.max() < 0.01 * allowed  # else the tests below would say little
    apart = joints_apart(SCENARIO, outcome)
    assert apart is not None
    assert apart.max() < 1e-3 * APART


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_a_number_that_is_none_is_refused(outcome: Outcome, found: Found, value: float) -> None:
    spoilt = changed(found, "tip.x", 7, value)
    refused(result_checks(SCENARIO, outcome, spoilt), "tip.x is no longer a finite number", 7)


def test_a_journal_that_is_too_deep_is_refused(outcome: Outcome, found: Found) -> None:
    radius = SCENARIO.clearance_pins[PIN].contact.bearing.bore_radius
    deep = changed(found, DEPTH, 20, 1.01 * DEEPEST * radius)
    refused(
        result_checks(SCENARIO, outcome, deep), f"the journal of {PIN} is 13.2 mm deep in a bore of 65.5 mm", 20
    )
    assert result_checks(SCENARIO, outcome, changed(found, DEPTH, 20, 0.99 * DEEPEST * radius)) is None


def test_energy_that_does_not_add_up_is_refused(outcome: Outcome, found: Found) -> None:
    _, allowed = energy_open(SCENARIO, found)
    for sign in (-1.0, 1.0):
        failure = result_checks(SCENARIO, outcome, opened(found, sign * 1.01 * allowed))
        refused(failure, "energy does not add up: it is open by", 30)
        assert result_checks(SCENARIO, outcome, opened(found, sign * 0.98 * allowed)) is None


@pytest.mark.parametrize("name", ["damping_loss", "friction_loss"])
def test_a_loss_that_becomes_less_is_refused(outcome: Outcome, found: Found, name: str) -> None:
    allowed = GIVEN_BACK * turned_over(found) + rounding_of_energy(SCENARIO)
    for share, wrong in ((1.05, True), (0.95, False)):
        less = found[f"energy.{name}"].values.copy()
        less[20:] += 1.0 - less[20]  # else a loss of nothing could not become less
        less[30:] -= share * allowed - (less[30:] - less[20:29].max())
        failure = result_checks(
            SCENARIO, outcome, {**found, f"energy.{name}": replace(found["time"], values=less)}
        )
        if wrong:
            refused(failure, f"energy.{name} becomes less by", 30)
            assert failure is not None
            law = "LankaraniNikravesh" if name == "damping_loss" else "Ambrosio"
            assert f"pins.{PIN} = {law}" in failure.reason
        else:
            assert failure is None


def test_what_bristles_have_stored_may_be_given_back(outcome: Outcome, found: Found) -> None:
    contact = SCENARIO.clearance_pins[PIN].contact
    bristles = replace(contact, friction=LuGre(static_coefficient=0.3, sliding_coefficient=0.2))
    sticking = replace(SCENARIO, pins={PIN: ClearancePin(contact=bristles)})
    bent = replace(outcome.trajectory.sections[PIN][0], deflection=np.linspace(0.0, -1e-3, 51))
    run_with = replace(outcome, trajectory=replace(outcome.trajectory, sections={PIN: [bent]}))
    # as much as their largest deflection under the largest force; damping has stored nothing
    stored = 1e-3 * outcome.largest_force[PIN]
    allowed = GIVEN_BACK * turned_over(found) + rounding_of_energy(SCENARIO)
    assert stored > 2.0 * allowed
    for name, share, wrong in (
        ("friction_loss", 0.95, False),
        ("friction_loss", 1.05, True),
        ("damping_loss", 0.95, True),
    ):
        less = np.full(51, 1e4)
        less[30:] -= share * (stored + allowed)
        failure = result_checks(
            sticking, run_with, {**found, f"energy.{name}": replace(found["time"], values=less)}
        )
        assert (failure is not None) == wrong


def test_an_ideal_pin_that_comes_apart_is_refused(outcome: Outcome, found: Found) -> None:
    failure = result_checks(SCENARIO, moved(outcome, 12, 1.5 * APART), found)
    refused(failure, "what is joined is 0.15 mm apart; allowed: 0.1 mm", 12)
    assert result_checks(SCENARIO, moved(outcome, 12, 0.9 * APART), found) is None


def test_a_rigid_actuator_of_another_length_is_refused(outcome: Outcome, found: Found) -> None:
    # as if the actuators had not followed their drive; at the end they would be longer by so much
    for share, wrong in ((1.5, True), (0.9, False)):
        driven = replace(SCENARIO, drive=Steady(rate=share * APART / SCENARIO.duration))
        failure = result_checks(driven, outcome, found)
        assert (failure is not None) == wrong
        if failure is not None:
            assert "what is joined is 0.15 mm apart" in failure.reason


# --- in a run ---


def wrong_by(change: str) -> Any:
    """A formulation whose trajectory is wrong."""

    def run_wrongly(scenario: Scenario, progress: Any) -> Outcome:
        made = run(scenario, progress)
        if change == "apart":
            return moved(made, 5, 0.01)
        series = getattr(made.trajectory, change).copy()
        series[5] = math.nan if change == "acceleration" else series[5] + 1e4
        return replace(made, trajectory=replace(made.trajectory, **{change: series}))

    return SimpleNamespace(check=lambda scenario: None, run=run_wrongly)


WRONG = {
    "apart": "what is joined is 10 mm apart",
    "friction_loss": "energy does not add up",
    "acceleration": "is no longer a finite number",
}


@pytest.mark.parametrize("change", WRONG)
def test_a_run_that_comes_out_wrong_is_refused_unless_asked_for(
    change: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("support_exudyn.simulation.single_run.formulation", lambda name: wrong_by(change))
    scenario = replace(SCENARIO, duration=0.01)
    # whatever is recorded
    scenario = replace(scenario, channels=("tip.x",))
    with pytest.raises(SimulationError, match=WRONG[change]) as caught:
        simulate(scenario)
    assert caught.value.failure.time == pytest.approx(5e-3, rel=1e-12)  # rounding
    unseen = simulate(replace(scenario, solver=SolverSettings(result_checks=False)))
    assert unseen.time.size == 11


# --- whatever is recorded ---


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
