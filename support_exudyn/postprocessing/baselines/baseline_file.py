"""The file of a baseline: JSON whose lines say what has changed when two versions of it are compared.

A digest of all that it says stands in it: what was damaged, or written by hand, is not taken for a baseline.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from support_exudyn.files.whole_file import contents, missing_file, whole_file
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.baselines.kept_impacts import KeptImpact
from support_exudyn.postprocessing.baselines.kept_run import KeptCurve, KeptRun
from support_exudyn.simulation.estimate import Estimate
from user_forces.values.value import InputError, cleaned

FORMAT = "support_exudyn baseline 1"
MOST = 100_000_000  # bytes
DIGITS, OF_ERRORS = (
    13,
    3,
)  # of values and of errors that are written; rounding is counted in errors from 1e-10 on
DAMAGES = (LookupError, AttributeError, TypeError, ValueError, RecursionError, OverflowError)
MEND = (
    "allowed: a file as `baseline make` writes it; take it from version control, or remove it and make it again"
)


def write_baseline(kept: KeptRun, path: Path) -> None:
    """Write a baseline whole or not at all.

    Raises OSError that names the file if it cannot be written.
    """
    body = _body(kept)
    data = {"format": FORMAT, "digest": _digest(body), **body}
    with whole_file(path) as temporary:
        temporary.write_text(_lines(data), encoding="utf-8", newline="\n")


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
        return _kept(data)
    except DAMAGES as error:
        told = cleaned(" ".join(str(error).split()))[:200]
        raise InputError(f"{path}: is no baseline, damaged, or changed by hand ({told}); {MEND}") from None


def _digest(body: Mapping[str, Any]) -> str:
    text = json.dumps(body, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()


# --- what is written: numbers that are not known, or without end, as null ---


def _body(kept: KeptRun) -> dict[str, Any]:
    return {
        "provenance": dict(kept.provenance),
        "history": [dict(one) for one in kept.history],
        "horizon_s": _finite(kept.horizon),
        "numbers": {name: _plain(one) for name, one in kept.numbers.items()},
        "impacts": {
            pin: [[*_plain(one.time)[:2], *_plain(one.speed)[:2]] for one in impacts]
            for pin, impacts in kept.impacts.items()
        },
        "time_s": _rounded(kept.time, DIGITS),
        "curves": {
            name: {
                "unit": one.unit,
                "values": _rounded(one.values, DIGITS),
                "errors": _rounded(one.errors, OF_ERRORS),
            }
            for name, one in kept.curves.items()
        },
        "scenario": json.loads(json.dumps(kept.scenario)),
    }


def _plain(one: Estimate) -> list[float | str | None]:
    return [_finite(one.value), _finite(float(f"{one.error:.{OF_ERRORS}g}")), one.unit]


def _rounded(values: Series, digits: int) -> list[float | None]:
    return [_finite(float(f"{value:.{digits}g}")) for value in values.tolist()]


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _lines(data: Mapping[str, Any]) -> str:
    """JSON with a line for each number, channel, and impact."""
    parts = []
    for key, item in data.items():
        if isinstance(item, dict) and item and key != "scenario":
            inside = ",\n".join(f"  {json.dumps(name)}: {_line(one)}" for name, one in item.items())
            parts.append(f" {json.dumps(key)}: {{\n{inside}\n }}")
        else:
            parts.append(f" {json.dumps(key)}: {_line(item)}")
    return "{\n" + ",\n".join(parts) + "\n}\n"


def _line(item: Any) -> str:
    if isinstance(item, list) and item and isinstance(item[0], list):  # impacts
        return "[\n" + ",\n".join(f"   {json.dumps(one)}" for one in item) + "\n  ]"
    return json.dumps(item, allow_nan=False)


# --- what is read ---


def _kept(data: Mapping[str, Any]) -> KeptRun:
    time = _series(data["time_s"])
    curves = {
        str(name): KeptCurve(str(one["unit"]), _series(one["values"]), _series(one["errors"], math.inf))
        for name, one in data["curves"].items()
    }
    for name, curve in curves.items():
        if not curve.values.size == curve.errors.size == time.size:
            raise ValueError(f"channel {name!r} has not a value and an error for each time")
    return KeptRun(
        numbers={str(name): _number(*one) for name, one in data["numbers"].items()},
        provenance={str(name): str(text) for name, text in data["provenance"].items()},
        scenario=dict(data["scenario"]),
        time=time,
        curves=curves,
        impacts={str(pin): tuple(map(_impact, impacts)) for pin, impacts in data["impacts"].items()},
        horizon=_float(data["horizon_s"], math.inf),
        history=tuple({str(key): str(text) for key, text in one.items()} for one in data["history"]),
    )


def _impact(row: Sequence[Any]) -> KeptImpact:
    time, late, speed, slow = row
    return KeptImpact(_number(time, late, "s"), _number(speed, slow, "m/s"))


def _number(value: Any, error: Any, unit: Any) -> Estimate:
    return Estimate(_float(value, math.nan), _float(error, math.inf), str(unit))


def _series(items: Sequence[Any], unknown: float = math.nan) -> Series:
    return np.array([_float(one, unknown) for one in items], dtype=np.float64)


def _float(item: Any, unknown: float) -> float:
    if item is None:
        return unknown
    if isinstance(item, bool) or not isinstance(item, (int, float)):
        raise TypeError(f"{item!r:.40} is no number")
    return float(item)
