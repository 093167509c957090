"""The run in Exudyn's solution viewer, on a display in memory: start, step through frames, close."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

from support_exudyn import CubicStep, Result, simulate
from tests import screen
from tests.processes import environment, wait_until
from tests.reference.cases import loose_support

if sys.platform != "linux":
    pytest.skip("the display in memory is of X11", allow_module_level=True)

PATIENCE = 240.0  # [s], on a machine that does much else
VIEWER, ENGINE = "solution viewer", "Exudyn OpenGL window"


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    result = simulate(loose_support(1.5, 0.25, drive=CubicStep(start=0.0, end=0.3, stroke=0.2), duration=0.3))
    return result.save(tmp_path_factory.mktemp("run") / "rise.h5")


@pytest.fixture(scope="module")
def display() -> Iterator[str]:
    screen.needed()
    with screen.display() as name:
        yield name


@contextmanager
def viewing(run: Path, display: str, home: Path, *options: str) -> Iterator[subprocess.Popen[str]]:
    """`python -m support_exudyn view RUN`, ended if it does not end by itself."""
    program = subprocess.Popen(
        [sys.executable, "-m", "support_exudyn", "view", str(run), *options],
        env=screen.environment_on(display, home),
        cwd=home,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        yield program
    finally:
        if program.poll() is None:
            program.kill()
        program.communicate()


@pytest.mark.parametrize("shown", ["records", "solution file"])
def test_it_starts_steps_through_frames_and_closes(
    run: Path, shown: str, display: str, tmp_path: Path
) -> None:
    options = []
    if shown == "solution file":
        options = ["--solution", str(Result.load(run).save_solution(tmp_path / "rise.sol")), "--every", "3"]
    x = screen.Screen(display)
    with viewing(run, display, tmp_path, *options) as program:

        def window() -> int | None:
            assert program.poll() is None, program.stderr.read()
            return next((number for title, number in x.windows().items() if VIEWER in title), None)

        assert wait_until(lambda: window() is not None, PATIENCE)
        # it plays by itself: ever other pictures, of which the last is of a window with a machine in it
        seen = {screen.picture(display).tobytes()}

        def plays() -> bool:
            assert program.poll() is None, program.stderr.read()
            seen.add(screen.picture(display).tobytes())
            return len(seen) >= 5

        assert wait_until(plays, PATIENCE)
        dialog = window()
        assert dialog is not None
        x.ask_to_close(dialog)
        said, told = program.communicate(timeout=PATIENCE)
    x.close()
    assert program.returncode == 0
    assert told == ""
    assert [entry for entry in tmp_path.iterdir() if entry.name not in ("rise.sol", ".exudyn")] == []


STEP = """
import sys
import numpy as np
from support_exudyn import Result
from support_exudyn.view import window
result = Result.load(sys.argv[1])
with window(result, size=(900, 600)) as shown:
    found = {}
    for row in (0, 150, 300):
        shown.show(row)
        found[f"time{row}"] = shown.time
        found[f"picture{row}"] = shown.picture()
np.savez(sys.argv[2], **found)
"""


def test_a_script_steps_through_frames_without_the_dialog(run: Path, display: str, tmp_path: Path) -> None:
    script = [sys.executable, "-c", STEP, str(run), str(tmp_path / "seen.npz")]
    env = screen.environment_on(display, tmp_path)
    subprocess.run(script, env=env, check=True, timeout=PATIENCE)
    seen = np.load(tmp_path / "seen.npz")
    result = Result.load(run)
    for row in (0, 150, 300):
        assert seen[f"time{row}"] == result.time[row]
        assert seen[f"picture{row}"].shape == (600, 900, 3)
    first, middle, last = (painted(seen[f"picture{row}"]) for row in (0, 150, 300))
    # upright and the goaf, where the links are, on the right: forward, the canopy, is on the left and on top
    above, below = first[150:300].any(axis=0), first[400:].any(axis=0)
    assert np.flatnonzero(above).min() < np.flatnonzero(below).min()
    # nothing is cut off, and the machine fills the window
    for shown in (first, middle, last):
        columns, lines = np.flatnonzero(shown.any(axis=0)), np.flatnonzero(shown.any(axis=1))
        assert 0 < columns.min() < columns.max() < 899
        assert lines.max() < 599
        assert columns.max() - columns.min() > 600
    # it rises
    tops = [np.flatnonzero(shown.any(axis=1)).min() for shown in (first, middle, last)]
    assert tops[0] > tops[1] > tops[2]


def painted(picture: np.ndarray) -> np.ndarray:
    """Where a machine is in a picture: neither white, nor the black of words, nor the axes in the corner."""
    colours = picture.astype(int)
    inside = (colours.min(axis=2) < 225) & (colours.max(axis=2) > 60)
    inside[:100, :500] = inside[480:, :150] = False
    inside[570:] = False
    return inside


# --- where no window opens ---


def refused(run: Path, env: dict[str, str], folder: Path) -> str:
    command = [sys.executable, "-m", "support_exudyn", "view", str(run)]
    done = subprocess.run(command, env=env, cwd=folder, capture_output=True, text=True, timeout=PATIENCE)
    assert done.returncode == 1
    assert done.stderr.startswith("error: ")
    assert "Traceback" not in done.stderr
    assert list(folder.iterdir()) == []
    return done.stderr


def test_without_a_display_it_says_what_to_do(run: Path, tmp_path: Path) -> None:
    env = {name: value for name, value in environment().items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
    said = refused(run, env, tmp_path)
    assert "no display" in said
    assert "render RUN" in said
    assert "xvfb-run" in said


def test_a_display_that_is_not_there_is_refused(run: Path, tmp_path: Path) -> None:
    assert "no display" in refused(run, environment() | {"DISPLAY": ":7654"}, tmp_path)


def test_a_display_without_opengl_is_refused(run: Path, tmp_path: Path) -> None:
    screen.needed()
    with screen.display("-extension", "GLX") as name:
        assert "GLX" in refused(run, environment() | {"DISPLAY": name}, tmp_path)


def test_without_tkinter_it_says_so(run: Path, tmp_path: Path) -> None:
    folder = tmp_path / "empty"
    folder.mkdir()
    (tmp_path / "tkinter.py").write_text("raise ImportError('No module named _tkinter')")
    env = environment()
    env["PYTHONPATH"] = f"{tmp_path}:{env['PYTHONPATH']}"
    assert "python3-tk" in refused(run, env, folder)


def test_windows_that_are_not_to_open_do_not(run: Path, tmp_path: Path) -> None:
    env = environment() | {"EXUDYN_SUPPRESS_UI_WINDOW_OPEN": "1"}
    assert "EXUDYN_SUPPRESS_UI_WINDOW_OPEN" in refused(run, env, tmp_path)
