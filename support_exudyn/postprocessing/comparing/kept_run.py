"""What a baseline keeps of a run: numbers, impacts and thinned curves, each with its error; and its file.

The file is JSON with a line for each number, impact and curve, so that its versions can be compared. A number
is a text of its value, its error and its unit; a curve is a text of its values.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from support_exudyn.files.whole_file import contents, missing_file, whole_file
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.comparing.with_errors import SINGLE, curve_errors
from support_exudyn.simulation.estimate import Estimate, errors
from support_exudyn.simulation.horizon import horizon
from support_exudyn.simulation.provenance import provenance
from support_exudyn.simulation.reported_numbers import impact_numbers, measures
from support_exudyn.simulation.result import Result
from support_exudyn.sweeps.key import program
from support_exudyn.sweeps.own_sources import own_sources
from user_forces.values.value import InputError, cleaned

RECORDS = 100  # of every curve that are kept
MOST_IMPACTS = 100  # of every clearance pin that are kept
DOUBTFUL = 0.01  # share by which an impact may be uncertain; soon behind it nothing is known
ONSET = ".onset_"  # in names of numbers: impacts are kept by themselves
FORMAT = "support_exudyn baseline 2"
MOST = 100_000_000  # bytes
DIGITS, OF_ERRORS = 13, 3  # of values and errors that are written; errors count rounding from 1e-10 on
DAMAGES = (LookupError, AttributeError, TypeError, ValueError, RecursionError, OverflowError)
MEND = (
    "allowed: a file as `baseline make` writes it; take it from version control, or remove it and make it again"
)


class KeptColumn(NamedTuple):
    """A curve at times [s] (n,), with values and errors (n,); a number has no times and a single value.

    unit: of all but the times; None: not known. An error that is NaN is not known.
    """

    unit: str | None
    time: Series
    values: Series
    errors: Series


def kept_number(number: Estimate) -> KeptColumn:
    """A number as a column of a single value."""
    return KeptColumn(number.unit, np.zeros(0), np.array([number.value]), np.array([number.error]))


class KeptImpact(NamedTuple):
    """An impact of a clearance pin: onset [s] and initial impact velocity [m/s], with their errors."""

    time: Estimate
    speed: Estimate


@dataclass(frozen=True)
class KeptRun:
    """What is kept of a run, so that a change can be recognised later.

    numbers: by name, those of single impacts left out.
    provenance: versions, platform, time, digests of our own sources and of the user's modules.
    scenario: of the run, as plain data; empty where it is not compared.
    curves: thinned, at common times, by channel, in SI.
    impacts: the first of every clearance pin.
    horizon: up to when single impacts and curves are determined [s], see `kept_impacts`.
    history: date and reason of each change of the baseline.
    """

    numbers: Mapping[str, Estimate]
    provenance: Mapping[str, str]
    scenario: Mapping[str, Any] = field(default_factory=dict)
    curves: Mapping[str, KeptColumn] = field(default_factory=dict)
    impacts: Mapping[str, tuple[KeptImpact, ...]] = field(default_factory=dict)
    horizon: float = math.inf
    history: tuple[Mapping[str, str], ...] = ()


def kept_run(result: Result) -> KeptRun:
    """What is kept of a run.

    Beyond the horizon impacts depend on the steps, and so does any number of the whole run: of a run with a
    horizon no numbers are kept.

    result: with errors. Raises InputError if the result has nothing to estimate errors by.
    """
    if result.coarser is None:
        raise InputError(
            "the run has no numerical errors, so that no change can be told from them; allowed: a run with an "
            "accuracy, or made with errors=True"
        )
    impacts, end = kept_impacts(result)
    rows = np.unique(np.linspace(0, result.time.size - 1, RECORDS).round().astype(np.intp))
    names = [name for name, channel in result.channels.items() if name != "time" and channel.is_determined]
    known = curve_errors(result, names)
    own = {f"module {name}": digest for name, digest in own_sources(result.scenario.plain).items()}
    numbers = result.numbers() if math.isinf(end) else {}
    return KeptRun(
        numbers={name: number for name, number in numbers.items() if ONSET not in name},
        provenance={**result.provenance, "sources": program()["sources"], **own},
        curves={
            name: KeptColumn(result.unit(name), result.time[rows], result[name][rows], known[name][rows])
            for name in names
        },
        impacts=impacts,
        horizon=end,
    )


def kept_numbers(numbers: Mapping[str, Estimate]) -> KeptRun:
    """Numbers of one's own with their errors, kept as those of a run are."""
    return KeptRun(numbers=dict(numbers), provenance={**provenance(), "sources": program()["sources"]})


