"""What the README and the pages of the rooms show works as it stands there."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest
from cyclopts import CycloptsError

from support_exudyn.commands.app import COMMANDS, app
from support_exudyn.files.scenarios.scenario_file import read_scenario
from support_exudyn.postprocessing.comparing.mapping import read_compare_file
from support_exudyn.sweeps import read_sweep
from tests.pages import ROOT, Listing, links, listings, named, pages

SHOWN = [one for page in pages() for one in listings(page)]
A_RISE = next(listings(ROOT / "support_exudyn" / "scenario" / "in_python.md"))
NAMES = {name for commands in COMMANDS.values() for name in commands}
PROGRAM = re.compile(r"^(?:support-exudyn|python -m support_exudyn)\s+")


def of_kind(kind: str) -> list[Listing]:
    return [one for one in SHOWN if one.kind == kind]


def told(one: Listing) -> str:
    return f"{named(one.page)}:{one.number}"


@pytest.mark.parametrize("page", pages(), ids=named)
def test_links_and_pictures_are_there(page: Path) -> None:
    assert [link for link in links(page) if not (page.parent / link).exists()] == []


def extends(one: Listing) -> bool:
    """Whether it adds a class to the package, which other tests should not meet."""
    return one.page.parent.name == "extending"


def check_printed(one: Listing, printed: list[str]) -> None:
    """What is printed begins as the comment behind each print says; a number with an error is so within it."""
    promised = [
        line.partition("  # ")[2] for line in one.text.splitlines() if line.lstrip().startswith("print(")
    ]
    assert len(printed) == len(promised)
    for line, promise in zip(printed, promised, strict=True):
        number, known, error = promise.partition(" ± ")
        if known:  # its last digits hang on the machine
            told, size = float(line.partition(" ± ")[0]), float(error.split()[0])
            assert told == pytest.approx(float(number), abs=2.0 * size)
            assert line.split()[-1] == error.split()[1]
        else:
            assert line.startswith(promise.partition(":")[0])


@pytest.mark.parametrize(
    "one", [one for one in of_kind("python") if not extends(one) and one != A_RISE], ids=told
)
def test_python_prints_what_its_comments_say(
    one: Listing, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    exec(compile(one.text, told(one), "exec"), {})
    check_printed(one, capsys.readouterr().out.splitlines())


@pytest.mark.slow  # a process each
@pytest.mark.parametrize("one", [one for one in of_kind("python") if extends(one)], ids=told)
def test_what_extends_the_package_runs(one: Listing, tmp_path: Path) -> None:
    (tmp_path / "listing.py").write_text(one.text, encoding="utf-8")
    path = os.pathsep.join(filter(None, [str(ROOT), os.environ.get("PYTHONPATH", "")]))
    done = subprocess.run(
        [sys.executable, "listing.py"], cwd=tmp_path, env={**os.environ, "PYTHONPATH": path},
        capture_output=True, text=True, timeout=300, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    check_printed(one, done.stdout.splitlines())


def command_lines() -> list[tuple[str, str]]:
    """All command lines that pages show, as listings or in a sentence: page, and words behind the program."""
    found = []
    for page in pages():
        text = page.read_text(encoding="utf-8")
        spans = re.findall(r"`([^`\n]+)`", re.sub(r"^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE))
        spans += [line.strip() for line in text.splitlines()]
        for span in spans:
            words = span.split()
            if PROGRAM.match(span):
                found.append((named(page), PROGRAM.sub("", span)))
            elif words and words[0] in NAMES and f"`{span}`" in text and words[1:2] not in ([], ["="]):
                found.append((named(page), span))
    return found


def is_read(line: str) -> bool:
    words = shlex.split(line.replace("COMMAND ...", "docs"), comments=True)
    if words[:1] == ["--import"]:  # of all commands
        del words[:2]
    try:
        app.parse_args(words)
    except CycloptsError:
        return False
    return True


def test_command_lines_of_pages_can_be_read() -> None:
    found = command_lines()
    assert len(found) > 60
    assert not is_read("plot rise.h5 --no-such-option")
    assert [(page, line) for page, line in found if not is_read(line)] == []


@pytest.mark.parametrize("one", of_kind("toml"), ids=told)
def test_toml_is_read(one: Listing, tmp_path: Path) -> None:
    path = tmp_path / "shown.toml"
    path.write_text(one.text, encoding="utf-8")
    if "[vary]" in one.text:
        scenario = next(other for other in listings(one.page) if "machine = " in other.text)
        (tmp_path / "rise.toml").write_text(scenario.text, encoding="utf-8")
        assert read_sweep(path)
    elif "[tolerances]" in one.text:
        assert read_compare_file(path, [Path("measured.csv")])
    elif "machine" in one.text:
        assert read_scenario(path)


@pytest.mark.parametrize(
    "seconds", [pytest.param(2.0, id="whole", marks=pytest.mark.slow), pytest.param(0.1, id="its beginning")]
)
def test_the_example_of_a_scenario_is_a_sound_run(
    seconds: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert A_RISE.text.count("duration=2.0") == 1
    exec(compile(A_RISE.text.replace("duration=2.0", f"duration={seconds}"), told(A_RISE), "exec"), {})
    lines = capsys.readouterr().out.splitlines()
    check_printed(A_RISE, lines)
    assert float(lines[0].split()[0]) > 58000.0  # the static force in the low posture
    assert float(lines[1].split()[0]) < 3e-3  # 0.01 to 0.25 %, by rounding and by the step
    assert (tmp_path / "pin_1mm.h5").stat().st_size > 0
