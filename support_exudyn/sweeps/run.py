"""A sweep: what the store does not hold is run, and the table is written."""

import os
import pickle
import time
from collections.abc import Callable, Iterator
from contextlib import closing, suppress
from dataclasses import dataclass
from itertools import chain
from pathlib import Path

from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.result import Result
from support_exudyn.simulation.simulate import simulate
from support_exudyn.sweeps.key import key
from support_exudyn.sweeps.measures import check_numbers
from support_exudyn.sweeps.plan import Inputs, Plan
from support_exudyn.sweeps.store import Store, StoredRun
from support_exudyn.sweeps.table import FILE, SweepTable
from support_exudyn.sweeps.work import (
    Task,
    in_processes,
    in_threads_first,
    reason_of,
    row_of,
    suits_threads,
)
from user_forces.values.names import nearest
from user_forces.values.value import InputError, short

SELDOM = 10.0  # the table is written every so many seconds while runs come in,
LOOKED_AT = 100  # runs in which a number is looked for that the first has not
SHARE = 0.02  # and this share of the time at most


@dataclass
class SweepOutcome:
    """How far a sweep is.

    runs: of the plan. table: where it is. found: were in the store already. done, failed, killed: rows of the
    table. unmet: done, but less accurate than asked for. pruned: runs that were removed from the store.
    missing: numbers that were asked for and that no run has.
    """

    runs: int
    table: Path
    found: int = 0
    done: int = 0
    failed: int = 0
    killed: int = 0
    unmet: int = 0
    pruned: int = 0
    missing: tuple[str, ...] = ()

    @property
    def finished(self) -> int:
        """Rows that are known."""
        return self.done + self.failed + self.killed


Told = Callable[[SweepOutcome], None]


def sweep(
    plan: Plan,
    out: str | Path | None = None,
    *,
    workers: int | None = None,
    scheduler: str = "",
    retry_failed: bool = False,
    prune: bool = False,
    progress: Told = lambda outcome: None,
) -> SweepOutcome:
    """Run what the store does not hold yet, and write the table.

    Runs that fail are rows with their reason. Interrupted or killed in mid-work, the store holds all that was
    finished, and the same call goes on from there.

    Arguments:
        plan: what to run and what to note.
        out: folder of the store; made if it is missing. By default NAME_sweep beside the sweep's file.
        workers: number of threads or processes on this machine, >= 1; as many as there are cores if None.
        scheduler: address of a Dask scheduler, whose workers then run it all.
        retry_failed: run again what has failed before; what was killed is in any case.
        prune: remove what the store holds of other runs than those of the plan, when all is done.
        progress: is told how far it is after every row.

    Raises InputError if no run can be made of any point, if no folder is known, for numbers that no run can
    have, or if the cluster runs another program; OSError if the store cannot be written to, or if another
    process is writing there.
    """
    out = plan.store if out is None else out
    if out is None:
        raise InputError("out = None: the plan has no file beside which its store may lie; allowed: a folder")
    store = Store(Path(out))
    outcome = SweepOutcome(len(plan.points), store.folder / FILE)
    with store.writing():
        keeper = _Keeper(plan, store, outcome, retry_failed, progress)
        try:
            keeper.run(scheduler, workers or os.cpu_count() or 1)
        finally:
            keeper.look_again()
            keeper.write()
            store.name_runs(dict(zip(keeper.table.run_names, keeper.table.keys, strict=True)))
        if prune:
            outcome.pruned = store.prune(keeper.table.keys)
    outcome.missing = tuple(
        name
        for name in plan.record.numbers
        if not any(c in name for c in "*?[") and name not in keeper.table.numbers
    )
    return outcome


def known(plan: Plan, out: str | Path, retry_failed: bool = False) -> SweepOutcome:
    """How far a sweep is, without running anything."""
    store = Store(Path(out))
    outcome = SweepOutcome(len(plan.points), store.folder / FILE)
    keeper = _Keeper(plan, store, outcome, retry_failed, lambda outcome: None)
    for _ in keeper.tasks():
        pass
    return outcome


def open_run(plan: Plan, name: str, out: str | Path | None = None) -> Result:
    """A run of a sweep: read from its file if that is kept, else computed again.

    Arguments:
        plan: of the sweep.
        name: of the run in the table, such as "run_07".
        out: folder of the store; by default NAME_sweep next to the sweep's file.

    Raises InputError if there is no such run, or if it cannot be run; SimulationError if it fails.
    """
    names = plan.run_names
    if name not in names:
        raise InputError(f"run = {short(name)}: there is none of this name; {nearest(name, names)}")
    scenario = plan.scenario(plan.points[names.index(name)])
    folder = plan.store if out is None else Path(out)
    file = Store(folder or Path()).run_file(key(scenario, plan.errors))
    return Result.load(file) if file.exists() else simulate(scenario, errors=plan.errors)


