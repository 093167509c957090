"""What commands take from start to end: the tutorial's run, a first run, help, a look at a run; and memory."""

import math
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import NamedTuple

import support_exudyn
from studies.benchmarking.lines import BenchmarkLine, left_out
from studies.benchmarking.stopwatch import on_one_core

ROOT = Path(support_exudyn.__file__).parents[1]
TUTORIAL, RUN = "clearance.toml", "clearance.h5"  # of the set of files that `init` writes
TURNS = 3
PREPARING = 10.0  # at most, to write the tutorial's files [s]
GROW = """
import sys
from pathlib import Path
from dataclasses import replace
from studies.benchmarking.scenes import SCENES
from support_exudyn import SolverSettings, simulate
def peak():  # of this program alone; getrusage would tell that of the process which started it too
    status = Path("/proc/self/status").read_text()
    return int(status.split("VmHWM:")[1].split()[0]) / 1024
scene = replace(SCENES["drop"].scenario, record_period=0.1, step=2e-3, formulation=sys.argv[1],
                solver=SolverSettings(impact_steps=64, tolerance=1e-5))
simulate(replace(scene, duration=2.0))
before = peak()
simulate(replace(scene, duration=float(sys.argv[2])))
print(before, peak())
"""
LONG = 50.0  # of what a run grows to, 2 s at first [s]
GROWN = "1.1"  # how much more memory is asked for at most


class CommandRow(NamedTuple):
    """A command line of the program, what was asked for, and what it may take in all turns [s].

    is_first: whether nothing is compiled yet.
    """

    what: str
    words: Sequence[str]
    asked: str
    most: float
    is_first: bool = False


COMMANDS = (
    CommandRow("tutorial's run, draft", ("run", TUTORIAL, "--accuracy", "draft"), "1 s", 20.0),
    CommandRow("tutorial's run, standard", ("run", TUTORIAL, "--accuracy", "standard"), "1.5 s", 14.0),
    CommandRow("command line, --help", ("--help",), "0.3 s", 3.0),
    CommandRow("command line, show", ("show", RUN), "0.8 s", 4.0),
    CommandRow(
        "first run of a fresh installation, draft", ("run", TUTORIAL, "--accuracy", "draft"), "10 s", 25.0, True
    ),
)


class Took(NamedTuple):
    """Time of a process from start to end [s], and that of the processor."""

    wall: float
    processor: float


@contextmanager
def tutorial() -> Iterator[Path]:
    """The tutorial's folder, in which files are written as its first command does."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "support"
        with suppress(subprocess.SubprocessError, OSError):
            _timed(("init", "four_column_support", "--out", str(folder)), Path(name), {}, PREPARING)
        folder.mkdir(exist_ok=True)
        yield folder


def command_line(row: CommandRow, folder: Path, most: float) -> BenchmarkLine:
    """Time a command in the tutorial's folder, a few times within a time [s]."""
    began, found, how = time.monotonic(), list[Took](), " ".join(row.words)
    try:
        while len(found) < (1 if row.is_first else TURNS):
            spent = time.monotonic() - began
            if found and spent + found[-1].wall > most:
                break
            with tempfile.TemporaryDirectory() as empty:
                fresh = {"NUMBA_CACHE_DIR": empty} if row.is_first else {}
                found.append(_timed(row.words, folder, fresh, most - spent))
    except subprocess.TimeoutExpired:
        if not found:
            return BenchmarkLine(row.what, how, most, asked=row.asked, is_more=True, note="ended")
    except (subprocess.SubprocessError, OSError) as error:
        return left_out(row.what, _failed(error), how, asked=row.asked)
    least = min(found)
    wanted = 1 if row.is_first else TURNS
    cut = f"; {len(found)} of {wanted} turns" if len(found) < wanted else ""
    processor = "" if math.isnan(least.processor) else f"processor {least.processor:.3g} s"
    return BenchmarkLine(row.what, how, least.wall, asked=row.asked, note=processor + cut)


def _timed(words: Sequence[str], folder: Path, more: dict[str, str], most: float) -> Took:
    return _process(("-m", "support_exudyn", *words), folder, more, most)[0]


def _process(words: Sequence[str], folder: Path, more: dict[str, str], most: float) -> tuple[Took, str]:
    """Run Python within a time [s]; what it took, and what it printed."""
    known = {"PYTHONPATH": os.pathsep.join(filter(None, (str(ROOT), os.environ.get("PYTHONPATH", ""))))}
    before, began = os.times(), time.perf_counter()
    with on_one_core():
        done = subprocess.run(
            [sys.executable, *words],
            cwd=folder,
            env=os.environ | known | more,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=max(most, 0.01),
            check=True,
        )
    wall, after = time.perf_counter() - began, os.times()
    used = after.children_user + after.children_system - before.children_user - before.children_system
    return Took(wall, used if used > 0.0 else math.nan), done.stdout  # Windows does not tell


def _failed(error: Exception) -> str:
    """Why a command did not come to its end."""
    if isinstance(error, subprocess.CalledProcessError) and error.stderr:
        return str(error.stderr).strip().splitlines()[-1]
    return f"failed: {type(error).__name__}"


def memory_line(formulation: str, most: float) -> BenchmarkLine:
    """Peak memory of a run and of one many times as long, with records every 0.1 s."""
    what, how = f"memory of a run 25 times as long: {formulation}", f"{LONG:g} s"
    if not Path("/proc/self/status").exists():
        return left_out(what, "this system does not tell", how, asked=GROWN)
    try:
        _, said = _process(("-c", GROW, formulation, f"{LONG:g}"), ROOT, {}, most)
    except subprocess.TimeoutExpired:
        return left_out(what, f"ended after {most:.0f} s", how, asked=GROWN)
    except (subprocess.SubprocessError, OSError) as error:
        return left_out(what, _failed(error), how, asked=GROWN)
    before, after = map(float, said.split())
    return BenchmarkLine(what, how, after, "2 s", before, GROWN, unit="MB")


def importing(most: float) -> BenchmarkLine:
    """What importing the package takes beyond the engine's import."""
    what, asked = "import of the package, beyond the engine's", "0.5 s"
    program = (
        "import time, exudyn; t = time.perf_counter(); "
        "from support_exudyn import ClearancePin, Scenario, machine, simulate; "
        "print(time.perf_counter() - t)"
    )
    try:
        times = [float(_process(("-c", program), ROOT, {}, most / TURNS)[1]) for _ in range(TURNS)]
    except (subprocess.SubprocessError, OSError) as error:
        return left_out(what, _failed(error), asked=asked)
    return BenchmarkLine(what, "", min(times), asked=asked)
