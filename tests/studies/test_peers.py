"""Programs of others, short: all have the pin forces of our own runs of the same scenes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest

from studies.benchmarking.peers.in_drake import run_drake
from studies.benchmarking.peers.in_mujoco import run_mujoco
from studies.benchmarking.peers.in_scipy import run_lsoda
from studies.benchmarking.peers.on_exudyn import Evaluator, run_connector, run_stock
from studies.benchmarking.peers.plain_support import PeerRun
from studies.benchmarking.yardstick import YardstickError, compiled, run_yardstick
from support_exudyn import CubicStep, Held, Result, SolverSettings, simulate
from support_exudyn.scenario.scenario import Scenario
from tests.cases.run_cases import PIN, loose_slider_crank, loose_support
from user_forces import InputError


class Peer(NamedTuple):
    """A program and its setting."""

    run: Callable[[Scenario, float], PeerRun]
    setting: float
    package: str = ""


PEERS = {
    "stock recipe": Peer(run_stock, 1e-5),
    "MuJoCo": Peer(run_mujoco, 1e-5, "mujoco"),
    "Drake": Peer(run_drake, 1e-6, "pydrake"),
    "LSODA": Peer(run_lsoda, 1e-9),
}


@pytest.fixture(params=PEERS)
def peer(request: pytest.FixtureRequest) -> Peer:
    found = PEERS[request.param]
    if found.package:
        pytest.importorskip(found.package, reason=f"{found.package} is not installed")
    return found


def drop() -> Scenario:
    return loose_support(drive=Held(), duration=0.045)


def exact(scenario: Scenario) -> Result:
    return simulate(replace(scenario, formulation="compiled", solver=SolverSettings(tolerance=1e-11)))


def mean(found: PeerRun, begin: float) -> tuple[float, float]:
    """Mean and standard deviation of the force from a time [s] on."""
    inside = found.time > begin
    time = np.concatenate([[begin], found.time[inside]])
    series = np.concatenate([[np.interp(begin, found.time, found.force)], found.force[inside]])
    average = float(np.trapezoid(series, time) / np.ptp(time))
    return average, float(np.sqrt(np.trapezoid((series - average) ** 2, time) / np.ptp(time)))


def test_a_journal_drops_alike(peer: Peer) -> None:
    found, ours = peer.run(drop(), peer.setting), exact(drop())
    begins = np.flatnonzero((found.force[1:] > 0.0) & (found.force[:-1] == 0.0)) + 1
    assert len(begins) == 2
    for place, onset in zip(begins, ours.onsets[PIN], strict=True):
        # between the ends of two steps
        assert found.time[place - 1] - 2e-6 < onset.time < found.time[place] + 2e-6
    assert mean(found, 0.0)[0] == pytest.approx(ours.window(f"pin.{PIN}.force", 0.0).mean, rel=1e-3)
    assert found.largest == found.force.max()


def test_columns_follow_the_drive_and_friction_acts(peer: Peer) -> None:
    scenario = loose_support(1.5, 0.25, drive=CubicStep(stroke=0.05, start=0.01, end=0.11), duration=0.06)
    found, ours = peer.run(scenario, peer.setting), exact(scenario)
    average, spread = mean(found, 0.03)
    force = ours.window(f"pin.{PIN}.force", 0.03)
    assert average == pytest.approx(force.mean, rel=1e-3)
    assert spread == pytest.approx(force.std, rel=2e-3)
    assert found.largest == pytest.approx(ours.largest_force[PIN], rel=2e-3)


@pytest.mark.parametrize("contact", ["function", "joint"])
def test_our_connector_moves_the_support_as_the_built_in_contact_does(contact: Evaluator) -> None:
    (_, built_in), (_, ours) = (run_connector(drop(), 1e-5, one) for one in ("built_in", contact))
    # of places that the fall moves by 1.5 mm; the engine's contact sees the impact a step later
    assert np.abs(ours - built_in).max() < 1e-6


def test_the_program_in_c_integrates_the_same_machine() -> None:
    scenario = loose_support(1.5, 0.25)
    try:
        with compiled() as program:
            found = run_yardstick(scenario, 1e-9, program=program, runs=1)
    except YardstickError as error:
        pytest.skip(str(error))  # no C compiler
    ours = exact(scenario)
    assert found.mean == pytest.approx(ours[f"pin.{PIN}.force"][ours.time >= 3.0].mean(), rel=1e-7)
    assert found.onsets[2].speed == pytest.approx(ours.onsets[PIN][2].speed, rel=1e-6)


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
