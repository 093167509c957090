"""What studies share: numbers with errors in words, options, and runs at halved steps."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from studies.ladder import Ladder
from studies.study import Number, Pair, brief, options, output_folder, rounded
from support_exudyn.command_line import count
from support_exudyn.workshop import PREFIX
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


# --- halved steps ---


@dataclass(frozen=True)
class Run:
    """Stands for a result: one number."""

    value: float


def value_of(run: Any) -> float:
    return float(run.value)


@given(row=st.lists(st.integers(-1000, 1000).map(float), min_size=2, max_size=5))
def test_a_ladders_number_is_the_finest_with_its_distance_from_the_one_before(row: list[float]) -> None:
    ladder = Ladder(tuple(Run(x) for x in row))  # type: ignore[arg-type]
    number = ladder.number("force", "ideal", "N", value_of)
    assert number == Number("force", "ideal", row[-1], "N", abs(row[-1] - row[-2]))
    assert ladder.finest == Run(row[-1])


def test_the_error_of_a_ladder_of_second_order_falls_by_four() -> None:
    exact: Callable[[int], float] = lambda n: 10.0 + 3.0 / 4**n  # noqa: E731
    errors = [
        Ladder(tuple(Run(exact(n)) for n in range(last + 1))).number("x", "", "1", value_of).numerical_error  # type: ignore[arg-type]
        for last in (1, 2, 3)
    ]
    assert [a / b for a, b in pairwise(errors)] == pytest.approx([4.0, 4.0])


def test_a_pairs_number_is_the_finer_ones() -> None:
    pair = Pair(coarse=Run(3.0), fine=Run(2.5))  # type: ignore[arg-type]
    assert pair.number("force", "ideal", "N", value_of, 2.0) == Number("force", "ideal", 2.5, "N", 0.5, 2.0)


@posix_only
def test_of_hidden_files_in_its_folder_a_study_removes_those_that_are_known_for_its_own(tmp_path: Path) -> None:
    own = with_own_files(tmp_path) + with_own_files(tmp_path / "which_pin")
    left = [left_behind(tmp_path, "a"), left_behind(tmp_path / "which_pin", "b")]
    with output_folder(tmp_path):
        assert not any(path.exists() for path in left)
        left_behind(tmp_path / "which_pin" / "runs")
    assert not list(tmp_path.rglob(f"{PREFIX}abc"))
    assert all(path.read_text(encoding="utf-8") == "of the user" for path in own)