class _Keeper:
    """What is known so far, in the table."""

    def __init__(
        self, plan: Plan, store: Store, outcome: SweepOutcome, retry_failed: bool, progress: Told
    ) -> None:
        self.table = SweepTable(plan)
        self._plan, self._store, self._outcome = plan, store, outcome
        self._retry_failed = retry_failed
        self._progress = progress
        self._places: dict[str, list[int]] = {}  # of keys under way
        self._rows: dict[str, int] = {}  # of keys that are known: where
        self._checked, self._refused = False, list[InputError]()
        self._wait, self._written = SELDOM, time.monotonic()

    def run(self, scheduler: str, workers: int) -> None:
        """Run what is not known; if all is, no process is started."""
        tasks = self._missing()
        if (first := next(tasks, None)) is None:
            return
        tasks = chain([first], tasks)
        if scheduler:
            from support_exudyn.sweeps.cluster import on_cluster

            found = on_cluster(tasks, self._store, scheduler)
        elif suits_threads(first):
            found = in_threads_first(tasks, self._store, workers)
        else:
            found = in_processes(tasks, self._store, workers)
        with closing(found) as rows:  # also after an interruption processes end before the table is written
            for row in rows:
                self._note(self._places[row.key], row)

    def _missing(self) -> Iterator[Task]:
        """What is to be run; of runs that are kept other numbers are noted at once."""
        for task, kept in self.tasks():
            if kept:
                with suppress(InputError, OSError):  # damaged since, in a way that its size and age do not tell
                    row = row_of(task, Result.load(self._store.run_file(task.key)))
                    self._note(self._places[task.key], self._store.put(row))
                    continue
            yield task

    def tasks(self) -> Iterator[tuple[Task, bool]]:
        """What is not known, and whether its run is kept; all else goes straight into the table."""
        for number, point in enumerate(self._plan.points):
            try:
                scenario = self._plan.scenario(point)
                self._plan.record.check(scenario)
                task = Task(key(scenario, self._plan.errors), scenario, self._plan.record, self._plan.errors)
                pickle.dumps(scenario)  # as it is sent to other processes
            except Exception as error:  # of classes of one's own any
                self._refuse(number, error)
                continue
            if not self._checked:
                self._check_numbers(task.scenario, number)
                self._checked = True
            places = self._places.setdefault(task.key, [])
            places.append(number)
            if len(places) > 1 and task.key not in self._rows:
                continue  # it is under way
            row = self._store.row(task.key)
            whole = row is not None and row.status == "done" and self._store.has_run(row)
            if row is None or not self._is_good(row, whole):
                yield task, whole
                continue
            self._outcome.found += len(places) == 1
            self._rows[task.key] = number
            self._set([number], row)
        if len(self._refused) == len(self._plan.points):
            raise self._refused[0]  # that is no sweep

    def _is_good(self, row: StoredRun, whole: bool) -> bool:
        """Whether what is known of a run is what is wanted; whole: the run itself is there, too."""
        if row.status == "failed":
            return not self._retry_failed
        record = self._plan.record
        return row.status == "done" and row.noted == record.digest and (whole or not record.keep_runs)

    def _refuse(self, number: int, error: Exception) -> None:
        self._refused.append(error if isinstance(error, InputError) else InputError(reason_of(error)))
        self._set([number], StoredRun("", "failed", reason_of(error)))

    def _check_numbers(self, scenario: Scenario, first: int) -> None:
        """Raise InputError for a number that no run can have.

        A run with an ideal pin has fewer than one with clearance, so others are looked at, too.
        """
        points = self._plan.points[first:][: LOOKED_AT + 1]
        for name in self._plan.record.numbers:
            if not any(self._can_have(name, point) for point in points):
                check_numbers(scenario, [name])

    def _can_have(self, name: str, point: Inputs) -> bool:
        try:
            check_numbers(self._plan.scenario(point), [name])
        except Exception:  # of classes of one's own any
            return False
        return True

    def _note(self, numbers: list[int], row: StoredRun) -> None:
        """Note a run that has ended."""
        self._rows.setdefault(row.key, numbers[0])
        self._set(numbers, row)
        if time.monotonic() - self._written > self._wait:
            self.write()

    def look_again(self) -> None:
        """Note what was finished while nobody listened any more."""
        for name, numbers in self._places.items():
            if name not in self._rows:
                row = self._store.row(name)
                if row is not None and self._is_good(row, True):
                    self._rows[name] = numbers[0]
                    self._set(numbers, row)

    def _set(self, numbers: list[int], row: StoredRun) -> None:
        for number in numbers:
            self.table.set(number, row)
            setattr(self._outcome, row.status, getattr(self._outcome, row.status) + 1)
            self._outcome.unmet += row.status == "done" and bool(row.reason)
        self._progress(self._outcome)

    def write(self) -> None:
        """Write the table."""
        began = time.monotonic()
        self.table.write(self._store.folder)
        self._written = time.monotonic()
        self._wait = max(SELDOM, (self._written - began) / SHARE)
