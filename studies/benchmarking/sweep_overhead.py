"""What does a sweep cost beside its runs, and how much faster are two cores than one?

A thousand runs of the paper's rise; 256 machines whose numbers are drawn, in a sweep and as the study of the
claims runs them. Measured in turns, in folders that are made for it. Nothing is asserted. Measure on a machine
that does nothing else: two processes on two cores have none to spare. What each step takes of the processor is
measured apart, in this process alone; other work on the machine changes that less.

The table of the last measurement that was kept is `studies/benchmarking/SWEEPS.md`, made by

    python -m studies.benchmarking.sweep_overhead && cp results/sweep_overhead/SWEEPS.md studies/benchmarking/
"""

import os
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from studies.benchmarking import process
from studies.claims import hypercube
from studies.claims.plausible import samples
from studies.claims.run import SEED
from studies.common import paper_machine
from studies.common.study import folder_of, show_table, work_in_folder
from support_exudyn import Scenario, SolverSettings, simulate
from support_exudyn.files.temporary import workshop
from support_exudyn.files.whole_file import whole_file
from support_exudyn.postprocessing.page.pieces import Sheet
from support_exudyn.simulation.result import with_digest
from support_exudyn.sweeps import Plan, grid, read_sweep, read_table, sweep
from support_exudyn.sweeps.plan import Inputs
from support_exudyn.sweeps.run import SweepOutcome
from support_exudyn.sweeps.store import Store
from support_exudyn.sweeps.work import Wanted, row_of
from support_exudyn.sweeps.workers import keep_memory

STUDY = "sweep_overhead"
RUNS, MACHINES = 1000, 256
TURNS = 2  # of each sweep of rises, of which the fastest counts
STEPS_OF = 100  # rises whose steps are measured apart
MOST_OVERHEAD, LEAST_GAIN, MOST_SECONDS = 0.002, 1.9, 8.0  # asked [s a run; two cores over one; s]
RISE = replace(
    paper_machine.clearance_rise(1.5, 0.0, 1e-3, law=paper_machine.PAPERS_LAW),
    formulation="compiled",
    solver=SolverSettings(),
)
DRAWN = f"""
method = "latin_hypercube"
samples = {MACHINES}
seed = 1

[scenario]
machine = "reference"
duration_s = 5
formulation = "compiled"
drive = {{ mode = 2 }}
pins.rear_base.clearance_mm = 1.5

[vary]
"machine.*" = "stated range"
"""


def rise(point: Inputs) -> Scenario:
    """The paper's rise with clearance and all channels, some milliseconds of work."""
    joint = paper_machine.clearance_joint(float(point["clearance_mm"]), 0.0, law=paper_machine.PAPERS_LAW)
    return replace(RISE, pins={paper_machine.CLEARANCE_PIN: joint})


RISES = Plan(grid({"clearance_mm": np.linspace(1.45, 1.55, RUNS).tolist()}), rise)


@dataclass(frozen=True)
class Timing:
    """A sweep: its runs, processes, wall time and the sum of what its runs took [s].

    started: until the first run had ended, but for what that run took [s].
    """

    runs: int
    workers: int
    wall: float
    work: float
    started: float

    @property
    def overhead(self) -> float:
        """What a run took beyond its simulation, start of the processes not counted [s]."""
        return (self.wall - self.started - self.work / self.workers) / self.runs


def timed(plan: Plan, workers: int) -> Timing:
    """Time a sweep into a new store."""
    first: list[float] = []
    with tempfile.TemporaryDirectory() as folder:
        began = time.perf_counter()

        def note(outcome: SweepOutcome) -> None:
            if not first:
                first.append(time.perf_counter() - began)

        outcome = sweep(plan, Path(folder), workers=workers, progress=note)
        wall = time.perf_counter() - began
        walls = [
            one or 0.0 for one in read_table(folder)["wall_time_s"].to_pylist()
        ]  # none of a refused machine
    return Timing(outcome.runs, workers, wall, sum(walls), max(0.0, first[0] - walls[0]))


def rises() -> list[tuple[str, ...]]:
    """The paper's rise with one process and with two, each the best of its turns."""
    found: dict[int, list[Timing]] = {1: [], 2: []}
    for _ in range(TURNS):
        for workers, turns in found.items():
            turns.append(timed(RISES, workers))
            print(f"{turns[-1]}, {1e3 * turns[-1].overhead:.3g} ms", file=sys.stderr)
    alone, two = (min(turns, key=lambda one: one.wall) for turns in found.values())
    gains = f"{alone.wall / two.wall:.2f}", f"{(alone.wall - alone.started) / (two.wall - two.started):.2f}"
    return [(*_told(f"{RUNS} rises", alone), "", ""), (*_told(f"{RUNS} rises", two), *gains)]


