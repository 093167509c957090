"""What the fixtures do: runs that are kept, closeness to a reference, baselines of tests."""

from __future__ import annotations

import math
import os
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from support_exudyn import Failure, InputError, Result, SimulationError, simple_scenario, simulate
from support_exudyn.files.series.named_series import NamedSeries
from support_exudyn.postprocessing.comparing import in_tests
from support_exudyn.postprocessing.comparing.in_tests import (
    against_baseline,
    baseline_path,
    cached_run,
    closeness,
)
from support_exudyn.postprocessing.export.tables import to_hdf5
from support_exudyn.postprocessing.pytest_plugin import AssertClose, SimulateCached
from support_exudyn.simulation.estimate import Estimate
from tests.postprocessing.baselines.scenes import rocker

TIME = np.linspace(0.0, 1.0, 101)


@pytest.fixture(scope="module")
def run(simulate_cached: SimulateCached) -> Result:
    return simulate_cached(rocker())


def curve(
    values: np.ndarray, unit: str | None = "mm", name: str = "tip.x", time: np.ndarray = TIME
) -> NamedSeries:
    return NamedSeries(name, unit, time, values)


# --- numbers and curves ---

SINE = np.sin(2.0 * math.pi * TIME)
OFF = SINE + 0.05 * (np.arange(TIME.size) == 30)
HOLES = np.where(np.arange(TIME.size) == 5, math.nan, TIME**2)
FINE = np.linspace(0.0, 1.0, 1001)


@pytest.mark.parametrize(
    ("now", "was", "allowed", "verdict", "apart"),
    [
        # without a tolerance both errors are allowed
        (Estimate(1.05, 0.04, "N"), Estimate(1.0, 0.1, "N"), None, "agrees", 0.05),
        (Estimate(1.15, 0.04, "N"), Estimate(1.0, 0.1, "N"), None, "differs", 0.15),
        (Estimate(1500.0, 1.0, "N"), Estimate(1.5, 1e-3, "kN"), None, "agrees", 0.0),
        (Estimate(1.1, math.inf, "N"), Estimate(1.0, 0.1, "N"), None, "not decided", 0.1),
        # a share is of a number's reference
        (1.019, 1.0, 0.02, "differs within tolerance", 0.019),
        (1.021, 1.0, "2 %", "differs", 0.021),
        (1e-9, 0.0, 0.01, "differs", 1e-9),
        (Estimate(0.0015, 0.0, "m"), 0.0017, "0.3 mm", "differs within tolerance", 2e-4),
        # an error that is larger than the tolerance decides nothing, unless the difference is larger still
        (Estimate(1.0, 0.5, "N"), 1.1, 0.2, "not decided", 0.1),
        (Estimate(0.5, 1.1, "N"), 0.0, "1 N", "not decided", 0.5),  # it could be 1.6
        (Estimate(3.0, 1.1, "N"), 0.0, "1 N", "differs", 3.0),  # it is 1.9 at least
        (Estimate(1.0, 0.0, "N"), 0.0, "1 N", "differs within tolerance", 1.0),
        (Estimate(math.nan, 0.0, "N"), 0.0, "1 N", "not decided", math.nan),
        # a share is of a curve's range
        (curve(OFF), curve(SINE), "2 %", "differs", 0.05),
        (curve(OFF), curve(SINE), "3 %", "differs within tolerance", 0.05),
        (curve(FINE**2, time=FINE), curve(TIME**2), 1e-4, "agrees", 0.0),
        # where the reference has no value there is nothing to compare with
        (curve(TIME**2), curve(HOLES), 1e-4, "differs within tolerance", 0.0),
        (curve(HOLES), curve(TIME**2), 1e-4, "not decided", 0.0),
    ],
)
def test_what_is_close(now: Any, was: Any, allowed: float | str | None, verdict: str, apart: float) -> None:
    (one,) = closeness(now, was, allowed)
    assert one.verdict == verdict
    assert bool(one.faults) == (verdict in ("differs", "not decided"))
    assert one.largest.value == pytest.approx(apart, abs=1e-12, nan_ok=True)


