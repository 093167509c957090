"""Quantities over time as files give them, each with its name, its unit and where it comes from."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from pathlib import Path

import numpy as np
import numpy.typing as npt


@dataclass(frozen=True)
class NamedSeries:
    """A quantity over time, as a file gives it.

    name: as the file writes it, unique in the file.
    unit: of the values, in words that pint reads, such as "mm" or "kN"; "" of a pure number; None if the file
        names none.
    time: [s], increasing.
    values: one for each time, in `unit`; NaN where the file has none.
    """

    name: str
    unit: str | None
    time: npt.NDArray[np.float64]
    values: npt.NDArray[np.float64]


@dataclass(frozen=True)
class SeriesFile:
    """All quantities of a file.

    path: of the file. kind: what it is, in words, such as "ADAMS result file".
    series: by their names.
    notes: what a reader of the numbers has to know, a sentence each: rows that were sorted, times that were
        repeated, the analysis that was taken of several.
    changes: the notes on rows that were left out or sorted.
    """

    path: Path
    kind: str
    series: Mapping[str, NamedSeries]
    notes: tuple[str, ...] = ()
    changes: tuple[str, ...] = ()


# --- what is asked of a reader ---

Progress = Callable[[float], None]  # receives the share that is read, 0 to 1


def silent(share: float) -> None:
    """Progress that nobody looks at."""


@dataclass(frozen=True)
class Asked:
    """What is wanted of a file.

    units: what unit a column without one has, by patterns of names as in a shell; the first that fits counts.
    analysis: the name of one of several in an ADAMS result file; None: the first.
    sheet: the name of one of several in a workbook; None: the first with a table.
    rate: samples per second [Hz] of a file without times; None: it is not known.
    names: patterns of the series that are wanted; all if there are none.
    progress: receives the share that is read.
    """

    units: Mapping[str, str] = field(default_factory=dict)
    analysis: str | None = None
    sheet: str | None = None
    rate: float | None = None
    names: Sequence[str] = ()
    progress: Progress = silent

    def unit(self, name: str, given: str | None) -> str | None:
        """The unit of a series: that of the file if it gives one."""
        fitting = (unit for pattern, unit in self.units.items() if _fits(name, pattern))
        return next(fitting, None) if given is None else given

    def wants(self, name: str) -> bool:
        """Whether a series is wanted."""
        return not self.names or any(_fits(name, pattern) for pattern in self.names)


def _fits(name: str, pattern: str) -> bool:
    return name == pattern or fnmatchcase(name, pattern)  # names have brackets
