"""The work of the pytest plugin: runs that are kept, closeness to a reference, baselines of tests."""

from __future__ import annotations

import math
import re
import time
from collections.abc import Mapping, Sequence
from contextlib import suppress
from fnmatch import fnmatchcase
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from filelock import FileLock

from support_exudyn.files.series.named_series import NamedSeries, SeriesFile
from support_exudyn.postprocessing.comparing.baselines import (
    ENDING,
    FOLDER,
    changes,
    determined_until,
    kept_run,
    lines,
    read_baseline,
    write_baseline,
)
from support_exudyn.postprocessing.comparing.compared_channel import ComparedChannel, ComparedColumn, compared
from support_exudyn.postprocessing.comparing.compared_file import compared_file, recorded_columns
from support_exudyn.postprocessing.comparing.mapping import BOTH_ERRORS, tolerance
from support_exudyn.postprocessing.figures.selection import matching
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.estimate import Estimate
from support_exudyn.simulation.result import Result
from support_exudyn.simulation.simulate import simulate
from support_exudyn.sweeps.key import key
from user_forces.values.names import meant
from user_forces.values.value import InputError, short

Measured = Result | NamedSeries | Estimate | float
Reference = Measured | SeriesFile | str | PathLike[str] | Mapping[str, NamedSeries | Estimate | float]
ALONE = "it"  # the name of a number without a name
OLD = 30 * 86400.0  # [s] since a run was made, after which it is made anew
NO_NAME = re.compile(r"[^\w.-]+")  # is left out of a file's name
LONGEST = 150  # letters of a file's name
FEW = 5  # changes in the message of a failure


def cached_run(folder: Path, scenario: Scenario, errors: bool = False) -> Result:
    """The run of a scenario in a folder, made if it is not there or damaged; always read from its file.

    The key of a run is that of sweeps. Several processes may use the folder: the first makes a run, others
    that ask for the same wait for it. A new run removes those that are older than `OLD`.

    errors: whether errors are estimated, see `simulate`, whose exceptions are raised; OSError if the run cannot
    be kept.
    """
    path = folder / f"{key(scenario, errors)}.h5"
    with FileLock(path.with_suffix(".lock")):
        with suppress(InputError, OSError):  # it is not there, or damaged
            return Result.load(path)
        for other in folder.iterdir():
            with suppress(OSError):  # another process may remove it at the same time
                if time.time() - other.stat().st_mtime > OLD:
                    other.unlink()
        return Result.load(simulate(scenario, errors=errors).save(path))


def baseline_path(test_file: Path, name: str) -> Path:
    """The file of a test's baseline, in a folder next to the test's file."""
    return test_file.parent / FOLDER / f"{NO_NAME.sub('_', name).strip('_.')[:LONGEST] or ALONE}{ENDING}"


def against_baseline(item: Any, path: Path, updated: Sequence[str]) -> tuple[str, bool]:
    """Compare a result with errors, an Estimate, or Estimates by names, with a baseline, or write it.

    updated: names, or patterns of them, of baselines that are written.

    Returns:
        The changes, or that there is no baseline, in lines, empty if nothing has changed; and whether
        the baseline was written.

    Raises InputError if it is damaged, or if the item cannot be a baseline.
    """
    named = {ALONE: item} if isinstance(item, Estimate) else item
    is_named = isinstance(named, Mapping) and all(isinstance(each, Estimate) for each in named.values())
    if not (is_named or isinstance(named, Result)):
        allowed = "a Result with errors, an Estimate, or Estimates by their names"
        raise InputError(f"{short(item)}: cannot be a baseline; allowed: {allowed}")
    now, report = kept_run(named), [f"{path}: there is no such baseline"]
    if path.exists():
        changed = changes(read_baseline(path), now)
        if not changed:
            return "", False
        head = f"{path.stem}: {len(changed)} changed by more than both errors, new, or gone"
        report = [head, *lines(changed, FEW)]
    if any(fnmatchcase(path.stem, pattern) for pattern in updated):
        write_baseline(now, path)
        return "\n".join([f"{path}: written", *report]), True
    return "\n".join([*report, f"to write it: pytest --baseline-update {path.stem}"]), False


