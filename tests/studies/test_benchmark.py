"""Speed against accuracy: programs of others have our pin forces; what is told of times and errors."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from studies.benchmarking import trade
from studies.benchmarking.peers.in_scipy import run_lsoda
from studies.benchmarking.peers.on_exudyn import run_stock
from studies.benchmarking.peers.plain_support import PeerRun
from studies.benchmarking.trade import ONCE, OURS_COMPILED, PROGRAMS, STOCK, TradePoint, cheapest
from studies.common.options import Options
from support_exudyn import CubicStep, Held, Result, SolverSettings, simulate
from support_exudyn.scenario.scenario import Scenario
from tests.at_once import at_once
from tests.cases.run_cases import PIN, loose_slider_crank, loose_support
from user_forces import InputError

Peer = Callable[[Scenario], PeerRun]
PEERS = {"stock recipe": (run_stock, 1e-5), "LSODA": (run_lsoda, 1e-9)}
DROP = loose_support(drive=Held(), duration=0.045)
POINTS = [
    TradePoint(OURS_COMPILED, "standard", 0.5, 1e-8),
    *(TradePoint(OURS_COMPILED + ONCE, label, 0.05, 1e-5) for label in PROGRAMS[OURS_COMPILED + ONCE].settings),
    *(TradePoint(STOCK, label, 2.0, 0.1) for label in PROGRAMS[STOCK].settings),
]


@pytest.fixture(params=PEERS)
def peer(request: pytest.FixtureRequest) -> Peer:
    run, setting = PEERS[request.param]
    return lambda scenario: run(scenario, setting)


def exact(scenario: Scenario) -> Result:
    return simulate(replace(scenario, formulation="compiled", solver=SolverSettings(tolerance=1e-11)))


def mean(run: PeerRun, begin: float) -> tuple[float, float]:
    """Mean and standard deviation of the force from a time [s] on."""
    inside = run.time > begin
    time = np.concatenate([[begin], run.time[inside]])
    series = np.concatenate([[np.interp(begin, run.time, run.force)], run.force[inside]])
    average = float(np.trapezoid(series, time) / np.ptp(time))
    return average, float(np.sqrt(np.trapezoid((series - average) ** 2, time) / np.ptp(time)))


def test_a_journal_drops_alike(peer: Peer) -> None:
    run, ours = peer(DROP), exact(DROP)
    begins = np.flatnonzero((run.force[1:] > 0.0) & (run.force[:-1] == 0.0)) + 1
    assert len(begins) == 2
    for place, onset in zip(begins, ours.onsets[PIN], strict=True):
        # between the ends of two steps
        assert run.time[place - 1] - 2e-6 < onset.time < run.time[place] + 2e-6
    assert mean(run, 0.0)[0] == pytest.approx(ours.window(f"pin.{PIN}.force", 0.0).mean, rel=1e-3)


def test_columns_follow_the_drive_and_friction_acts(peer: Peer) -> None:
    scenario = loose_support(1.5, 0.25, drive=CubicStep(stroke=0.05, start=0.01, end=0.11), duration=0.06)
    run, ours = peer(scenario), exact(scenario)
    average, spread = mean(run, 0.03)
    force = ours.window(f"pin.{PIN}.force", 0.03)
    assert average == pytest.approx(force.mean, rel=1e-3)
    assert spread == pytest.approx(force.std, rel=2e-3)
    assert run.force.max() == pytest.approx(ours.largest_force[PIN], rel=2e-3)


@pytest.mark.parametrize(
    ("scenario", "allowed"),
    [
        (loose_slider_crank(8e-4), "HydraulicSupport"),
        (replace(DROP, start="settled"), "concentric"),
        (replace(DROP, dimensions=3), "plane"),
    ],
)
def test_what_is_not_covered_is_refused(scenario: Scenario, allowed: str, peer: Peer) -> None:
    with pytest.raises(InputError, match=allowed):
        peer(scenario)


def test_errors_are_distances_from_a_tight_run() -> None:
    reference = trade.exact_force()
    assert reference.value == pytest.approx(444589.8641, rel=2e-8)
    assert reference.error < 1e-8 * reference.value  # measured: 1e-10


@pytest.mark.parametrize(
    ("errors", "best"),
    [((1e-2, 1e-4, 1e-5), 1e-4), ((1e-4, 1e-2, 1e-5), 1e-5), ((1e-4, 1e-5, 1e-2), None), ((), None)],
)
def test_the_cheapest_setting_is_good_and_all_finer_ones_too(
    errors: tuple[float, ...], best: float | None
) -> None:
    points = [TradePoint(STOCK, f"{error:g}", 1.0, error) for error in errors]
    chosen = cheapest(points, STOCK)
    assert (chosen.error if chosen else None) == best


def test_the_study_and_the_command_write_table_and_figure(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(trade, "measured", lambda with_slow=False: iter(POINTS))
    chapter = trade.SpeedAccuracy(Options(tmp_path, at_once())).write()
    assert [picture.stem for picture in chapter.pictures] == [trade.FIGURE]
    assert "takes 50 ms compiled" in chapter.answer
    numbers = json.loads((tmp_path / "summary.json").read_text("utf-8"))["numbers"]
    assert len(numbers) == 1 + len(chapter.sheets[0].rows) == 1 + len(POINTS)
    assert all(number["numerical_error"] > 0.0 for number in numbers)
    assert trade.benchmark(out=tmp_path / "table") == 0
    assert f"| {STOCK} | step 0.2 ms | 2 | 1.0e-01 |" in (tmp_path / "table" / "RESULTS.md").read_text("utf-8")
    assert (tmp_path / "table" / f"{trade.FIGURE}.png").stat().st_size > 10_000