def machines() -> list[tuple[str, ...]]:
    """Machines whose numbers are drawn: a rise of each by a sweep, and as the study of the claims runs them."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "drawn.toml"
        path.write_text(DRAWN, encoding="utf-8")
        swept = timed(read_sweep(path), 2)
    lines = [(*_told(f"a rise of each of {MACHINES} drawn machines", swept), "", "")]
    with tempfile.TemporaryDirectory() as folder:
        began = time.perf_counter()
        hypercube.run(samples(MACHINES, SEED), Path(folder), 2, lambda done, of: None)
        taken = time.perf_counter() - began
    lines.append((f"{MACHINES} machines of the claims", "2", f"{taken:.1f}", *5 * ("",)))
    return lines


def _told(name: str, one: Timing) -> tuple[str, ...]:
    times = f"{one.wall:.2f}", f"{one.started:.2f}", f"{1e3 * one.work / one.runs:.1f}"
    return name, str(one.workers), *times, f"{1e3 * one.overhead:.1f}"


def steps() -> list[tuple[str, str]]:
    """What each step of a rise takes of the processor [ms], the median of some."""
    taken: dict[str, list[float]] = {}
    before = time.process_time()

    def lap(step: str) -> None:
        nonlocal before
        now = time.process_time()
        taken.setdefault(step, []).append(now - before)
        before = now

    wanted = Wanted(RISES.scenario, RISES.record)
    keep_memory()  # as the processes of a sweep do
    with tempfile.TemporaryDirectory() as folder:
        store = Store(Path(folder))
        with workshop(store.folder) as within:
            for point in RISES.points[: STEPS_OF + 1]:
                before = time.process_time()
                task = wanted.task(point)
                lap("scenario and key")
                result = simulate(task.scenario)
                lap("simulation")
                row = row_of(task, result)
                lap("numbers")
                image = result.image()
                lap("its bytes")
                pieces = with_digest(image)
                lap("their digest")
                store.put(row, pieces, within)
                lap("writing run and row")
    found = {step: float(np.median(each[1:])) for step, each in taken.items()}  # the first imports and compiles
    beside = sum(found.values()) - found["simulation"]
    return [(step, f"{1e3 * one:.2f}") for step, one in (found | {"all but simulation": beside}).items()]


def busy() -> str:
    """How much the machine has to do before anything is measured."""
    if not hasattr(os, "getloadavg"):
        return ""
    return f" The load of the machine was {os.getloadavg()[0]:.1f} when it was begun."


def study(out: Path) -> None:
    """Measure, print and write the tables."""
    others = busy()
    apart = Sheet(
        title="Sweeps: processor time of a rise, by steps",
        header=("step", "a run [ms]"),
        rows=tuple(steps()),
        caption=f"The median of {STEPS_OF} runs in one process.{others}",
    )
    show_table(out / "sweep_steps", apart, width=150)
    table = Sheet(
        title=f"Sweeps: what they cost beside their runs (rises: the fastest of {TURNS} turns)",
        header=(
            "sweep", "processes", "wall [s]", "of it start [s]", "a run [ms]", "overhead a run [ms]",
            "gain over one", "without start",
        ),
        rows=(*rises(), *machines()),
        caption=(
            f"Asked of {RUNS} rises on two cores: an overhead of at most {1e3 * MOST_OVERHEAD:g} ms a run, and "
            f"a gain of at least {LEAST_GAIN:g}; of {MACHINES} machines at most {MOST_SECONDS:g} s. Overhead: "
            "wall time less start and less the sum of the runs' own times over the number of processes; making "
            "scenarios and keys, sending, numbers, saving run and row, and the table. Start: importing the "
            "package in the processes, and loading what is compiled. A machine of the claims is 18 runs, "
            f"to tighter tolerances.{others}"
        ),
    )  # fmt: skip
    show_table(out / "sweep_overhead", table, width=150)
    with whole_file(out / "SWEEPS.md") as temporary:
        words = "\n\n".join(["# Sweeps", process.machine(), process.markdown(table), process.markdown(apart)])
        temporary.write_text(words + "\n", encoding="utf-8")


def main(argv: Sequence[str] | None = None) -> int:
    """Entry of `python -m studies.benchmarking.sweep_overhead`."""
    return work_in_folder(study, folder_of(f"benchmarking.{STUDY}", __doc__, argv))


if __name__ == "__main__":
    sys.exit(main())
