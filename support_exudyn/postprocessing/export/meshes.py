"""The machine of a run as a surface mesh that moves, and its pins as points, with names for their numbers."""

import csv
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND
from support_exudyn.postprocessing.look.looks import look
from support_exudyn.postprocessing.look.poses import Poses, moving_parts, placed_pins
from support_exudyn.postprocessing.look.solid import Role
from support_exudyn.simulation.result import Result

Field = npt.NDArray[Any]
ROLES = tuple(Role)


class MeshFrame(NamedTuple):
    """A mesh at a record: points (m, 3) [m], and data of the points by names that end in their unit."""

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
        names: for a field of numbers, such as "body", what these stand for from 0 on.
        point_constants, cell_constants: data that stay, of points (m,) and of cells (c,).
    """

    name: str
    cell_type: str
    cells: npt.NDArray[np.int32]
    frame: Callable[[int], MeshFrame]
    names: Mapping[str, list[str]]
    point_constants: Mapping[str, Field] = field(default_factory=dict)
    cell_constants: Mapping[str, Field] = field(default_factory=dict)

    @property
    def values_per_step(self) -> int:
        """The count of numbers that a step has."""
        frame = self.frame(0)
        return frame.points.size + sum(data.size for data in frame.data.values())


def write_names(path: Path, meshes: Iterable[MeshSeries]) -> None:
    """Write what the numbers of meshes stand for as CSV with the columns field, id, name."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("field", "id", "name"))
        for mesh in meshes:
            for name, known in mesh.names.items():
                writer.writerows((name, number, one) for number, one in enumerate(known))


def meshes_of(result: Result, first: int) -> list[MeshSeries]:
    """All there is to write of a run: the machine, then its pins if it has any.

    first: the record that displacements are seen from.

    Raises InputError if the run has not recorded where its bodies are and how fast they move, or forces, depths
    and slips of its pins.
    """
    machine, pins = machine_mesh(result, first), pin_points(result)
    return [machine] if pins is None else [machine, pins]


def machine_mesh(result: Result, first: int = 0) -> MeshSeries:
    """The surfaces of all bodies; the ground is body 0.

    Data of points: velocity_m_s, and displacement_m since the record `first`. Of triangles: body and role.
    """
    parts = moving_parts(look(result.scenario), Poses(result))
    bodies = list(dict.fromkeys([GROUND, *(part.body for part in parts)]))

    def points(record: int) -> Series:
        return np.concatenate([part.frame(record).points(part.mesh.vertices) for part in parts])

    start = points(first)

    def frame(record: int) -> MeshFrame:
        velocities = [part.frame(record).velocities(part.mesh.vertices) for part in parts]
        places = points(record)
        return MeshFrame(places, {"velocity_m_s": np.concatenate(velocities), "displacement_m": places - start})

    firsts = np.cumsum([0, *(len(part.mesh.vertices) for part in parts[:-1])])
    counts = [len(part.mesh.faces) for part in parts]
    numbers = {
        "body": [bodies.index(part.body) for part in parts],
        "role": [ROLES.index(part.role) for part in parts],
    }
    return MeshSeries(
        name="machine",
        cell_type="triangle",
        cells=np.concatenate([p.mesh.faces + n for p, n in zip(parts, firsts, strict=True)]).astype(np.int32),
        frame=frame,
        names={"body": bodies, "role": [role.value for role in ROLES]},
        cell_constants={name: np.repeat(of, counts).astype(np.int32) for name, of in numbers.items()},
    )


def pin_points(result: Result) -> MeshSeries | None:
    """All pins of a run, in space all bearings, with what happens in them; None if there are none.

    A clearance pin is where its journal is. Data: force_N of the first body on the second and its size
    force_magnitude_N; depth_m, negative in free flight, and slip_m_s, which an ideal pin has not (NaN); pin;
    loose, 1 or 0.
    """
    pins, poses = placed_pins(result.scenario), Poses(result)
    if not pins:
        return None
    zero, unknown = np.zeros(result.time.size), np.full(result.time.size, np.nan)

    def channel(name: str) -> Series:
        return result.recorded(name, "pins are written with it")

    ends = [pin.first if pin.with_clearance is None else pin.journal for pin in pins]
    places = np.array([poses.of(end.body).path(end.point) for end in ends])
    axes = "xyz" if result.scenario.dimensions == 3 else "xy"
    forces = np.array([
        np.column_stack([channel(f"pin.{pin.name}.force_{axis}") if axis in axes else zero for axis in "xyz"])
        for pin in pins
    ])  # fmt: skip
    depths, slips = (
        np.array([unknown if pin.with_clearance is None else channel(f"pin.{pin.name}.{what}") for pin in pins])
        for what in ("depth", "slip")
    )

    def frame(record: int) -> MeshFrame:
        force = forces[:, record]
        data = {"force_N": force, "force_magnitude_N": np.linalg.norm(force, axis=1)}
        return MeshFrame(
            places[:, record], {**data, "depth_m": depths[:, record], "slip_m_s": slips[:, record]}
        )

    numbers = np.arange(len(pins), dtype=np.int32)
    with_clearance = np.array([pin.with_clearance is not None for pin in pins], dtype=np.int32)
    return MeshSeries(
        name="pins",
        cell_type="vertex",
        cells=numbers[:, None],
        frame=frame,
        names={"pin": [pin.name for pin in pins]},
        point_constants={"pin": numbers, "with_clearance": with_clearance},
    )
