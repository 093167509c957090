"""Columns that are hydraulic cylinders: against closed forms, another integrator, and columns of oil."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from support_exudyn import (
    Body,
    Column,
    Held,
    HydraulicCylinder,
    Inlet,
    Linkage,
    Machine,
    OilColumn,
    RampedOpening,
    Result,
    Scenario,
    SimulationError,
    Slide,
    SuddenOpening,
    simulate,
)
from support_exudyn.kinetics import kinetics_of
from support_exudyn.machine import GROUND
from support_exudyn.oil import static_loads
from tests.reference.cases import FORCE, loose_support, support
from user_forces import value

MASS, GRAVITY = 16000.0, 9.81
CYLINDER = HydraulicCylinder(
    bore_area=0.098,
    rod_side_area=0.03,
    oil_length=0.5,
    rod_side_length=1.0,
    bulk_modulus=1.5e9,
    system_pressure=31.5e6,
    tank_pressure=0.5e6,
    nominal_flow=6e-3,
    hose_volume=5e-3,
    rod_side_hose_volume=3e-3,
)


@value
class Ram(Machine):
    """A ram of 16 t on one upright cylinder."""

    def linkage(self) -> Linkage:
        return Linkage(
            bodies={"ram": Body(mass=MASS, inertia=1.0, centre=(0.0, 1.6))},
            columns={"jack": Column(foot=GROUND, head="ram", foot_point=(0.0, 0.0), head_point=(0.0, 1.6))},
            slides={"guide": Slide(body="ram", point=(0.0, 1.6), direction=0.5 * math.pi)},
        )


def lift(cylinder: HydraulicCylinder, duration: float, step: float = 5e-4, record: float = 1e-3) -> Result:
    return simulate(
        Scenario(
            machine=Ram(),
            columns={"jack": cylinder},
            drive=Held(),
            duration=duration,
            step=step,
            record_period=record,
        )
    )


def opened(inlet: Inlet, **changes: Any) -> HydraulicCylinder:
    return replace(CYLINDER, inlet=inlet, **changes)


def on_cylinders(loose: bool, inlet: Inlet | None = None, **changes: Any) -> Scenario:
    cylinder = CYLINDER if inlet is None else opened(inlet)
    columns = dict.fromkeys(("front_column", "rear_column"), cylinder)
    return (loose_support if loose else support)(columns=columns, drive=Held(), **changes)


def test_a_machine_with_closed_valves_stays_where_it_is() -> None:
    result = simulate(on_cylinders(False, duration=1.0))
    for name in ("front_column", "rear_column"):
        # rounding of a length of 1.6 m, over a second; 1e-9 m was asked for
        assert np.ptp(result[f"{name}.length"]) < 1e-12
        assert np.ptp(result[f"{name}.pressure"]) < 1.0  # [Pa]
    np.testing.assert_allclose(result[FORCE], 58778.944, rtol=1e-6)  # as with rigid columns
    settled = simulate(on_cylinders(True, start="settled", duration=0.3))
    # the journal has sunk, and pressures have changed with the posture
    assert np.ptp(settled["rear_column.length"]) < 1e-10
    assert settled["rear_column.pressure"][0] != pytest.approx(result["rear_column.pressure"][0], rel=1e-6)


def test_a_blow_makes_closed_oil_ring_at_its_frequency() -> None:
    stiffness = 1.5e9 * (0.098**2 / (0.098 * 0.5 + 5e-3) + 0.03**2 / (0.03 + 3e-3))
    wanted = math.sqrt(stiffness / MASS) / (2.0 * math.pi)
    # opened for a millisecond: 0.1 mm, which changes the stiffness by 2e-4
    result = lift(opened(SuddenOpening(start=0.01, end=0.011, extent=0.5)), duration=1.0, step=1e-4)
    late = result.time > 0.05
    swing, t = (result["jack.length"] - result["jack.length"][late].mean())[late], result.time[late]
    up = np.flatnonzero((swing[:-1] < 0.0) & (swing[1:] >= 0.0))
    crossings = t[up] - swing[up] * (t[up + 1] - t[up]) / (swing[up + 1] - swing[up])
    frequency = (crossings.size - 1) / (crossings[-1] - crossings[0])
    # second order: 130 rad/s and 1e-4 s leave 2e-5; crossings between records of a millisecond a little more
    assert frequency == pytest.approx(wanted, rel=5e-4)


def test_the_speed_under_an_open_valve_and_the_pressure_after_it() -> None:
    damping, opening = 1e5, 0.6
    cylinder = opened(SuddenOpening(start=0.0, end=1.5, extent=opening), damping=damping)
    result = lift(cylinder, duration=4.0)
    wide = opening * 6e-3 / math.sqrt(1e6)

    def excess(v: float) -> float:
        piston = 31.5e6 - (v * 0.098 / wide) ** 2
        rod = 0.5e6 + (v * 0.03 / wide) ** 2
        return piston * 0.098 - rod * 0.03 - damping * v - MASS * GRAVITY

    speed = brentq(excess, 0.01, 1.0)
    rising = (result.time > 1.2) & (result.time < 1.5)
    # what rings has died out to 1e-4 of the speed
    np.testing.assert_allclose(result["ram.velocity_y"][rising], speed, rtol=1e-3)
    assert result["jack.flow"][rising].mean() == pytest.approx(speed * 0.098, rel=1e-3)
    # at rest again: the oil carries the weight, and the rod side is as much less than the tank's as the column
    # has moved on after the valve had closed
    assert result["jack.force"][-1] == pytest.approx(MASS * GRAVITY, rel=1e-3)
    closing = int(np.searchsorted(result.time, 1.5))
    pressures = [result[f"jack.{name}"][[closing, -1]] for name in ("pressure", "rod_pressure")]
    ends = result["jack.length"][[closing, -1]] - 1.6
    for pressure, volumes in zip(pressures, np.array([cylinder.volumes(e) for e in ends]).T, strict=True):
        expected = pressure[0] + 1.5e9 * math.log(volumes[0] / volumes[1])
        assert pressure[1] == pytest.approx(expected, abs=2e3)  # [Pa], of 2e6: second order in the step


@pytest.mark.parametrize(
    ("inlet", "times"),
    [
        (SuddenOpening(start=0.02, end=0.15, extent=0.8), (0.02, 0.15)),
        (RampedOpening(start=0.02, end=0.2, ramp=0.05), (0.02, 0.07, 0.15, 0.2)),
        (SuddenOpening(start=0.0, end=0.15, extent=-0.3), (0.15,)),
    ],
)
def test_pressures_and_motion_are_those_of_another_integrator_to_second_order(
    inlet: Inlet, times: tuple[float, ...]
) -> None:
    cylinder = opened(inlet, damping=5e4)
    duration, records = 0.3, np.arange(1, 31) * 0.01

    def rates(t: float, y: np.ndarray) -> list[float]:
        e, v, piston, rod = y
        o = inlet.opening(t)
        above, below = (31.5e6, 0.5e6) if o >= 0.0 else (0.5e6, 31.5e6)

        def flow(drop: float) -> float:
            return abs(o) * 6e-6 * math.copysign(math.sqrt(abs(drop)), drop)

        return [
            v,
            (piston * 0.098 - rod * 0.03 - 5e4 * v) / MASS - GRAVITY,
            1.5e9 / (0.098 * (0.5 + e) + 5e-3) * (flow(above - piston) - 0.098 * v),
            1.5e9 / (0.03 * (1.0 - e) + 3e-3) * (flow(below - rod) + 0.03 * v),
        ]

    state = np.array([0.0, 0.0, (MASS * GRAVITY + 0.5e6 * 0.03) / 0.098, 0.5e6])
    found: list[np.ndarray] = []
    for begin, end in zip((0.0, *times), (*times, duration), strict=True):
        if end == begin:
            continue
        # a tenth of a nanosecond beside the jumps, where the opening is that of the piece
        asked = records[(records > begin + 1e-9) & (records <= end + 1e-9)]
        piece = solve_ivp(
            rates, (begin + 1e-10, end), state, method="Radau", rtol=1e-10, atol=[1e-12, 1e-11, 1e-2, 1e-2],
            t_eval=np.append(asked, end) if asked.size == 0 or asked[-1] < end - 1e-9 else asked,
        )  # fmt: skip
        assert piece.success
        found += list(piece.y.T[: asked.size])
        state = piece.y[:, -1]
    wanted = np.array(found)
    names = ("jack.length", "ram.velocity_y", "jack.pressure", "jack.rod_pressure")

    def error(step: float) -> np.ndarray:
        run = lift(cylinder, duration, step=step, record=0.01)
        values = np.column_stack([run[name][1:] for name in names]) - [1.6, 0.0, 0.0, 0.0]
        return np.asarray(np.abs(values - wanted).max(axis=0) / np.ptp(wanted, axis=0))

    coarse, fine = error(2e-4), error(1e-4)
    # of what each quantity passes through; the rod side starts at the root's steepest point
    assert (fine < [4e-5, 4e-4, 3e-4, 3e-4]).all()
    # 4 for second order, as norm of all: single ones have zeros of their error
    assert 3.0 < np.linalg.norm(coarse) / np.linalg.norm(fine) < 5.5


def test_the_whole_support_on_cylinders_is_that_of_another_integrator_to_second_order() -> None:
    start, duration, names = 0.01, 0.08, ("front_column", "rear_column")
    scenario = on_cylinders(False, SuddenOpening(start=start, end=1.0, extent=0.5), duration=duration)
    linkage, n = scenario.linkage, 3 * len(scenario.linkage.bodies)
    pins = kinetics_of(linkage, rigid=())  # masses and pins by matrices; no engine
    weight, mass = pins.weight(scenario.gravity), pins.mass()
    loads = static_loads(linkage, scenario.gravity)
    pressures = [
        ((loads[name] + 0.5e6 * 0.03) / 0.098, 0.5e6)
        if loads[name] > 0.5e6 * 0.068
        else (0.5e6, (0.5e6 * 0.098 - loads[name]) / 0.03)
        for name in names
    ]

    def flow(drop: float) -> float:
        return 0.5 * 6e-6 * math.copysign(math.sqrt(abs(drop)), drop)

    def rates(t: float, y: np.ndarray) -> np.ndarray:
        q, v, p = y[:n], y[n : 2 * n], y[2 * n :]
        force, changes = weight.copy(), []
        for k, name in enumerate(names):
            column = linkage.columns[name]
            foot, foot_rate = pins.point(q, column.foot, column.foot_point)
            head, head_rate = pins.point(q, column.head, column.head_point)
            length = float(np.hypot(*(head - foot)))
            along = (head - foot) / length @ (head_rate - foot_rate)
            piston, rod = p[2 * k : 2 * k + 2]
            force += along * (0.098 * piston - 0.03 * rod)
            e, speed = length - column.start_length, float(along @ v)
            changes += [
                1.5e9 / (0.098 * (0.5 + e) + 5e-3) * (flow(31.5e6 - piston) - 0.098 * speed),
                1.5e9 / (0.03 * (1.0 - e) + 3e-3) * (flow(0.5e6 - rod) + 0.03 * speed),
            ]
        rows, h = pins.rows(q), 1e-6
        turning = (pins.rows(q + h * v) - pins.rows(q - h * v)) @ v / (2.0 * h)
        system = np.block([[np.diag(mass), rows.T], [rows, np.zeros((len(rows), len(rows)))]])
        answer = np.linalg.solve(system, np.concatenate([force, -turning]))
        return np.concatenate([v, answer[:n], changes])

    state = np.concatenate([np.zeros(2 * n), *pressures])
    times = np.arange(2, 9) * 0.01
    scales = np.concatenate([np.full(n, 1e-12), np.full(n, 1e-11), np.full(4, 1e-2)])
    exact = solve_ivp(rates, (start, duration), state, method="LSODA", rtol=1e-10, atol=scales, t_eval=times)
    assert exact.success

    def error(step: float) -> float:
        run = simulate(replace(scenario, step=step, record_period=0.01))
        found = np.array([run[f"{name}.{p}pressure"][2:] for name in names for p in ("", "rod_")])
        wanted = exact.y[2 * n :]
        return float((np.abs(found - wanted).max(axis=1) / np.ptp(wanted, axis=1)).max())

    coarse, fine = error(2e-4), error(1e-4)
    assert fine < 2e-3  # of what pressures pass through; 500 rad/s and 1e-4 s
    assert 3.0 < coarse / fine < 5.5  # 4 for second order


def test_one_closed_chamber_is_a_column_of_oil() -> None:
    tiny = 1e-9
    cylinder = replace(CYLINDER, rod_side_area=tiny, hose_volume=tiny, tank_pressure=0.0)
    oil = OilColumn(bore_area=0.098, oil_length=0.5, bulk_modulus=1.5e9, damping_time=0.0)
    runs = [
        simulate(
            loose_support(
                columns=dict.fromkeys(("front_column", "rear_column"), one), drive=Held(), duration=0.2
            )
        )
        for one in (cylinder, oil)
    ]
    for channel in ("rear_column.force", "front_column.force"):  # the pin's own has many sharp impacts
        one, other = (run[channel] for run in runs)
        swing = np.ptp(other)
        assert swing > 1e4  # the journal has fallen through its clearance
        # the stiffness of a cylinder follows its length, by 1e-3 for half a millimetre; impacts add to that
        assert np.abs(one - other).max() < 0.01 * swing


@pytest.mark.parametrize(
    "inlet", [SuddenOpening(start=0.1, end=0.3, extent=0.5), RampedOpening(start=0.1, end=0.3, ramp=0.1)]
)
def test_energy_adds_up_with_loose_pins_and_valves(inlet: Inlet) -> None:
    scenario = on_cylinders(True, inlet, duration=0.35)
    scenario = replace(scenario, solver=replace(scenario.solver, impact_steps=64))
    coarse, fine = (simulate(scenario.refined(n)) for n in (1, 2))
    # the valves turn 100 kJ into heat; impacts and pressures follow to second order
    assert fine.energy_error < 1e-4 * fine["energy.damping_loss"][-1]
    assert fine.energy_error < 0.6 * coarse.energy_error
    assert fine["rear_column.pressure"].max() == pytest.approx(coarse["rear_column.pressure"].max(), rel=0.02)


def test_a_piston_at_the_end_of_its_cylinder_stops_the_run() -> None:
    cylinder = opened(SuddenOpening(start=0.0, end=0.4), rod_side_length=0.05)
    with pytest.raises(SimulationError, match=r"jack is extended by 0\.05.*allowed: -0\.5 to 0\.05 m"):
        lift(cylinder, duration=0.5)


def test_errors_are_known_and_files_keep_cylinders(tmp_path: object) -> None:
    scenario = on_cylinders(False, SuddenOpening(start=0.01, end=0.1, extent=0.5), duration=0.05)
    result = simulate(scenario, errors=True)
    assert result.coarser is not None
    again = Result.load(result.save(f"{tmp_path}/cylinders.h5"))
    assert again.scenario == result.scenario
    np.testing.assert_array_equal(again["rear_column.pressure"], result["rear_column.pressure"])
    asked = replace(result.scenario, channels=("rear_column.pressure", "energy.balance"))
    np.testing.assert_array_equal(simulate(asked)["rear_column.pressure"], result["rear_column.pressure"])
    assert simulate(replace(scenario, accuracy=1e-2)).scenario.formulation == "redundant"
