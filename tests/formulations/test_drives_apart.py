"""Parts of one machine that follow different drives: kinematics, impulses, energy, and both formulations."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import root

from support_exudyn import CubicStep, Held, OilColumn, Result, UniformSpeed, bore_area, simulate
from support_exudyn.files.machines import reference_support
from support_exudyn.postprocessing.pytest_plugin import SimulateCached
from tests.cases.run_cases import FORCE, loose_support, support

FRONT = CubicStep(stroke=0.12, start=0.05, end=0.45)
REAR = CubicStep(stroke=-0.03, start=0.15, end=0.35)
OIL = OilColumn(bore_area=bore_area(0.25, number=2), oil_length=0.5, bulk_modulus=1.5e9)


@pytest.fixture(scope="module")
def apart(simulate_cached: SimulateCached) -> Result:
    return simulate_cached(support(drive=FRONT, drives={"rear_column": REAR}, duration=0.5, step=1e-3))


def test_actuators_driven_apart_bring_the_support_where_their_lengths_say(apart: Result) -> None:
    machine = reference_support()
    start = machine.start()
    before = np.array(machine.column_lengths(start))
    turns = np.array([start.rear_link, start.canopy])
    for n in range(0, 501, 25):
        t = float(apart.time[n])
        wanted = before + np.array([FRONT.extension(t), REAR.extension(t)])

        def misfit(trial: np.ndarray, wanted: np.ndarray = wanted) -> np.ndarray:
            posture = machine.posture(*trial.tolist())
            assert posture is not None
            return np.array(machine.column_lengths(posture)) - wanted

        turns = root(misfit, turns, tol=1e-14).x
        posture = machine.posture(*turns.tolist())
        assert posture is not None
        # both solve the same closed loops: Newton's tolerance of 1e-8 on lengths of 3 m
        np.testing.assert_allclose([apart["tip.x"][n], apart["tip.y"][n]], posture.tip, atol=1e-8)
        turned = apart["rear_link.angle"][n] - apart["rear_link.angle"][0]
        assert turned == pytest.approx(posture.rear_link - start.rear_link, abs=1e-8)


def test_energy_adds_up_where_actuators_are_driven_apart(apart: Result) -> None:
    assert apart["energy.work"].max() > 500.0
    # Each by its own force and speed. At a break of one drive the force on the other, which moves, jumps, and
    # overshoots for some of the refined steps after it: 6e-5 at 1 ms, of first order in the step
    assert apart.energy_error < 1e-4 * apart["energy.work"].max()
    finer = simulate(apart.scenario.refined())
    assert finer.energy_error < 0.6 * apart.energy_error


def test_a_part_that_is_told_the_same_drive_changes_nothing(apart: Result) -> None:
    told = {"front_column": FRONT, "rear_column": FRONT}
    one = simulate(support(drive=FRONT, duration=0.1))
    other = simulate(support(drive=Held(), drives=told, duration=0.1))
    for name in one.channels:
        np.testing.assert_array_equal(one[name], other[name])  # the same numbers in the same order


def test_a_jump_of_one_actuator_strikes_the_other_too() -> None:
    drive = UniformSpeed(stroke=0.05, start=0.1, end=0.3)
    result = simulate(support(drives={"front_column": drive}, duration=0.2))
    (impulse,) = result.impulses
    # only the front column moves, and so only its impulse does work: the impulse times half the speed; rounding
    assert impulse.energy == pytest.approx(0.5 * 0.25 * impulse.actuators["front_column"], rel=1e-9)
    assert abs(impulse.actuators["rear_column"]) > 1.0
    np.testing.assert_allclose(result["rear_column.length"], result["rear_column.length"][0], atol=1e-11)
    # a step after the jump is known by its end only: second order of the step, of 40 J
    assert result.energy_error < 1e-3 * impulse.energy


def test_a_jump_of_an_oil_column_strikes_nothing() -> None:
    drive = UniformSpeed(stroke=0.05, start=0.1, end=0.3)
    result = simulate(
        support(drives={"front_column": drive}, actuators={"front_column": OIL}, duration=0.15, step=1e-4)
    )
    assert result.impulses == ()
    assert result.energy_error < 1e-3 * result["energy.work"][-1]  # as above


def test_breaks_of_all_drives_are_met() -> None:
    scenario = support(drive=FRONT, drives={"rear_column": REAR}, duration=0.5)
    assert scenario.breaks == (0.05, 0.15, 0.35, 0.45)
    assert scenario.drive_of("front_column") == FRONT
    assert scenario.drive_of("rear_column") == REAR


def test_the_compiled_formulation_follows_the_drives_too() -> None:
    scene = {
        "drive": FRONT,
        "drives": {"rear_column": REAR},
        "actuators": {"front_column": OIL, "rear_column": OIL},
        "duration": 0.22,
    }
    compiled = simulate(loose_support(formulation="compiled", **scene))
    redundant = simulate(loose_support(step=1e-4, **scene))
    # the Exudyn formulation's error of impacts and steps, as in `test_formulations_agree`
    np.testing.assert_allclose(compiled["tip.y"], redundant["tip.y"], atol=2e-6)
    np.testing.assert_allclose(
        compiled["energy.work"], redundant["energy.work"], atol=1e-3 * compiled["energy.work"].max()
    )
    mean = [run[FORCE][run.time > 0.15].mean() for run in (compiled, redundant)]
    assert mean[0] == pytest.approx(mean[1], rel=1e-3)
