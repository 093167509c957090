"""What is close to a reference, by tolerances and by errors."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from support_exudyn import InputError, Result, simulate
from support_exudyn.files.series.named_series import NamedSeries
from support_exudyn.postprocessing.comparing.in_tests import closeness
from support_exudyn.postprocessing.comparing.tables import faults
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
        (Estimate(1.05, 0.04, "N"), Estimate(1.0, 0.1, "N"), None, "within", 0.05),
        (Estimate(1.15, 0.04, "N"), Estimate(1.0, 0.1, "N"), None, "not within", 0.15),
        (Estimate(1500.0, 1.0, "N"), Estimate(1.5, 1e-3, "kN"), None, "within", 0.0),
        (Estimate(1.1, math.inf, "N"), Estimate(1.0, 0.1, "N"), None, "not decided", 0.1),
        # a share is of a number's reference
        (1.019, 1.0, 0.02, "within", 0.019),
        (1.021, 1.0, "2 %", "not within", 0.021),
        (1e-9, 0.0, 0.01, "not within", 1e-9),
        (Estimate(0.0015, 0.0, "m"), 0.0017, "0.3 mm", "within", 2e-4),
        (Estimate(0.0015, 0.0, "m"), 0.0017, "0.1 mm", "not within", 2e-4),
        # an error that is larger than the tolerance decides nothing, unless the difference is larger still
        (Estimate(1.0, 0.5, "N"), 1.1, 0.2, "not decided", 0.1),
        (Estimate(9.0, 0.5, "N"), 1.1, 0.2, "not within", 7.9),
        # a share is of a curve's range
        (curve(OFF), curve(SINE), "2 %", "not within", 0.05),
        (curve(OFF), curve(SINE), "3 %", "within", 0.05),
        (curve(OFF), curve(1e-3 * SINE, "m"), "51 um", "within", 0.05),
        (curve(FINE**2, time=FINE), curve(TIME**2), 1e-4, "within", 0.0),
        # where the reference has no value there is nothing to compare with
        (curve(TIME**2), curve(HOLES), 1e-4, "within", 0.0),
        (curve(HOLES), curve(TIME**2), 1e-4, "not decided", 0.0),
    ],
)
def test_what_is_close(now: Any, was: Any, allowed: float | str | None, verdict: str, apart: float) -> None:
    (one,) = closeness(now, was, allowed)
    assert one.verdict == verdict
    assert bool(faults(one)) == (verdict != "within")
    assert one.largest.value == pytest.approx(apart, abs=1e-12)


@pytest.mark.parametrize(
    ("now", "was", "allowed", "said"),
    [
        (Estimate(1.0, 0.1, "N"), Estimate(1.0, 0.1, "m"), None, "cannot be given in"),
        (1.0, 1.0, None, "no numerical error is known"),
        (curve(TIME), curve(TIME, None), 0.1, "gives no unit"),
        (curve(TIME), 1.0, 0.1, "is a curve beside a number"),
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
