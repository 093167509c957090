"""The machine of a run as a surface mesh that moves, and its pins as points, with names for their numbers."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

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


@dataclass(frozen=True)
class MeshSeries:
    """A mesh over time; the same points and cells at all times.

    Arguments:
        name: of its files.
        cell_type: as meshio calls it.
        cells: points of each, shape (c, points of a cell).
        frame: gives the points (m, 3) [m] at a record, and data of them by names that end in their unit.
        names: for a field of numbers, such as "body", what these stand for from 0 on.
        point_constants, cell_constants: data that stay, of points (m,) and of cells (c,).
    """

    name: str
    cell_type: str
    cells: npt.NDArray[np.int32]
    frame: Callable[[int], tuple[Series, Mapping[str, Field]]]
    names: Mapping[str, list[str]]
    point_constants: Mapping[str, Field] = field(default_factory=dict)
    cell_constants: Mapping[str, Field] = field(default_factory=dict)


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

    def frame(record: int) -> tuple[Series, Mapping[str, Field]]:
        velocities = [poses.frame(one, record).velocities(one.mesh.vertices) for one in shapes]
        places = points(record)
        return places, {"velocity_m_s": np.concatenate(velocities), "displacement_m": places - start}

    firsts = np.cumsum([0, *(len(one.mesh.vertices) for one in shapes[:-1])])
    cells = np.concatenate([one.mesh.faces + n for one, n in zip(shapes, firsts, strict=True)]).astype(np.int32)
    numbers = {
        "body": [bodies.index(one.body) for one in shapes],
        "role": [ROLES.index(one.role) for one in shapes],
    }
    counts = [len(one.mesh.faces) for one in shapes]
    constants = {name: np.repeat(of, counts).astype(np.int32) for name, of in numbers.items()}
    names = {"body": bodies, "role": [role.value for role in ROLES]}
    return MeshSeries("machine", "triangle", cells, frame, names, cell_constants=constants)


def pin_points(result: Result) -> MeshSeries | None:
    """All pins of a run, in space all bearings, with what happens in them; None if there are none.

    A clearance pin is where its journal is. Data: force_N of the first body on the second and its size
    force_magnitude_N; depth_m, negative in free flight, and slip_m_s, which an ideal pin has not (NaN); pin;
    with_clearance, 1 or 0.
    """
    pins, poses = placed_pins(result.scenario), Poses(result)
    if not pins:
        return None
    is_loose = [pin.with_clearance is not None for pin in pins]
    ends = [pin.journal if loose else pin.first for pin, loose in zip(pins, is_loose, strict=True)]
    places = np.array([poses.of(end.body).path(end.point) for end in ends])

    def channel(what: str, known: list[bool]) -> Series:
        unknown, why = np.full(result.time.size, np.nan), "pins are written with it"
        pairs = zip(pins, known, strict=True)
        return np.array(
            [result.recorded(f"pin.{pin.name}.{what}", why) if is_ else unknown for pin, is_ in pairs]
        )

    forces = np.zeros_like(places)
    for k, axis in enumerate("xyz"[: result.scenario.dimensions]):
        forces[:, :, k] = channel(f"force_{axis}", [True] * len(pins))
    depths, slips = (channel(what, is_loose) for what in ("depth", "slip"))

    def frame(record: int) -> tuple[Series, Mapping[str, Field]]:
        force = forces[:, record]
        data = {"force_N": force, "force_magnitude_N": np.linalg.norm(force, axis=1)}
        return places[:, record], data | {"depth_m": depths[:, record], "slip_m_s": slips[:, record]}

    numbers = np.arange(len(pins), dtype=np.int32)
    constants = {"pin": numbers, "with_clearance": np.array(is_loose, dtype=np.int32)}
    return MeshSeries("pins", "vertex", numbers[:, None], frame, {"pin": [pin.name for pin in pins]}, constants)
