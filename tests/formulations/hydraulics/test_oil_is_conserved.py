"""Oil is conserved, and what is counted is what pressures and lengths say."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from support_exudyn import HydraulicCylinder, Result, SolverSettings, simulate
from tests.formulations.hydraulics.leg_cases import CASES, LENGTH

ATMOSPHERE = 101325.0
SHARE = 1e-10  # of the oil


@cache
def run(name: str) -> Result:
    return simulate(replace(CASES[name], formulation="compiled", solver=SolverSettings(tolerance=1e-7)))


def channel(result: Result, name: str) -> np.ndarray:
    """A channel, or nothing where a leg has none."""
    return result[name] if name in result.channels else np.zeros(result.time.size)


def let_in(result: Result, leg: str) -> np.ndarray:
    """What a leg has got so far, by its inlets or its drive."""
    model = result.scenario.actuators[leg]
    if isinstance(model, HydraulicCylinder):
        return result[f"{leg}.let_in"]
    drive = result.scenario.drive_of(leg)
    return model.bore_area * np.array([drive.extension(t) for t in result.time.tolist()])


def lost(result: Result, leg: str) -> np.ndarray:
    return channel(result, f"{leg}.yielded") + channel(result, f"{leg}.relieved")


@pytest.mark.parametrize("name", CASES)
def test_what_a_leg_holds_is_what_it_had_and_got_less_what_it_lost(name: str) -> None:
    result = run(name)
    for leg in result.scenario.actuators:
        oil = result[f"{leg}.oil"]
        open_by = oil - oil[0] - let_in(result, leg) + lost(result, leg)
        assert np.abs(open_by).max() < SHARE * oil[0]


def weight(pressure: np.ndarray, volume: np.ndarray, model: Any, reference: Any) -> np.ndarray:
    """Oil without pressure that has a pressure in a volume."""
    strain = pressure / model.bulk_modulus
    return volume * np.exp(strain) if isinstance(model, HydraulicCylinder) else volume + strain * reference


def chambers(result: Result, leg: str) -> dict[str, np.ndarray]:
    """Oil in the chambers, by what pressures and lengths say."""
    model, extension = result.scenario.actuators[leg], result[f"{leg}.length"] - LENGTH
    outer, stage = extension, model.second_stage
    pressure = result[f"{leg}.pressure"]
    if stage is not None:
        outer = result[f"{leg}.stage_extension"]
    volume = model.bore_area * (model.oil_length + outer) + getattr(model, "hose_volume", 0.0)
    drive = result.scenario.drive_of(leg)
    driven = np.array([drive.extension(t) for t in result.time.tolist()])
    reference = model.bore_area * (model.oil_length + driven)
    if (air := model.trapped_air) is not None:
        volume = volume - air.volume * (ATMOSPHERE / (pressure + ATMOSPHERE)) ** (1.0 / air.exponent)
    found = {"piston": weight(pressure, volume, model, reference)}
    if isinstance(model, HydraulicCylinder):
        volume = model.rod_side_area * (model.rod_side_length - outer) + model.rod_side_hose_volume
        if stage is not None:
            volume = volume + stage.rod_side_area * (stage.rod_side_length - extension + outer)
        found["rod"] = weight(result[f"{leg}.rod_pressure"], volume, model, volume)
    if stage is not None:
        volume = stage.bore_area * (stage.oil_length + extension - outer)
        found["tube"] = weight(
            result[f"{leg}.stage_pressure"], volume, model, stage.bore_area * stage.oil_length
        )
    if model.line is not None:
        room = np.full(result.time.size, model.line.volume)
        found["line"] = weight(result[f"{leg}.line_pressure"], room, model, room)
    return found


@pytest.mark.parametrize("name", CASES)
def test_what_is_held_is_what_pressures_and_volumes_say(name: str) -> None:
    result = run(name)
    for leg in result.scenario.actuators:
        full = channel(result, f"{leg}.cavity") == 0.0
        assert np.count_nonzero(full) > 5
        oil = sum(chambers(result, leg).values(), np.zeros(result.time.size))
        np.testing.assert_allclose(oil[full], result[f"{leg}.oil"][full], rtol=SHARE)


@pytest.mark.parametrize("name", [name for name in CASES if "cavity" in name or "everything" in name])
def test_a_cavity_is_what_the_liquid_does_not_fill(name: str) -> None:
    result, leg = run(name), "leg0"
    oil = sum(chambers(result, leg).values(), np.zeros(result.time.size))
    model = result.scenario.actuators[leg]
    assert model.vapour_pressure is not None
    # what would fill it has the pressure of the vapour, too
    thin = weight(np.array(model.vapour_pressure), np.array(1.0), model, 0.0)
    wanted = oil - result[f"{leg}.oil"]
    assert result[f"{leg}.cavity"].max() > 1e-6
    np.testing.assert_allclose(result[f"{leg}.cavity"] * thin, wanted, rtol=1e-7, atol=SHARE * oil[0])


PUMPED = [name for name, scene in CASES.items() if scene.pump is not None]


def from_the_pump(result: Result, leg: str) -> np.ndarray:
    """Oil that the pump has given a leg so far: into the side that its inlet connects it to."""
    there = chambers(result, leg)
    model = result.scenario.actuators[leg]
    if model.inlet.extent < 0.0:
        return there["rod"] - there["rod"][0] + channel(result, f"{leg}.relieved")
    piston = there["piston"] + there.get("line", 0.0) + there.get("tube", 0.0)
    return piston - piston[0] + channel(result, f"{leg}.yielded")


@pytest.mark.parametrize("name", PUMPED)
def test_what_the_pump_has_given_is_in_its_line_and_in_the_legs(name: str) -> None:
    result = run(name)
    drawn = sum((from_the_pump(result, leg) for leg in result.scenario.actuators), np.zeros(result.time.size))
    oil, given = result["pump.oil"], result["pump.given"]
    assert given[-1] > 1e-5
    np.testing.assert_allclose(oil - oil[0], given - drawn, rtol=0.0, atol=SHARE * oil[0])
    pump = result.scenario.pump
    assert pump is not None
    wanted = pump.pressure + pump.bulk_modulus * (oil - oil[0]) / pump.line_volume
    np.testing.assert_allclose(result["pump.pressure"], wanted, rtol=1e-9)
