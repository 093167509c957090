"""What a baseline keeps of a run: numbers and thinned curves with their errors; its file; what has changed.

The file is JSON with a line for each number and curve, so that its versions can be compared. A number
is a text of its value, its error and its unit; a curve is a text of its values.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal, NamedTuple

import numpy as np

from support_exudyn.files.whole_file import contents, missing_file, whole_file
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.comparing.compared_channel import ComparedColumn, ComparedWindow, compared
from support_exudyn.postprocessing.comparing.tables import faults
from support_exudyn.postprocessing.comparing.tolerance import BOTH_ERRORS
from support_exudyn.postprocessing.comparing.with_errors import recorded_columns
from support_exudyn.simulation.estimate import Estimate
from support_exudyn.simulation.horizon import horizon
from support_exudyn.simulation.provenance import provenance
from support_exudyn.simulation.result import Result
from support_exudyn.sweeps.key import program
from support_exudyn.sweeps.own_sources import own_sources
from user_forces.values.value import InputError, cleaned

RECORDS = 100  # of every curve that are kept
FORMAT = "support_exudyn baseline 2"
MOST = 100_000_000  # bytes
SHOWN = 12  # changes of a scenario that are printed
DIGITS, OF_ERRORS = 13, 3  # of values and errors that are written; errors count rounding from 1e-10 on
DAMAGES = (LookupError, AttributeError, TypeError, ValueError, RecursionError, OverflowError)
MEND = (
    "allowed: a file as `baseline make` writes it; take it from version control, or remove it and make it again"
)


@dataclass(frozen=True)
class KeptRun:
    """What is kept of a run, so that a change can be recognised later.

    numbers: by name.
    provenance: versions, platform, time, digests of our own sources and of the user's modules.
    scenario: of the run, as plain data; empty where it is not compared.
    curves: thinned, at common times, by channel, in SI.
    horizon: up to when curves are determined [s], see `determined_until`.
    """

    numbers: Mapping[str, Estimate]
    provenance: Mapping[str, str]
    scenario: Mapping[str, Any] = field(default_factory=dict)
    curves: Mapping[str, ComparedColumn] = field(default_factory=dict)
    horizon: float = math.inf


def kept_run(result: Result) -> KeptRun:
    """What is kept of a run.

    Beyond the horizon impacts depend on the steps, and so does any number of the whole run: of a run with a
    horizon no numbers are kept.

    result: with errors. Raises InputError if the result has nothing to estimate errors by.
    """
    if result.coarser is None:
        raise InputError(
            "the run has no numerical errors, so that no change can be recognised; allowed: a run with an "
            "accuracy, or made with errors=True"
        )
    end = determined_until(result)
    rows = np.unique(np.linspace(0, result.time.size - 1, RECORDS).round().astype(np.intp))
    names = [name for name, channel in result.channels.items() if name != "time" and channel.is_determined]
    own = {f"module {name}": digest for name, digest in own_sources(result.scenario.plain).items()}
    return KeptRun(
        numbers=result.numbers() if math.isinf(end) else {},
        provenance={**result.provenance, "sources": program()["sources"], **own},
        curves={
            name: ComparedColumn(one.unit, one.time[rows], one.values[rows], one.errors[rows])
            for name, one in recorded_columns(result, names).items()
        },
        horizon=end,
    )


def kept_numbers(numbers: Mapping[str, Estimate]) -> KeptRun:
    """Numbers of one's own with their errors, kept as those of a run are."""
    return KeptRun(numbers=dict(numbers), provenance={**provenance(), "sources": program()["sources"]})


def determined_until(result: Result) -> float:
    """Until when a run is determined [s]: the earlier horizon of it and of the next coarser run."""
    runs = [run for run in (result, result.coarser) if run is not None and run.coarser is not None]
    return min(map(horizon, runs), default=math.inf)


# --- what has changed ---


class RunChange(NamedTuple):
    """A difference between a run and its baseline.

    kind: whether it has changed, is new, or gone. what: "number", "channel", "key" of the scenario.
    name: of it. values: what it was and is, in words.
    ratio: the difference over the sum of both errors; infinite if nothing measures it.
    """

    kind: Literal["changed", "new", "gone"]
    what: str
    name: str
    values: str = ""
    ratio: float = math.inf


def changes(old: KeptRun, new: KeptRun) -> list[RunChange]:
    """All that has changed by more than the errors of both runs, is new, or gone, the worst first.

    Keys of the scenario stand first, for they explain the rest. What is not determined is not compared: numbers
    of which an error is not known or that one of the runs has no more because of its horizon, and curves beyond
    the horizon of either run.
    """
    was, now = dict(_leaves(old.scenario)), dict(_leaves(new.scenario))
    keys = [*_gone_and_new("key", was, now)]
    keys += [
        RunChange("changed", "key", key, f"{was[key]} -> {now[key]}")
        for key in was
        if key in now and was[key] != now[key]
    ]
    found = [*_columns("channel", old.curves, new.curves, min(old.horizon, new.horizon))]
    if math.isinf(old.horizon) == math.isinf(new.horizon):
        numbers = [
            {name: ComparedColumn.of_number(one, one.unit) for name, one in run.numbers.items()}
            for run in (old, new)
        ]
        found += _columns("number", numbers[0], numbers[1], math.inf)
    return [*sorted(keys), *sorted(found, key=lambda change: (-change.ratio, change.name))]


