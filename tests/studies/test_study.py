"""What studies share: numbers with errors in words, options, and runs with errors."""

from __future__ import annotations

import argparse
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from studies.common.numbers import Number, brief, compared, counted, measured, rounded
from studies.common.runs import halvings, run_with_errors, save_run
from studies.common.study import options, output_folder
from support_exudyn import Result, Scenario, Steady, ravn_slider_crank
from support_exudyn.commands.command_line import count
from support_exudyn.files.temporary import PREFIX
from tests.hostile import left_behind, posix_only, with_own_files

sizes = st.floats(1e-9, 1e9)
values = sizes | sizes.map(lambda x: -x)
shares = st.floats(-12.0, 1.0).map(lambda x: 10.0**x)  # an error, of the number


def parts(text: str) -> tuple[float, float, str, str]:
    """Number and error, as numbers and as they are said."""
    value, error = text.split(" ± ")
    return float(value), float(error), value, error


# --- numbers with errors ---


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (51503.8323, 0.0088, "51503.8323 ± 0.0088"),
        (51503.8323, 255.0, "51504 ± 255"),
        (0.015271, 0.000097, "0.015271 ± 0.000097"),
        (-3.690176, 0.0123, "-3.690 ± 0.012"),
        (857942.947, 0.0, "857942.947"),
        (1.0, math.inf, "1"),
        (1.0, math.nan, "1"),
        (12.0, 1.0, "12.0 ± 1.0"),
    ],
)
def test_a_number_is_rounded_to_the_digits_that_its_error_leaves(value: float, error: float, text: str) -> None:
    assert rounded(value, error) == text


@given(value=values, share=shares)
def test_a_rounded_number_is_off_by_less_than_its_error(value: float, share: float) -> None:
    error = share * abs(value)
    said, its_error, number, of_it = parts(rounded(value, error))
    # two digits of the error are left: half of the second is at most a twentieth of it; rounding aside. Where
    # more than nine decimals would be needed, six digits of the number are said
    assert abs(said - value) <= max(
        0.0501 * error, 0.501e-5 * abs(value) if "e" in of_it else 0.0, 1e-15 * abs(value)
    )
    assert its_error == pytest.approx(error, rel=0.5 if "e" in of_it else 0.051)
    assert len(number.partition(".")[2]) <= 10


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (51503.8323, 0.0088, "51503.83 ± 0.01"),
        (51503.83, 0.0000123, "51503.83 ± 1e-05"),
        (51503.8323, 255.0, "51504 ± 255"),
        (-3.690176, 1e-9, "-3.690176 ± 1e-09"),
        (0.0, 0.0, "0"),
        (0.1234567891, 0.0, "0.1234568"),
    ],
)
def test_a_brief_number_is_short(value: float, error: float, text: str) -> None:
    assert brief(value, error) == text


@given(value=values, share=shares)
@example(value=99999.99999, share=1e-9)
@example(value=51503.8323, share=1.7e-7)
def test_a_brief_number_is_right_to_seven_digits_or_to_its_error(value: float, share: float) -> None:
    error = share * abs(value)
    said, its_error, number, _ = parts(brief(value, error))
    unit = 10.0 ** (math.floor(math.log10(abs(value))) - 6)  # of the seventh digit
    # half of it, or what the error leaves; where more than nine decimals would be needed six digits are said
    scientific = 5.01 * unit if "e" in number else 0.0
    assert abs(said - value) <= max(0.501 * unit, 0.0501 * error, scientific)
    assert abs(its_error - error) <= max(0.501 * error, 0.501 * unit)  # one digit of the error, or the seventh
    digits = number.partition("e")[0].lstrip("-0.").replace(".", "")
    integers = math.floor(math.log10(abs(value))) + 1
    assert len(digits) <= max(7, integers) + 1  # one more where rounding carries


# --- options ---


@pytest.mark.parametrize(("text", "number"), [("1", 1), ("256", 256), (" 8 ", 8)])
def test_a_count_is_a_whole_number_from_one_on(text: str, number: int) -> None:
    assert count(text) == number


