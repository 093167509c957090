"""The command line as a whole: help, versions, exit codes, and JSON for scripts."""

from __future__ import annotations

import json
import math
import subprocess
import sys
from pathlib import Path

import pytest

from support_exudyn.__main__ import main
from support_exudyn.commands.app import COMMANDS, app
from support_exudyn.commands.command_line import answer


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
        ("render run.h5 --movie git", 2, 'Did you mean "gif"?'),
        ("render run.h5 --size big", 2, "allowed: width and height in pixels, such as 1280x720"),
        ("sweep a.toml --workers 0", 2, "--workers. Must be >= 1"),
        ("init four_column", 2, "did you mean four_column_support? allowed: four_column_support, two_leg"),
        ("view run.h5 tip.x", 2, "tip.x"),
        ("show no.h5", 1, "no.h5: no such file"),
        ("sweep a.toml --workers 2 --scheduler tcp://x:1", 1, "allowed: without --scheduler"),
        ("chart no tip.x --tornado --histogram", 1, "allowed: one of them"),
        ("plot no.h5 --out x.xyz", 2, "--out. allowed: a file that ends in .png, .pdf, .svg or a folder"),
        ("chart no tip.x --out x.jpg", 2, "allowed: a file that ends in .png, .pdf, .svg or a folder"),
        ("check reference --out x.tif", 2, "allowed: a file that ends in .png, .pdf, .svg or a folder"),
        ("stand reference --figure x.eps", 2, "allowed: a file that ends in .png, .pdf, .svg or a folder"),
        ("report no.h5 --out x.pdf", 2, "allowed: a file that ends in .html or a folder"),
        ("render no.h5 --out x.mp4", 2, "allowed: a file that ends in .png or a folder"),
        ("render no.h5 --out x.png", 1, "--out x.png: allowed without --still: a folder"),
        ("measure no.h5 --out x.xlsx", 2, "allowed: a file that ends in .csv"),
        ("run no.toml --out x.csv", 2, "allowed: a file that ends in .h5, .hdf5"),
        ("export no.h5 --out x.csv", 1, "--out x.csv: is a folder for all formats"),
        ("plot no.csv", 1, "is no run; allowed: with a run before it"),
        ("compare no.h5", 2, "allowed: two files or more, the first is the reference"),
        ("--import gone.py show no.h5", 1, "--import 'gone.py': there is no such file"),
        ("show no.h5 --import gone.py", 1, "--import 'gone.py': there is no such file"),
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