def closeness(
    result: Measured,
    reference: Reference,
    allowed: float | str | None = None,
    *,
    channels: Sequence[str] = (),
    after: float = 0.0,
    until: float = math.inf,
) -> list[ComparedChannel]:
    """Each curve or number of a result against its reference, those that are not within first.

    Arguments:
        result: a Result, a NamedSeries, an Estimate such as `result.numbers()[name]`, or a number.
        reference: another Result; a file with curves, by its path or as `read_series` gives it; a NamedSeries;
            an Estimate or a number; or several of these by the names of channels and numbers of a Result.
        allowed: a relative tolerance, such as 0.02 or "2 %": of curves it is of the range of the reference, of
            numbers of their reference; an amount with its unit, "0.1 mm"; None: the errors of both, which have
            to be known of one side at least, and of curves up to the time when runs are determined.
        channels: of a Result, by names or patterns; without, all that both have.
        after, until: the part of curves and runs that is compared [s].

    Raises InputError if there is nothing to compare, if units do not fit, or if the tolerance is none.
    """
    is_share = isinstance(allowed, (int, float)) and not isinstance(allowed, bool)
    text = f"{100.0 * float(allowed or 0.0):.12g} %" if is_share else str(allowed)
    rule = BOTH_ERRORS if allowed is None else tolerance("*", text)
    is_named = isinstance(reference, Mapping)
    if isinstance(reference, (str, PathLike)):
        read = compared_file(Path(reference))
        reference = read.columns if read.run is None else read.run  # type: ignore[assignment]
    if isinstance(result, Result):
        numbers = result.numbers(after, until) if result.coarser is not None else {}
        mine = {name: _column(number) for name, number in numbers.items()} | recorded_columns(result)
        its = _columns(reference)
        missing = [name for name in its if name not in mine]
        if missing and (is_named or len(missing) == len(its)):
            known = meant(missing[0], list(mine))
            why = "the result has no such channel or number with an error"
            raise InputError(
                f"{missing[0]}: {why}; {known}; allowed: names of the result's channels and numbers"
            )
        names = [name for name in its if name in mine]
        names = matching(names, channels) if channels else names
    else:
        mine, column = _columns(result), _column(reference)
        names, its = list(mine), dict.fromkeys(mine, column)
    if rule.is_errors:
        runs = [run for run in (result, reference) if isinstance(run, Result)]
        until = min([until, *map(determined_until, runs)])
    close = [compared(name, its[name], mine[name], rule, after=after, until=until) for name in names]
    if rule.is_errors and (unknown := [each.name for each in close if np.isnan(each.errors).all()]):
        raise InputError(
            f"{unknown[0]}: no numerical error is known; allowed: a tolerance, such as '2 %', or runs with an "
            "accuracy"
        )
    return sorted(close, key=lambda channel: not channel.faults)


def _columns(item: Any) -> dict[str, ComparedColumn]:
    """Curves and numbers by their names, as columns. Raises InputError if an item is neither."""
    if isinstance(item, Result):
        determined = [name for name, each in item.channels.items() if each.is_determined and name != "time"]
        return recorded_columns(item, determined)
    item = item.series if isinstance(item, SeriesFile) else item
    if isinstance(item, Mapping) and item:
        return {name: _column(each) for name, each in item.items()}
    return {item.name if isinstance(item, NamedSeries) else ALONE: _column(item)}


def _column(item: Any) -> ComparedColumn:
    """A curve or number as a column. Raises InputError if it is neither."""
    if isinstance(item, ComparedColumn):
        return item
    if isinstance(item, NamedSeries):
        return ComparedColumn.of_series(item)
    if isinstance(item, Estimate):
        return ComparedColumn.of_number(item, item.unit)
    if isinstance(item, (int, float)) and not isinstance(item, bool):
        return ComparedColumn.of_number(Estimate(float(item), math.nan, ""), None)
    raise InputError(f"{short(item)}: cannot be compared; allowed: a NamedSeries, an Estimate, a number")