@pytest.mark.parametrize("text", ["0", "-3", "1.5", "many", "", "1e3", "nan"])
def test_what_is_no_count_is_refused_with_what_is_allowed(text: str) -> None:
    with pytest.raises(argparse.ArgumentTypeError, match=r"allowed: (a whole number )?from 1 on"):
        count(text)


def test_options_have_defaults() -> None:
    plain = options("claims", [], "Text.")
    assert plain.out.parts == ("results", "claims")
    assert not plain.quick
    assert plain.machines is None
    assert isinstance(plain.workers, int)
    assert plain.workers >= 1
    given = options("claims", ["--quick", "--workers", "3", "--machines", "9", "--out", "x"], "Text.")
    assert (given.quick, given.workers, given.machines, given.out.parts) == (True, 3, 9, ("x",))


def test_no_machines_are_refused_with_the_reason(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        options("claims", ["--machines", "0"], "Text.")
    assert "--machines: 0: allowed: from 1 on" in capsys.readouterr().err


# --- runs with errors ---


@pytest.fixture(scope="module")
def runs() -> dict[str, Result]:
    stand = Scenario(machine=ravn_slider_crank(), drive=Steady(rate=100.0), duration=0.01, step=1e-3)
    cases = {"slow": stand, "fast": replace(stand, drive=Steady(rate=300.0))}
    return run_with_errors({name: replace(case, record_period=1e-3) for name, case in cases.items()}, 1)


def moment(run: Result) -> float:
    return float(np.abs(run["crank.moment"]).max())


def test_every_case_is_run_at_its_steps_at_half_and_at_a_quarter_of_them(runs: dict[str, Result]) -> None:
    for run in runs.values():
        assert [one.scenario.step for one in halvings(run)] == [1e-3, 5e-4, 2.5e-4]


def test_a_number_has_the_error_that_accuracies_estimate(runs: dict[str, Result]) -> None:
    run = runs["fast"]
    found, told = measured("moment", "fast", "N m", run, moment, 2.0), run.estimate(moment)
    assert found == Number("moment", "fast", told.value, "N m", told.error, 2.0)
    *_, before, last = map(moment, halvings(run))
    assert found.numerical_error > abs(last - before) / 3.0  # which is the error of second order itself
    assert found.value == last


@posix_only
def test_of_hidden_files_in_its_folder_a_study_removes_those_that_are_known_for_its_own(tmp_path: Path) -> None:
    own = with_own_files(tmp_path) + with_own_files(tmp_path / "which_pin")
    left = [left_behind(tmp_path, "a"), left_behind(tmp_path / "which_pin", "b")]
    with output_folder(tmp_path):
        assert not any(path.exists() for path in left)
        left_behind(tmp_path / "which_pin" / "runs")
    assert not list(tmp_path.rglob(f"{PREFIX}abc"))
    assert all(path.read_text(encoding="utf-8") == "of the user" for path in own)


def test_errors_of_both_runs_add_up_in_a_comparison(runs: dict[str, Result]) -> None:
    fast, slow = runs["fast"], runs["slow"]
    found = compared("more", "fast", "N m", fast, slow, lambda run, other: moment(run) - moment(other))
    assert found.value == moment(fast) - moment(slow)
    apart = fast.estimate(moment).error + slow.estimate(moment).error
    assert found.numerical_error == pytest.approx(apart, rel=1e-2)  # but for shares of rounding
    own = compared("more", "fast", "N m", fast, fast, lambda run, other: moment(run) - moment(other))
    assert own.value == 0.0


def test_a_count_is_off_by_as_much_as_its_coarser_runs_are(runs: dict[str, Result]) -> None:
    steps = [run.counts.steps for run in halvings(runs["slow"])]
    assert counted("steps", "slow", runs["slow"], lambda run: run.counts.steps) == Number(
        "steps", "slow", steps[-1], "1", steps[-1] - steps[0]
    )


def test_a_kept_run_has_no_coarser_ones(runs: dict[str, Result], tmp_path: Path) -> None:
    (tmp_path / "runs").mkdir()
    save_run(runs["slow"], tmp_path, "slow")
    assert Result.load(tmp_path / "runs" / "slow.h5").coarser is None
