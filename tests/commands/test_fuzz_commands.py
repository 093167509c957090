"""Command lines of any words: options, or exit code 2 with a usage and one line; never a traceback."""

from __future__ import annotations

import contextlib
import importlib
import io
from collections.abc import Callable, Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

import studies.__main__ as all_studies
from studies import report
from studies.benchmarking import benchmark
from studies.catalogue import STUDIES
from studies.common import study
from studies.common.study import ALL_OPTIONS, Options, options, run_main
from studies.scene_detail import run as scene_detail
from tests import strategies as some
from user_forces import InputError

words = (
    st.sampled_from(
        (
            *(
                "--out",
                "--quick",
                "--workers",
                "--machines",
                "--commit-evidence",
                "--help",
                "-h",
                "--",
                "-",
                "--o",
            ),
            *(
                "--w",
                "--=",
                "--out=",
                "--workers=2",
                "--workers=1e3",
                "--machines=-1",
                "--machines=٣",
                "1",
                "0",
            ),
            *(
                "-1",
                "1e999",
                "1" * 5000,
                "nan",
                " ",
                "",
                "\x00",
                "\ud800",
                "é",
                "%s",
                "{0}",
                "%(prog)s",
                "a\nb",
            ),
        )
    )
    | st.text(max_size=6)
    | st.integers().map(str)
)
command_lines = st.lists(words, max_size=5)


def outcome(call: Callable[[], Any]) -> tuple[Any, int | None, str]:
    """What a call gave, the exit code if it ended the program, and what it said on standard error."""
    said, shown = io.StringIO(), io.StringIO()
    with contextlib.redirect_stderr(said), contextlib.redirect_stdout(shown):
        try:
            return call(), None, said.getvalue()
        except SystemExit as stop:
            return None, int(stop.code or 0), said.getvalue()


def is_usage_and_a_line(said: str) -> None:
    """A usage, folded or not, and what is wrong in a line of bounded length."""
    usage, found, wrong = said.rpartition("error: ")
    assert usage.startswith("usage: python -m studies")
    assert found
    assert 0 < len(wrong.strip()) < 1000
    assert "\n" not in wrong.strip()


def check(code: int | None, said: str, chosen: Options | None) -> None:
    assert code in (None, 0, 2)
    if code == 2:
        is_usage_and_a_line(said)
    elif chosen is not None:
        assert isinstance(chosen.out, Path)
        if isinstance(chosen.workers, NoPool):  # which was asked for as many as were noted
            return
        assert isinstance(chosen.workers, int)
        assert chosen.workers >= 1
        assert chosen.machines is None or chosen.machines >= 1


@given(argv=command_lines, taken=st.lists(st.sampled_from(ALL_OPTIONS), unique=True))
@some.tried("options")
def test_options_of_a_study_are_taken_or_refused(argv: list[str], taken: Sequence[str]) -> None:
    chosen, code, said = outcome(lambda: options("contact_laws", argv, "What is asked.", taken))
    check(code, said, chosen)


class NoPool:
    """In place of processes."""

    def __enter__(self) -> NoPool:
        return self

    def __exit__(self, *_: object) -> None:
        pass


PLACES = (*(f"{name}.run" for name in STUDIES), "benchmarking.benchmark", "report")


@pytest.fixture
def nothing_runs(monkeypatch: pytest.MonkeyPatch) -> list[Options]:
    """Studies that only note with what they would run."""
    noted: list[Options] = []

    def note(_: object, chosen: Options) -> int:
        noted.append(chosen)
        return 0

    for module in (study, scene_detail, benchmark):  # where a study begins
        monkeypatch.setattr(module, "run_main", note)
    monkeypatch.setattr(all_studies, "run_main", note)
    monkeypatch.setattr(all_studies, "worker_pool", lambda number: NoPool())
    monkeypatch.setattr(all_studies, "rebuild", lambda *_: 0)
    monkeypatch.setattr(report, "rebuild", lambda *_: 0)
    monkeypatch.setattr(
        scene_detail, "EvidenceTable", SimpleNamespace(load=lambda _: SimpleNamespace(save=lambda _: 0))
    )
    return noted


def test_every_study_takes_its_command_line_or_refuses_it(nothing_runs: list[Options]) -> None:
    mains = [importlib.import_module(f"studies.{name}").main for name in PLACES]

    @given(argv=command_lines, main=st.sampled_from((all_studies.main, *mains)))
    @some.tried("all studies")
    def holds(argv: list[str], main: Callable[[Sequence[str]], int]) -> None:
        nothing_runs.clear()
        given_back, code, said = outcome(lambda: main(argv))
        assert given_back in (None, 0)
        check(code, said, nothing_runs[0] if nothing_runs else None)

    holds()


@pytest.mark.parametrize("out", ["\x00", "a\x00b", "\ud800", "x" * 300, "/dev/null/x", "/proc/nothing"])
def test_a_folder_that_cannot_be_is_refused_in_a_sentence(
    out: str, capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    chosen, code, said = outcome(lambda: options("contact_laws", ["--out", out], "What is asked."))
    if code == 2:
        return is_usage_and_a_line(said)
    assert run_main(lambda _: None, chosen) == 1
    said = capsys.readouterr().err
    assert said.startswith("error: --out ")
    assert "allowed: " in said
    return None


def test_an_input_that_a_study_refuses_is_a_sentence(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    def study(_: Options) -> None:
        raise InputError("Scenario.step = 0.0: allowed: > 0")

    assert run_main(study, Options(tmp_path, quick=True, workers=1)) == 1
    assert "error: Scenario.step = 0.0: allowed: > 0" in capsys.readouterr().err


def test_a_number_of_thousands_of_digits_is_refused_in_a_line() -> None:
    chosen, code, said = outcome(lambda: options("contact_laws", ["--workers", "1" * 5000], "What is asked."))
    assert (chosen, code) == (None, 2)
    is_usage_and_a_line(said)
