"""A sweep: what the store does not hold is run, and the table is written."""

import os
import time
from collections.abc import Callable, Iterator
from contextlib import closing, suppress
from dataclasses import dataclass
from pathlib import Path

from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.result import Result
from support_exudyn.simulation.simulate import simulate
from support_exudyn.sweeps.key import key
from support_exudyn.sweeps.measures import check_numbers, is_pattern
from support_exudyn.sweeps.plan import Plan
from support_exudyn.sweeps.store import Store, StoredRun
from support_exudyn.sweeps.table import FILE, SweepTable
from support_exudyn.sweeps.work import Task, here, reason_of
from user_forces.values.names import nearest
from user_forces.values.value import InputError, short

SELDOM = 10.0  # the table is written every so many seconds while runs come in,
SHARE = 0.02  # and this share of the time at most
LOOKED_AT = 100  # runs in which a number is looked for that the first has not


@dataclass
class SweepOutcome:
    """How far a sweep is.

    runs: of the plan. table: where it is. found: were in the store already. done, failed, killed: rows of the
    table. unmet: done, but less accurate than asked for. pruned: rows that were removed from the store.
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


def _ignore(outcome: SweepOutcome) -> None:
    del outcome


def sweep(
    plan: Plan,
    out: str | Path | None = None,
    *,
    workers: int | None = None,
    scheduler: str = "",
    retry_failed: bool = False,
    prune: bool = False,
    progress: Told = _ignore,
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
        progress: receives how far it is after every row.

    Raises InputError if no run can be made of any point, if no folder is known, for numbers that no run can
    have, or if the cluster runs another program; OSError if the store cannot be written to, or if another
    process is writing there.
    """
    out = plan.store if out is None else out
    if out is None:
        raise InputError("out = None: the plan has no file beside which its store may lie; allowed: a folder")
    keeper = _Keeper(plan, Store(Path(out)), retry_failed, progress)
    outcome, table = keeper.outcome, keeper.table
    with keeper.store.writing():
        try:
            keeper.run(scheduler, workers or os.cpu_count() or 1)
        finally:
            table.write(keeper.store.folder)
        if prune:
            outcome.pruned = keeper.store.prune(table.keys)
    outcome.missing = tuple(
        name for name in plan.record.numbers if not is_pattern(name) and name not in table.numbers
    )
    return outcome


def known(plan: Plan, out: str | Path, retry_failed: bool = False) -> SweepOutcome:
    """How far a sweep is, without running anything."""
    keeper = _Keeper(plan, Store(Path(out)), retry_failed, _ignore)
    with keeper.store.reading():
        for _ in keeper.missing():
            pass
    return keeper.outcome


def open_run(plan: Plan, name: str) -> Result:
    """Compute a run of a sweep again, with all its channels.

    Arguments:
        plan: of the sweep.
        name: of the run in the table, such as "run_07".

    Raises InputError if there is no such run, or if it cannot be run; SimulationError if it fails.
    """
    names = plan.run_names
    if name not in names:
        raise InputError(f"run = {short(name)}: there is none of this name; {nearest(name, names)}")
    return simulate(plan.scenario(plan.points[names.index(name)]), errors=plan.errors)


class _Keeper:
    """What is known so far, in the table."""

    def __init__(self, plan: Plan, store: Store, retry_failed: bool, progress: Told) -> None:
        self.store, self.table = store, SweepTable(plan)
        self.outcome = SweepOutcome(len(plan.points), store.folder / FILE)
        self._plan, self._retry_failed, self._progress = plan, retry_failed, progress
        self._places: dict[str, list[int]] = {}  # of keys that are known or under way

    def run(self, scheduler: str, workers: int) -> None:
        """Run what is not known; the table is written now and then."""
        if scheduler:
            from support_exudyn.sweeps.cluster import on_cluster

            found = on_cluster(self.missing(), scheduler)
        else:
            found = here(self.missing(), workers)
        wait, written = SELDOM, time.monotonic()
        with closing(found) as rows:  # also after an interruption processes end before the table is written
            for row in rows:
                self.store.put(row)
                self._set(self._places[row.key], row)
                if (began := time.monotonic()) - written > wait:
                    self.table.write(self.store.folder)
                    written = time.monotonic()
                    wait = max(SELDOM, (written - began) / SHARE)

    def missing(self) -> Iterator[Task]:
        """What is not known; all else goes straight into the table."""
        record, checked, refused = self._plan.record, False, list[InputError]()
        for number, point in enumerate(self._plan.points):
            try:
                scenario = self._plan.scenario(point)
                record.check(scenario)
                name = key(scenario, self._plan.errors)
            except Exception as error:  # of classes of one's own any
                refused.append(error if isinstance(error, InputError) else InputError(reason_of(error)))
                self._set([number], StoredRun("", "failed", reason_of(error)))
                continue
            if not checked:
                self._check_numbers(scenario, number)
                checked = True
            places = self._places.setdefault(name, [])
            places.append(number)
            row = self.store.row(name)
            if len(places) > 1 and self.table.status[places[0]] == "waiting":
                continue  # it is under way
            if len(places) > 1 or (row is not None and self._is_good(row)):
                assert row is not None
                self.outcome.found += len(places) == 1
                self._set([number], row)
            else:
                yield Task(name, scenario, record, self._plan.errors)
        if len(refused) == len(self._plan.points):
            raise refused[0]  # that is no sweep

    def _is_good(self, row: StoredRun) -> bool:
        """Whether what is known of a run is what is wanted."""
        if row.status == "failed":
            return not self._retry_failed
        return row.status == "done" and row.noted == self._plan.record.digest

    def _check_numbers(self, scenario: Scenario, first: int) -> None:
        """Raise InputError for a number that no run can have.

        A run with an ideal pin has fewer than one with clearance, so others are looked at, too.
        """
        left = list(self._plan.record.numbers)
        for point in self._plan.points[first:][: LOOKED_AT + 1]:
            for name in [*left]:
                with suppress(Exception):  # of classes of one's own any
                    check_numbers(self._plan.scenario(point), [name])
                    left.remove(name)
            if not left:
                return
        check_numbers(scenario, left)

    def _set(self, numbers: list[int], row: StoredRun) -> None:
        for number in numbers:
            self.table.set(number, row)
            setattr(self.outcome, row.status, getattr(self.outcome, row.status) + 1)
            self.outcome.unmet += row.status == "done" and bool(row.reason)
        self._progress(self.outcome)
