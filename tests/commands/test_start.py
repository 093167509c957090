"""What a command imports: what is asked for, and nothing that takes long and that it has no use for."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from support_exudyn import ClearancePin, CubicStep, Scenario, machine, simulate
from support_exudyn.commands.app import COMMANDS
from tests.processes import environment

HEAVY = {
    "bokeh", "exudyn", "jinja2", "llvmlite", "matplotlib", "meshio", "numba", "pandas", "PIL", "pint",
    "pyarrow", "scipy", "shapely", "trimesh", "xarray",
}  # fmt: skip
BASIC = {"h5py", "numpy", "pydantic"}  # of whoever reads a run
MODULES = {module for commands in COMMANDS.values() for module, _ in commands.values()}
TOLD = """
import json, sys
from support_exudyn.__main__ import main
main({words!r})
names = sorted({{name.partition(".")[0] for name in sys.modules}})
commands = sorted(name for name in sys.modules if name.startswith("support_exudyn.commands."))
print(json.dumps([names, commands]), file=sys.stderr)
"""


def imported_by(*words: str) -> tuple[set[str], set[str]]:
    """Packages that a command line imports, and modules of commands."""
    command = [sys.executable, "-c", TOLD.format(words=list(words))]
    done = subprocess.run(command, env=environment(), capture_output=True, text=True, check=True)
    packages, commands = json.loads(done.stderr.splitlines()[-1])
    return set(packages), {name.rpartition(".")[2] for name in commands}


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    pin = ClearancePin.simple(clearance=0.5e-3, bore_radius=0.06, length=0.5, friction=0.1)
    drive = CubicStep(stroke=0.01, start=0.0, end=0.1)
    scenario = Scenario(machine=machine("reference"), pins={"rear_base": pin}, drive=drive, duration=0.01)
    return simulate(scenario).save(tmp_path_factory.mktemp("run") / "short.h5")


@pytest.mark.parametrize("words", [["--help"], ["--version"], ["shaw", "run.h5"]], ids=" ".join)
def test_the_command_line_itself_imports_no_library_and_no_command(words: list[str]) -> None:
    packages, commands = imported_by(*words)
    assert packages & (HEAVY | BASIC) == set()
    assert commands & MODULES == set()


@pytest.mark.parametrize("more", [[], ["--json"], ["*.force"]], ids=" ".join)
def test_a_run_is_shown_without_engine_compiler_and_figures(run: Path, more: list[str]) -> None:
    packages, commands = imported_by("show", str(run), *more)
    assert packages & HEAVY == set()
    assert packages >= BASIC
    assert commands & MODULES == {"show"}
