"""Two elements of a leg, each one class of this file: both solvers, equilibrium, channels, events, pages."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from support_exudyn import (
    LegChannel,
    LegValve,
    Result,
    Scenario,
    SolverSettings,
    TrappedAir,
    channels,
    reference_support,
    simulate,
    value,
)
from support_exudyn.files.scenarios.scenario_file import read_scenario, save_scenario
from support_exudyn.model.hydraulics.valves import NO_GAP, Room
from tests.formulations.hydraulics.leg_cases import COLUMN, LENGTH, MASS, scene
from user_forces import InputError
from user_forces.kernel import kernel

G, ATMOSPHERE = 9.81, 101325.0


@value
class FlowLimiter(LegValve):
    """A restriction to the tank with a pressure compensator, a spool that follows the pressure drop.

    Arguments:
        resistance: [Pa s/m^3]. limit: of the flow [m^3/s]. lag: of the spool [s].
    """

    extensive: ClassVar[tuple[str, ...]] = ("limit",)
    EVENT: ClassVar[str] = "limits"
    STATES: ClassVar[dict[str, LegChannel]] = {"spool": LegChannel("Pa", "drop that its spool has followed")}

    resistance: float = 5e8
    limit: float = 4e-3
    lag: float = 2e-3

    @staticmethod
    @kernel
    def action(
        before: float, after: float, pilot: float, opening: float, travel: float, memory: float,
        spool: float, resistance: float, limit: float, lag: float,
    ) -> tuple[float, ...]:  # fmt: skip
        drop, gap = before - after, spool - resistance * limit
        flow = drop / resistance if gap < 0.0 else limit * drop / spool
        return flow, gap, (drop - spool) / lag, drop


@value
class GasStore(LegValve):
    """An accumulator behind a laminar resistance.

    Arguments:
        size: of its room [m^3]. gas: in it. resistance: [Pa s/m^3].
    """

    AFTER: ClassVar[str] = "own"
    JOINS: ClassVar[bool] = True

    gas: TrappedAir
    size: float = 2e-3
    resistance: float = 2e8

    @staticmethod
    @kernel
    def action(
        before: float,
        after: float,
        pilot: float,
        opening: float,
        travel: float,
        memory: float,
        resistance: float,
    ) -> tuple[float, ...]:
        return (before - after) / resistance, NO_GAP

    @property
    def room(self) -> Room:
        return Room(self.size, air=self.gas)


LIMITER, STORE = FlowLimiter(), GasStore(gas=TrappedAir(volume=5e-3))
SCENE = scene(replace(COLUMN, valves={"limiter": LIMITER, "store": STORE}), speed=-0.3)
AREA, HEIGHT, MODULUS = COLUMN.bore_area, COLUMN.oil_length, COLUMN.bulk_modulus
LOAD = MASS * G / AREA  # pressure at rest [Pa]
both = pytest.mark.parametrize("formulation", ["compiled", "exudyn"])


def pressure(oil: float, extension: float) -> float:
    return MODULUS * (oil / AREA - extension - HEIGHT) / HEIGHT


def in_store(p: float) -> float:
    """Oil in the store at a pressure."""
    gas = STORE.gas.volume * (ATMOSPHERE / (p + ATMOSPHERE)) ** (1.0 / STORE.gas.exponent)
    return STORE.size * (1.0 + p / MODULUS) - gas


def store_pressure(oil: float) -> float:
    return brentq(lambda p: in_store(p) - oil, -0.5e5, 100e6, xtol=1e-6, rtol=1e-15)


def rates(t: float, state: np.ndarray) -> list[float]:
    extension, velocity, oil, stored, spool = state
    p, behind = pressure(oil, extension), store_pressure(stored)
    flow = p / LIMITER.resistance if spool < LIMITER.resistance * LIMITER.limit else LIMITER.limit * p / spool
    into = (p - behind) / STORE.resistance
    return [velocity, p * AREA / MASS - G, -flow - into, into, (p - spool) / LIMITER.lag]


def run(formulation: str, scenario: Scenario = SCENE) -> Result:
    solver = SolverSettings(tolerance=1e-9, newton_tolerance=1e-11)
    return simulate(replace(scenario, formulation=formulation, step=1e-4, solver=solver))


@both
def test_it_moves_as_by_scipy(formulation: str) -> None:
    result = run(formulation)
    start = [0.0, -0.3, AREA * HEIGHT * (1.0 + LOAD / MODULUS), in_store(LOAD), LOAD]
    found = solve_ivp(rates, (0.0, SCENE.duration), start, "Radau", result.time, rtol=1e-9, atol=1e-13)
    extension, _, oil, stored, spool = found.y
    wanted = {
        "length": LENGTH + extension,
        "pressure": pressure(oil, extension),
        "store.pressure": np.array([*map(store_pressure, stored)]),
        "limiter.spool": spool,
        "limiter.passed": oil[0] + stored[0] - oil - stored,
        "store.passed": stored - stored[0],
        "oil": oil + stored,
    }
    for name, values in wanted.items():
        # second order in the step of the engine
        share = 2e-3 if formulation == "exudyn" else 1e-6
        assert np.abs(result[f"leg0.{name}"] - values).max() < share * np.ptp(values), name
    limits = LIMITER.resistance * LIMITER.limit
    assert [event.begins for event in result.oil_events["leg0"] if event.what == "limiter limits"][:2] == [
        True,
        False,
    ]
    first = next(event.time for event in result.oil_events["leg0"])
    assert np.interp(first, result.time, spool) == pytest.approx(limits, rel=1e-2)


def test_energies_add_up() -> None:
    result = run("compiled")
    lost = sum(result[f"leg0.{name}.loss"][-1] for name in ("limiter", "store"))
    assert lost == pytest.approx(result["energy.damping_loss"][-1], rel=1e-12)
    assert result.energy_error < 1e-7 * lost


@both
def test_a_settled_leg_has_one_pressure_in_all_rooms(formulation: str) -> None:
    leg = replace(SCENE.actuators["leg0"], setting_pressure=3e6)
    result = run(formulation, replace(SCENE, start="settled", duration=0.01, actuators={"leg0": leg}))
    oil = AREA * HEIGHT * (1.0 + 3e6 / MODULUS) + in_store(3e6) - in_store(LOAD)
    for name in ("pressure", "store.pressure", "limiter.spool"):
        assert result[f"leg0.{name}"][0] == pytest.approx(LOAD, rel=1e-6), name
    rise = brentq(lambda extension: pressure(oil, extension) - LOAD, -0.1, 0.1)
    assert result["leg0.length"][0] - LENGTH == pytest.approx(rise, rel=1e-6)


def test_its_channels_are_known_and_it_is_kept_in_files(tmp_path: Path) -> None:
    table = channels(SCENE)
    assert table["leg0.limiter.flow"] == ("m^3/s", "from piston to tank")
    assert table["leg0.limiter.spool"] == ("Pa", "drop that its spool has followed")
    scenario = replace(SCENE, machine=reference_support(), actuators={"front_column": SCENE.actuators["leg0"]})
    assert read_scenario(save_scenario(scenario, tmp_path / "own.toml")) == scenario


@value
class Listed(FlowLimiter):
    """A valve whose flow no compiler understands."""

    @staticmethod
    @kernel
    def action(*numbers: float) -> tuple[float, ...]:
        return float(f"{numbers[0]:e}"), *numbers[:3]


@both
def test_an_action_that_cannot_be_compiled_is_named(formulation: str) -> None:
    leg = replace(COLUMN, valves={"listed": Listed()})
    with pytest.raises(InputError, match=r"actuators\.leg0\.valves\.listed: numba cannot compile it"):
        run(formulation, replace(SCENE, actuators={"leg0": leg}))


def test_a_valve_to_a_room_that_is_not_there_is_refused() -> None:
    class Astray(FlowLimiter):
        AFTER: ClassVar[str] = "rod"

    with pytest.raises(InputError, match=r"valves\.astray: joins 'rod', .*; allowed: tank, piston"):
        scene(replace(COLUMN, valves={"astray": Astray()}))
    with pytest.raises(InputError, match=r"valves\.line: allowed: a name"):
        scene(replace(COLUMN, valves={"line": LIMITER}))
