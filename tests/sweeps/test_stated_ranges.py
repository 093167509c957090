"""A sweep draws from the ranges that a machine's file states for its numbers."""

from __future__ import annotations

from decimal import Decimal
from pathlib import Path

import pytest

from support_exudyn.files import read_scenario
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


def test_each_sample_is_the_machine_with_these_numbers_in_it(tmp_path: Path) -> None:
    plan = read_sweep(write(tmp_path, '"machine.*" = "stated range"'))
    assert sorted(plan.names) == sorted(DRAWN)
    assert len(plan.points) == 4
    for n, point in enumerate(plan.points):
        tip, link, canopy = (point[name] for name in DRAWN)
        assert 3800 <= tip <= 4000
        assert 700 <= link <= Decimal("1500.5")
        assert 4000 <= canopy <= 13000
        by_hand = OURS.replace("rear_link = 900", f"rear_link = {link}").replace("[3900,", f"[{tip},")
        by_hand = by_hand.replace("canopy = 5200", f"canopy = {canopy}")
        (tmp_path / f"by_hand_{n}.toml").write_text(by_hand, encoding="utf-8")
        (tmp_path / "b.toml").write_text(SCENARIO.replace("ours", f"by_hand_{n}"), encoding="utf-8")
        expected = read_scenario(tmp_path / "b.toml")
        assert plan.scenario(point) == expected
        assert key(plan.scenario(point)) == key(expected)
    for name, low, high in zip(DRAWN, (3800, 700, 4000), (4000, 1500.5, 13000), strict=True):
        parts = sorted(int(4 * (float(point[name]) - low) / (high - low)) for point in plan.points)
        assert parts == [0, 1, 2, 3]  # one in each quarter


@pytest.mark.parametrize(
    ("vary", "drawn"),
    [
        ('"machine.masses_kg.*" = "stated range"', DRAWN[1:]),
        ('machine.masses_kg.canopy = "stated range"', DRAWN[2:]),
        ('"machine.*canopy" = "stated range"\n"machine.masses_kg.*" = "stated range"', DRAWN[1:]),
        ('"machine.*" = "stated range"\nduration_s = [0.5, 1]', (*DRAWN, "duration_s")),
    ],
)
def test_named_ones_alone_are_drawn(vary: str, drawn: tuple[str, ...], tmp_path: Path) -> None:
    assert set(read_sweep(write(tmp_path, vary)).names) == set(drawn)


def test_what_is_said_of_a_key_goes_before_what_the_file_states(tmp_path: Path) -> None:
    own = '"machine.masses_kg.canopy" = [9000]\n"machine.pivots_mm.tip" = [[3850, 2600]]'
    plan = read_sweep(write(tmp_path, f'"machine.*" = "stated range"\n{own}'))
    assert set(plan.names) == {*DRAWN[1:], "machine.pivots_mm.tip"}
    for point in plan.points:
        machine = plan.scenario(point).machine
        assert machine.parts["canopy"][0].mass == 9000.0  # type: ignore[attr-defined]
        assert machine.tip == (3.85, 2.6)  # type: ignore[attr-defined]


@pytest.mark.parametrize(
    ("vary", "head", "said"),
    [
        ('"machine.*" = "stated range"', "", r"allowed with method = 'latin_hypercube'"),
        ('"machine.masses_kg.front_link" = "stated range"', None, r"ours.toml states a range for no such"),
        ('"machine.masses_kg.canpy" = "stated range"', None, r"did you mean machine.masses_kg.canopy"),
        ('duration_s = "stated range"', None, r"states a range for no such number"),
        ('machine = ["a.toml"]\n"machine.*" = "stated range"', None, r"vary.'machine' and vary"),
        ('"machine.*" = "told"', None, '"stated range" for numbers of the machine'),
    ],
)
def test_what_cannot_be_drawn_is_told(vary: str, head: str | None, said: str, tmp_path: Path) -> None:
    path = write(tmp_path, vary) if head is None else write(tmp_path, vary, head)
    with pytest.raises(InputError, match=said):
        read_sweep(path)


def test_a_machine_without_a_file_states_nothing(tmp_path: Path) -> None:
    path = write(tmp_path, '"machine.*" = "stated range"')
    (tmp_path / "a.toml").write_text('duration_s = 1\n[machine]\ntype = "SlidingPin"\n', encoding="utf-8")
    with pytest.raises(InputError, match=r"'stated range': allowed where the machine is named by its file"):
        read_sweep(path)
