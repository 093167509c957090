"""Programs of others, short: all find the impacts that independent solutions of the same scenes have."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np
import pytest

from studies.benchmarking.peers.in_drake import run_drake
from studies.benchmarking.peers.in_mujoco import run_mujoco
from studies.benchmarking.peers.in_scipy import run_lsoda
from studies.benchmarking.peers.on_exudyn import Evaluator, run_built_in, run_stock
from studies.benchmarking.peers.plain_support import PeerRun, impacts
from studies.benchmarking.yardstick import YardstickError, compiled, run_yardstick
from support_exudyn import CubicStep, Held, SolverSettings, simulate
from support_exudyn.scenario.scenario import Scenario
from tests.cases.run_cases import PIN, loose_slider_crank, loose_support
from tests.formulations.test_drop import SPEEDS, TIMES
from user_forces import InputError
from user_forces.contact_state import Onset


class Peer(NamedTuple):
    """A program, its setting, and how close the second impact has to be: its time [s] and speed."""

    run: Callable[[Scenario, float], PeerRun]
    setting: float
    time: float
    speed: float
    package: str = ""


# those with steps see an impact at the end of a step, or at zero depth of the cubic through it, whose ends the
# contact has changed already
PEERS = {
    "stock recipe": Peer(run_stock, 1e-5, 1e-6, 5e-4),
    "built-in contact": Peer(run_built_in, 1e-5, 1e-6, 5e-4),
    "user function": Peer(partial(run_built_in, contact="function"), 1e-5, 1e-6, 5e-4),
    "joint": Peer(partial(run_built_in, contact="joint"), 1e-5, 1e-6, 5e-4),
    "MuJoCo": Peer(run_mujoco, 1e-5, 1e-6, 5e-4, "mujoco"),
    "Drake": Peer(run_drake, 1e-6, 1e-6, 5e-4, "pydrake"),
    "LSODA": Peer(run_lsoda, 1e-9, 1e-7, 2e-5),
}


@pytest.fixture(params=PEERS)
def peer(request: pytest.FixtureRequest) -> Peer:
    found = PEERS[request.param]
    if found.package:
        pytest.importorskip(found.package, reason=f"{found.package} is not installed")
    return found


def drop() -> Scenario:
    return loose_support(drive=Held(), duration=0.045)


def test_a_journal_drops_alike(peer: Peer) -> None:
    first, second = peer.run(drop(), peer.setting).onsets
    assert first.time == pytest.approx(TIMES[0], abs=2e-8)
    assert first.speed == pytest.approx(SPEEDS[0], rel=1e-5)
    assert second.time == pytest.approx(TIMES[1], abs=peer.time)
    assert second.speed == pytest.approx(SPEEDS[1], rel=peer.speed)


def test_columns_follow_the_drive_and_friction_acts(peer: Peer) -> None:
    drive = CubicStep(stroke=0.05, start=0.01, end=0.11)
    scenario = loose_support(1.5, 0.25, drive=drive, duration=0.06)
    tight = SolverSettings(tolerance=1e-11)
    exact = simulate(replace(scenario, formulation="compiled", solver=tight))
    if peer in (PEERS["built-in contact"], PEERS["user function"], PEERS["joint"]):
        with pytest.raises(InputError, match="friction"):
            peer.run(scenario, peer.setting)
        return
    found = peer.run(scenario, peer.setting)
    inside = found.time > 0.03
    time = np.concatenate([[0.03], found.time[inside]])
    series = np.concatenate([[np.interp(0.03, found.time, found.force)], found.force[inside]])
    mean = np.trapezoid(series, time) / np.ptp(time)
    spread = np.sqrt(np.trapezoid((series - mean) ** 2, time) / np.ptp(time))
    force = exact.window(f"pin.{PIN}.force", 0.03)
    assert mean == pytest.approx(force.mean, rel=1e-3)
    assert spread == pytest.approx(force.std, rel=2e-3)
    assert found.force.max() == pytest.approx(exact.largest_force[PIN], rel=2e-3)


@pytest.mark.parametrize("contact", ["function", "joint"])
def test_our_connector_makes_the_steps_of_the_built_in_contact(contact: Evaluator) -> None:
    built_in, ours = (run_built_in(drop(), 5e-5, contact=one) for one in ("built_in", contact))
    assert ours.time.size == built_in.time.size
    assert ours.force.max() == pytest.approx(built_in.force.max(), rel=1e-4)


def test_the_program_in_c_integrates_the_same_machine() -> None:
    scenario = loose_support(1.5, 0.25)
    try:
        with compiled() as program:
            found = run_yardstick(scenario, 1e-9, program=program, runs=1)
    except YardstickError as error:
        pytest.skip(str(error))  # no C compiler
    tight = replace(scenario, formulation="compiled", solver=SolverSettings(tolerance=1e-11))
    exact = simulate(tight)
    assert found.mean == pytest.approx(exact[f"pin.{PIN}.force"][exact.time >= 3.0].mean(), rel=1e-7)
    assert found.onsets[2].speed == pytest.approx(exact.onsets[PIN][2].speed, rel=1e-6)


# depth t - 0.35 at a rate of 1, and (t - 0.35)(0.75 - t), both noted every 0.2 s and met by the cubic
@pytest.mark.parametrize("end", [np.inf, 0.75])
def test_impacts_are_those_of_the_cubic(end: float) -> None:
    time = np.arange(0.0, 1.1, 0.2)
    depth, rate = time - 0.35, np.ones(time.size)
    exact = Onset(0.35, 1.0)
    if end < np.inf:
        depth, rate = depth * (end - time), 1.1 - 2.0 * time
        exact = Onset(0.35, 0.4, end, 0.4)
    assert impacts(time, depth, rate) == (pytest.approx(exact, rel=1e-12),)
    assert impacts(time[2:], depth[2:], rate[2:]) == ()  # it began in contact


@pytest.mark.parametrize(
    ("scenario", "said"),
    [
        (loose_slider_crank(8e-4), "HydraulicSupport"),
        (replace(drop(), start="settled"), "concentric"),
        (replace(drop(), dimensions=3), "plane"),
    ],
)
def test_what_is_not_covered_is_refused(scenario: Scenario, said: str, peer: Peer) -> None:
    with pytest.raises(InputError, match=said):
        peer.run(scenario, peer.setting)
