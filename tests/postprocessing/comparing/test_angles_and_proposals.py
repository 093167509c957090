"""Angles that differ by full turns are equal, rates are not; proposals for curves that lag or are reversed."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from support_exudyn import compare_files
from support_exudyn.postprocessing.comparing.files_compared import read_files
from support_exudyn.postprocessing.comparing.propose import proposal
from user_forces import InputError

TIME = np.linspace(0.0, 1.0, 501)
TURNED = 540.0 * TIME  # one and a half turns [deg]
SWUNG = 170.0 + 30.0 * np.sin(9.0 * TIME)


def table(path: Path, title: str, values: np.ndarray) -> Path:
    lines = [f"{t!r},{v!r}" for t, v in zip(TIME.tolist(), values.tolist(), strict=True)]
    path.write_text("\n".join([f"time_s,{title}", *lines]), encoding="utf-8")
    return path


def wrapped(values: np.ndarray, low: float = -180.0) -> np.ndarray:
    return np.asarray((values - low) % 360.0 + low)


@pytest.mark.parametrize(
    ("first", "second", "unit", "verdict"),
    [
        (TURNED, wrapped(TURNED), "deg", "within"),
        (TURNED, wrapped(TURNED, 0.0), "deg", "within"),
        (wrapped(TURNED), wrapped(TURNED, 0.0), "deg", "within"),
        (SWUNG, wrapped(SWUNG), "deg", "within"),
        (TURNED, TURNED - 720.0, "deg", "within"),
        (TURNED, np.radians(wrapped(TURNED) + 360.0), "rad", "within"),
        (TURNED, 1.01 * TURNED, "deg", "not within"),
        (TURNED, 2.0 * TURNED, "deg", "not within"),  # apart by full turns at the end only
        (TURNED, TURNED + 180.0, "deg", "not within"),
        (TURNED, TURNED + 360.0, "deg/s", "not within"),
        (TURNED, wrapped(TURNED), "mm", "not within"),
    ],
)
def test_angles_are_compared_modulo_full_turns(
    first: np.ndarray, second: np.ndarray, unit: str, verdict: str, tmp_path: Path
) -> None:
    own = "deg" if unit == "rad" else unit
    files = (
        table(tmp_path / "one.csv", f"wheel [{own}]", first),
        table(tmp_path / "two.csv", f"wheel [{unit}]", second),
    )
    found = compare_files(*files, tolerance="*=0.001 %")
    assert found.verdict == verdict
    if verdict == "within":
        assert abs(found.pairs[0].channels["wheel"].largest.value) < 1e-9


WAVE = 2.0 * math.pi * 3.0


def bump(at: float) -> np.ndarray:
    return np.asarray(np.exp(-(((TIME - at) / 0.05) ** 2)))


@pytest.mark.parametrize(
    ("first", "second", "shift", "lines", "absent"),
    [
        # half a period late: no sign, and no shift is sure
        (np.sin(WAVE * TIME), np.sin(WAVE * TIME - math.pi), False, '"Force" = "Force_B"', "sign = -1 }"),
        (bump(0.4), -bump(0.4), False, '"Force" = { column = "Force_B", sign = -1 }', "shift"),
        (bump(0.4), bump(0.6), False, "no column is like a channel", "sign"),
        (bump(0.4), bump(0.6), True, "shift_s = -0.2", "sign"),
        (bump(0.4), bump(0.6), True, '"Force" = "Force_B" # names', "sign"),
    ],
)
def test_proposals_tell_a_shift_from_a_sign(
    first: np.ndarray, second: np.ndarray, shift: bool, lines: str, absent: str, tmp_path: Path
) -> None:
    files = (
        table(tmp_path / "one.csv", "Force [N]", first),
        table(tmp_path / "two.csv", "Force_B [N]", second),
    )
    text = proposal(*read_files(files), find_shift=shift)
    assert lines in text
    assert absent not in text


def test_a_shift_that_is_not_sure_is_refused(tmp_path: Path) -> None:
    wave = [np.sin(WAVE * TIME - late) for late in (0.0, math.pi)]
    files = [table(tmp_path / f"{n}.csv", f"Force{'_B' * n} [N]", one) for n, one in enumerate(wave)]
    with pytest.raises(InputError, match="no shift in time is sure"):
        proposal(*read_files(files), find_shift=True)