@pytest.mark.parametrize(
    ("now", "was", "allowed", "said"),
    [
        (Estimate(1.0, 0.1, "N"), Estimate(1.0, 0.1, "m"), None, "cannot be given in"),
        (1.0, 1.0, None, "no numerical error is known"),
        (curve(TIME), curve(TIME, None), 0.1, "gives no unit"),
        (curve(TIME), 1.0, 0.1, "a curve cannot be compared with a number"),
        (1.0, {"a": 1.0}, 0.1, "cannot be compared; allowed:"),
        ("a text", 1.0, 0.1, "allowed:"),
        *((1.0, 1.0, bad, "allowed:") for bad in ("", "2", "-1 %", "2 bananas", -0.1, math.nan, True, [1])),
    ],
)
def test_what_cannot_be_compared_is_refused(now: Any, was: Any, allowed: Any, said: str) -> None:
    with pytest.raises(InputError, match=said):
        closeness(now, was, allowed)


# --- runs ---


def test_a_run_is_close_to_one_with_other_steps(
    run: Result, simulate_cached: SimulateCached, assert_close: AssertClose
) -> None:
    other = simulate_cached(rocker(), accuracy=5e-6)
    assert_close(other, run)
    assert_close(run.numbers()["pin.B.force.mean"], other.numbers()["pin.B.force.mean"])
    heavier = simulate(replace(rocker(), gravity=(0.0, -9.82)))
    with pytest.raises(AssertionError, match=r"at \S+ s, where the reference is "):
        assert_close(heavier, run)
    with pytest.raises(AssertionError, match=r"pin\.B\.\S+: "):
        assert_close(heavier, run, channels=["pin.B.*"])


def test_a_run_beside_numbers_and_curves_by_name(run: Result, assert_close: AssertClose) -> None:
    force, x = run.numbers()["pin.B.force.mean"], run["middle.x"]
    reference = {"pin.B.force.mean": force.value, "middle.x": curve(1e3 * x, "mm", "middle.x", run.time)}
    assert_close(run, reference, 1e-6)
    assert_close(run, {"pin.B.onset_1.speed": run.onsets["B"][0].speed}, 1e-6)
    with pytest.raises(AssertionError, match=r"force\.mean"):
        assert_close(run, {"pin.B.force.mean": 1.01 * force.value}, 1e-3)
    with pytest.raises(InputError, match="no such channel or number"):
        assert_close(run, {"pin.B.force.median": 1.0}, 1e-3)


def test_a_run_beside_files(run: Result, assert_close: AssertClose, tmp_path: Path) -> None:
    run.save(tmp_path / "run.h5")
    assert_close(run, tmp_path / "run.h5")
    rows = "".join(f"{t},{1e3 * x:.4f}\n" for t, x in zip(run.time, run["middle.x"], strict=True))
    (tmp_path / "measured.csv").write_text(f"time_s,middle.x_mm\n{rows}", "utf-8")
    assert_close(run, tmp_path / "measured.csv", "0.001 mm")
    with pytest.raises(AssertionError, match=r"middle\.x: "):
        assert_close(run, tmp_path / "measured.csv", "1e-6 mm")
    (channels,) = to_hdf5(run, tmp_path / "channels.h5")
    assert_close(run, channels, 1e-6, channels=["middle.*"])  # channels alone, also called .h5


@pytest.mark.parametrize("bad", [None, "no_file.csv", {}, 1.0, [1.0]])
def test_what_is_no_reference_is_refused(bad: object, run: Result) -> None:
    with pytest.raises(InputError, match=r"no such channel or number .*; did you mean 'pin\.B\.force'"):
        closeness(run, {"pin.B.forc": 1.0}, 0.1)
    with pytest.raises((InputError, FileNotFoundError), match="allowed:"):
        closeness(run, bad, 0.1)  # type: ignore[arg-type]


