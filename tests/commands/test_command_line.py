"""The command line as a whole: help, versions, exit codes, JSON for scripts, and what a command imports."""

from __future__ import annotations

import json
import math
import subprocess
import sys
from pathlib import Path

import pytest

from support_exudyn import ClearancePin, CubicStep, Scenario, machine, simulate
from support_exudyn.__main__ import main
from support_exudyn.commands.app import COMMANDS, app
from support_exudyn.commands.command_line import answer
from tests.processes import environment


def test_help_lists_every_command_in_its_group_and_every_exit_code(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--help"]) == 0
    printed = capsys.readouterr().out
    for group, commands in COMMANDS.items():
        panel = printed.partition(f"─ {group} ")[2].partition("╰")[0]
        assert [name for name in commands if f"│ {name} " not in panel] == []
    assert [code for code in ("0", "1", "2", "3", "130") if f" {code}: " not in printed] == []


def test_completion_is_written_for_shells() -> None:
    script = app.generate_completion(shell="bash")
    assert [word for word in ("--difference", "--tolerance", "baseline") if word not in script] == []


def test_the_installed_command_is_the_module() -> None:
    installed = Path(sys.executable).with_name("support-exudyn")
    answers = [
        subprocess.run([*start, "show", "no.h5"], capture_output=True, text=True, check=False)
        for start in ([str(installed)], [sys.executable, "-m", "support_exudyn"])
    ]
    assert [(a.returncode, a.stdout) for a in answers] == [(1, "")] * 2
    assert answers[0].stderr == answers[1].stderr
    assert answers[0].stderr.startswith("error: no.h5")


@pytest.mark.parametrize(
    ("words", "code", "message"),
    [
        ("show run.h5 --untl 3", 2, "--untl. Did you mean --until?"),
        ("shaw run.h5", 2, 'Did you mean "show"?'),
        ("show", 2, "RUN requires an argument"),
        ("show run.h5 --after soon", 2, '--after: unable to convert "soon"'),
        ("run a.toml --accuracy 5", 2, "allowed: draft, standard, reference, or a relative error from"),
        ("baseline chek .", 2, 'Did you mean "check"?'),
        ("render run.h5 --size big", 2, "allowed: width and height in pixels, such as 1280x720"),
        ("render no.h5 --no-movie", 1, "no.h5: no such file"),
        ("sweep a.toml --workers 0", 2, "--workers. Must be >= 1"),
        ("init four_column", 2, "did you mean four_column_support? allowed: four_column_support, two_leg"),
        ("show no.h5", 1, "no.h5: no such file"),
        ("sweep a.toml --workers 2 --scheduler tcp://x:1", 1, "allowed: without --scheduler"),
        ("chart no tip.x --tornado --histogram", 1, "allowed: one of them"),
        ("plot no.h5 --out x.xyz", 2, "--out. allowed: a file that ends in .png, .pdf, .svg or a folder"),
        ("chart no tip.x --out x.jpg", 2, "allowed: a file that ends in .png, .pdf, .svg, .html or a folder"),
        ("chart no tip.x --out x.html", 1, "allowed: a file that ends in .html with --sliders"),
        ("chart no --sliders --tornado", 1, "allowed: without --by, --histogram, --tornado"),
        ("render no.h5 --out x.png", 1, "--out x.png: allowed without --still: a folder"),
        ("measure no.h5 --out x.xlsx", 2, "allowed: a file that ends in .csv"),
        ("run no.toml --out x.csv", 2, "allowed: a file that ends in .h5, .hdf5"),
        ("export no.h5 --out x.csv", 1, "--out x.csv: is a folder for all formats"),
        ("plot no.csv", 1, "is no run; allowed: with a run before it"),
        ("compare no.h5", 2, "allowed: two files or more, the first is the reference"),
        ("--import gone.py show no.h5", 1, "--import 'gone.py': there is no such file"),
    ],
)
def test_what_is_wrong_is_a_line_on_standard_error_and_an_exit_code(
    words: str, code: int, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(words.split()) == code
    printed = capsys.readouterr()
    assert (printed.out, len(printed.err.splitlines())) == ("", 1)
    assert message in printed.err


@pytest.mark.parametrize("place", [1, 2, 3])
def test_options_stand_before_between_and_behind_names(place: int) -> None:
    words = ["show", "rise.h5", "tip.*"]
    _, bound, _ = app.parse_args([*words[:place], "--after", "3", *words[place:]])
    assert (bound.args, bound.kwargs) == ((Path("rise.h5"), "tip.*"), {"after": 3.0})


def test_json_has_no_number_that_is_none(capsys: pytest.CaptureFixture[str]) -> None:
    answer({"a": math.nan, "b": [1.5, math.inf], "c": {"d": Path("x")}, "e": (True, None, "ä")})
    assert json.loads(capsys.readouterr().out) == {
        "a": None,
        "b": [1.5, None],
        "c": {"d": "x"},
        "e": [True, None, "ä"],
    }


# --- what a command imports ---

HEAVY = {
    "bokeh", "exudyn", "jinja2", "llvmlite", "matplotlib", "meshio", "numba", "pandas", "PIL", "pint",
    "pyarrow", "scipy", "shapely", "trimesh", "xarray",
}  # fmt: skip
BASIC = {"h5py", "numpy", "pydantic"}  # of whoever reads a run
MODULES = {module for commands in COMMANDS.values() for module, _ in commands.values()}
IMPORTED = """
import json, sys
from support_exudyn.__main__ import main
main({words!r})
names = sorted({{name.partition(".")[0] for name in sys.modules}})
commands = sorted(name for name in sys.modules if name.startswith("support_exudyn.commands."))
print(json.dumps([names, commands]), file=sys.stderr)
"""


def imported_by(*words: str) -> tuple[set[str], set[str]]:
    """Packages that a command line imports, and modules of commands."""
    command = [sys.executable, "-c", IMPORTED.format(words=list(words))]
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
    assert packages & HEAVY <= {"scipy"}  # which finds the start posture of a four-bar
    assert packages >= BASIC
    assert commands & MODULES == {"runs"}
