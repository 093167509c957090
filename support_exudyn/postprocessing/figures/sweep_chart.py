"""A number of the runs of a sweep over what was varied."""

from __future__ import annotations

from collections.abc import Mapping
from difflib import get_close_matches
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.style import caption
from support_exudyn.postprocessing.figures.units import readable_change
from user_forces.values import units as quantity
from user_forces.values.units import Unit as Written
from user_forces.values.value import InputError, short

if TYPE_CHECKING:
    import pyarrow as pa

WALL_TIME = "wall_time_s"
LITTLE = 1e-3  # share of a number in whose unit a smaller difference is still shown
LOST = "#666666"  # runs without a result
# curves: with markers, too, for grey prints
CURVES = tuple((colour, marker, dashes) for (colour, dashes), marker in zip(style.CURVES, "os^D", strict=False))


def sweep_chart(table: pa.Table, x: str, y: str, by: str | None = None) -> Figure:
    """One number over one varied field, with estimated errors as bars; runs that failed are marked on the axis.

    Points are joined where there is but one for every place on the axis and nothing else was varied: a line
    between runs that differ in more than the axis tells would look like a course of the number.

    Arguments:
        table: of a sweep, as `read_table` gives it.
        x: what was varied, as the sweep's file calls it.
        y: a number of the table, with its unit at the end or without.
        by: something else that was varied, with few values: each has a curve.

    Raises InputError if there is no such column, or if it has too many values for `by`.
    """
    varied = varied_in(table)
    x = column(x, varied)
    by = None if by is None else column(by, [name for name in varied if name != x])
    y = number_column(table, y)
    rows = table.to_pydict()
    places, ticks = _places(rows[x])
    values = np.array([np.nan if one is None else one for one in rows[y]], dtype=float)
    if np.isnan(values).all():
        raise InputError(f"{y}: no run has this number; allowed: {_some(numbers_in(table))}")
    unit = metadata(table, y).get("unit", "")
    apart = float(np.nanmax(values) - np.nanmin(values))
    shown = readable_change(unit, float(np.nanmax(np.abs(values))), apart)
    alike = all(name in (x, by) or len(set(map(str, rows[name]))) == 1 for name in varied)
    known = f"{y}_error" in rows
    errors = np.array([np.nan if one is None else one for one in rows[f"{y}_error"]]) if known else None
    drawing = style.begin(170, 95, f"{bare(y, unit)} over {in_words(x).partition(' [')[0]}")
    axes = drawing.subplots()
    for label, chosen, (colour, marker, dashes) in _curves(rows, by, len(values)):
        there = chosen & ~np.isnan(values)
        order = np.flatnonzero(there)[np.argsort(places[there], kind="stable")]
        alone = alike and len(np.unique(places[order])) == order.size
        bars = None if errors is None else shown.scale * np.nan_to_num(errors[order])
        axes.errorbar(
            places[order], shown.scale * values[order], bars, color=colour, marker=marker, ms=5, mfc="none",
            mew=1.2, ls=dashes if alone and ticks is None else "none", lw=1.0, capsize=2.5, elinewidth=0.8,
            label=label,
        )  # fmt: skip
    lost = np.array([one != "done" for one in rows["status"]])
    if lost.any():
        axes.plot(
            places[lost], np.zeros(int(lost.sum())), "x", color=LOST, ms=6, mew=1.4, clip_on=False,
            zorder=5, transform=axes.get_xaxis_transform(), label=f"no result ({int(lost.sum())} runs)",
        )  # fmt: skip
    if ticks is not None:
        axes.set_xticks(range(len(ticks)), ticks)
    _label(axes, x, y, unit, shown.name)
    if by is not None or lost.any():
        handles, labels = axes.get_legend_handles_labels()
        sequence = sorted(range(len(labels)), key=lambda n: labels[n].startswith("no result"))  # these last
        handles, labels = [handles[n] for n in sequence], [labels[n] for n in sequence]
        axes.legend(handles, labels, title=None if by is None else in_words(by), loc="best", alignment="left")
    caption(drawing, _words(rows, varied, x, by, known))
    return drawing


def varied_in(table: pa.Table) -> list[str]:
    """The names of the columns of what was varied."""
    return [name for name in table.column_names if metadata(table, name).get("meaning") == "varied"]


