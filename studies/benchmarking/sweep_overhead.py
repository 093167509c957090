"""What does a sweep cost beside its runs, and how much faster are two cores than one?

Measured in turns, in folders that are made for it. Nothing is asserted. Measure on a machine that does nothing
else: two processes on two cores have none to spare. What each step takes of the processor is measured apart, in
this process alone; other work on the machine changes that little.

The table of the last measurement that was kept is `studies/benchmarking/SWEEPS.md`, made by

    python -m studies.benchmarking.sweep_overhead && cp results/sweep_overhead/SWEEPS.md studies/benchmarking/
"""

import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from studies.benchmarking import process
from studies.common import paper_machine
from studies.common.study import folder_of, show_table, work_in_folder
from support_exudyn import Scenario, simulate
from support_exudyn.files.whole_file import whole_file
from support_exudyn.postprocessing.page.pieces import Sheet
from support_exudyn.sweeps import Plan, grid, read_table, sweep
from support_exudyn.sweeps.key import key
from support_exudyn.sweeps.plan import Inputs
from support_exudyn.sweeps.run import SweepOutcome
from support_exudyn.sweeps.store import Store
from support_exudyn.sweeps.work import Task, row_of

STUDY = "sweep_overhead"
SHORT, LONG = 300, 160  # runs of a sweep of short ones, of longer ones (a minute on two cores)
STEPS_OF = 100  # short runs whose steps are measured apart
MOST_OVERHEAD, LEAST_GAIN = 0.020, 1.8  # what was asked for [s a run; two cores over one]


def short_rise(point: Inputs) -> Scenario:
    """A rise of 0.2 s with ideal pins, some milliseconds of work."""
    return replace(paper_machine.ideal_rise(1e-3), duration=0.2, gravity=(0.0, -float(point["gravity"])))


def long_rise(point: Inputs) -> Scenario:
    """A rise of 0.3 s with a clearance pin, some tenths of a second of work."""
    return replace(paper_machine.clearance_rise(float(point["clearance_mm"]), 0.0, 5e-4), duration=0.3)


PLANS = {
    "short": Plan(grid({"gravity": np.linspace(9.0, 10.0, SHORT).tolist()}), short_rise),
    "longer": Plan(grid({"clearance_mm": np.linspace(1.0, 2.0, LONG).tolist()}), long_rise),
}


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
        walls = read_table(folder)["wall_time_s"].to_pylist()
    return Timing(outcome.runs, workers, wall, sum(walls), max(0.0, first[0] - walls[0]))


def rows() -> list[tuple[str, ...]]:
    """All sweeps, each the best of its turns."""
    found: dict[tuple[str, int], list[Timing]] = {}
    for name in ("short", "longer", "short"):
        for workers in (1, 2):
            one = timed(PLANS[name], workers)
            found.setdefault((name, workers), []).append(one)
            print(f"{name}: {one}, {1e3 * one.overhead:.3g} ms", file=sys.stderr)
    best = {key: min(turns, key=lambda one: one.wall) for key, turns in found.items()}
    lines: list[tuple[str, ...]] = []
    for (name, workers), one in best.items():
        alone = best[name, 1]
        gain = alone.wall / one.wall
        steady = (alone.wall - alone.started) / (one.wall - one.started)
        gains = ("", "") if workers == 1 else (f"{gain:.2f}", f"{steady:.2f}")
        times = f"{one.wall:.2f}", f"{one.started:.2f}", f"{1e3 * one.work / one.runs:.1f}"
        lines.append((f"{one.runs} {name} runs", str(workers), *times, f"{1e3 * one.overhead:.1f}", *gains))
    return lines


def steps() -> list[tuple[str, str]]:
    """What each step of a short run takes of the processor [ms], the mean of some."""
    taken = dict.fromkeys(("scenario and key", "simulation", "numbers", "saving the run", "its row"), 0.0)
    before = time.process_time()

    def lap(step: str) -> None:
        nonlocal before
        now = time.process_time()
        taken[step] += now - before
        before = now

    plan = PLANS["short"]
    with tempfile.TemporaryDirectory() as folder:
        store = Store(Path(folder))
        for number in range(STEPS_OF + 1):
            if number == 1:  # the first imports and compiles
                taken = dict.fromkeys(taken, 0.0)
            before = time.process_time()
            scenario = plan.scenario(plan.points[number])
            name = key(scenario)
            lap("scenario and key")
            result = simulate(scenario)
            lap("simulation")
            row = row_of(Task(name, scenario, plan.record), result)
            lap("numbers")
            result.save(store.run_file(name))
            lap("saving the run")
            store.put(row)
            lap("its row")
    beside = sum(taken.values()) - taken["simulation"]
    return [
        (step, f"{1e3 * one / STEPS_OF:.2f}") for step, one in (taken | {"all but simulation": beside}).items()
    ]


def study(out: Path) -> None:
    """Measure, print and write the tables."""
    apart = Sheet(
        title="Sweeps: processor time of a short run, by steps",
        header=("step", "a run [ms]"),
        rows=tuple(steps()),
        caption=f"The mean of {STEPS_OF} runs in one process. Sending a run and noting its row come "
        "on top, with less than a millisecond.",
    )
    show_table(out / "sweep_steps", apart, width=150)
    table = Sheet(
        title="Sweeps: what they cost beside their runs (short ones: the faster of two turns)",
        header=(
            "sweep", "processes", "wall [s]", "of it start [s]", "a run [ms]", "overhead a run [ms]",
            "gain over one", "without start",
        ),
        rows=tuple(rows()),
        caption=(
            f"Asked: an overhead of at most {1e3 * MOST_OVERHEAD:g} ms a run, and a gain of at least "
            f"{LEAST_GAIN:g} on two cores. Overhead: wall time less start and less the sum of the runs' own "
            "times over the number of processes; making scenarios and keys, sending, saving run and row, and "
            "the table. Start: importing the package in the processes, and loading what is compiled."
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