def lines(found: Sequence[RunChange], most: int = SHOWN) -> list[str]:
    """The first changes as sentences, and how many more there are."""
    shown = [
        f"{one.kind} {one.what} {one.name}{': ' if one.values else ''}{one.values}" for one in found[:most]
    ]
    return shown + [f"and {len(found) - most} more"] * (len(found) > most)


def _leaves(data: Any, place: str = "") -> Iterator[tuple[str, Any]]:
    """The items of nested data with their places in it, such as pins.B.friction or gravity[1]."""
    if isinstance(data, Mapping) and data:
        for key, item in data.items():
            yield from _leaves(item, f"{place}.{key}" if place else str(key))
    elif isinstance(data, (list, tuple)) and data:
        for n, item in enumerate(data):
            yield from _leaves(item, f"{place}[{n}]")
    else:
        yield place, data


def _gone_and_new(what: str, was: Mapping[str, Any], now: Mapping[str, Any]) -> Iterator[RunChange]:
    for kind, mine, its in (("gone", was, now), ("new", now, was)):
        for name in [name for name in mine if name not in its]:
            yield RunChange(kind, what, name, str(mine[name]) if what == "key" else "")  # type: ignore[arg-type]


def _columns(
    what: str, old: Mapping[str, ComparedColumn], new: Mapping[str, ComparedColumn], end: float
) -> Iterator[RunChange]:
    """Changes of curves up to a time [s], or of numbers."""
    yield from _gone_and_new(what, old, new)
    for name in [name for name in old if name in new]:
        was, now = old[name], new[name]
        if was.unit != now.unit:
            yield RunChange("changed", what, name, f"in {was.unit} -> in {now.unit}")
        elif not (was.time.size and was.time[0] > end):
            one = compared(name, was, now, BOTH_ERRORS, ComparedWindow(until=end))
            if one.gaps or one.verdict == "not within":
                ratio = math.inf if one.gaps else one.beside_errors.ratio
                yield RunChange("changed", what, name, faults(one)[0].removeprefix(f"{name}: "), ratio)


# --- the file ---


def write_baseline(kept: KeptRun, path: Path) -> None:
    """Write a baseline whole or not at all. Raises OSError that names the file if it cannot be written."""
    time = next((curve.time for curve in kept.curves.values()), np.zeros(0))
    data = {
        "format": FORMAT,
        "provenance": dict(kept.provenance),
        "horizon_s": kept.horizon if math.isfinite(kept.horizon) else None,
        "numbers": {name: f"{_words(number)} {number.unit}" for name, number in kept.numbers.items()},
        "time_s": _rounded(time.tolist(), DIGITS),
        "curves": {
            name: {
                "unit": curve.unit,
                "values": _rounded(curve.values.tolist(), DIGITS),
                "errors": _rounded(curve.errors.tolist(), OF_ERRORS),
            }
            for name, curve in kept.curves.items()
        },
        "scenario": kept.scenario,
    }
    text = json.dumps(data, indent=1, allow_nan=False)
    with whole_file(path) as temporary:
        temporary.write_text(f"{text}\n", encoding="utf-8", newline="\n")


def _words(number: Estimate) -> str:
    value = float(number.value) if math.isfinite(number.value) else math.nan
    return f"{value!r} {_rounded([number.error], OF_ERRORS)}"


def _rounded(values: Iterable[float], digits: int) -> str:
    """Numbers in a text; those that are not known, or without end, as nan."""
    return " ".join(f"{value:.{digits}g}" if math.isfinite(value) else "nan" for value in values)


def read_baseline(path: Path) -> KeptRun:
    """Read what `write_baseline` wrote.

    Raises InputError if the file is no baseline or damaged; OSError if it cannot be read.
    """
    if not path.exists():
        raise missing_file(path, "the file of a baseline")
    try:
        data = json.loads(contents(path, MOST).decode("utf-8"))
        if not isinstance(data, dict) or data.pop("format", None) != FORMAT:
            raise ValueError(f"it does not begin with {FORMAT!r}")
        time = _series(data["time_s"])
        return KeptRun(
            numbers={name: _estimate(*text.split(" ", 2)) for name, text in data["numbers"].items()},
            provenance=data["provenance"],
            scenario=data["scenario"],
            curves={name: _curve(time, **curve) for name, curve in data["curves"].items()},
            horizon=math.inf if data["horizon_s"] is None else data["horizon_s"],
        )
    except DAMAGES as error:
        why = cleaned(" ".join(str(error).split()))[:200]
        raise InputError(f"{path}: is no baseline, or damaged ({why}); {MEND}") from None


def _estimate(value: str, error: str, unit: str) -> Estimate:
    """A number and its error, which is infinite if it is not known."""
    known = float(error)
    return Estimate(float(value), math.inf if math.isnan(known) else known, unit)


def _curve(time: Series, unit: str | None, values: str, errors: str) -> ComparedColumn:
    """A curve; errors that are not known are infinite. Raises ValueError if it has not as many as times."""
    of_values, of_errors = _series(values), _series(errors)
    if not of_values.size == of_errors.size == time.size:
        raise ValueError("a curve has more or fewer values than there are times")
    return ComparedColumn(unit, time, of_values, np.where(np.isnan(of_errors), math.inf, of_errors))


def _series(text: str) -> Series:
    return np.array([float(word) for word in text.split()], dtype=np.float64)
