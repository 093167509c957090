"""A sweep draws from the ranges that the files of machine and scenario state for their numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pytest

from support_exudyn.files import load_toml, read_scenario, toml_text
from support_exudyn.sweeps import read_sweep
from support_exudyn.sweeps.key import key
from tests.machine_files import OURS
from user_forces.values.value import InputError

SCENARIO = 'machine = "ours.toml"\nduration_s = 0.5\n'
RANGES = {  # of numbers of the file
    "rear_link = 900": "rear_link = { value = 900, from = 700, to = 1500.5, source = 'a' }",
    "canopy = 5200": "canopy = { value = 5200, from = 4000, to = 13000 }",
    "front_link = 700": "front_link = { value = 700, source = 'weighed' }",
    "tip = [3900, 2650]": "tip = [{ value = 3900, from = 3800, to = 4000 }, 2650]",
}
DRAWN = ("machine.pivots_mm.tip.0", "machine.masses_kg.rear_link", "machine.masses_kg.canopy")


def write(folder: Path, vary: str, head: str = 'method = "latin_hypercube"\nsamples = 4\nseed = 1') -> Path:
    text = OURS
    for old, new in RANGES.items():
        assert old in text
        text = text.replace(old, new)
    (folder / "ours.toml").write_text(text, encoding="utf-8")
    (folder / "a.toml").write_text(SCENARIO, encoding="utf-8")
    path = folder / "sweep.toml"
    path.write_text(f'scenario = "a.toml"\n{head}\n[vary]\n{vary}\n', encoding="utf-8")
    return path


def in_each_part(points: Sequence[Mapping[str, Any]], name: str, low: float, high: float) -> bool:
    count = len(points)
    return sorted(int(count * (float(one[name]) - low) / (high - low)) for one in points) == [*range(count)]


def test_each_sample_is_the_machine_with_these_numbers_in_it(tmp_path: Path) -> None:
    plan = read_sweep(write(tmp_path, '"machine.*" = "stated range"'))
    assert sorted(plan.names) == sorted(DRAWN)
    for n, point in enumerate(plan.points):
        tip, link, canopy = (point[name] for name in DRAWN)
        by_hand = OURS.replace("rear_link = 900", f"rear_link = {link}").replace("[3900,", f"[{tip},")
        by_hand = by_hand.replace("canopy = 5200", f"canopy = {canopy}")
        (tmp_path / f"by_hand_{n}.toml").write_text(by_hand, encoding="utf-8")
        (tmp_path / "b.toml").write_text(SCENARIO.replace("ours", f"by_hand_{n}"), encoding="utf-8")
        expected = read_scenario(tmp_path / "b.toml")
        assert plan.scenario(point) == expected
        assert key(plan.scenario(point)) == key(expected)
    for name, low, high in zip(DRAWN, (3800, 700, 4000), (4000, 1500.5, 13000), strict=True):
        assert in_each_part(plan.points, name, low, high)


@pytest.mark.parametrize(
    ("vary", "head", "said"),
    [
        ('"machine.*" = "stated range"', "", r"allowed with method = 'latin_hypercube'"),
        ('"machine.masses_kg.front_link" = "stated range"', None, r"no range is stated for such a number"),
        ('"machine.masses_kg.canpy" = "stated range"', None, r"did you mean 'machine.masses_kg.canopy'"),
        ('duration_s = "stated range"', None, r"as \{value = 1960, from = 1500, to = 2200\}"),
        ('machine = ["a.toml"]\n"machine.*" = "stated range"', None, r"vary.'machine' and vary"),
    ],
)
def test_what_cannot_be_drawn_is_told(vary: str, head: str | None, said: str, tmp_path: Path) -> None:
    path = write(tmp_path, vary) if head is None else write(tmp_path, vary, head)
    with pytest.raises(InputError, match=said):
        read_sweep(path)


# --- numbers of a scenario's file ---

LEG = """
[actuators.front_column]
type = "HydraulicCylinder"
bore_area_mm2 = 98175
rod_side_area_mm2 = 15080
oil_length_mm = { value = 500, from = 300, to = 800, source = "assumed" }
rod_side_length_mm = { value = 600, source = "assumed" }
bulk_modulus_MPa = { value = 1960, from = 1500, to = 2200 }
system_pressure_MPa = 31.5
nominal_flow_l_per_min = 400
nominal_drop_MPa = 3

[loads.roof]
type = "Roof"
body = "canopy"
point_mm = [{ value = 900, from = 850, to = 950 }, 1785]
stiffness_kN_per_mm = 1000
damping_s_per_m = 1
descent = { type = "CubicStep", stroke_mm = 30, start_s = 0.1, end_s = 0.7 }
"""
OF_SCENARIO = {
    "actuators.front_column.oil_length_mm": (300, 800),
    "actuators.front_column.bulk_modulus_MPa": (1500, 2200),
    "loads.roof.point_mm.0": (850, 950),
}


def with_leg(folder: Path, vary: str) -> Path:
    head = 'machine = "reference"\nduration_s = 0.5'
    path = write(folder, vary, 'method = "latin_hypercube"\nsamples = 3')
    (folder / "a.toml").write_text(head + LEG, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("vary", "drawn"),
    [
        ('"actuators.*" = "stated range"', [*OF_SCENARIO][:2]),
        ('"*.front_column.bulk_modulus_MPa" = "stated range"', [*OF_SCENARIO][1:2]),
        ('"actuators.*" = "stated range"\n"loads.*" = "stated range"', [*OF_SCENARIO]),
    ],
)
def test_numbers_of_a_scenario_are_drawn_from_its_ranges(vary: str, drawn: list[str], tmp_path: Path) -> None:
    plan = read_sweep(with_leg(tmp_path, vary))
    assert sorted(plan.names) == sorted(drawn)
    for name in drawn:
        assert in_each_part(plan.points, name, *OF_SCENARIO[name])
    for point in plan.points:  # the same as where the numbers are written by hand
        table = load_toml(tmp_path / "a.toml")
        for name in drawn:
            first, second, key, *rest = name.split(".")
            where = table[first][second][key] if rest else table[first][second]
            where[int(rest[0]) if rest else key] = point[name]
        (tmp_path / "b.toml").write_text(toml_text(table), encoding="utf-8")
        assert plan.scenario(point) == read_scenario(tmp_path / "b.toml")


def test_what_is_wrong_with_a_range_is_told_where_it_is_named(tmp_path: Path) -> None:
    path = with_leg(tmp_path, '"actuators.front_column.bulk_modulus_MPa" = "stated range"')
    scenario = tmp_path / "a.toml"
    scenario.write_text(scenario.read_text("utf-8").replace("from = 1500", "from = 2500"), encoding="utf-8")
    with pytest.raises(InputError, match=r"bulk_modulus_MPa.from = 2500: allowed: <= to = 2200"):
        read_sweep(path)
