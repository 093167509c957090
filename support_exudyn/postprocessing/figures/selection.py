"""The chosen part of a run: channels by names and patterns, and a piece between two times."""

import math
import re
from collections.abc import Collection, Sequence
from difflib import get_close_matches
from fnmatch import fnmatchcase

import numpy as np
import numpy.typing as npt

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError, short

CLEARANCE = 1e-9  # [s], of times that were computed as sums of steps
FEWEST = 2  # records that make a line


def is_called(name: str, pattern: str) -> bool:
    """Whether a name is a name or fits a pattern as in a shell; `F[1]`, which is both, is itself, too."""
    return name == pattern or fnmatchcase(name, pattern)


def matching(names: Collection[str], patterns: Sequence[str], kind: str = "channel") -> list[str]:
    """The names that any of the patterns matches, in the order of the patterns; time is not among them.

    Arguments:
        names: of channels.
        patterns: names, or patterns of them as in a shell, such as "pin.*.force".
        kind: what they are names of.

    Raises InputError for a pattern that matches none.
    """
    found: list[str] = []
    for pattern in patterns:
        matched = [name for name in names if name != "time" and is_called(name, pattern)]
        if not matched:
            near = get_close_matches(pattern, names, 4, 0.4) or sorted(names)[:4]
            raise InputError(
                f"{short(pattern)}: no such {kind}; allowed: names or patterns such as 'pin.*.force', of the "
                f"{len(names)} that there are, among them {', '.join(near)}"
            )
        found += [name for name in matched if name not in found]
    return found


def as_words(name: str) -> str:
    """A name of a file or of a class as words: "rear_base" as "rear base", "HydraulicSupport" likewise."""
    words = re.sub(r"(?<=[a-z0-9])(?=[A-Z])|_", " ", name).split()
    return " ".join(word.lower() if word[1:].islower() else word for word in words)


def in_line(text: str) -> str:
    """A text in one line."""
    return " ".join(text.split())


def machine_name(scenario: Scenario) -> str:
    """The kind of a scenario's machine in words, such as "hydraulic support"."""
    return as_words(type(scenario.machine).__name__)


def inside(result: Result, after: float, until: float, fewest: int = FEWEST) -> npt.NDArray[np.bool_]:
    """The records that lie between two times [s], as a mask (n,).

    Raises InputError if they are fewer than `fewest`.
    """
    found = (result.time >= after - CLEARANCE) & (result.time <= until + CLEARANCE)
    if (count := int(found.sum())) < fewest:
        first, last = result.time[[0, -1]]
        raise InputError(
            f"from {max(after, first):g} to {min(until, last):g} s: {count} records lie "
            f"between; allowed: times around at least {fewest} of the {result.time.size} records, "
            f"from {first:g} to {last:g} s"
        )
    return found


def window_text(result: Result, after: float, until: float) -> str:
    """The piece in words, such as "3 to 5 s"."""
    first, last = result.time[[0, -1]]
    return f"{max(after, first):g} to {min(until, last):g} s"


def spacing(result: Result) -> float:
    """Time between records [s], the median; infinite if there is only one."""
    steps = np.diff(result.time)
    return float(np.median(steps)) if steps.size else math.inf


def nearest(time: Series, times: Series) -> npt.NDArray[np.intp]:
    """The indexes of the records (n,) next to times (m,) [s]; of two that are equally near the earlier one."""
    if time.size == 1:
        return np.zeros(times.size, dtype=np.intp)
    after = np.clip(np.searchsorted(time, times), 1, time.size - 1)
    return np.where(times - time[after - 1] <= time[after] - times, after - 1, after).astype(np.intp)


def common_records(
    first: Result, second: Result, after: float, until: float
) -> tuple[npt.NDArray[np.intp], npt.NDArray[np.intp]]:
    """The records of two runs that are of the same times, between two times [s].

    Raises InputError if there are none.
    """
    for run in (first, second):
        inside(run, after, until, fewest=1)  # says which times there are
    ticks = [np.round(run.time / CLEARANCE).astype(np.int64) for run in (first, second)]
    _, mine, its = np.intersect1d(ticks[0], ticks[1], assume_unique=True, return_indices=True)
    within = inside(first, after, until, fewest=1)[mine]
    if not within.any():
        raise InputError(
            f"record_period = {first.scenario.recorded_every:g} and {second.scenario.recorded_every:g} s: the "
            "runs have no record at the same time there; allowed: periods with a common multiple"
        )
    return mine[within], its[within]
