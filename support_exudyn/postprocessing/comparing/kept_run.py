"""What a baseline keeps of a run: numbers, impacts and thinned curves, each with its error; and its file.

The file is JSON with a line for each number and impact, so that its versions can be compared. A digest of its
contents stands in it: a damaged file, or a file written by hand, is not taken for a baseline.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Mapping, Sequence
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
FORMAT = "support_exudyn baseline 1"
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


# --- the file: numbers that are not known, or without end, as null ---


def write_baseline(kept: KeptRun, path: Path) -> None:
    """Write a baseline whole or not at all. Raises OSError that names the file if it cannot be written."""
    time = next((curve.time for curve in kept.curves.values()), np.zeros(0))
    body = {
        "provenance": dict(kept.provenance),
        "history": [dict(entry) for entry in kept.history],
        "horizon_s": _finite(kept.horizon),
        "numbers": {name: [*_pair(number), number.unit] for name, number in kept.numbers.items()},
        "impacts": {
            pin: [[*_pair(impact.time), *_pair(impact.speed)] for impact in impacts]
            for pin, impacts in kept.impacts.items()
        },
        "time_s": _rounded(time, DIGITS),
        "curves": {
            name: {
                "unit": curve.unit,
                "values": _rounded(curve.values, DIGITS),
                "errors": _rounded(curve.errors, OF_ERRORS),
            }
            for name, curve in kept.curves.items()
        },
        "scenario": json.loads(json.dumps(kept.scenario)),
    }
    parts = []
    for key, item in {"format": FORMAT, "digest": _digest(body), **body}.items():
        text = _line(item)
        if isinstance(item, dict) and item and key != "scenario":
            inside = ",\n".join(f"  {json.dumps(name)}: {_line(entry)}" for name, entry in item.items())
            text = f"{{\n{inside}\n }}"
        parts.append(f" {json.dumps(key)}: {text}")
    with whole_file(path) as temporary:
        temporary.write_text("{\n" + ",\n".join(parts) + "\n}\n", encoding="utf-8", newline="\n")


def _digest(body: Mapping[str, Any]) -> str:
    text = json.dumps(body, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()


def _pair(number: Estimate) -> list[float | None]:
    return [_finite(number.value), _finite(float(f"{number.error:.{OF_ERRORS}g}"))]


def _rounded(values: Series, digits: int) -> list[float | None]:
    return [_finite(float(f"{value:.{digits}g}")) for value in values.tolist()]


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _line(item: Any) -> str:
    if isinstance(item, list) and item and isinstance(item[0], list):  # impacts
        return "[\n" + ",\n".join(f"   {json.dumps(row)}" for row in item) + "\n  ]"
    return json.dumps(item, allow_nan=False)


def read_baseline(path: Path) -> KeptRun:
    """Read what `write_baseline` wrote.

    Raises InputError if the file is no baseline, damaged, or changed by hand; OSError if it cannot be read.
    """
    if not path.exists():
        raise missing_file(path, "the file of a baseline")
    try:
        data = json.loads(contents(path, MOST).decode("utf-8"))
        if not isinstance(data, dict) or data.pop("format", None) != FORMAT:
            raise ValueError(f"it does not begin with {FORMAT!r}")
        if data.pop("digest", None) != _digest(data):
            raise ValueError("its digest is that of other contents")
        time = _series(data["time_s"])
        return KeptRun(
            numbers={name: Estimate(*_read(*pair), unit) for name, (*pair, unit) in data["numbers"].items()},
            provenance=data["provenance"],
            scenario=data["scenario"],
            curves={
                name: KeptColumn(
                    curve["unit"], time, _series(curve["values"]), _series(curve["errors"], math.inf)
                )
                for name, curve in data["curves"].items()
            },
            impacts={
                pin: tuple(
                    KeptImpact(Estimate(*_read(*row[:2]), "s"), Estimate(*_read(*row[2:]), "m/s"))
                    for row in rows
                )
                for pin, rows in data["impacts"].items()
            },
            horizon=math.inf if data["horizon_s"] is None else data["horizon_s"],
            history=tuple(data["history"]),
        )
    except DAMAGES as error:
        why = cleaned(" ".join(str(error).split()))[:200]
        raise InputError(f"{path}: is no baseline, damaged, or changed by hand ({why}); {MEND}") from None


def _read(value: float | None, error: float | None) -> tuple[float, float]:
    return math.nan if value is None else value, math.inf if error is None else error


def _series(items: Sequence[float | None], unknown: float = math.nan) -> Series:
    return np.array([unknown if item is None else item for item in items], dtype=np.float64)
