"""What goes on for long: joints do not drift, energy stays closed, memory and forces stay as they were."""

from __future__ import annotations

import math

import numpy as np
import pytest

from studies.extremes import long_runs
from support_exudyn import Scenario, SolverSettings, Steady, simulate
from support_exudyn.formulations.compiled.run import _Run as Run
from support_exudyn.formulations.registry import formulation
from support_exudyn.scene.contract import silent
from support_exudyn.scene.motion import hold, place
from support_exudyn.scene.setup import model_of
from support_exudyn.simulation.result_checks import joints_apart
from tests.cases.run_cases import slider_crank
from tests.formulations.plain import plain
from tests.linkage_cases import CrankRocker

# share of what was turned over that is lost in the impacts of the first two seconds, at 64 steps each;
# measured: up to 1e-5
IMPACTS = 3e-5
# the same, open for every further second: steps of second order that nothing damps; measured: up to 2e-8
A_SECOND = 1e-7
# the same on oil, whose vibration after the impacts, 0.6 J, is damped by the steps alone; measured: 6e-5
VIBRATION = 1e-4


@pytest.mark.parametrize(
    "name",
    [
        long_runs.IDEAL,
        long_runs.OIL,
        *(pytest.param(name, marks=pytest.mark.slow) for name in (long_runs.SMOOTH, long_runs.DRY)),
    ],
)
def test_a_support_raised_and_lowered_for_long_neither_drifts_nor_loses_energy(name: str) -> None:
    duration = 24.0
    found = long_runs.run(long_runs.scene(name, duration))
    # measured: 4e-12 m, what Newton's method leaves open; asked for: 1e-8 m
    assert 0.0 < found.gap_first < 1e-10
    assert found.gap_last < 1e-10
    # a drift by this would take 1000 s to a hundredth of what is asked for; measured: up to 1e-14 m/s
    assert abs(found.gap_slope) < 1e-13
    if name == long_runs.OIL:
        assert found.energy_share < VIBRATION
    else:
        assert found.energy_share < IMPACTS
        assert abs(found.energy_share - found.energy_first) < A_SECOND * duration


def test_every_record_of_the_compiled_formulation_has_its_joints_closed() -> None:
    scene = Scenario(
        machine=CrankRocker(angle=0.3, speed=10.0), duration=2.0, solver=SolverSettings(tolerance=1e-9)
    )
    # within rounding; steps of this tolerance that nothing closes add up to some 1e-8 m
    assert joints_apart(scene, formulation("compiled").run(scene, silent)).max() < 3e-13


def is_table(part: object) -> bool:
    return isinstance(part, np.ndarray) and part.dtype.names is not None


def test_every_step_of_the_compiled_formulation_ends_with_its_joints_closed() -> None:
    # records close joints by themselves: here is the state that steps go on from
    scene = Scenario(
        machine=CrankRocker(angle=0.3, speed=10.0), duration=0.5, solver=SolverSettings(tolerance=1e-5)
    )
    model = model_of(scene)
    made = Run(model)
    made.go(silent)
    records = {name: part.view(np.recarray) for name, part in model.scene._asdict().items() if is_table(part)}
    arrays = model.scene._replace(**records)
    plain(place)(arrays, made.y)
    plain(hold)(arrays, made.y)
    # within rounding, as above
    assert np.abs(arrays.rows.off).max() < 3e-13


def test_what_has_come_to_rest_stays_at_rest_and_costs_little() -> None:
    result = simulate(long_runs.scene(long_runs.REST, 40.0))
    late = result.time > 20.0
    # the pin's swings fall off as long as they are damped; what is left is rounding of 6 t at 1e-13 m
    assert result["energy.kinetic"][late].max() < 1e-12
    # rounding of a depth that is the difference of places some metres from the origin
    # (the last step is half as long, and Newton's method leaves 1e-12 m after that)
    assert np.ptp(result["pin.rear_base.depth"][late][:-1]) < 1e-13
    longer = simulate(long_runs.scene(long_runs.REST, 60.0))
    # steps of 0.1 s: two records
    assert longer.counts.steps - result.counts.steps == pytest.approx(20.0 / 0.1, abs=2)


# --- angles of thousands of radians ---


def test_after_a_thousand_revolutions_a_crank_is_where_the_closed_form_says() -> None:
    rate = 2.0 * math.pi * 100.0
    # twenty steps to a revolution: at the default spectral radius of 0.5 the engine's moments lag so far behind
    # that 2.7 J of work a revolution do not add up; at 0.9 it is 0.02 J
    turning = slider_crank(
        10.0,
        drive=Steady(rate=rate),
        step=5e-4,
        record_period=0.0125,
        channels=("slider.x", "crank.angle"),
        solver=SolverSettings(spectral_radius=0.9),
    )
    result = simulate(turning)
    machine = result.scenario.machine
    last = result.time > 9.0
    wanted = [machine.slider_position(rate * t) for t in result.time[last].tolist()]
    # times near 10 s are rounded by 1e-15 s in each of the 25 steps between records, at up to 31 m/s; the angle
    # of 6283 rad by 5e-13
    assert result["slider.x"][last] == pytest.approx(wanted, abs=2e-12)
    assert result["crank.angle"][-1] == pytest.approx(rate * 10.0, abs=4e-11)
