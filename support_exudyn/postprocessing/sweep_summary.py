"""What a sweep came to: how many runs, what varied, what their numbers are, and which input they follow."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from support_exudyn.postprocessing.figures.sweep_chart import (
    bare,
    in_words,
    metadata,
    numbers_by_name,
    varied_in,
)
from support_exudyn.postprocessing.figures.units import DisplayUnit, readable
from support_exudyn.sweeps.statistics import Percentile, Rank, percentiles, ranking
from support_exudyn.sweeps.table import is_sampled

if TYPE_CHECKING:
    import pyarrow as pa

Row = tuple[str, ...]
DIGITS = 5
MOST_NAMED = 6  # values of an input that are told one by one


class SweepNumber(NamedTuple):
    """A number of the runs: its column, name and unit, values (n,) in SI, and which runs have it."""

    column: str
    name: str
    unit: str
    values: np.ndarray
    rows: list[int]


def number_of(table: pa.Table, column: str) -> SweepNumber:
    """A column of numbers, of the runs that have one."""
    values = table.column(column).to_pylist()
    rows = [n for n, one in enumerate(values) if one is not None]
    unit = metadata(table, column).get("unit", "")
    return SweepNumber(column, bare(column, unit), unit, np.array([values[n] for n in rows], dtype=float), rows)


def counts(table: pa.Table) -> str:
    """How many runs there are of each kind, in words."""
    found = Counter(table.column("status").to_pylist())
    unmet = sum(
        status == "done" and bool(reason)
        for status, reason in zip(
            table.column("status").to_pylist(), table.column("reason").to_pylist(), strict=True
        )
    )
    words = [f"{number} {kind}" for kind, number in sorted(found.items())]
    less = f"; {unmet} less accurate than asked for" if unmet else ""
    return f"{table.num_rows} runs: {', '.join(words)}{less}"


def reasons(table: pa.Table) -> list[Row]:
    """Why runs failed or missed their accuracy, the most frequent first: how many, and words."""
    found = Counter(reason for reason in table.column("reason").to_pylist() if reason)
    return [(str(number), reason) for reason, number in found.most_common(MOST_NAMED)]


def what_varied(table: pa.Table) -> list[Row]:
    """Inputs: name with unit, how many values, least and greatest or all of them."""
    rows: list[Row] = []
    for name in varied_in(table):
        values = list(dict.fromkeys(table.column(name).to_pylist()))
        numeric = all(isinstance(one, (int, float)) and not isinstance(one, bool) for one in values)
        if numeric and len(values) > MOST_NAMED:
            told = f"{min(values):.{DIGITS}g} to {max(values):.{DIGITS}g}"
        else:
            told = ", ".join(f"{one:.{DIGITS}g}" if numeric else str(one) for one in values[:MOST_NAMED])
            told += ", ..." if len(values) > MOST_NAMED else ""
        rows.append((in_words(name), str(len(values)), told))
    return rows


def what_came_out(table: pa.Table, columns: list[str]) -> tuple[Row, list[Row]]:
    """Header and rows of numbers over the runs: least, mean and greatest, of drawn runs also percentiles."""
    sampled = is_sampled(table)
    header = ["number", "unit", ">runs", ">min"]
    header += [">5 %", ">50 %", ">95 %"] if sampled else [">mean"]
    rows: list[Row] = []
    for one in (number_of(table, column) for column in columns):
        if not one.values.size:
            rows.append((one.name, "", "0", *[""] * (len(header) - 2)))
            continue
        unit = readable(one.unit, float(np.abs(one.values).max()))
        middle = [_with_band(each, unit) for each in percentiles(one.values.tolist())] if sampled else []
        middle = middle or [_said(one.values.mean(), unit)]
        ends = _said(one.values.min(), unit), _said(one.values.max(), unit)
        rows.append((one.name, unit.name, str(one.values.size), ends[0], *middle, ends[1]))
    return (*header, ">max"), rows


def ranked(table: pa.Table, column: str) -> list[Rank]:
    """Inputs by how far a number of the runs follows them, the strongest first."""
    one = number_of(table, column)
    inputs: dict[str, list[Any]] = {}
    for name in varied_in(table):
        values = table.column(name).to_pylist()
        inputs[name] = [values[n] for n in one.rows]
    return ranking(inputs, one.values.tolist())


def what_it_follows(table: pa.Table, columns: list[str]) -> list[Row]:
    """Rows of number, input, rank correlation with its interval, and what that says."""
    rows: list[Row] = []
    for column in columns:
        name = number_of(table, column).name
        for n, one in enumerate(ranked(table, column)):
            interval = f"{one.low:+.2f} to {one.high:+.2f}"
            doubt = "" if one.is_certain else "may be none"
            rows.append(
                (name if n == 0 else "", in_words(one.name), f"{one.correlation:+.2f}", interval, doubt)
            )
    return rows


def data_of(table: pa.Table, columns: list[str]) -> dict[str, Any]:
    """What came out, for scripts: of each number its unit, statistics, percentiles and ranks, in SI."""
    numbers: dict[str, Any] = {}
    for one in (number_of(table, column) for column in columns):
        if not one.values.size:
            continue
        told: dict[str, Any] = {"unit": one.unit, "runs": int(one.values.size)}
        told |= {word: float(getattr(one.values, word)()) for word in ("min", "mean", "std", "max")}
        if is_sampled(table):
            told["percentiles"] = [each._asdict() for each in percentiles(one.values.tolist())]
        told["ranking"] = [each._asdict() for each in ranked(table, one.column)]
        numbers[one.name] = told
    status = Counter(table.column("status").to_pylist())
    return {"runs": table.num_rows, "status": dict(status), "varied": varied_in(table), "numbers": numbers}


def shown_numbers(table: pa.Table, most: int) -> list[str]:
    """The columns that are looked at first: those that any run has, up to so many."""
    return [name for name in numbers_by_name(table).values() if table.column(name).null_count < table.num_rows][
        :most
    ]


def _said(value: float, unit: DisplayUnit) -> str:
    return f"{unit.scale * float(value):.{DIGITS}g}"


def _with_band(one: Percentile, unit: DisplayUnit) -> str:
    """A percentile and its interval; a dash where the runs are too few to bound it."""
    low, high = ("-" if np.isnan(end) else _said(end, unit) for end in (one.low, one.high))
    return f"{_said(one.value, unit)} ({low} to {high})"
