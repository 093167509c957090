"""What the settings of the time integration do in the Exudyn formulation."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from support_exudyn import ClearancePin, CubicStep, Held, OilColumn, Result, SolverSettings, bore_area, simulate
from support_exudyn.formulations.redundant.solver.step_growth import SMOOTH
from tests.cases.run_cases import (
    CRANK_SPEED,
    FORCE,
    PIN,
    loose_support,
    paper_contact,
    slider_crank,
    support,
)
from tests.formulations.test_drop import SPEEDS, TIMES
from user_forces import Exact, InputError

INDEX_2: dict[str, object] = {"integrator": "trapezoidal", "constraint_index": 2}
OIL = OilColumn(bore_area=bore_area(0.25, number=2), oil_length=0.5, bulk_modulus=1.5e9)
ACTUATORS = {"front_column": OIL, "rear_column": OIL}


def drop(step: float = 5e-4, duration: float = 0.08, **solver: object) -> Result:
    settings = SolverSettings(**solver)
    return simulate(loose_support(drive=Held(), duration=duration, step=step, solver=settings))


def order(errors: list[float]) -> float:
    """Of convergence, from the first and the last of runs of which each has half the step of the one before."""
    return math.log2(abs(errors[0] / errors[-1])) / (len(errors) - 1)


# --- the trapezoidal rule with constraints of index 2 ---


def test_trapezoidal_drop_converges_with_second_order() -> None:
    runs = [drop(5e-4 / n, impact_steps=64 * n, **INDEX_2).onsets[PIN] for n in (1, 2, 4)]
    # the first impact is located as by the other rule: a cubic through a step of free flight
    assert runs[0][0].time == pytest.approx(TIMES[0], abs=2e-8)
    assert runs[0][0].speed == pytest.approx(SPEEDS[0], rel=1e-7)
    # impacts cut the steps unevenly, hence not 2
    assert order([run[2].speed / SPEEDS[2] - 1.0 for run in runs]) > 1.7
    assert runs[-1][2].speed == pytest.approx(SPEEDS[2], rel=2e-3)  # measured 1e-3


def rise_on_oil(step: float, **solver: object) -> Result:
    drive = CubicStep(start=0.0, end=0.5, stroke=0.1)
    settings = SolverSettings(**solver)
    return simulate(support(actuators=ACTUATORS, drive=drive, duration=0.6, step=step, solver=settings))


def test_trapezoidal_rise_on_oil_converges_with_second_order() -> None:
    fine = rise_on_oil(6.25e-5)
    runs = [rise_on_oil(step, **INDEX_2) for step in (1e-3, 5e-4)]
    # as measured at finer steps too: 1.98 and 1.95; the undamped rule has 5 N of noise below 2.5e-4 s
    for channel in ("tip.y", FORCE):
        assert order([float(np.abs(run[channel] - fine[channel]).max()) for run in runs]) > 1.8


def test_positions_drift_with_index_2() -> None:
    def closure(result: Result) -> float:
        """Largest distance [m] by which the pin of shield and canopy has come apart."""
        machine = result.scenario.machine.linkage()
        place = machine.pins["shield_canopy"]
        apart = []
        for name, point in ((place.first, place.first_point), (place.second, place.second_point)):
            body = machine.bodies[name]
            arm = np.subtract(point, body.centre)
            turn = result[f"{name}.angle"] - result[f"{name}.angle"][0]
            x = result[f"{name}.x"] + np.cos(turn) * arm[0] - np.sin(turn) * arm[1]
            y = result[f"{name}.y"] + np.sin(turn) * arm[0] + np.cos(turn) * arm[1]
            apart.append(np.array([x, y]))
        return float(np.abs(apart[1] - apart[0]).max())

    assert closure(rise_on_oil(1e-3)) < 1e-12  # index 3: rounding
    assert 1e-11 < closure(rise_on_oil(1e-3, **INDEX_2)) < 1e-8  # measured 2e-9 in the worst pin


def test_cranks_turn_with_index_2() -> None:
    machine = slider_crank(1e-3).machine
    runs = [simulate(slider_crank(1e-3, step=step, solver=SolverSettings(**INDEX_2))) for step in (4e-6, 2e-6)]
    for run in runs:
        # at constant speed the trapezoidal rule gives the angle, to Newton's tolerance
        np.testing.assert_allclose(run["crank.angle"], CRANK_SPEED * run.time, atol=1e-10)
    exact = np.array([machine.slider_position(angle) for angle in CRANK_SPEED * runs[0].time])
    # the drift of the slider is of second order
    assert order([float(np.abs(run["slider.x"] - exact).max()) for run in runs]) > 1.3
    np.testing.assert_allclose(runs[1]["slider.x"], exact, atol=1e-8)
    other = simulate(slider_crank(1e-3))
    np.testing.assert_allclose(runs[1]["crank.moment"], other["crank.moment"], atol=1e-3 * 138.5)


def test_what_index_2_cannot_do_is_refused() -> None:
    with pytest.raises(InputError, match=r"constraint_index = 2: .* generalised alpha"):
        simulate(support(duration=0.01, drive=Held(), solver=SolverSettings(constraint_index=2)))
    with pytest.raises(InputError, match=r"constraint_index = 2: front_column is rigid and moves"):
        simulate(support(solver=SolverSettings(**INDEX_2)))


# --- Newton's method ---


@pytest.mark.parametrize("rule", [{}, INDEX_2])
def test_full_newton_gives_the_same(rule: dict[str, object]) -> None:
    modified, full = drop(impact_steps=64, **rule), drop(impact_steps=64, newton="full", **rule)
    assert full.counts.jacobians == full.counts.newton_iterations
    assert full.counts.newton_iterations < modified.counts.newton_iterations
    # Newton's tolerance of 1e-8 and what the impacts make of it
    for one, other in zip(modified.onsets[PIN], full.onsets[PIN], strict=True):
        assert one.speed == pytest.approx(other.speed, rel=1e-4)


# --- nothing located ---


def test_without_locating_steps_stay_on_their_grid() -> None:
    result = drop(1e-4, locate=False)
    assert (result.counts.steps, result.counts.cut_steps) == (800, 0)


def test_without_locating_onsets_are_those_of_plain_recipes() -> None:
    runs = {step: drop(step, locate=False).onsets[PIN] for step in (2e-4, 5e-5)}
    for step, onsets in runs.items():
        # noticed up to a step late, of free fall at 10 m/s^2; interpolated by a straight line
        assert SPEEDS[0] < onsets[0].speed < SPEEDS[0] + 10.0 * step
        assert onsets[0].time == pytest.approx(TIMES[0], abs=10.0 * step**2 / SPEEDS[0])
    # and the third impact is off by what a late first one makes of it, far more than if it is located
    assert abs(runs[2e-4][2].speed / SPEEDS[2] - 1.0) > 0.1


# --- steps that grow ---


def rise(growth: float) -> Result:
    """A rise that begins when the pin has come to rest, which a restitution of 0.1 lets it do soon."""
    contact = paper_contact(1.5, 0.0)
    normal = Exact(stiffness=contact.normal.stiffness, restitution=0.1)
    pin = ClearancePin(contact=replace(contact, normal=normal))
    solver = SolverSettings(growth=growth, impact_steps=128)
    drive = CubicStep(start=0.5, end=2.5)
    return simulate(support(pins={PIN: pin}, drive=drive, duration=1.1, solver=solver))


def test_steps_that_grow_save_steps_and_cost_no_accuracy() -> None:
    plain, grown = rise(1.0), rise(16.0)
    assert grown.counts.steps < plain.counts.steps - 400  # measured 524
    assert grown.onsets == plain.onsets
    np.testing.assert_allclose(grown.time, plain.time, rtol=0.0, atol=1e-15)
    late = plain.time > 0.3
    # of 60 kN; vibrations of SMOOTH of the load may be lost
    np.testing.assert_allclose(grown[FORCE][late], plain[FORCE][late], atol=SMOOTH * plain[FORCE].max())
    np.testing.assert_allclose(grown["tip.y"], plain["tip.y"], atol=SMOOTH * 1.5e-4)  # of the depth
    assert grown.energy_error < 1.5 * plain.energy_error


def test_records_inside_a_step_lie_on_the_motion() -> None:
    drive = CubicStep(start=0.0, end=2.0)
    runs = [
        simulate(support(drive=drive, duration=1.0, step=1e-3, solver=SolverSettings(growth=growth)))
        for growth in (1.0, 8.0)
    ]
    plain, grown = runs
    assert grown.counts.steps < 0.6 * plain.counts.steps
    for channel in ("tip.y", "rear_link.angular_velocity"):
        largest = np.abs(plain[channel]).max()
        # second order at steps up to 8 ms of a motion of 1 s
        np.testing.assert_allclose(grown[channel], plain[channel], atol=1e-5 * largest)
    # a change of the step disturbs accelerations by less than what it takes to let steps shrink
    channel = "rear_link.angular_acceleration"
    np.testing.assert_allclose(grown[channel], plain[channel], atol=SMOOTH * 9.81)
