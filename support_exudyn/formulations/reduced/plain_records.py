"""Records of a run in plain Python, and the work of the drive from record to record."""

from __future__ import annotations

from typing import Protocol

import numpy as np
import numpy.typing as npt

from support_exudyn.formulations.compiled import on_arrays
from support_exudyn.formulations.reduced import layout
from support_exudyn.formulations.reduced.drive import Matrix, Vector, driven
from support_exudyn.formulations.reduced.integrate import CLOSE
from support_exudyn.formulations.reduced.outline import Outline
from support_exudyn.formulations.reduced.trajectory import power

_driven = on_arrays(driven)
NODES, WEIGHTS = np.polynomial.legendre.leggauss(4)


class Path(Protocol):
    """A step: its ends [s] and the states between."""

    begin: float
    end: float

    def states(self, times: Vector) -> Vector:
        """States at times [s], shape (n, STATES)."""


class PlainRecords:
    """Collects states at the records, and between them those at which the drive's power is asked for."""

    def __init__(self, made: Outline) -> None:
        self._made = made
        self._count = 0  # of records so far
        self._rows: list[Matrix] = []  # blocks (ROWS, n)
        self._nodes: list[Matrix] = []  # likewise
        self._widths: list[Vector] = []  # of the intervals that have so many nodes each [s]
        self._after: list[npt.NDArray[np.int64]] = []  # records before the end of each interval
        self._jumps: list[tuple[int, float]] = []  # records before a jump, and its energy [J]

    def first(self, y: list[float], segment: list[float], memory: list[float]) -> None:
        """The state at the start."""
        self._rows.append(_block(np.zeros(1), np.array([y]), segment, memory))
        self._count = 1

    def jump(self, energy: float) -> None:
        """The drive's speed has jumped and given the bodies this energy [J]."""
        self._jumps.append((self._count, energy))

    def step(self, path: Path, segment: list[float], memory: list[float]) -> bool:
        """A step has been accepted; whether records lie in it."""
        times = self._made.times
        until = path.end + (CLOSE if path.end >= segment[layout.END] else 0.0)
        last = int(np.searchsorted(times, until, side="right"))
        due = times[self._count : last]
        if any(segment[layout.A1 : layout.FREQUENCY]):
            edges = np.concatenate([[path.begin], np.minimum(due, path.end), [path.end]])
            middles, widths = 0.5 * (edges[1:] + edges[:-1]), np.diff(edges)
            nodes = (middles[:, None] + 0.5 * widths[:, None] * NODES).ravel()
            self._nodes.append(_block(nodes, path.states(nodes), segment, memory))
            self._widths.append(widths)
            self._after.append(self._count + np.arange(widths.size))
        if due.size:
            self._rows.append(_block(due, path.states(due), segment, memory))
            self._count = last
        return bool(due.size)

    def write(self, p: list[float]) -> None:
        """Fill the run's records."""
        rows = self._made.rows
        rows[:] = np.concatenate(self._rows, axis=1)
        gained = np.zeros(self._count + 1)
        if self._nodes:
            assert self._made.pin is not None
            powers = power(p, self._made.pin, np.concatenate(self._nodes, axis=1)).reshape(-1, NODES.size)
            powers = 0.5 * powers @ WEIGHTS
            np.add.at(gained, np.concatenate(self._after), powers * np.concatenate(self._widths))
        for count, energy in self._jumps:
            gained[count] += energy
        rows[layout.STATE_ROW + layout.WORK] = np.cumsum(gained[: self._count])


def _block(times: Vector, states: Vector, segment: list[float], memory: list[float]) -> Matrix:
    """Rows of records, see `layout`."""
    rows = np.empty((layout.ROWS, times.size))
    rows[layout.TIME] = times
    rows[layout.STATE_ROW : layout.MEMORY_ROW] = states.T
    rows[layout.MEMORY_ROW : layout.EXTENSION] = np.array(memory)[:, None]
    drive = _driven(segment, times)
    rows[layout.EXTENSION] = drive.extension
    rows[layout.SPEED] = drive.speed
    rows[layout.ACCELERATION] = drive.acceleration
    return rows
