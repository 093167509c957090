"""What is close to a reference, by tolerances and by errors."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import InputError, Result, simulate
from support_exudyn.files.series.named_series import NamedSeries
from support_exudyn.postprocessing.comparing.baselines import said_apart
from support_exudyn.postprocessing.comparing.closeness import Closeness, closeness, difference_figure
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


def only(found: list[Closeness]) -> Closeness:
    (one,) = found
    return one


# --- numbers ---


@given(value=st.floats(0.1, 1e6), off=st.floats(-3.0, 3.0), share=st.floats(1e-6, 0.5))
def test_a_share_is_of_the_reference(value: float, off: float, share: float) -> None:
    one = only(closeness(value * (1.0 + off * share), value, share))
    assert one.is_close == (abs(one.values[0] - value) <= share * value)
    assert one.ratio == pytest.approx(abs(off), abs=1e-6)


@pytest.mark.parametrize(
    ("now", "is_close"),
    [((1.05, 0.04), True), ((1.15, 0.04), False), ((1.05, 0.2), True), ((0.85, 0.04), False)],
)
def test_without_a_tolerance_both_errors_are_allowed(now: tuple[float, float], is_close: bool) -> None:
    assert only(closeness(Estimate(*now, "N"), Estimate(1.0, 0.1, "N"))).is_close is is_close


def test_units_of_numbers_are_converted() -> None:
    assert only(closeness(Estimate(1500.0, 1.0, "N"), Estimate(1.5, 1e-3, "kN"))).is_close
    assert only(closeness(Estimate(0.0015, 0.0, "m"), 0.0017, "0.3 mm")).is_close
    assert not only(closeness(Estimate(0.0015, 0.0, "m"), 0.0017, "0.1 mm")).is_close
    with pytest.raises(InputError, match="cannot be given in"):
        closeness(Estimate(1.0, 0.1, "N"), Estimate(1.0, 0.1, "m"))


def test_an_error_larger_than_the_tolerance_decides_nothing() -> None:
    one = only(closeness(Estimate(1.0, 0.5, "N"), 1.1, 0.2))
    assert (one.verdict, one.is_close) == ("not decided", False)
    assert str(one) == (
        "it: 1 N, where the reference is 1.1 N: it cannot be told whether they are close, for the numerical "
        "error is 0.5 N; allowed: 0.22 N (20 % of the value of the reference); a higher accuracy may tell"
    )
    assert only(closeness(Estimate(9.0, 0.5, "N"), 1.1, 0.2)).verdict == "not within"


def test_unknown_errors_allow_nothing() -> None:
    one = only(closeness(Estimate(1.0, math.inf, "N"), Estimate(1.0, 0.1, "N")))
    assert one.verdict == "not decided"
    assert "the numerical error is not known" in str(one)
    assert str(only(closeness(1e-9, 0.0, 0.01))) == (
        "it: 1e-09, where the reference is 0: they differ by 1e-09; allowed: 0 (1 % of the value of the "
        "reference)"
    )
    with pytest.raises(InputError, match="no numerical error is known"):
        closeness(1.0, 1.0)


# --- curves ---


def test_a_share_of_a_curve_is_of_its_range_and_the_worst_time_is_told(tmp_path: Path) -> None:
    reference = np.sin(2.0 * math.pi * TIME)
    result = reference.copy()
    result[30] += 0.05
    found = closeness(curve(result), curve(reference), "2 %")
    one = only(found)
    assert not one.is_close
    assert one.time[one.where] == pytest.approx(0.3)
    assert "at t = 0.3 s" in str(one)
    assert "they differ by 0.05 mm; allowed: 0.04 mm (2 % of the range of the reference)" in str(one)
    assert only(closeness(curve(result), curve(reference), "3 %")).is_close
    assert only(closeness(curve(result), curve(1e-3 * reference, "m"), "51 um")).is_close
    said = said_apart(found, tmp_path)
    assert (tmp_path / "tip.x.png").read_bytes().startswith(b"\x89PNG")
    assert said.endswith(f"figure: {tmp_path / 'tip.x.png'}")


def test_the_figure_shows_both_curves_and_the_difference() -> None:
    one = only(closeness(curve(TIME + 0.1), curve(TIME), "0.05 mm"))
    above, below = difference_figure(one).axes
    assert [line.get_label() for line in above.lines] == ["reference", "result"]
    assert np.asarray(below.lines[0].get_ydata()) == pytest.approx(0.1)
    assert below.get_ylabel() == "difference [mm]"


def test_times_may_be_others_and_what_is_not_known_is_left_out() -> None:
    fine = np.linspace(0.0, 1.0, 1001)
    assert only(closeness(curve(fine**2, time=fine), curve(TIME**2), 1e-4)).is_close
    holes = TIME**2
    holes[5] = math.nan
    assert only(closeness(curve(TIME**2), curve(holes), 1e-4)).is_close
    assert only(closeness(curve(holes), curve(TIME**2), 1e-4)).verdict == "not within"


def test_a_column_without_unit_is_not_guessed() -> None:
    with pytest.raises(InputError, match="gives no unit"):
        closeness(curve(TIME), curve(TIME, None), 0.1)


# --- runs ---


def test_a_run_is_close_to_one_with_other_steps(
    run: Result, simulate_cached: SimulateCached, assert_close: AssertClose
) -> None:
    other = simulate_cached(rocker(), accuracy=5e-6)
    assert_close(other, run)
    assert_close(run.numbers()["pin.B.force.mean"], other.numbers()["pin.B.force.mean"])
    heavier = simulate(replace(rocker(), gravity=(0.0, -9.82)))
    with pytest.raises(AssertionError, match=r"at t = \S+ s, where the reference is [\s\S]*figure: "):
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


@pytest.mark.parametrize("bad", ["", "2", "-1 %", "2 bananas", -0.1, math.nan, True, [1]])
def test_what_is_no_tolerance_is_refused(bad: object, run: Result) -> None:
    with pytest.raises(InputError, match="allowed:"):
        closeness(run.numbers()["pin.B.force.mean"], 1.0, bad)  # type: ignore[arg-type]


@pytest.mark.parametrize("bad", [None, "no_file.csv", {}, 1.0, [1.0]])
def test_what_is_no_reference_is_refused(bad: object, run: Result) -> None:
    with pytest.raises(InputError, match=r"no such channel or number .*; did you mean 'pin\.B\.force'"):
        closeness(run, {"pin.B.forc": 1.0}, 0.1)
    with pytest.raises((InputError, FileNotFoundError), match="allowed:"):
        closeness(run, bad, 0.1)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="allowed:"):
        closeness("a text", 1.0, 0.1)  # type: ignore[arg-type]
