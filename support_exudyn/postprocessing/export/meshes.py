"""The machine of a run as a surface mesh that moves, and its pins as points, with names for their numbers."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND
from support_exudyn.postprocessing.look.looks import look
from support_exudyn.postprocessing.look.poses import Poses, placed_pins
from support_exudyn.postprocessing.look.shapes import Role
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


def meshes_of(result: Result, first: int) -> list[MeshSeries]:
    """All there is to write of a run: the machine, then its pins if it has any.

    first: the record that displacements are measured from.

    Raises InputError if the run has not recorded where its bodies are and how fast they move, or forces, depths
    and slips of its pins.
    """
    machine, pins = machine_mesh(result, first), pin_points(result)
    return [machine] if pins is None else [machine, pins]


def machine_mesh(result: Result, first: int = 0) -> MeshSeries:
    """The surfaces of all bodies; the ground is body 0.

    Data of points: velocity_m_s, and displacement_m since the record `first`. Of triangles: body and role.
    """
    shapes, poses = look(result.scenario).shapes, Poses(result)
    bodies = list(dict.fromkeys([GROUND, *(shape.body for shape in shapes)]))

    def points(record: int) -> Series:
        return np.concatenate([poses.frame(one, record).points(one.mesh.vertices) for one in shapes])

    start = points(first)

    def frame(record: int) -> MeshFrame:
        velocities = [poses.frame(one, record).velocities(one.mesh.vertices) for one in shapes]
        places = points(record)
        return MeshFrame(places, {"velocity_m_s": np.concatenate(velocities), "displacement_m": places - start})

    firsts = np.cumsum([0, *(len(one.mesh.vertices) for one in shapes[:-1])])
    counts = [len(one.mesh.faces) for one in shapes]
    numbers = {
        "body": [bodies.index(one.body) for one in shapes],
        "role": [ROLES.index(one.role) for one in shapes],
    }
    return MeshSeries(
        "machine",
        "triangle",
        np.concatenate([s.mesh.faces + n for s, n in zip(shapes, firsts, strict=True)]).astype(np.int32),
        frame,
        {"body": bodies, "role": [role.value for role in ROLES]},
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
    unknown, axes = np.full(result.time.size, np.nan), "xyz"[: result.scenario.dimensions]
    is_loose = [pin.with_clearance is not None for pin in pins]

    def channel(name: str) -> Series:
        return result.recorded(name, "pins are written with it")

    ends = [pin.journal if loose else pin.first for pin, loose in zip(pins, is_loose, strict=True)]
    places = np.array([poses.of(end.body).path(end.point) for end in ends])
    forces = np.zeros_like(places)
    for k, axis in enumerate(axes):
        forces[:, :, k] = [channel(f"pin.{pin.name}.force_{axis}") for pin in pins]
    depths, slips = (
        np.array([
            channel(f"pin.{pin.name}.{what}") if loose else unknown
            for pin, loose in zip(pins, is_loose, strict=True)
        ])
        for what in ("depth", "slip")
    )  # fmt: skip

    def frame(record: int) -> MeshFrame:
        force = forces[:, record]
        data = {"force_N": force, "force_magnitude_N": np.linalg.norm(force, axis=1)}
        data |= {"depth_m": depths[:, record], "slip_m_s": slips[:, record]}
        return MeshFrame(places[:, record], data)

    numbers = np.arange(len(pins), dtype=np.int32)
    constants = {"pin": numbers, "with_clearance": np.array(is_loose, dtype=np.int32)}
    return MeshSeries("pins", "vertex", numbers[:, None], frame, {"pin": [pin.name for pin in pins]}, constants)
