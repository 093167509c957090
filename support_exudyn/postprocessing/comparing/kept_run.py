"""What a baseline keeps of a run: numbers and thinned curves, each with its error; and its file.

The file is JSON with a line for each number and curve, so that its versions can be compared. A number
is a text of its value, its error and its unit; a curve is a text of its values.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from support_exudyn.files.whole_file import contents, missing_file, whole_file
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.comparing.common_times import ComparedColumn
from support_exudyn.postprocessing.comparing.with_errors import curve_errors
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
DIGITS, OF_ERRORS = 13, 3  # of values and errors that are written; errors count rounding from 1e-10 on
DAMAGES = (LookupError, AttributeError, TypeError, ValueError, RecursionError, OverflowError)
MEND = (
    "allowed: a file as `baseline make` writes it; take it from version control, or remove it and make it again"
)


def kept_number(number: Estimate) -> ComparedColumn:
    """A number as a column of a single value."""
    return ComparedColumn(number.unit, np.zeros(0), np.array([number.value]), np.array([number.error]))


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
            "the run has no numerical errors, so that no change can be told from them; allowed: a run with an "
            "accuracy, or made with errors=True"
        )
    end = determined_until(result)
    rows = np.unique(np.linspace(0, result.time.size - 1, RECORDS).round().astype(np.intp))
    names = [name for name, channel in result.channels.items() if name != "time" and channel.is_determined]
    known = curve_errors(result, names)
    own = {f"module {name}": digest for name, digest in own_sources(result.scenario.plain).items()}
    return KeptRun(
        numbers=result.numbers() if math.isinf(end) else {},
        provenance={**result.provenance, "sources": program()["sources"], **own},
        curves={
            name: ComparedColumn(result.unit(name), result.time[rows], result[name][rows], known[name][rows])
            for name in names
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