def in_words(name: str) -> str:
    """A key of a file with its unit as text: "pins.hinge.clearance_mm" as "pins.hinge.clearance [mm]"."""
    endings = {
        ending
        for one in vars(quantity).values()
        for item in getattr(one, "__metadata__", ())
        if isinstance(item, Written)
        for ending in item.endings
    }
    fitting = [ending for ending in endings if name.endswith(f"_{ending}")]
    if not fitting:
        return name
    ending = max(fitting, key=len)
    said = ending.replace("_per_", "/").removeprefix("per_") if "per_" in ending else ending.replace("_", " ")
    if ending.startswith("per_"):
        said = f"1/{said}"
    return f"{name.removesuffix(f'_{ending}')} [{said}]"


def _curves(rows: Mapping[str, list[Any]], by: str | None, size: int) -> list[tuple[str, Any, Any]]:
    if by is None:
        return [("runs", np.ones(size, dtype=bool), CURVES[0])]
    values = list(dict.fromkeys(rows[by]))
    if all(isinstance(one, (int, float)) for one in values):
        values.sort()
    if len(values) > len(CURVES):
        raise InputError(f"{by}: has {len(values)} values; allowed for a curve each: up to {len(CURVES)}")
    return [
        (
            f"{one:g}" if isinstance(one, float) else str(one),
            np.array([item == one for item in rows[by]]),
            curve,
        )
        for one, curve in zip(values, CURVES, strict=False)
    ]


def _places(values: list[Any]) -> tuple[np.ndarray, list[str] | None]:
    """Where on the axis; with names of the places if they are no numbers."""
    if all(isinstance(one, (int, float)) and not isinstance(one, bool) for one in values):
        return np.array(values, dtype=float), None
    names = list(dict.fromkeys(map(str, values)))
    return np.array([names.index(str(one)) for one in values], dtype=float), names


def _label(axes: Axes, x: str, y: str, unit: str, shown: str) -> None:
    axes.set_xlabel(in_words(x))
    axes.set_ylabel(f"{bare(y, unit)} [{shown}]" if shown else bare(y, unit))


def bare(y: str, unit: str) -> str:
    """The number without its unit at the end."""
    from support_exudyn.sweeps.table import with_unit  # and pyarrow

    return y.removesuffix(with_unit("", unit)) if unit else y


def _words(rows: Mapping[str, list[Any]], varied: list[str], x: str, by: str | None, known: bool) -> str:
    done = sum(one == "done" for one in rows["status"])
    text = f"{done} runs of {len(rows['status'])}. "
    rest = [name for name in varied if name not in (x, by)]
    if rest:
        text += f"Also varied, and not told apart here: {', '.join(map(in_words, rest))}. "
    if known:
        return text + "Bars: estimated numerical error, often smaller than the mark."
    return text + "The runs were not made to an accuracy: nothing tells their numerical errors."


def numbers_in(table: pa.Table) -> list[str]:
    """The names of the columns of numbers of the runs, without those of their errors."""
    first = table.column_names.index(WALL_TIME)
    return [name for name in table.column_names[first:] if not name.endswith("_error")]


def numbers_by_name(table: pa.Table) -> dict[str, str]:
    """The columns of numbers by their names without units; the time that runs took is none of these."""
    columns = [name for name in numbers_in(table) if name != WALL_TIME]
    return {bare(name, metadata(table, name).get("unit", "")): name for name in columns}


def number_column(table: pa.Table, name: str) -> str:
    """The column of a number, by its name with its unit or without. Raises InputError if there is none."""
    known, columns = numbers_by_name(table), numbers_in(table)
    if name in known or name in columns:
        return known.get(name, name)
    near = get_close_matches(name, known, 5, 0.4)
    raise InputError(f"{short(name)}: no such number; allowed: {_some(near or list(known))}")


def column(name: str, allowed: list[str]) -> str:
    """The column of this name, with its unit or without. Raises InputError if there is none."""
    if name in allowed:
        return name
    begun = [one for one in allowed if one.startswith(f"{name}_")]
    if len(begun) == 1:
        return begun[0]
    near = get_close_matches(name, allowed, 5, 0.4)
    raise InputError(f"{short(name)}: no such column; allowed: {_some(near or allowed)}")


def _some(names: list[str]) -> str:
    return ", ".join(names[:8]) + (f" and {len(names) - 8} more" if len(names) > 8 else "") or "none"


def metadata(table: pa.Table, name: str) -> dict[str, str]:
    """Unit and meaning of a column."""
    found = table.schema.field(name).metadata or {}
    return {key.decode(): text.decode() for key, text in found.items()}
