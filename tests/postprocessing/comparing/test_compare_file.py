"""compare.toml: read whole, refused with all that is wrong; columns become channels by it."""

from __future__ import annotations

import math
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import pytest
import tomli_w
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import compare_files
from support_exudyn.postprocessing.comparing.compare_file import MappedColumn, read_compare_file, tolerances_of
from user_forces import InputError

WHOLE = """
bands_Hz = [0, 5, 50]

[files."seen*.csv"]
shift_ms = 12
analysis = "Last_Run"

[files."seen*.csv".columns]
"tip.x" = "Canopy X"
"pin.A.force" = { column = "Load cell", sign = -1, offset = 0.5 }

[files."seen*.csv".units]
"Canopy*" = "mm"

[units]
time = "s"
"Load*" = "kN"
"Canopy*" = "m"

[tolerances]
"tip.*" = "0.1 mm"
"pin.*" = "2 %"
"""


def written(folder: Path, text: str, name: str = "compare.toml") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_a_whole_file_is_read(tmp_path: Path) -> None:
    seen = tmp_path / "seen_1.csv"
    found = read_compare_file(written(tmp_path, WHOLE), [seen, Path("rise.h5")])
    mine = found.of(seen)
    assert mine.columns == {
        "tip.x": MappedColumn(column="Canopy X"),
        "pin.A.force": MappedColumn(column="Load cell", sign=-1, offset=0.5),
    }
    assert mine.shift == pytest.approx(0.012)
    assert mine.analysis == "Last_Run"
    # what is said of the file goes before what is said of all
    assert mine.units == {"Canopy*": "mm", "time": "s", "Load*": "kN"}
    assert found.of(Path("rise.h5")).columns == {}
    assert found.of(Path("rise.h5")).units["Canopy*"] == "m"
    assert found.bands == (0.0, 5.0, 50.0)
    assert [(one.pattern, one.text) for one in tolerances_of(found)] == [("tip.*", "0.1 mm"), ("pin.*", "2 %")]


def test_all_faults_are_told_at_once(tmp_path: Path) -> None:
    text = """
        confirmed = false
        bands_hz = [0, 5]
        [files."other.csv"]
        shift = 3
        [files."seen.csv".columns]
        "tip.x" = { column = "a", sign = 2 }
        "tip.y" = { sign = -1 }
        [files."seen.csv".units]
        a = "?"
        b = "furlongs per banana"
        [tolerances]
        "tip.*" = "2"
    """
    with pytest.raises(InputError) as error:
        read_compare_file(written(tmp_path, text), [Path("seen.csv"), Path("rise.h5")])
    said = str(error.value)
    for part in (
        "bands_hz: has another unit; allowed: bands_Hz",
        "files.other.csv: no file of this name is compared",
        "files.other.csv.shift: is written with its unit; allowed: shift_s, shift_ms",
        "files.seen.csv.columns.tip.x.sign = 2: allowed: 1, -1",
        "files.seen.csv.columns.tip.y.column: missing",
        "files.seen.csv.units.a = '?': allowed: a unit",
        "files.seen.csv.units.b = 'furlongs per banana': allowed: a unit",
        "tolerances: 'tip.*' = '2': allowed: a share of the reference's range",
        "confirmed = false: allowed: true",
    ):
        assert part in said, part
    assert said.count(f"{tmp_path / 'compare.toml'}: ") == 9


@pytest.mark.parametrize("bands", ["[5]", "[5, 5]", "[5, 1]", "[-1, 5]", '"5"'])
def test_bands_increase(bands: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="bands"):
        read_compare_file(written(tmp_path, f"bands_Hz = {bands}"), [])


@pytest.fixture
def files(tmp_path: Path) -> tuple[Path, Path]:
    """A reference, and the same with other names, units, sign, offset and begin of time."""
    time = np.linspace(0.0, 1.0, 101)
    place, force = 0.3 * np.sin(5.0 * time), 4e3 * np.cos(3.0 * time)
    table = np.column_stack([time, place, force])
    one = written(tmp_path, "time_s,tip.x_m,pin.A.force_N\n", "reference.csv")
    with one.open("a", encoding="utf-8") as file:
        np.savetxt(file, table, delimiter=",", fmt="%.12g")
    other = written(tmp_path, "t,Canopy X,Load cell\n", "seen_1.csv")
    with other.open("a", encoding="utf-8") as file:
        # force = 0.5 - cell [kN]; times began 12 ms earlier
        np.savetxt(
            file, np.column_stack([time - 0.012, 1e3 * place, 0.5 - 1e-3 * force]), delimiter=",", fmt="%.12g"
        )
    return one, other


