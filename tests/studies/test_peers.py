"""Competitors, short: all find the impacts that independent solutions of the same scenes have."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from studies.benchmarking.lsoda import run_lsoda
from studies.benchmarking.peers.built_in import Evaluator, run_built_in
from studies.benchmarking.peers.in_drake import run_drake
from studies.benchmarking.peers.in_mujoco import run_limit, run_mujoco
from studies.benchmarking.peers.peer_run import PeerRun, impacts
from studies.benchmarking.peers.stock import run_stock
from studies.benchmarking.peers.tree import run_tree
from support_exudyn import Held
from support_exudyn.scenario.scenario import Scenario
from tests.cases.run_cases import loose_slider_crank, loose_support
from tests.formulations.test_drop import SPEEDS as DROP_SPEEDS
from tests.formulations.test_drop import TIMES as DROP_TIMES
from tests.formulations.test_slider_crank import SPEEDS as CRANK_SPEEDS
from tests.formulations.test_slider_crank import TIMES as CRANK_TIMES
from user_forces import InputError
from user_forces.contact_state import Onset

EVALUATORS: tuple[Evaluator, ...] = ("built_in", "python", "symbolic")
DROP_STEP, CRANK_STEP = 1e-5, 2.5e-7  # [s]


def drop() -> Scenario:
    return loose_support(drive=Held(), duration=0.045)


def crank() -> Scenario:
    return loose_slider_crank(8e-4)


def assert_drops(run: PeerRun) -> None:
    # The first flight is smooth; in its last step the bore pushes already, a relative 1e-6. After that the
    # initial impact velocity is that at the end of a step: off by up to a step times the acceleration of 10
    # m/s^2, a relative 6e-4, which is how much the damping is off; the restitution of 0.91 then by some 5e-5,
    # magnified in the next flight.
    assert len(run.onsets) == 2
    assert run.onsets[0].time == pytest.approx(DROP_TIMES[0], abs=1e-8)
    assert run.onsets[0].speed == pytest.approx(DROP_SPEEDS[0], rel=5e-6)
    assert run.onsets[1].time == pytest.approx(DROP_TIMES[1], abs=1e-6)
    assert run.onsets[1].speed == pytest.approx(DROP_SPEEDS[1], rel=5e-4)


def assert_cranks(run: PeerRun, first: float, later: float) -> None:
    assert len(run.onsets) == 3
    for n in range(3):
        enough = first if n == 0 else later
        assert run.onsets[n].time == pytest.approx(CRANK_TIMES[n], abs=1e-6 * max(enough / 1e-3, 1e-3))
        assert run.onsets[n].speed == pytest.approx(CRANK_SPEEDS[n], rel=enough)


@pytest.mark.parametrize("contact", EVALUATORS)
def test_a_journal_drops_alike(contact: Evaluator) -> None:
    assert_drops(run_built_in(drop(), DROP_STEP, contact=contact))


def test_a_journal_drops_by_the_stock_recipe() -> None:
    assert_drops(run_stock(drop(), DROP_STEP))


@pytest.mark.parametrize("contact", EVALUATORS)
def test_a_slider_crank_runs_alike(contact: Evaluator) -> None:
    # steps of an eightieth of an impact, whose force sees the impact up to a step late
    assert_cranks(run_built_in(crank(), CRANK_STEP, contact=contact), 1e-4, 2e-3)


def test_a_slider_crank_runs_in_minimal_coordinates() -> None:
    assert_cranks(run_tree(crank(), 1e-8), 1e-5, 2e-3)


def test_a_slider_crank_runs_by_scipy() -> None:
    onsets = run_lsoda(crank(), 1e-9).onsets
    assert [one.time for one in onsets] == pytest.approx(CRANK_TIMES[:3], abs=1e-9)  # their digits
    assert [one.speed for one in onsets] == pytest.approx(CRANK_SPEEDS[:3], rel=1e-6)
    assert onsets[0].separation_time < onsets[1].time


def test_a_slider_crank_runs_in_mujoco() -> None:
    pytest.importorskip("mujoco", reason="MuJoCo is not installed")
    run = run_mujoco(crank(), CRANK_STEP)
    # classical Runge-Kutta, whose force has a kink in the step of an onset or separation
    assert_cranks(run, 1e-5, 1e-5)
    assert run.user_function_calls == 4 * run.steps + 1
    np.testing.assert_allclose(run.x, run_lsoda(crank(), 1e-10).slider, rtol=0.0, atol=1e-8)


def test_the_limit_of_a_tendon_is_another_law() -> None:
    pytest.importorskip("mujoco", reason="MuJoCo is not installed")
    run = run_limit(crank(), 1e-6)
    # the flight before the first impact has no law in it; a linear spring then gives other speeds
    assert run.onsets[0].time == pytest.approx(CRANK_TIMES[0], abs=1e-9)
    assert run.onsets[0].speed == pytest.approx(CRANK_SPEEDS[0], rel=2e-3)  # a tenth of a step is in contact
    assert run.onsets[1].time == pytest.approx(CRANK_TIMES[1], abs=5e-6)
    assert run.onsets[1].speed == pytest.approx(CRANK_SPEEDS[1], rel=2e-2)
    # its restitution is that which is asked for: 0.9 of the speed beside what the machine does meanwhile
    assert run.onsets[0].separation_velocity / run.onsets[0].speed == pytest.approx(0.9, abs=0.03)


def test_a_slider_crank_runs_in_drake() -> None:
    pytest.importorskip("pydrake", reason="Drake is not installed")
    run = run_drake(crank(), 1e-7)
    assert_cranks(run, 1e-6, 1e-6)
    np.testing.assert_allclose(run.x, run_lsoda(crank(), 1e-10).slider, rtol=0.0, atol=1e-8)


def test_our_connector_makes_the_steps_of_the_built_in_contact() -> None:
    runs = {contact: run_built_in(drop(), 5e-5, contact=contact) for contact in EVALUATORS}
    built_in = runs["built_in"]
    for run in runs.values():
        assert run.steps == built_in.steps
        assert run.newton_iterations == pytest.approx(built_in.newton_iterations, rel=0.02)
        assert run.largest_force == pytest.approx(built_in.largest_force, rel=1e-4)
    assert runs["symbolic"].user_function_calls == 0
    # one evaluation a Newton iteration and one before the first
    python = runs["python"]
    assert python.user_function_calls == pytest.approx(python.newton_iterations + python.steps, rel=0.02)
    # both backends are the same connector; what rarely looks misses nothing
    one, two = (np.array(runs[name].onsets) for name in ("python", "symbolic"))
    np.testing.assert_allclose(one, two, rtol=1e-6)


def test_touches_are_those_of_the_cubic() -> None:
    # depth t - 0.35 at a rate of 1, looked at every 0.2 s
    time = np.arange(0.0, 1.1, 0.2)
    (impact,) = impacts(time.tolist(), (time - 0.35).tolist(), np.ones(time.size).tolist())
    assert impact == pytest.approx(Onset(0.35, 1.0), rel=1e-12)


def test_a_touch_ends_where_the_cubic_passes_zero_again() -> None:
    # depth (t - 0.35)(0.75 - t) at its rate, which is met exactly
    time = np.arange(0.0, 1.1, 0.2)
    depth, rate = (time - 0.35) * (0.75 - time), 1.1 - 2.0 * time
    (impact,) = impacts(time.tolist(), depth.tolist(), rate.tolist())
    assert impact == pytest.approx(Onset(0.35, 0.4, 0.75, 0.4), rel=1e-12)  # rounding
    # one that is in contact from the start on has not been in contact
    assert impacts(time[2:].tolist(), depth[2:].tolist(), rate[2:].tolist()) == ()


def test_what_is_not_covered_is_refused() -> None:
    rough = loose_support(1.5, 0.25, duration=0.01)
    with pytest.raises(InputError, match="friction"):
        run_built_in(rough, 1e-5)
    for run in (run_tree, run_lsoda):
        with pytest.raises(InputError, match="SliderCrank"):
            run(drop(), 1e-6)
    with pytest.raises(InputError, match="concentric"):
        run_stock(replace(drop(), start="settled"), 1e-5)
