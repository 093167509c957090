"""The run in Exudyn's solution viewer, on a display in memory: start, step through frames, close."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from support_exudyn import CubicStep, Result, save_solution, simulate
from tests import screen
from tests.cases.run_cases import loose_support
from tests.processes import wait_until

if sys.platform != "linux":
    pytest.skip("the display in memory is of X11", allow_module_level=True)

PATIENCE = 240.0  # [s], on a machine that does much else
VIEWER, ENGINE = "solution viewer", "Exudyn OpenGL"


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


# records are shown below, too
@pytest.mark.parametrize("shown", [pytest.param("records", marks=pytest.mark.slow), "solution file"])
def test_it_starts_steps_through_frames_and_closes(run: Path, shown: str, display: str, tmp_path: Path) -> None:
    options = []
    if shown == "solution file":
        options = ["--solution", str(save_solution(Result.load(run), tmp_path / "rise.sol")), "--every", "3"]
    x = screen.Screen(display)
    with viewing(run, display, tmp_path, *options) as program:

        def window(named: str) -> int | None:
            assert program.poll() is None, program.stderr.read()
            return next((number for title, number in x.windows().items() if named in title), None)

        assert wait_until(lambda: None not in (window(VIEWER), window(ENGINE)), PATIENCE)
        # it plays by itself: below the dialog, which covers a corner of it, the engine's window shows ever
        # other pictures, far more than it does while it opens
        context: set[bytes] = set()

        def plays() -> bool:
            assert program.poll() is None, program.stderr.read()
            context.add(screen.picture(display)[300:700, :1100].tobytes())
            return len(context) >= 12

        assert wait_until(plays, PATIENCE)
        dialog = window(VIEWER)
        assert dialog is not None
        x.ask_to_close(dialog)
        _, told = program.communicate(timeout=PATIENCE)
    x.close()
    assert program.returncode == 0
    assert "Traceback" not in told
    # nothing is left behind but what libraries keep in a home
    assert {entry.name for entry in tmp_path.iterdir() if not entry.name.startswith(".")} <= {"rise.sol"}
