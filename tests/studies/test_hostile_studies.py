"""Studies that are interrupted, started twice, or cannot write."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import nullcontext
from pathlib import Path

import pytest

from studies import __main__ as all_studies
from studies import report
from studies.common.options import Options
from studies.common.study import Study, work_in_folder
from studies.common.words import Chapter
from support_exudyn.commands.command_line import carry_out
from tests.hostile import posix_only
from user_forces.values.value import InputError

# --- folders ---


def nothing(chosen: object) -> None:
    pytest.fail("the work is begun")


@posix_only
@pytest.mark.parametrize("place", ["/dev/null/x", "a file"])
def test_a_folder_that_cannot_be_made_is_said_before_the_work(
    tmp_path: Path, place: str, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "a file").touch()
    out = tmp_path / place  # what begins with / stays what it is
    assert work_in_folder(nothing, out) == 1
    assert all_studies.main(["--out", str(out)]) == 1
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 2
    assert all(line.startswith("error: --out ") and "allowed: a folder" in line for line in lines)
    assert carry_out(report.app, ["--out", str(out)]) == 1
    assert capsys.readouterr().err.startswith("error: ")


def put_studies(monkeypatch: pytest.MonkeyPatch, work: Mapping[str, Callable[[Options], None]]) -> None:
    """Studies of the main command that only do this."""

    def only(name: str, one: Callable[[Options], None]) -> type[Study]:
        class OnlyWork(Study):
            """Why?"""

            def write(self) -> Chapter:
                one(self.chosen)
                return Chapter(
                    study=name, title="Title", question="Why?", answer="So.",
                    **dict.fromkeys(("method", "findings", "pictures", "sheets"), ()),
                )  # fmt: skip

        return OnlyWork

    monkeypatch.setattr(all_studies, "compiling", nullcontext)
    monkeypatch.setattr(all_studies, "STUDIES", {name: only(name, one) for name, one in work.items()})
    monkeypatch.setattr(all_studies, "DEFAULT", tuple(work))
    monkeypatch.setattr(all_studies, "rebuild", lambda out: None)


@pytest.mark.parametrize("error", [InputError("wrong: allowed: right"), RuntimeError("a bug")])
def test_a_study_that_fails_does_not_keep_the_others_from_the_report(
    tmp_path: Path, error: Exception, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    ran: list[str] = []

    def failing(chosen: Options) -> None:
        raise error

    put_studies(monkeypatch, {"one": failing, "two": lambda chosen: ran.append(chosen.out.name)})
    monkeypatch.setattr(all_studies, "rebuild", lambda out: ran.append("report"))
    assert all_studies.main(["--workers", "1", "--out", str(tmp_path)]) == 1
    assert ran == ["two", "report"]
    said = capsys.readouterr()
    assert str(error) in said.err
    assert "failed: one; the report has all the others" in said.err


@pytest.mark.parametrize(
    ("words", "expected"),
    [([], ["one"]), (["three", "two"], ["three", "two"]), (["--all"], ["one", "two", "three"])],
)
def test_studies_are_run_by_name(
    words: list[str], expected: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    ran: list[str] = []
    names = ("one", "two", "three")
    put_studies(monkeypatch, {name: lambda chosen: ran.append(chosen.out.name) for name in names})
    monkeypatch.setattr(all_studies, "DEFAULT", ("one",))
    assert all_studies.main([*words, "--workers", "1", "--out", str(tmp_path)]) == 0
    assert ran == expected


def test_names_that_no_study_has_are_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for words in (["four"], ["claims", "--all"], ["--pin", "rear_base"]):
        assert all_studies.main([*words, "--out", str(tmp_path)]) == 1
        assert "allowed: " in capsys.readouterr().err