# --- baselines of tests ---

FORCE = Estimate(100.0, 0.1, "N")
LARGER = Estimate(100.3, 0.1, "N")


def compared(item: object, folder: Path, *updated: str, name: str = "test_it.test_force") -> tuple[str, bool]:
    return against_baseline(item, baseline_path(folder / "test_it.py", name), updated)


def test_only_what_is_named_is_written(tmp_path: Path) -> None:
    path = tmp_path / "baseline" / "test_it.test_force.json"
    assert compared(FORCE, tmp_path, "another.*")[1] is False
    assert not path.exists()
    assert compared(FORCE, tmp_path, "test_it.*")[1] is True
    first = path.read_bytes()
    assert compared(Estimate(100.15, 0.1, "N"), tmp_path, "*") == ("", False)  # within both errors
    report, written = compared(LARGER, tmp_path)
    assert (path.read_bytes(), written) == (first, False)
    assert "100.3 N, where the reference is 100, differs by" in report
    assert compared(LARGER, tmp_path, "test_it.test_force")[1]
    assert compared(LARGER, tmp_path) == ("", False)


def test_only_results_and_numbers_with_errors_are_kept(simulate_cached: SimulateCached, tmp_path: Path) -> None:
    assert compared({"a": FORCE, "b": LARGER}, tmp_path, "*", name="one[x/y]")[1]
    assert (tmp_path / "baseline" / "one_x_y.json").exists()
    for item in (1.0, {"a": 1.0}, None):
        with pytest.raises(InputError, match="cannot be a baseline; allowed:"):
            compared(item, tmp_path, name="other")
    plain = simulate_cached(replace(rocker(0.002), accuracy=None))
    with pytest.raises(InputError, match=r"has no numerical errors, .*; allowed: a run with an accuracy"):
        compared(plain, tmp_path)


# --- runs that are kept ---

SCENE = simple_scenario(
    "crank_rocker", duration_s=0.01, drives={"crank": {"type": "Steady", "rate_rad_per_s": 60}}
)


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> list[object]:
    """What was simulated; a scene of 1 s fails."""
    scenarios: list[object] = []
    simulate = in_tests.simulate

    def counted(scenario: Any, **more: bool) -> object:
        if scenario.duration == 1.0:
            raise SimulationError(Failure("stuck", "take shorter steps", 0.1))
        scenarios.append(scenario)
        return simulate(scenario, **more)

    monkeypatch.setattr(in_tests, "simulate", counted)
    return scenarios


def test_a_run_is_made_once(made: list[object], tmp_path: Path) -> None:
    first, again = (cached_run(tmp_path, SCENE) for _ in range(2))
    assert len(made) == 1
    assert all(np.array_equal(first[name], again[name]) for name in first.channels)
    with_errors = cached_run(tmp_path, SCENE, errors=True)
    assert (len(made), with_errors.coarser is not None, first.coarser) == (2, True, None)
    for path in tmp_path.glob("*.h5"):
        os.utime(path, (0.0, 0.0))
    cached_run(tmp_path, replace(SCENE, duration=0.005))
    assert len(list(tmp_path.glob("*.h5"))) == 1  # old runs are removed


def test_who_asks_for_the_same_waits_and_a_run_that_fails_is_not_kept(
    made: list[object], tmp_path: Path
) -> None:
    with pytest.raises(SimulationError, match="stuck"):
        cached_run(tmp_path, replace(SCENE, duration=1.0))
    assert list(tmp_path.glob("*.h5")) == []  # and nothing is locked
    with ThreadPoolExecutor(3) as pool:
        runs = list(pool.map(lambda _: cached_run(tmp_path, SCENE), range(3)))
    assert (len(runs), len(made)) == (3, 1)
