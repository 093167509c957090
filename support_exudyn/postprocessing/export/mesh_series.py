"""A mesh that moves: what files of meshes hold, whatever their format."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from support_exudyn.mechanics.trajectory import Series

Field = npt.NDArray[Any]


@dataclass(frozen=True)
class Frame:
    """The mesh at a record: points (m, 3) [m], and data of the points by names that end in their unit."""

    points: Series
    data: Mapping[str, Field]


@dataclass(frozen=True)
class MeshSeries:
    """A mesh over time; the same points and cells at all times.

    Arguments:
        name: of its files.
        cell_type: as meshio calls it.
        cells: points of each, shape (c, points of a cell).
        frame: gives the mesh at a record.
        point_constants, cell_constants: data that stay, of points (m,) and of cells (c,).
    """

    name: str
    cell_type: str
    cells: npt.NDArray[np.int32]
    frame: Callable[[int], Frame]
    point_constants: Mapping[str, Field] = field(default_factory=dict)
    cell_constants: Mapping[str, Field] = field(default_factory=dict)

    @property
    def values_per_step(self) -> int:
        """How many numbers a step has."""
        frame = self.frame(0)
        return frame.points.size + sum(data.size for data in frame.data.values())
