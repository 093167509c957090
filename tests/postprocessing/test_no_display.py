"""Where no window can be opened, `view` says so in a sentence, whatever is missing."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from support_exudyn import Held, simulate
from support_exudyn.__main__ import main
from tests import screen
from tests.cases.run_cases import support
from tests.processes import environment

if sys.platform != "linux":
    pytest.skip("the displays are of X11", allow_module_level=True)

PATIENCE = 240.0  # [s], on a machine that does much else


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    result = simulate(support(drive=Held(), duration=0.01))
    return result.save(tmp_path_factory.mktemp("run") / "held.h5")


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> pytest.MonkeyPatch:
    """For `view` in this process, in an empty folder; a window would be an error."""
    (tmp_path / "empty").mkdir()
    monkeypatch.chdir(tmp_path / "empty")
    monkeypatch.delenv("EXUDYN_SUPPRESS_UI_WINDOW_OPEN", raising=False)

    def opened(*arguments: object) -> None:
        raise AssertionError

    monkeypatch.setattr("support_exudyn.postprocessing.viewer.view.Window", opened)
    return monkeypatch


def refused_here(run: Path, capsys: pytest.CaptureFixture[str]) -> str:
    assert main(["view", str(run)]) == 1
    said = capsys.readouterr().err
    assert said.startswith("error: ")
    assert list(Path().iterdir()) == []
    return said


def refused(run: Path, env: dict[str, str], folder: Path) -> str:
    command = [sys.executable, "-m", "support_exudyn", "view", str(run)]
    done = subprocess.run(command, env=env, cwd=folder, capture_output=True, text=True, timeout=PATIENCE)
    assert done.returncode == 1
    assert done.stderr.startswith("error: ")
    assert "Traceback" not in done.stderr
    assert list(folder.iterdir()) == []
    return done.stderr


def test_without_a_display_it_says_what_to_do(
    run: Path, here: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        here.delenv(name, raising=False)
    said = refused_here(run, capsys)
    assert "no display" in said
    assert "render RUN" in said
    assert "xvfb-run" in said


def test_a_display_that_is_not_there_is_refused(
    run: Path, here: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    here.setenv("DISPLAY", ":7654")
    assert "no display" in refused_here(run, capsys)


def test_a_display_without_opengl_is_refused(
    run: Path, here: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    screen.needed()
    with screen.display("-extension", "GLX") as name:
        here.setenv("DISPLAY", name)
        assert "GLX" in refused_here(run, capsys)


def test_without_tkinter_it_says_so(
    run: Path, tmp_path: Path, here: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "tkinter.py").write_text("raise ImportError('No module named _tkinter')")
    here.setenv("PYTHONPATH", f"{tmp_path}:{environment()['PYTHONPATH']}")
    assert "python3-tk" in refused_here(run, capsys)


def test_windows_that_are_not_to_open_do_not(run: Path, tmp_path: Path) -> None:
    env = environment() | {"EXUDYN_SUPPRESS_UI_WINDOW_OPEN": "1"}
    assert "EXUDYN_SUPPRESS_UI_WINDOW_OPEN" in refused(run, env, tmp_path)


# --- the tests' own display ---