def kept_impacts(result: Result) -> tuple[Mapping[str, tuple[KeptImpact, ...]], float]:
    """The first impacts of every clearance pin; up to when the run is determined [s], infinite: to its end.

    Each impact multiplies the errors of all before it, of whatever pin. The distances of three runs can be
    small by chance at one of them; so the error of an impact is at least, as a share, the largest of those
    before. The run is determined up to its horizon, to that of the next coarser run, and to the first impact
    that may be wrong by more than `DOUBTFUL`: its time, of the time since the impact before, or its speed.
    """
    end = horizon(result)
    if result.coarser is not None and result.coarser.coarser is not None:
        end = min(end, horizon(result.coarser))
    every = max(map(len, result.onsets.values()), default=0)
    kinds = {pin: impact_numbers(result, pin, every) for pin in result.onsets}
    whole = {name: kind for of_pin in kinds.values() for name, kind in of_pin.items()}
    known = errors(whole, result, result.fall, {**measures(result, 0.0, math.inf), **whole})
    impacts: list[tuple[str, KeptImpact]] = []
    for pin, of_pin in kinds.items():
        numbers = [Estimate(kind.measure(result), known[name], kind.unit) for name, kind in of_pin.items()]
        impacts += [(pin, KeptImpact(*pair)) for pair in zip(numbers[::2], numbers[1::2], strict=True)]
    kept: dict[str, list[KeptImpact]] = {pin: [] for pin in result.onsets}
    late = slow = 0.0  # shares
    for pin, (time, speed) in sorted(impacts, key=lambda impact: impact[1].time.value):
        since = time.value - (kept[pin][-1].time.value if kept[pin] else 0.0)
        late = max(late, time.error / since if since > 0.0 else 0.0)
        slow = max(slow, speed.error / speed.value if speed.value > 0.0 else 0.0)
        if max(late, slow) > DOUBTFUL:
            end = min(end, time.value)
        if time.value >= end:
            break
        off, wrong = max(time.error, late * since), max(speed.error, slow * speed.value)
        kept[pin].append(KeptImpact(time._replace(error=SINGLE * off), speed._replace(error=SINGLE * wrong)))
    return {pin: tuple(of_pin[:MOST_IMPACTS]) for pin, of_pin in kept.items()}, end


# --- the file ---


def write_baseline(kept: KeptRun, path: Path) -> None:
    """Write a baseline whole or not at all. Raises OSError that names the file if it cannot be written."""
    time = next((curve.time for curve in kept.curves.values()), np.zeros(0))
    data = {
        "format": FORMAT,
        "provenance": dict(kept.provenance),
        "history": [dict(entry) for entry in kept.history],
        "horizon_s": kept.horizon if math.isfinite(kept.horizon) else None,
        "numbers": {name: f"{_words(number)} {number.unit}" for name, number in kept.numbers.items()},
        "impacts": {
            pin: [f"{_words(impact.time)} {_words(impact.speed)}" for impact in impacts]
            for pin, impacts in kept.impacts.items()
        },
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
            impacts={pin: tuple(map(_impact, rows)) for pin, rows in data["impacts"].items()},
            horizon=math.inf if data["horizon_s"] is None else data["horizon_s"],
            history=tuple(data["history"]),
        )
    except DAMAGES as error:
        why = cleaned(" ".join(str(error).split()))[:200]
        raise InputError(f"{path}: is no baseline, or damaged ({why}); {MEND}") from None


def _estimate(value: str, error: str, unit: str) -> Estimate:
    """A number and its error, which is infinite if it is not known."""
    known = float(error)
    return Estimate(float(value), math.inf if math.isnan(known) else known, unit)


def _impact(text: str) -> KeptImpact:
    time, of_time, speed, of_speed = text.split()
    return KeptImpact(_estimate(time, of_time, "s"), _estimate(speed, of_speed, "m/s"))


def _curve(time: Series, unit: str | None, values: str, errors: str) -> KeptColumn:
    """A curve; errors that are not known are infinite. Raises ValueError if it has not as many as times."""
    of_values, of_errors = _series(values), _series(errors)
    if not of_values.size == of_errors.size == time.size:
        raise ValueError("a curve has more or fewer values than there are times")
    return KeptColumn(unit, time, of_values, np.where(np.isnan(of_errors), math.inf, of_errors))


def _series(text: str) -> Series:
    return np.array([float(word) for word in text.split()], dtype=np.float64)
