"""Quantities over time as files give them, each with its name, its unit and where it comes from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
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
    """

    path: Path
    kind: str
    series: Mapping[str, NamedSeries]
    notes: tuple[str, ...] = ()
