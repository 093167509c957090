"""Command lines of any words: options, a usage and one line, or what is wrong in a line; never a traceback."""

from __future__ import annotations

import argparse
import contextlib
import io
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from studies.common.options import Options, add_options, read_options
from support_exudyn.commands.command_line import Parser
from support_exudyn.commands.parser import NAMES
from support_exudyn.commands.parser import parser as program_parser
from tests import strategies as some
from user_forces import InputError

OPTIONS = "--out --quick --list --all --machine --pin --runs --workers --machines --help -h"
VALUES = "-- - --o --w --= --out= --workers=2 --workers=1e3 --machines=-1 --machines=٣ --runs=-1"
PLAIN = "--machine=/dev/null contact_laws 0 -1 1e999 nan é %s {0} %(prog)s"
ODD = ("1" * 5000, " ", "", "\x00", "\ud800", "a\nb")
texts = st.text(max_size=6) | st.integers().map(str)
words = st.sampled_from((*OPTIONS.split(), *VALUES.split(), *PLAIN.split(), *ODD)) | texts
command_lines = st.lists(words, max_size=5)


def outcome(call: Callable[[], Any]) -> tuple[Any, int | None, str]:
    """What a call gave, the exit code if it ended the program, and what it said on standard error."""
    said, shown = io.StringIO(), io.StringIO()
    with contextlib.redirect_stderr(said), contextlib.redirect_stdout(shown):
        try:
            return call(), None, said.getvalue()
        except SystemExit as stop:
            return None, int(stop.code or 0), said.getvalue()


def is_usage_and_a_line(said: str, program: str = "studies") -> None:
    """A usage, folded or not, and what is wrong in a line of bounded length."""
    usage, found, wrong = said.rpartition("error: ")
    assert usage.startswith(f"usage: python -m {program}")
    assert found
    assert 0 < len(wrong.strip()) < 1000
    assert "\n" not in wrong.strip()


def check(given_back: Any, code: int | None, said: str) -> None:
    """All is well, or the words are refused with a usage, or what they name is refused in a sentence."""
    assert code in (None, 0, 2)
    assert given_back in (None, 0, 1)
    if code == 2:
        is_usage_and_a_line(said)
    if given_back == 1:
        (wrong,) = [line for line in said.splitlines() if line.startswith("error: ")]
        assert len(wrong) < 1000


def check_options(chosen: Options) -> None:
    assert isinstance(chosen.out, Path)
    for number in (chosen.machines, chosen.runs):
        assert number is None or number >= 1
    assert chosen.subject.is_paper or chosen.subject.pin
    if isinstance(chosen.workers, int):
        assert chosen.workers >= 1


def options(argv: Sequence[str]) -> Options:
    parser = Parser(prog="python -m studies.contact_laws")
    add_options(parser, Path("results"))
    return read_options(parser.parse_args(argv))


@given(argv=command_lines)
@some.tried("options")
def test_options_of_a_study_are_taken_or_refused(argv: list[str]) -> None:
    try:
        chosen, code, said = outcome(lambda: options(argv))
    except (InputError, OSError):  # of a machine that is not there, which `main` says in a line
        return
    check(None, code, said)
    if chosen is not None:
        check_options(chosen)


# --- the program's own commands ---

SHOWN = "--all --from --after --until --difference --tornado --histogram --orbit --poincare --spectrum --pin"
DRAWN = (
    "--phase --out --show --to --every --frames-per-second --speed --movie --size --still --solution --to=csv"
)
own = st.sampled_from((*SHOWN.split(), *DRAWN.split(), "xdmf", "gif", "1280x720", "1x", "0.5", "-1", "tip.x"))


@given(command=st.sampled_from(list(NAMES)) | words, rest=st.lists(own | words, max_size=6))
@some.tried("options")
def test_words_of_the_programs_commands_are_taken_or_refused(command: str, rest: list[str]) -> None:
    found, code, said = outcome(lambda: program_parser().parse_args([command, *rest]))
    assert code in (None, 0, 2)
    if code == 2:
        is_usage_and_a_line(said, "support_exudyn")
    elif code is None:
        assert isinstance(found, argparse.Namespace)
        assert found.command in NAMES
