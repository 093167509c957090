"""`init` writes sets of files that run as they are."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from support_exudyn.__main__ import main
from support_exudyn.files.machines import load_machine
from support_exudyn.files.scenarios.scenario_file import read_scenario
from support_exudyn.files.starters import KINDS, starter
from support_exudyn.sweeps import read_sweep

MODULES = {"own_law": "my_laws", "own_machine": "crank_rocker"}


@pytest.mark.parametrize("kind", KINDS)
def test_files_are_written_once_and_nothing_is_replaced(
    kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["init", kind]) == 0
    written = [Path(line) for line in capsys.readouterr().out.splitlines()]
    assert {path.name for path in written} == starter(kind).keys()
    assert {path.parent for path in written} == {Path(kind)}
    written[-1].write_text("mine", encoding="utf-8")
    assert main(["init", kind]) == 1
    assert "is there already, and nothing is replaced" in capsys.readouterr().err
    assert written[-1].read_text(encoding="utf-8") == "mine"


@pytest.mark.parametrize(
    "kind",
    [
        pytest.param(kind, marks=[pytest.mark.slow] * (kind == "four_column_support"))
        for kind in sorted(KINDS.keys() - MODULES.keys())
    ],
)
def test_files_are_what_they_say(kind: str, tmp_path: Path) -> None:
    assert main(["init", kind, "--out", str(tmp_path)]) == 0
    assert main(["check", str(tmp_path / "machine.toml"), "--out", str(tmp_path)]) == 0
    data = load_machine(tmp_path / "machine.toml")
    assert data.bore_radii.keys() == data.machine.linkage().pins.keys()  # any pin may be given a clearance
    for name in ("ideal", "clearance"):
        assert len(read_scenario(tmp_path / f"{name}.toml").clearance_pins) == (name == "clearance")
    assert read_sweep(tmp_path / "sizes.toml")


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_every_scenario_runs_by_the_command_in_its_first_lines(kind: str, tmp_path: Path) -> None:
    assert main(["init", kind, "--out", str(tmp_path)]) == 0
    for path in sorted(tmp_path.glob("*.toml")):
        found = re.search(r"support-exudyn (.*)$", path.read_text(encoding="utf-8"), re.MULTILINE)
        if found is None:
            assert path.name == "machine.toml"  # one that comes with the package
            continue
        words = found.group(1).split()
        done = subprocess.run(
            [sys.executable, "-m", "support_exudyn", *words], cwd=tmp_path, capture_output=True, text=True,
            timeout=500, check=False,
        )  # fmt: skip
        assert done.returncode == 0, done.stderr
        if "\naccuracy = " in path.read_text(encoding="utf-8") and words[-2] == "run":
            assert "±" in done.stdout
