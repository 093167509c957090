"""Legs with every element alone and together: what the program computes is what scipy finds without it."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.integrate import trapezoid

from support_exudyn import Result, Scenario, SolverSettings, simulate
from tests.formulations.hydraulics.integrated import Stand, Trajectory
from tests.formulations.hydraulics.leg_cases import CASES, LENGTH

LONG = (  # a second and more of scipy each
    "column, poppet", "cylinder, poppet", "column, everything", "cylinder, two stages", "column, two stages",
    "cylinder, lowered in two stages", "two on a pump, with lines",
)  # fmt: skip
QUICK = [name for name in CASES if name not in LONG]
EVERY = [pytest.param(name, marks=pytest.mark.slow if name in LONG else ()) for name in CASES]
CHANNELS = {  # of a leg, and of the reference
    "length": "e", "pressure": "p", "rod_pressure": "p1", "line_pressure": "pl", "stage_pressure": "p2",
    "stage_extension": "s", "yielded": "out", "relieved": "out1",
}  # fmt: skip
SWITCHES = {  # what the program calls them, and the reference
    "yield valve open": ("open y", True),
    "rod relief open": ("open y1", True),
    "piston side filled": ("liquid p", True),
    "rod side filled": ("liquid p1", True),
    "tube filled": ("liquid p2", True),
    "line filled": ("liquid pl", True),
}


def precise(scenario: Scenario, tolerance: float = 1e-11) -> Scenario:
    return replace(scenario, formulation="compiled", solver=SolverSettings(tolerance=tolerance))


@cache
def run(name: str) -> Result:
    return simulate(precise(CASES[name]))


@cache
def reference(name: str) -> Trajectory:
    scenario = CASES[name]
    times = np.linspace(0.0, scenario.duration, 81)
    return Stand(scenario).run(times, rtol=1e-9)


def pairs(result: Result, wanted: Trajectory) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """What was computed and what was found by scipy, by the channels' names."""
    found = {}
    for n, leg in enumerate(result.scenario.actuators):
        found[f"mass{n}.velocity_y"] = (result[f"mass{n}.velocity_y"], wanted[f"{leg}.v"])
        for channel, key in CHANNELS.items():
            if f"{leg}.{channel}" in result.channels and f"{leg}.{key}" in wanted.values:
                start = LENGTH if channel == "length" else 0.0
                found[f"{leg}.{channel}"] = (result[f"{leg}.{channel}"] - start, wanted[f"{leg}.{key}"])
    if "pump.p" in wanted.values:
        found["pump.pressure"] = (result["pump.pressure"], wanted["pump.p"])
        found["pump.given"] = (result["pump.given"], wanted["pump.in"])
    return found


def test_every_element_is_met_by_some_case() -> None:
    happened = {what.partition(".")[2] for name in QUICK for _, what, _ in reference(name).events}
    assert happened >= {
        "open y", "open y1", "liquid p", "liquid p1", "gland", "release", "released", "in", "back", "gives all",
    }  # fmt: skip


@pytest.mark.parametrize("name", EVERY)
def test_motion_pressures_and_oil_are_those_of_scipy(name: str) -> None:
    result, wanted = run(name), reference(name)
    np.testing.assert_allclose(result.time, wanted.time, rtol=0.0, atol=1e-12)
    for channel, (ours, theirs) in pairs(result, wanted).items():
        # of what it passes through; either's own error is some 1e-8, and falls with its tolerance
        size = max(float(np.ptp(theirs)), 1e-6 * float(np.abs(theirs).max()), 1e-9)
        assert np.abs(ours - theirs).max() < 1e-7 * size, channel


@pytest.mark.parametrize("name", EVERY)
def test_valves_and_cavities_open_and_close_when_scipy_says(name: str) -> None:
    wanted = reference(name)
    happened = run(name).oil_events
    for leg, events in happened.items():
        poppet = getattr(CASES[name].actuators[leg], "yield_valve", None)
        for what, (switch, _) in SWITCHES.items():
            if what == "yield valve open" and poppet is not None and poppet.poppet is not None:
                continue  # the program tells when the pressure passes, the reference when the poppet lifts
            ours = [(one.time, one.begins) for one in events if one.what == what]
            theirs = [(t, to) for t, name, to in wanted.events if name == f"{leg}.{switch}"]
            assert [begins for _, begins in ours] == [to for _, to in theirs], what
            np.testing.assert_allclose([t for t, _ in ours], [t for t, _ in theirs], rtol=0.0, atol=2e-9)


@pytest.mark.parametrize("name", ["column, drained by its poppet", "cylinder, drained by its poppet"])
def test_steps_stay_few_where_an_open_poppet_has_drained_the_leg(name: str) -> None:
    # the flow once ended with a jump at the pressure of the tank: steps then were as short as the tolerance
    coarse, fine = (simulate(precise(CASES[name], tolerance)) for tolerance in (1e-5, 1e-8))
    pressure, tank = fine["leg0.pressure"], 0.5e6 if "cylinder" in name else 0.0
    drained = (pressure < tank + 0.1 * 4e6) & (pressure > tank) & (fine["leg0.yield_flow"] > 0.0)
    assert drained.sum() > 3
    assert fine.counts.steps < 10 * coarse.counts.steps


@pytest.mark.parametrize("name", EVERY)
def test_energy_adds_up(name: str) -> None:
    result = run(name)
    turned = max(
        float(np.ptp(result[f"energy.{kind}"])) for kind in ("kinetic", "potential", "elastic", "work")
    )
    assert result.energy_error < 1e-7 * turned


@pytest.mark.parametrize(
    ("name", "loss"),
    [
        ("column, yield valve", "yield_loss"),
        ("cylinder, hysteresis", "yield_loss"),
        ("column, line", "line_loss"),
        ("column, seals", "seal_loss"),
    ],
)
def test_what_an_element_takes_is_flow_times_drop(name: str, loss: str) -> None:
    """By the trapezoidal rule over records of the reference, which knows no energy."""
    scenario = CASES[name]
    leg = scenario.actuators["leg0"]
    times = np.linspace(0.0, scenario.duration, 8_001)
    found = Stand(scenario).run(times, rtol=1e-9)
    p, rate = found["leg0.p"], found["leg0.v"]
    if loss == "yield_loss":
        tank = getattr(leg, "tank_pressure", 0.0)
        flow = np.gradient(found["leg0.out"], times)
        modulus = leg.bulk_modulus
        volume = flow * np.exp(-p / modulus) if hasattr(leg, "inlet") else flow
        power = volume * (p - tank)
    elif loss == "line_loss":
        power = (found["leg0.pl"] - p) ** 2 / leg.line.resistance
    else:
        seal = leg.seal_friction
        bump = (seal.static - seal.coulomb) * np.exp(-((rate / seal.stribeck_speed) ** 2))
        power = (seal.coulomb + bump) * np.tanh(rate / seal.transition_speed) * rate
    wanted = trapezoid(power, times)
    result = run(name)
    assert result[f"leg0.{loss}"][-1] == pytest.approx(wanted, rel=1e-5)
