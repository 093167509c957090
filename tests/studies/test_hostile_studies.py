"""Studies that are interrupted, started twice, or cannot write."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import nullcontext
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import pytest

from studies import __main__ as all_studies
from studies import report
from studies.catalogue import DEFAULT, STUDIES
from studies.claims import hypercube
from studies.claims.plausible import REFERENCE
from studies.common.chapter import Chapter
from studies.common.numbers import Number, write_summary
from studies.common.options import Options
from studies.common.study import Study, StudyOutcome, save_figures, say_short, work_in_folder
from studies.common.subject import paper_subject
from studies.common.witness import Witness
from support_exudyn.files.whole_file import writing_alone
from support_exudyn.postprocessing.figures import style
from support_exudyn.sweeps.workers import ProcessEndedError, Workers
from tests.hostile import DISKS, left_behind, little_room, posix_only
from tests.processes import ROOT, environment, linux_only, session_of, wait_until
from tests.studies import hostile_main
from user_forces.values.value import InputError

# --- interrupted, and started twice ---


@dataclass(frozen=True)
class Story:
    """Of a study that another was started beside, and that was then interrupted as by the console."""

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
        assert line.startswith(
            f"error: --out {story.out}: another process ({story.pid}) is writing there; wait"
        )


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


def test_a_folder_whose_name_no_folder_can_have_is_said_before_the_work(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "a\0b"
    assert work_in_folder(nothing, out) == 1
    assert "allowed: a folder" in capsys.readouterr().err
    with pytest.raises(SystemExit):
        all_studies.main(["--out", str(out)])
    assert "allowed: a name that a folder can have" in capsys.readouterr().err


@posix_only
def test_all_studies_wait_for_one_that_writes_all(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with writing_alone(tmp_path):
        assert all_studies.main(["--out", str(tmp_path)]) == 1
    assert f"another process ({os.getpid()}) is writing there" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


WITH_WITNESS = "judged"  # the name of a study that has a witness


def put_studies(monkeypatch: pytest.MonkeyPatch, work: Mapping[str, Callable[[Options], None]]) -> None:
    """Studies of the main command that only do this."""

    @dataclass(frozen=True)
    class OnlyWork:
        name: str
        work: Callable[[Options], None]
        seconds: float = 1.0
        own_machine: bool = False
        question: str = "Why?"

        def begin(self, chosen: Options) -> tuple[Chapter, StudyOutcome]:
            self.work(chosen)
            said = Chapter(self.name, "Title", "Why?", (), (), (), (), answer="So.")
            witness = Witness({}, lambda runs: [], lambda numbers: {}) if self.name == WITH_WITNESS else None
            return said, StudyOutcome([], {}, {}, {}, witness=witness)

        def with_witness(self, chosen: Options, found: StudyOutcome) -> None:
            self.work(replace(chosen, out=chosen.out.with_name(f"witness of {self.name}")))

    monkeypatch.setattr(all_studies, "compiling", nullcontext)
    monkeypatch.setattr(all_studies, "STUDIES", {name: OnlyWork(name, one) for name, one in work.items()})
    monkeypatch.setattr(all_studies, "DEFAULT", tuple(work))
    monkeypatch.setattr(all_studies, "rebuild", lambda out, order: 0)


def test_a_witness_is_computed_after_the_papers_studies_and_before_others(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    ran: list[str] = []
    names = (WITH_WITNESS, "two", "three")
    put_studies(monkeypatch, dict.fromkeys(names, lambda chosen: ran.append(chosen.out.name)))
    monkeypatch.setattr(all_studies, "DEFAULT", names[:2])
    assert all_studies.main(["--all", "--workers", "1", "--out", str(tmp_path)]) == 0
    assert ran == [WITH_WITNESS, "two", f"witness of {WITH_WITNESS}", "three"]


def test_an_interruption_ends_all_studies(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    ran: list[str] = []

    def interrupted(chosen: Options) -> None:
        ran.append(chosen.out.name)
        left_behind(chosen.out)
        raise KeyboardInterrupt

    put_studies(monkeypatch, {"one": lambda o: ran.append(o.out.name), "two": interrupted, "three": nothing})
    with pytest.raises(SystemExit, match="130"):
        all_studies.main(["--workers", "1", "--out", str(tmp_path)])
    assert ran == ["one", "two"]
    assert sorted(path.name for path in tmp_path.rglob("*")) == ["one", "two"]


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
    assert said.out.count("can be read now") == 2  # of the two commands with more than one study
    assert said.out.count(str(tmp_path / "report.html")) == 3 + 2
    assert all_studies.main(["four", *place]) == 1
    assert "'four': no such study; allowed: one, two, three" in capsys.readouterr().err
    assert all_studies.main(["one", "--all", *place]) == 1


def test_all_studies_are_told_with_question_and_time(capsys: pytest.CaptureFixture[str]) -> None:
    assert all_studies.main(["--list"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines] == [*STUDIES, "benchmark", "adams"]
    for line, study in zip(lines, STUDIES.values(), strict=False):  # the last two are none
        assert study.question in line
        assert re.search(r"\d+ (s|min)\b", line)
        assert ("takes --machine" in line) == study.own_machine
    assert [line.split()[0] for line in lines if "the paper's answer" in line] == list(DEFAULT)


def test_what_a_study_says_in_the_terminal_has_ten_lines(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    chapter = Chapter(
        "name", "Title", "What does it do? " * 8, (), (), (), (), answer="It does this, see [@fig]. " * 8,
        numbers=("force: 1 N", "path: 2 mm", "angle: 3 deg"),
    )  # fmt: skip
    say_short(chapter, tmp_path)
    said = capsys.readouterr().out
    assert len(said.strip().splitlines()) <= 10
    assert "[@" not in said
    assert str(tmp_path) in said


def test_a_study_of_the_papers_machine_alone_refuses_another(tmp_path: Path) -> None:
    about = Study("only", "Why?", lambda chosen: pytest.fail("it is begun"))
    mine = replace(paper_subject(), name="mine")
    with pytest.raises(InputError, match="--machine: only is about the paper's machine alone"):
        about(Options(tmp_path, subject=mine))


# --- disks ---


@pytest.mark.parametrize("kind", DISKS)
def test_a_study_on_a_full_disk_says_which_file_and_leaves_the_old_ones(
    tmp_path: Path, kind: str, capsys: pytest.CaptureFixture[str]
) -> None:
    drawing, axes = plt.subplots()
    axes.plot([0.0, 1.0], [0.0, 1.0])
    with little_room(tmp_path, 65536, kind) as folder:
        chosen = Options(folder / "out")

        def numbers(count: int) -> Callable[[Options], None]:
            many = [Number("n", str(n), 1.0, "1", 0.0) for n in range(count)]
            return lambda chosen: (write_summary(chosen.out, "study", many, 0.0), None)[1]

        def figure(chosen: Options) -> None:
            with style.look():
                (chosen.out / "figure.png").write_bytes(b"old")
                (chosen.out / "filler").write_bytes(bytes(50000))
                save_figures(chosen, {"figure": drawing})

        assert work_in_folder(lambda out: numbers(1)(chosen), chosen.out) == 0
        old = (chosen.out / "summary.json").read_bytes()
        capsys.readouterr()
        assert work_in_folder(lambda out: numbers(2000)(chosen), chosen.out) == 1
        (line,) = capsys.readouterr().err.splitlines()
        assert line.startswith(f"error: {chosen.out / 'summary.json'}: ")
        assert line.endswith("it cannot be written")
        assert (chosen.out / "summary.json").read_bytes() == old
        if kind == "full disk":  # the figure alone is smaller than the limit
            assert work_in_folder(lambda out: figure(chosen), chosen.out) == 1
            (line,) = capsys.readouterr().err.splitlines()
            assert line.startswith(f"error: {chosen.out / 'figure.png'}: ")
            assert line.endswith("it cannot be written")
            assert (chosen.out / "figure.png").read_bytes() == b"old"
        assert not [path for path in chosen.out.iterdir() if path.name.startswith(".")]
    plt.close(drawing)


# --- the hypercube ---


def cheap(number: int, place: Path, sample: dict[str, object]) -> None:
    """In place of a machine's run, which takes seconds."""
    place.write_text(json.dumps({"sample": sample, "measures": {}, "failure": None}), encoding="utf-8")


class OneIsKilled(Workers):
    """Does the work here, and has the process of the second job killed."""

    def __init__(self) -> None:
        super().__init__(ThreadPoolExecutor(1), None)

    def run(self, jobs: Any, work: Any, progress: Any, ended: Any = None) -> list[Any]:
        return [
            ended(ProcessEndedError(place, 0.5, -9)) if place == 1 else work(place, *job)
            for place, job in enumerate(jobs)
        ]


def test_a_machine_whose_process_is_killed_is_a_row_that_is_not_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(hypercube, "_run_one", cheap)
    monkeypatch.setattr(hypercube, "warm_up", lambda: None)
    machines = [REFERENCE | {"scale": scale} for scale in (0.7, 0.8, 0.9)]
    rows = hypercube.run(machines, tmp_path, OneIsKilled(), lambda done, of: None)
    assert [row.sample["scale"] for row in rows] == [0.7, 0.8, 0.9]
    assert [row.failure for row in rows] == [
        None,
        "the process that computed it ended: signal 9 (SIGKILL, out of memory?)",
        None,
    ]
    assert rows[1].measures is None
    assert len(list((tmp_path / hypercube.FOLDER).iterdir())) == 2  # it is tried again next time
