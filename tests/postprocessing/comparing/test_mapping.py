"""compare.toml and tolerances: read whole, refused with all that is wrong; columns, verdicts and angles."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from support_exudyn import compare_files
from support_exudyn.postprocessing.comparing.mapping import (
    read_compare_file,
    read_tolerances,
    tolerance,
)
from user_forces import InputError

WHOLE = """
[files."seen*.csv"]
shift_ms = 12

[files."seen*.csv".columns]
"tip.x" = "Canopy X"
"pin.A.force" = { column = "Load cell", sign = -1, offset = 0.5 }

[files."seen*.csv".units]
"Canopy*" = "mm"
t = "s"
"Load*" = "kN"

[tolerances]
"tip.*" = "0.1 mm"
"pin.*" = "2 %"
"""


def written(folder: Path, text: str, name: str = "compare.toml") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        (
            '[files."seen.csv"]\nshift = 3\n[files."seen.csv".columns]\n'
            '"tip.x" = { column = "a", sign = 2 }\n"tip.y" = { sign = -1 }\n',
            (
                "files.seen.csv.shift: is written with its unit; allowed: shift_s, shift_ms",
                "files.seen.csv.columns.tip.x.sign = 2: allowed: 1, -1",
                "files.seen.csv.columns.tip.y.column: missing",
            ),
        ),
        (
            '[files."other.csv"]\n[files."seen.csv".units]\na = "?"\n',
            ("other.csv: no file of this name is compared", "files.seen.csv.units.a = '?': allowed: a unit"),
        ),
        ('[tolerances]\n"tip.*" = "2"\n', ("tolerances: 'tip.*' = '2': allowed: a share",)),
    ],
)
def test_faults_are_reported_together(text: str, parts: tuple[str, ...], tmp_path: Path) -> None:
    with pytest.raises(InputError) as error:
        read_compare_file(written(tmp_path, text), [Path("seen.csv"), Path("rise.h5")])
    assert [part for part in parts if part not in str(error.value)] == []
    assert str(error.value).count(f"{tmp_path / 'compare.toml'}: ") == len(parts)


@pytest.fixture
def files(tmp_path: Path) -> tuple[Path, Path]:
    """A reference, and the same with other names, units, sign, offset and begin of time."""
    time = np.linspace(0.0, 1.0, 101)
    place, force = 0.3 * np.sin(5.0 * time), 4e3 * np.cos(3.0 * time)
    # force = 0.5 - cell [kN]; times began 12 ms earlier
    seen = np.column_stack([time - 0.012, 1e3 * place, 0.5 - 1e-3 * force])
    paths = tmp_path / "reference.csv", tmp_path / "seen_1.csv"
    heads = "time_s,tip.x_m,pin.A.force_N", "t,Canopy X,Load cell"
    for path, head, columns in zip(paths, heads, (np.column_stack([time, place, force]), seen), strict=True):
        np.savetxt(path, columns, delimiter=",", fmt="%.12g", header=head, comments="")
    return paths


@pytest.mark.parametrize(
    ("replaced", "by", "channel", "apart"),
    [
        ("", "", "tip.x", 0.0),
        ("", "", "pin.A.force", 0.0),
        ("sign = -1, ", "", "pin.A.force", 8920.0),  # 1000 - 2 F, at its end
        ("offset = 0.5", "offset = 0", "pin.A.force", 500.0),
        ('"Canopy*" = "mm"', '"Canopy*" = "cm"', "tip.x", 2.7),  # 9 times 0.3 m
        ("shift_ms = 12", "", "tip.x", 0.018),  # the slope of 1.5 m/s for 12 ms
    ],
)
def test_every_part_of_a_mapping_counts(
    replaced: str, by: str, channel: str, apart: float, files: tuple[Path, Path], tmp_path: Path
) -> None:
    assert replaced in WHOLE
    found = compare_files(*files, mapping=written(tmp_path, WHOLE.replace(replaced, by, 1)))
    one = found.pairs[0].channels[channel]
    assert one.largest.value == pytest.approx(apart, rel=0.02, abs=1e-5)
    assert one.verdict == ("differs" if apart else "differs within tolerance")


@pytest.mark.parametrize(
    ("column", "said"),
    [
        ("Canopy Y", "'Canopy Y' for tip.x; did you mean 'Canopy X'"),
        ("Canopy X", r"tip.x: is in m in .*, and in no unit in .*units\] \"Canopy X\""),
    ],
)
def test_a_column_that_is_missing_or_without_unit(
    column: str, said: str, files: tuple[Path, Path], tmp_path: Path
) -> None:
    text = f'[files."seen_1.csv".columns]\n"tip.x" = "{column}"\n[files."seen_1.csv".units]\nt = "s"\n'
    with pytest.raises(InputError, match=said):
        compare_files(*files, mapping=written(tmp_path, text))


# --- tolerances ---


@pytest.mark.parametrize(
    ("text", "channel", "unit", "extent", "allowed"),
    [
        ("2%", "a.force", "N", 5e3, 100.0),
        ("0.1mm", "a", "m", 0.0, 1e-4),
        ("1deg", "a", "rad", 0.0, math.pi / 180.0),
        ("3e-2 m/s", "a=b", "m/s", 1.0, 0.03),
        ("2%", "a", "N", 0.0, 0.0),  # a share of a reference that is constant: only what is equal is within
    ],
)
def test_what_is_allowed_is_in_si(text: str, channel: str, unit: str, extent: float, allowed: float) -> None:
    # the first pattern that matches counts
    several = read_tolerances(f"b.*=1N, {channel} = {text},{channel}=7 s")
    assert [each.pattern for each in several] == ["b.*", channel, channel]
    assert several[1].in_si(channel, unit, extent) == pytest.approx(allowed, rel=1e-15)


@pytest.mark.parametrize(
    "text",
    ["", " , ", "tip", "=2%", "tip=", "tip=2", "tip=%", "tip=-2%", "tip=nan%", "tip=1e999mm", "tip=a mm"],
)
def test_what_is_no_tolerance_is_refused(text: str) -> None:
    with pytest.raises(InputError, match="allowed: "):
        read_tolerances(text)
    with pytest.raises(InputError, match=r"tolerance of tip\.x.*mm.*N"):
        tolerance("tip.*", "1 mm").in_si("tip.x", "N", 1.0)


# --- angles ---

TIME = np.linspace(0.0, 1.0, 501)
TURNED = 540.0 * TIME  # one and a half turns [deg]
SWUNG = 170.0 + 30.0 * np.sin(9.0 * TIME)


def wrapped(values: np.ndarray, low: float = -180.0) -> np.ndarray:
    return np.asarray((values - low) % 360.0 + low)


@pytest.mark.parametrize(
    ("first", "second", "unit", "verdict"),
    [
        (TURNED, wrapped(TURNED, 0.0), "deg", "differs within tolerance"),
        (wrapped(TURNED), wrapped(TURNED, 0.0), "deg", "differs within tolerance"),
        (SWUNG, wrapped(SWUNG), "deg", "differs within tolerance"),
        (TURNED, TURNED - 720.0, "deg", "differs within tolerance"),
        (TURNED, np.radians(wrapped(TURNED) + 360.0), "rad", "differs within tolerance"),
        (TURNED, 2.0 * TURNED, "deg", "differs"),  # apart by full turns at the end only
        (TURNED, TURNED + 180.0, "deg", "differs"),
        (TURNED, TURNED + 360.0, "deg/s", "differs"),
        (TURNED, wrapped(TURNED), "mm", "differs"),
    ],
)
def test_angles_are_compared_modulo_full_turns(
    first: np.ndarray, second: np.ndarray, unit: str, verdict: str, tmp_path: Path
) -> None:
    for name, values, of in (("a", first, "deg" if unit == "rad" else unit), ("b", second, unit)):
        columns = np.column_stack([TIME, values])
        np.savetxt(tmp_path / f"{name}.csv", columns, delimiter=",", header=f"time_s,wheel [{of}]", comments="")
    found = compare_files(tmp_path / "a.csv", tmp_path / "b.csv", tolerance="*=0.001 %")
    assert found.verdict == verdict
