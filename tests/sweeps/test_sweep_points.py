"""Points of a sweep, and the file that says them."""

from __future__ import annotations

from collections import Counter
from decimal import Decimal
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn.sweeps import Record, grid, latin_hypercube, read_sweep
from support_exudyn.sweeps.file import keys_of, replaced
from support_exudyn.sweeps.plan import Range
from user_forces.values.value import InputError

SCENARIO = """
machine = "reference"
duration_s = 1.0
[pins.rear_base]
clearance_mm = 1.0
bore_radius_mm = 65.5
"""


def unit(steps: int = 0) -> Range:
    return Range(Decimal(0), Decimal(1), steps)


# --- points ---


def test_the_last_of_a_grid_varies_fastest() -> None:
    assert grid({"a": [1, 2], "b": unit(3)}) == [
        {"a": a, "b": Decimal(b)} for a in (1, 2) for b in ("0", "0.5", "1")
    ]


def test_ranges_hit_their_ends_and_are_even_on_their_scale() -> None:
    assert Range(Decimal("0.1"), Decimal("0.3"), 3).values == [Decimal("0.1"), Decimal("0.2"), Decimal("0.3")]
    assert Range(Decimal(1), Decimal(100), 3, "log").values == [Decimal(1), Decimal(10), Decimal(100)]


@given(samples=st.integers(1, 60), seed=st.integers(0, 2**32))
def test_a_hypercube_has_one_point_in_each_part_of_each_range(samples: int, seed: int) -> None:
    varied = {
        "linear": Range(Decimal(-2), Decimal(6)),
        "log": Range(Decimal(1), Decimal(1000), scale="log"),
        "choice": ["a", "b", "c"],
    }
    points = latin_hypercube(varied, samples, seed)
    assert points == latin_hypercube(varied, samples, seed)
    parts = [float(point["linear"] + 2) / 8 * samples for point in points]
    # rounding to twelve digits may move a point that lies on the border of two parts
    assert sorted(int(part + 1e-9) for part in parts) == list(range(samples)) or any(
        abs(part - round(part)) < 1e-8 for part in parts
    )
    assert all(1 <= point["log"] <= 1000 for point in points)
    counts = Counter(point["choice"] for point in points)
    assert max(counts.values()) - min(counts.get(one, 0) for one in "abc") <= 1


# --- fields by their keys ---


def test_fields_are_replaced_where_their_keys_lead() -> None:
    table = {"a": {"b": [{"c": 1}, {"c": 2}]}, "d": 3}
    assert replaced(table, {"a.b.1.c": 5, "e.f": 6}) == {
        "a": {"b": [{"c": 1}, {"c": 5}]},
        "d": 3,
        "e": {"f": 6},
    }
    assert table == {"a": {"b": [{"c": 1}, {"c": 2}]}, "d": 3}
    assert keys_of('pins."a.b".c') == ["pins", "a.b", "c"]
    for wrong in ("d.x", "a.b.7.c", "a.b.first.c"):
        with pytest.raises(InputError, match=r"vary"):
            replaced(table, {wrong: 1})


# --- the file ---


def write(folder: Path, text: str) -> Path:
    (folder / "rise.toml").write_text(SCENARIO, encoding="utf-8")
    (folder / "sweep.toml").write_text(text, encoding="utf-8")
    return folder / "sweep.toml"


def test_values_have_the_units_of_their_keys(tmp_path: Path) -> None:
    text = """
    scenario = "rise.toml"
    method = "list"
    [vary]
    pins.rear_base.clearance_mm = [0.7, 1.5]
    duration_s = {from = 0.5, to = 1.0, steps = 2}
    "machine.pivots_mm.tip" = [[3219, 2417], [3000, 2400]]
    [record]
    numbers = ["tip.x.mean"]
    after_s = 0.25
    """
    plan = read_sweep(write(tmp_path, text))
    assert plan.record == Record(("tip.x.mean",), after=0.25)
    assert plan.names == ("pins.rear_base.clearance_mm", "duration_s", "machine.pivots_mm.tip")
    first, second = map(plan.scenario, plan.points)
    assert [one.clearance_pins["rear_base"].contact.bearing.clearance for one in (first, second)] == [
        7e-4,
        1.5e-3,
    ]
    assert [one.duration for one in (first, second)] == [0.5, 1.0]
    assert [one.machine.tip for one in (first, second)] == [(3.219, 2.417), (3.0, 2.4)]  # type: ignore[attr-defined]


WRONG = {
    "method = 'random'": r"method = 'random': allowed: 'grid', 'list', 'latin_hypercube'",
    "samples = 3": r"samples: means nothing here; allowed with method = 'latin_hypercube'",
    "method = 'latin_hypercube'\nvary.duration_s = [1.0]": r"samples = missing: allowed: a whole number",
    "vary.duration_s = 1.0": r"vary.'duration_s' = 1.0: allowed: a list of values, or a range",
    "vary.duration_s = {from = 0.1, to = 1.0}": r"vary.'duration_s'.steps: missing",
    "vary.duration_s = {from = 0.1}": r"vary.'duration_s'.to = missing: allowed: a number",
    "vary.duration_s = {from = 0.0, to = 1.0, steps = 3, scale = 'log'}": r"allowed with scale = 'log': > 0",
    "vary.duration_s = {mean = 1.0, std = 0.1}": r"vary.'duration_s'.mean: unknown key; allowed: from, scale",
    "record.after_s = -1": r"record.after_s = -1: allowed: a time in s, >= 0",
    "vary.'a b' = [1]": r"vary: 'a b': allowed: keys of a scenario file, joined by dots",
    "runs = 5": r"runs: unknown key; allowed: method, record",
}


@pytest.mark.parametrize("line", WRONG)
def test_what_is_wrong_in_a_file_is_said(tmp_path: Path, line: str) -> None:
    path = write(tmp_path, f'scenario = "rise.toml"\n{line}\n')
    with pytest.raises(InputError, match=rf"sweep.toml: .*{WRONG[line]}"):
        read_sweep(path)
