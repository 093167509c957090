"""Every law in the compiled formulation against the engine."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest

from support_exudyn import ClearancePin, Held, Scenario, SimulationError, SolverSettings
from tests.cases.law_cases import (
    BEARING,
    cylinder_law,
    kind_of,
)
from tests.cases.run_cases import PIN, loose_support, paper_contact
from tests.compiled_runs import simulate_compiled, simulate_on_exudyn
from user_forces import FrictionLaw, Johnson, KelvinVoigt, friction_law


def drop(bore: str = "first", duration: float = 0.042, **laws: Any) -> Scenario:
    """The journal falls from the middle of its bore and impacts twice or three times."""
    contact = replace(paper_contact(1.5, 0.0), **laws)
    solver = SolverSettings(impact_steps=512)
    base = loose_support(drive=Held(), duration=duration, solver=solver)
    return replace(base, pins={PIN: ClearancePin(contact=contact, bore=bore)})


def test_a_cut_of_tension_is_met_once() -> None:
    result = simulate_compiled(drop(normal=KelvinVoigt(stiffness=1e9, damping=5e4)), 1e-9)
    # two impacts, a separation, and tension that sets in before it and ends with it
    assert result.counts.cut_steps <= 6
    assert result.counts.clamped_steps >= 1


# --- beyond the range of a law ---


def pressed(length: float) -> Scenario:
    """A line contact so short that it hardly bears, or does not."""
    return drop(duration=0.08, normal=cylinder_law(Johnson, length=length, bearing=BEARING))


@pytest.mark.parametrize("tolerance", [1e-2, 1e-7])
def test_a_contact_beyond_the_range_of_its_law_stops_the_run(tolerance: float) -> None:
    scenario = pressed(1e-3)
    with pytest.raises(SimulationError) as caught:
        simulate_compiled(scenario, tolerance)
    failure = caught.value.failure
    assert failure.reason == "a contact is overloaded"
    assert "Johnson: depth = 0.000812" in failure.advice
    assert "allowed: up to 0.000812" in failure.advice
    with pytest.raises(SimulationError) as engines:
        simulate_on_exudyn(scenario)
    assert engines.value.failure.reason == failure.reason
    # the engine stops at the start of a step of 4e-5 s; the depth of a coarse run is right to 1e-3 of the way
    assert failure.time == pytest.approx(engines.value.failure.time, abs=1e-4)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-5, 1e-9])
def test_a_step_that_was_tried_too_far_does_not_stop_the_run(tolerance: float) -> None:
    # depths up to 0.780 of the largest, while the first try at a step may go beyond
    scenario = pressed(3e-3)
    law = scenario.clearance_pins[PIN].contact.normal
    result = simulate_compiled(scenario, tolerance)
    # measured 2.4e-3 at the coarsest
    assert result[f"pin.{PIN}.depth"].max() / law.largest_depth == pytest.approx(
        0.78002, abs=3e-3 if tolerance == 1e-3 else 1e-4
    )


# --- laws that break ---


@friction_law
def lost(slip: float, normal_force: float) -> float:
    """No number under more than 10 kN."""
    return math.nan if normal_force > 1e4 else 0.0


@friction_law
def overflowing(slip: float, normal_force: float) -> float:
    """Infinite there."""
    return -slip * math.exp(0.071 * normal_force) * 1e-300


@friction_law
def raising(slip: float, normal_force: float) -> float:
    """Nothing at all there."""
    if normal_force > 1e4:
        raise LookupError("a bug in the law")
    return 0.0


@pytest.mark.parametrize(
    ("law", "reason"),
    [
        (lost(), f"{PIN}: Lost gives a force of nan N at a slip of "),
        (overflowing(), "the linkage cannot close, or a value is no longer a finite number"),
        (raising(), f"{PIN}: a law of the contact fails: LookupError: a bug in the law"),
    ],
    ids=kind_of,
)
def test_a_law_that_gives_no_number_stops_the_run(law: FrictionLaw, reason: str) -> None:
    with pytest.raises(SimulationError) as caught:
        simulate_compiled(drop(friction=law))
    assert 0.01 < caught.value.failure.time < 0.04
    assert caught.value.failure.reason.startswith(reason)
