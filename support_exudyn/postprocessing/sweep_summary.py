"""What a sweep came to: how many runs, what varied, what their numbers are, and which input they follow."""

from __future__ import annotations

from collections import Counter
from typing import Any

import numpy as np

from support_exudyn.postprocessing.figures.units import DisplayUnit
from support_exudyn.postprocessing.result_table import ResultTable
from support_exudyn.postprocessing.sweep_runs import SweepNumber, SweepRuns, in_words
from support_exudyn.sweeps.statistics import Percentile, Rank, percentiles, ranking
from support_exudyn.sweeps.table import is_sampled

Row = tuple[str, ...]
DIGITS = 5
MOST_NAMED = 6  # values of an input that are listed
BOUNDING = 72  # runs that bound the percentiles of 5 and 95 %: 0.95^72 < 0.025
FOLLOWS = "what it follows: Spearman's rank correlation, -1 to 1, with its 95 % confidence interval"


def counts(runs: SweepRuns) -> str:
    """How many runs there are of each kind, in words."""
    status = runs.column("status")
    found = Counter(status)
    pairs = zip(status, runs.column("reason"), strict=True)
    unmet = sum(one == "done" and bool(reason) for one, reason in pairs)
    words = [f"{number} {kind}" for kind, number in sorted(found.items())]
    less = f"; {unmet} less accurate than asked for" if unmet else ""
    return f"{len(status)} runs: {', '.join(words)}{less}"


def sweep_tables(runs: SweepRuns, columns: list[str], rest: str = "") -> list[ResultTable]:
    """What varied, what went wrong, what came out, and what that follows.

    columns: of the numbers that are shown. rest: words on those that are not.
    """
    failed = Counter(reason for reason in runs.column("reason") if reason)
    reasons = [(str(number), reason) for reason, number in failed.most_common(MOST_NAMED)]
    return [
        ResultTable("what varied", ("input", ">values", "remark"), _what_varied(runs)),
        ResultTable("what went wrong", (">runs", "remark"), reasons),
        _what_came_out(runs, columns, rest),
        ResultTable(FOLLOWS, ("number", "input", ">correlation", ">interval", "remark"), _ranks(runs, columns)),
    ]


def _what_varied(runs: SweepRuns) -> list[Row]:
    """Inputs: name with unit, how many values, least and greatest or all of them."""
    rows: list[Row] = []
    for name in runs.varied:
        values = list(dict.fromkeys(runs.column(name)))
        numeric = all(isinstance(one, (int, float)) and not isinstance(one, bool) for one in values)
        if numeric and len(values) > MOST_NAMED:
            text = f"{min(values):.{DIGITS}g} to {max(values):.{DIGITS}g}"
        else:
            text = ", ".join(f"{one:.{DIGITS}g}" if numeric else str(one) for one in values[:MOST_NAMED])
            text += ", ..." if len(values) > MOST_NAMED else ""
        rows.append((in_words(name), str(len(values)), text))
    return rows


def _what_came_out(runs: SweepRuns, columns: list[str], rest: str) -> ResultTable:
    """Numbers over the runs: least, mean and greatest, of drawn runs also percentiles."""
    sampled = is_sampled(runs.table)
    middle = (">5 %", ">50 %", ">95 %") if sampled else (">mean",)
    header = ("number", "unit", ">runs", ">min", *middle, ">max")
    rows: list[Row] = []
    for one in map(runs.number, columns):
        if not one.known.size:
            rows.append((one.name, "", "0", *[""] * (len(header) - 3)))
            continue
        unit = one.display
        cells = [_with_band(each, unit) for each in percentiles(one.known.tolist())] if sampled else []
        cells = cells or [_rounded(one.known.mean(), unit)]
        ends = _rounded(one.known.min(), unit), _rounded(one.known.max(), unit)
        rows.append((one.name, unit.name, str(one.known.size), ends[0], *cells, ends[1]))
    band = ", percentiles with their 95 % confidence intervals" if sampled else ""
    if any("- to" in cell or "to -" in cell for row in rows for cell in row):
        band += f" (-: not bounded by so few runs; {BOUNDING} do)"
    return ResultTable(f"what came out{rest}{band}", header, rows)


def ranked(runs: SweepRuns, number: SweepNumber) -> list[Rank]:
    """Inputs by how far a number of the runs follows them, the strongest first."""
    columns = {name: runs.column(name) for name in runs.varied}
    inputs = {name: [items[n] for n in number.rows] for name, items in columns.items()}
    return ranking(inputs, number.known.tolist())


def _ranks(runs: SweepRuns, columns: list[str]) -> list[Row]:
    """Rows of number, input, rank correlation with its interval, and a remark."""
    rows: list[Row] = []
    for number in map(runs.number, columns):
        for n, one in enumerate(ranked(runs, number)):
            interval = f"{one.low:+.2f} to {one.high:+.2f}"
            doubt = "" if one.is_certain else "may be none"
            rows.append(
                (number.name if n == 0 else "", in_words(one.name), f"{one.correlation:+.2f}", interval, doubt)
            )
    return rows


def data_of(runs: SweepRuns, columns: list[str]) -> dict[str, Any]:
    """What came out, for scripts: of each number its unit, statistics, percentiles and ranks, in SI."""
    numbers: dict[str, Any] = {}
    for one in map(runs.number, columns):
        if not one.known.size:
            continue
        found: dict[str, Any] = {"unit": one.unit, "runs": int(one.known.size)}
        found |= {word: float(getattr(one.known, word)()) for word in ("min", "mean", "std", "max")}
        if is_sampled(runs.table):
            found["percentiles"] = [each._asdict() for each in percentiles(one.known.tolist())]
        found["ranking"] = [each._asdict() for each in ranked(runs, one)]
        numbers[one.name] = found
    status = runs.column("status")
    return {"runs": len(status), "status": dict(Counter(status)), "varied": runs.varied, "numbers": numbers}


def _rounded(value: float, unit: DisplayUnit) -> str:
    return f"{unit.scale * float(value):.{DIGITS}g}"


def _with_band(one: Percentile, unit: DisplayUnit) -> str:
    """A percentile and its interval; a dash where the runs are too few to bound it."""
    low, high = ("-" if np.isnan(end) else _rounded(end, unit) for end in (one.low, one.high))
    return f"{_rounded(one.value, unit)} ({low} to {high})"
