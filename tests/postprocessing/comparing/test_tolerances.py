"""Tolerances: how they are written, what they allow, what is decided."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn.postprocessing.comparing.tolerances import (
    check_patterns,
    of_channel,
    read_tolerances,
    tolerance,
)
from support_exudyn.postprocessing.comparing.verdict import JudgedDifference, worst
from user_forces import InputError


def test_a_list_of_a_command_line_is_read() -> None:
    first, second, third = read_tolerances("pin.*.force=2%, tip.* = 0.1 mm,a=b=3e-2 m/s")
    assert (first.pattern, first.amount, first.unit, first.is_relative) == ("pin.*.force", 2.0, "%", True)
    assert (second.pattern, second.amount, second.unit) == ("tip.*", 0.1, "mm")
    assert (third.pattern, third.amount, third.unit) == ("a=b", 0.03, "m/s")


def test_what_is_allowed_is_in_si() -> None:
    force, path = read_tolerances("pin.*=2%,tip.*=0.1mm")
    assert force.in_si("pin.A.force", "N", 5e3) == 100.0
    assert path.in_si("tip.x", "m", 0.0) == pytest.approx(1e-4, rel=1e-15)
    assert read_tolerances("a=1deg")[0].in_si("a", "rad", 0.0) == pytest.approx(math.pi / 180.0)
    # a share of a reference that is constant is nothing: only what is equal is within
    assert force.in_si("pin.A.force", "N", 0.0) == 0.0


def test_an_amount_of_another_kind_is_refused() -> None:
    with pytest.raises(InputError, match=r"tolerance of tip\.x.*mm.*N"):
        tolerance("tip.*", "1 mm").in_si("tip.x", "N", 1.0)


@pytest.mark.parametrize(
    "text",
    ["", " , ", "tip", "=2%", "tip=", "tip=2", "tip=%", "tip=-2%", "tip=nan%", "tip=1e999mm", "tip=a mm"],
)
def test_what_is_no_tolerance_is_refused(text: str) -> None:
    with pytest.raises(InputError, match="allowed: "):
        read_tolerances(text)


def test_the_first_pattern_that_fits_counts() -> None:
    several = read_tolerances("pin.A.*=1N,pin.*=5N")
    assert of_channel(several, "pin.A.force") is several[0]
    assert of_channel(several, "pin.B.force") is several[1]
    assert of_channel(several, "tip.x") is None
    with pytest.raises(InputError, match=r"'pin\.A\.\*': no such channel is compared"):
        check_patterns(several, ["pin.B.force"])


@pytest.mark.parametrize(
    ("value", "error", "allowed", "verdict"),
    [
        (1.0, 0.0, 1.0, "within"),
        (1.1, 0.0, 1.0, "not within"),
        (0.5, 0.9, 1.0, "within"),
        (0.5, 1.1, 1.0, "not decided"),  # it could be 1.6
        (3.0, 1.1, 1.0, "not within"),  # it is 1.9 at least
        (0.0, 0.0, 0.0, "within"),
        (math.nan, 0.0, 1.0, "not decided"),
        (0.1, math.inf, 1.0, "not decided"),
        (9.0, 9.0, math.nan, "told"),
    ],
)
def test_errors_larger_than_what_is_allowed_leave_it_open(
    value: float, error: float, allowed: float, verdict: str
) -> None:
    assert JudgedDifference("largest difference", value, error, allowed).verdict == verdict


@given(st.floats(0.0, 1e3), st.floats(0.0, 1e3), st.floats(1e-3, 1e3), st.floats(-1.0, 1.0))
def test_a_verdict_that_is_decided_by_a_small_error_is_nearly_right(
    true: float, error: float, allowed: float, share: float
) -> None:
    seen = abs(true + share * error)
    verdict = JudgedDifference("", seen, error, allowed).verdict
    if verdict == "within":
        assert true <= 2.0 * allowed  # the error was not larger than what is allowed
    if verdict == "not within" and error > allowed:
        assert true > allowed


def test_the_worst_counts() -> None:
    assert worst([]) == "told"
    assert worst(["told", "within"]) == "within"
    assert worst(["within", "not decided", "told"]) == "not decided"
    assert worst(["not decided", "not within"]) == "not within"
