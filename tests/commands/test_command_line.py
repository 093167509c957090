"""The command line as a whole: help, versions, exit codes, and JSON for scripts."""

from __future__ import annotations

import json
import math
import subprocess
import sys
from pathlib import Path

import pytest

from support_exudyn.__main__ import main
from support_exudyn.commands.command_line import answer
from support_exudyn.commands.parser import NAMES, parser


def test_help_tells_of_every_command_and_exit_code(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        main(["--help"])
    told = capsys.readouterr().out
    assert end.value.code == 0
    assert [name for name in NAMES if f"\n    {name} " not in told] == []
    assert [code for code in ("0", "1", "2", "130") if f"\n  {code} " not in told] == []


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
    ("words", "message"),
    [
        (["show", "run.h5", "--untl", "3"], "'--untl': no such option; did you mean --until"),
        (["render", "run.h5", "--movie", "git"], "--movie 'git': no such movie; did you mean gif"),
    ],
)
def test_a_wrong_word_is_told_with_those_that_look_like_it(
    words: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as end:
        main(words)
    assert end.value.code == 2
    assert message in capsys.readouterr().err


@pytest.mark.parametrize("place", [1, 2, 3])
def test_options_stand_before_between_and_behind_names(place: int) -> None:
    words = ["show", "rise.h5", "tip.*"]
    given = parser().parse_args([*words[:place], "--after", "3", *words[place:]])
    assert (given.run, given.channels, given.after) == (Path("rise.h5"), ["tip.*"], 3.0)


def test_json_has_no_number_that_is_none(capsys: pytest.CaptureFixture[str]) -> None:
    answer({"a": math.nan, "b": [1.5, math.inf], "c": {"d": Path("x")}, "e": (True, None, "ä")})
    assert json.loads(capsys.readouterr().out) == {
        "a": None,
        "b": [1.5, None],
        "c": {"d": "x"},
        "e": [True, None, "ä"],
    }