def test_a_mapping_makes_channels_of_columns(files: tuple[Path, Path], tmp_path: Path) -> None:
    mapping = written(tmp_path, WHOLE.replace('analysis = "Last_Run"', "").replace("time =", "t ="))
    found = compare_files(*files, mapping=mapping)
    pair = found.pairs[0]
    assert list(pair.channels) == ["tip.x", "pin.A.force"]
    assert pair.channels["tip.x"].largest.value < 1e-10
    assert pair.channels["pin.A.force"].largest.value < 1e-5
    assert pair.channels["pin.A.force"].unit == "N"
    assert found.verdict == "within"


@pytest.mark.parametrize(
    ("replaced", "by", "channel", "apart"),
    [
        ("sign = -1, ", "", "pin.A.force", 8920.0),  # 1000 - 2 F, at its end
        ("offset = 0.5", "offset = 0", "pin.A.force", 500.0),
        ('"Canopy*" = "mm"', '"Canopy*" = "cm"', "tip.x", 2.7),  # 9 times 0.3 m
        ("shift_ms = 12", "", "tip.x", 0.018),  # the slope of 1.5 m/s for 12 ms
    ],
)
def test_every_part_of_a_mapping_counts(
    replaced: str, by: str, channel: str, apart: float, files: tuple[Path, Path], tmp_path: Path
) -> None:
    text = WHOLE.replace('analysis = "Last_Run"', "").replace("time =", "t =")
    assert replaced in text
    found = compare_files(*files, mapping=written(tmp_path, text.replace(replaced, by, 1)))
    one = found.pairs[0].channels[channel]
    assert one.largest.value == pytest.approx(apart, rel=0.02)
    assert one.verdict == "not within"


def test_a_column_that_is_not_there_is_told_with_others(files: tuple[Path, Path], tmp_path: Path) -> None:
    text = '[files."seen_1.csv".columns]\n"tip.x" = "Canopy Y"\n[units]\nt = "s"\n"*" = "mm"\n'
    said = r"has no column 'Canopy Y', which is to be tip.x; did you mean Canopy X"
    with pytest.raises(InputError, match=said):
        compare_files(*files, mapping=written(tmp_path, text))


def test_a_column_without_unit_is_refused(files: tuple[Path, Path], tmp_path: Path) -> None:
    text = '[files."seen_1.csv".columns]\n"tip.x" = "Canopy X"\n[units]\nt = "s"\n'
    with pytest.raises(InputError, match=r"Canopy X: its file gives no unit.*\[units\] \"Canopy X\""):
        compare_files(*files, mapping=written(tmp_path, text))


def test_units_that_neither_file_names_are_refused(tmp_path: Path) -> None:
    one, other = (written(tmp_path, "time_s,a\n0,1\n1,2\n", f"{n}.csv") for n in "xy")
    with pytest.raises(
        InputError, match=r"a: has a unit in neither; allowed: .*'a \[mm\]'.*units\] \"a\" = \"mm\""
    ):
        compare_files(one, other)
    plain = written(tmp_path, '[units]\na = "1"\n')
    assert compare_files(one, other, mapping=plain).pairs[0].channels["a"].largest.value == 0.0


def test_nan_is_not_compared(tmp_path: Path) -> None:
    one = written(tmp_path, "time_s,a_m\n0,1\n1,2\n2,3\n3,4\n", "x.csv")
    other = written(tmp_path, "time_s,a_m\n0,1\n1,\n2,3\n3,4.5\n", "y.csv")
    found = compare_files(one, other, tolerance="a=1m").pairs[0].channels["a"]
    assert found.largest.value == 0.5
    assert found.measures.left_out == 1
    assert not math.isnan(found.mean.value)


KEYS = st.sampled_from(
    ["files", "columns", "units", "tolerances", "bands_Hz", "confirmed", "seen.csv", "a", "shift_s"]
)
ITEMS = st.recursive(
    st.one_of(
        st.text(max_size=5), st.integers(), st.booleans(), st.decimals(), st.sampled_from(["s", "2 %", "?"])
    ),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(KEYS, inner, max_size=4),
    max_leaves=12,
)


@given(st.dictionaries(KEYS, ITEMS, max_size=5))
def test_whatever_is_in_the_file_it_is_read_or_refused_in_sentences(table: dict[str, Any]) -> None:
    with TemporaryDirectory() as folder:
        path = Path(folder) / "compare.toml"
        path.write_text(tomli_w.dumps(table), encoding="utf-8")
        said = ""
        try:
            found = read_compare_file(path, [Path("seen.csv")])
        except InputError as error:
            said = str(error)
        if said:
            assert str(path) in said
        else:
            assert all(one.amount >= 0.0 for one in tolerances_of(found))
