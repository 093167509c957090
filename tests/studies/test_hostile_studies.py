"""Studies that are interrupted, started twice, or cannot write."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path

import pytest

from studies import __main__ as all_studies
from studies import report
from studies.common.options import Options
from studies.common.study import work_in_folder
from studies.common.words import Chapter
from tests.hostile import posix_only
from tests.processes import ROOT, environment, linux_only, session_of, wait_until
from tests.studies import hostile_main
from user_forces.values.value import InputError

# --- interrupted, and started twice ---


@dataclass(frozen=True)
class Story:
    """Of a study that another was started next to, and that was then interrupted as by the console."""

    out: Path
    second: subprocess.CompletedProcess[str]
    pid: int
    code: int
    said: str
    seconds: float
    left_over: set[int]


@pytest.fixture(scope="module")
def story(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Story]:
    out = tmp_path_factory.mktemp("results") / "out"
    command = [sys.executable, "-m", hostile_main.__name__, "--workers", "2", "--out", str(out)]
    given = {"cwd": ROOT, "env": environment(), "text": True}
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with subprocess.Popen(command, start_new_session=True, **given, **pipes) as process:  # type: ignore[call-overload]
        try:
            # itself, two workers, and the tracker of what they share
            assert wait_until(lambda: len(session_of(process.pid)) >= 4, 60.0)
            second = subprocess.run(command, capture_output=True, timeout=60, **given)  # type: ignore[call-overload]
            os.killpg(process.pid, signal.SIGINT)
            sent = time.perf_counter()
            _, said = process.communicate(timeout=60)
            seconds = time.perf_counter() - sent
            wait_until(lambda: not session_of(process.pid), 10.0)
            left_over = session_of(process.pid)
            yield Story(out, second, process.pid, process.returncode, said, seconds, left_over)
        finally:
            for pid in session_of(process.pid):
                os.kill(pid, signal.SIGKILL)


@pytest.mark.slow  # four processes, two of them at work
@linux_only
class TestInterrupted:
    """By the console: all its processes at once."""

    def test_it_says_so_in_a_line(self, story: Story) -> None:
        assert story.code == 130
        assert story.said.splitlines()[-1] == "interrupted; nothing half-written is left"
        assert "Traceback" not in story.said
        assert "KeyboardInterrupt" not in story.said

    def test_it_ends_soon_with_all_its_processes(self, story: Story) -> None:
        assert story.seconds < 40.0  # a second or two on an idle machine; the runs would take minutes
        assert story.left_over == set()

    def test_what_was_finished_stays_and_nothing_else(self, story: Story) -> None:
        assert [path.name for path in story.out.iterdir()] == ["summary.json"]
        assert json.loads((story.out / "summary.json").read_text(encoding="utf-8"))["study"] == "hostile"

    def test_a_second_one_into_its_folder_is_told_to_wait(self, story: Story) -> None:
        assert story.second.returncode == 1
        (line,) = story.second.stderr.splitlines()
        assert line.startswith(f"error: --out {story.out}: another process is writing there; wait")


# --- folders ---


def nothing(chosen: object) -> None:
    pytest.fail("the work is begun")


def below_a_file(path: Path) -> Path:
    (path / "file").write_text("", encoding="utf-8")
    return path / "file" / "out"


def a_file(path: Path) -> Path:
    below_a_file(path)
    return path / "file"


def a_dead_link(path: Path) -> Path:
    (path / "link").symlink_to(path / "nowhere" / "deep")
    return path / "link"


PLACES: dict[str, Callable[[Path], Path]] = {
    "below a device": lambda path: Path("/dev/null/x"),
    "a file": a_file,
    "below a file": below_a_file,
    "a dead link": a_dead_link,
    "too long": lambda path: path / ("x" * 300),
}


@posix_only
@pytest.mark.parametrize("place", PLACES)
def test_a_folder_that_cannot_be_made_is_said_before_the_work(
    tmp_path: Path, place: str, capsys: pytest.CaptureFixture[str]
) -> None:
    out = PLACES[place](tmp_path)
    assert work_in_folder(nothing, out) == 1
    assert all_studies.main(["--out", str(out)]) == 1
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 2
    assert all(line.startswith("error: --out ") and "allowed: a folder" in line for line in lines)
    assert report.main(["--out", str(out)]) == 1
    assert capsys.readouterr().err.startswith("error: ")


def put_studies(monkeypatch: pytest.MonkeyPatch, work: Mapping[str, Callable[[Options], None]]) -> None:
    """Studies of the main command that only do this."""

    @dataclass(frozen=True)
    class OnlyWork:
        name: str
        work: Callable[[Options], None]
        seconds: float = 1.0
        own_machine: bool = False
        question: str = "Why?"

        def __call__(self, chosen: Options) -> Chapter:
            self.work(chosen)
            return Chapter(
                study=self.name, title="Title", question="Why?", answer="So.",
                **dict.fromkeys(("method", "findings", "pictures", "sheets"), ()),
            )  # fmt: skip

    monkeypatch.setattr(all_studies, "compiling", nullcontext)
    monkeypatch.setattr(all_studies, "STUDIES", {name: OnlyWork(name, one) for name, one in work.items()})
    monkeypatch.setattr(all_studies, "DEFAULT", tuple(work))
    monkeypatch.setattr(all_studies, "rebuild", lambda out, order: 0)


@pytest.mark.parametrize("error", [InputError("wrong: allowed: right"), RuntimeError("a bug")])
def test_a_study_that_fails_does_not_keep_the_others_from_the_report(
    tmp_path: Path, error: Exception, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    ran: list[str] = []

    def failing(chosen: Options) -> None:
        raise error

    put_studies(monkeypatch, {"one": failing, "two": lambda chosen: ran.append(chosen.out.name)})
    monkeypatch.setattr(all_studies, "rebuild", lambda out, order: ran.append("report") or 0)
    assert all_studies.main(["--workers", "1", "--out", str(tmp_path)]) == 1
    assert ran == ["two", "report"]
    said = capsys.readouterr()
    assert str(error) in said.err
    assert said.err.splitlines()[-1] == "error: failed: one; the report has all the others"
    assert "study 2 of 2: two" in said.err


def test_studies_are_run_by_name_and_unknown_ones_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    ran: list[str] = []
    put_studies(
        monkeypatch, {name: lambda chosen: ran.append(chosen.out.name) for name in ("one", "two", "three")}
    )
    monkeypatch.setattr(all_studies, "DEFAULT", ("one",))
    place = ["--workers", "1", "--out", str(tmp_path)]
    for words, expected in (
        ([], ["one"]),
        (["three", "two"], ["three", "two"]),
        (["--all"], ["one", "two", "three"]),
    ):
        ran.clear()
        assert all_studies.main([*words, *place]) == 0
        assert ran == expected
    said = capsys.readouterr()
    assert "study 2 of 3: two" in said.err
    assert "answer    So." in said.out
    assert said.out.count(str(tmp_path / "report.html")) == 3
    assert all_studies.main(["four", *place]) == 1
    assert "'four': no such study; allowed: one, two, three" in capsys.readouterr().err
    assert all_studies.main(["one", "--all", *place]) == 1
