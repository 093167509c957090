"""The machine of a run as a surface mesh that moves, and its pins as points, as VTU and PVD by meshio.

Everything is in SI; names of fields end in their unit. Records of the run are written with their times, nothing
between them.
"""

import csv
import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree import ElementTree

import meshio
import numpy as np
import numpy.typing as npt

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND
from support_exudyn.postprocessing.export.sampling import Sampling
from support_exudyn.postprocessing.export.whole_set import whole_set
from support_exudyn.postprocessing.look.looks import look
from support_exudyn.postprocessing.look.poses import Poses, placed_pins
from support_exudyn.postprocessing.look.shapes import Role
from support_exudyn.scene.contract import Progress, silent
from support_exudyn.simulation.result import Result

Fields = Mapping[str, npt.NDArray[Any]]
MESHES = Sampling(frames_per_second=25.0)
ROLES = tuple(Role)
STEP = re.compile(r'file="((?:machine|pins)_\d{5,}\.vtu)"')  # in the index of an earlier export


class MeshSeries(NamedTuple):
    """A mesh over time with the same cells at all times.

    kind: of its cells, as meshio names it. cells: points of each (c, points of a cell). frame: returns the
    points (m, 3) [m] at a record and their data. cell_data: of cells (c,). names: of a field of numbers, such
    as "body", what these stand for from 0 on.
    """

    kind: str
    cells: npt.NDArray[np.int32]
    frame: Callable[[int], tuple[Series, Fields]]
    cell_data: Fields
    names: Mapping[str, list[str]]


def to_vtu(
    result: Result, folder: str | Path, sampling: Sampling = MESHES, progress: Progress = silent
) -> tuple[Path, ...]:
    """The machine and its pins as a VTU file per step, with PVD files of their times, for ParaView.

        machine.pvd, machine_00000.vtu ...  the surfaces. Data of points: velocity_m_s, and displacement_m since
                                            the first step. Of triangles: body and role.
        pins.pvd, pins_00000.vtu ...        the pins as points: force_N of the first body on the second,
                                            force_magnitude_N, depth_m (negative: gap), slip_m_s, pin,
                                            with_clearance (1 or 0). Of an ideal pin depth and slip are NaN. A
                                            clearance pin is at its journal's centre. In the plane a pin stands
                                            for those of a pair.
        names.csv                           what the numbers body, role and pin stand for

    Files of an earlier export are replaced, and removed if they were more; other files stay.

    Arguments:
        result: the run; it has recorded where its bodies are and how fast they move, and forces, depths and
            slips of its pins.
        folder: made if missing.
        sampling: which records are written.
        progress: is called with the share that is done.

    Returns the paths of the PVD files, then of the table and the steps.

    Raises InputError if a channel is missing or no record is chosen; OSError if it cannot be written. After an
    error or an interruption nothing has changed.
    """
    folder, records = Path(folder), sampling.records(result.time)
    meshes = {"machine": machine_mesh(result, records[0])}
    if (pins := pin_points(result)) is not None:
        meshes["pins"] = pins
    steps = {name: [f"{name}_{step:05d}.vtu" for step in range(len(records))] for name in meshes}
    files = ["names.csv", *(file for of_mesh in steps.values() for file in of_mesh)]
    indexes = [f"{name}.pvd" for name in meshes]
    stale = []  # files of others with such names, which no index of ours names, stay
    for index in (folder / "machine.pvd", folder / "pins.pvd"):
        if index.is_file() and (named := STEP.findall(index.read_text(encoding="utf-8", errors="replace"))):
            stale += [index.name, *named]
    with whole_set(folder, [*files, *indexes], stale) as temporary:
        for step, record in enumerate(records):
            for name, mesh in meshes.items():
                points, data = mesh.frame(record)
                cell_data = {field: [values] for field, values in mesh.cell_data.items()}
                written = meshio.Mesh(points, [(mesh.kind, mesh.cells)], dict(data), cell_data)
                written.write(temporary / steps[name][step], file_format="vtu")
            progress((step + 1) / len(records))
        for name in meshes:
            root = ElementTree.Element("VTKFile", type="Collection", version="0.1")
            collection = ElementTree.SubElement(root, "Collection")
            for file, time in zip(steps[name], result.time[records].tolist(), strict=True):
                ElementTree.SubElement(collection, "DataSet", timestep=repr(time), part="0", file=file)
            ElementTree.ElementTree(root).write(temporary / f"{name}.pvd", "utf-8", xml_declaration=True)
        with (temporary / "names.csv").open("w", newline="", encoding="utf-8") as table:
            rows = csv.writer(table, lineterminator="\n")
            rows.writerow(("field", "id", "name"))
            for mesh in meshes.values():
                for field, names in mesh.names.items():
                    rows.writerows((field, number, name) for number, name in enumerate(names))
    return tuple(folder / name for name in (*indexes, *files))


def machine_mesh(result: Result, first: int = 0) -> MeshSeries:
    """The surfaces of all bodies; the ground is body 0. first: the record displacements are measured from.

    Raises InputError if the run has not recorded where its bodies are and how fast they move.
    """
    shapes, poses = look(result.scenario).shapes, Poses(result)
    bodies = list(dict.fromkeys([GROUND, *(shape.body for shape in shapes)]))

    def points(record: int) -> Series:
        return np.concatenate([poses.frame(one, record).points(one.mesh.vertices) for one in shapes])

    start = points(first)

    def frame(record: int) -> tuple[Series, Fields]:
        velocities = [poses.frame(one, record).velocities(one.mesh.vertices) for one in shapes]
        places = points(record)
        return places, {"velocity_m_s": np.concatenate(velocities), "displacement_m": places - start}

    firsts = np.cumsum([0, *(len(one.mesh.vertices) for one in shapes[:-1])])
    cells = np.concatenate([one.mesh.faces + n for one, n in zip(shapes, firsts, strict=True)]).astype(np.int32)
    counts = [len(one.mesh.faces) for one in shapes]
    numbers = {
        "body": [bodies.index(one.body) for one in shapes],
        "role": [ROLES.index(one.role) for one in shapes],
    }
    cell_data = {name: np.repeat(of, counts).astype(np.int32) for name, of in numbers.items()}
    return MeshSeries(
        "triangle", cells, frame, cell_data, {"body": bodies, "role": [one.value for one in ROLES]}
    )


def pin_points(result: Result) -> MeshSeries | None:
    """All pins of a run, in space all bearings, as points; None if there are none.

    Raises InputError if the run has not recorded forces, depths and slips of its pins.
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
    numbers = np.arange(len(pins), dtype=np.int32)

    def frame(record: int) -> tuple[Series, Fields]:
        force = forces[:, record]
        data: Fields = {
            "force_N": force,
            "force_magnitude_N": np.linalg.norm(force, axis=1),
            "depth_m": depths[:, record],
            "slip_m_s": slips[:, record],
            "pin": numbers,
            "with_clearance": np.array(is_loose, dtype=np.int32),
        }
        return places[:, record], data

    return MeshSeries("vertex", numbers[:, None], frame, {}, {"pin": [pin.name for pin in pins]})
