"""Moving meshes of a run for other programs: XDMF with HDF5, and VTU with PVD, by meshio.

Everything is in SI; names of fields end in their unit. Records of the run are written with their times, nothing
between them.
"""

import csv
import re
from collections.abc import Iterable
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import h5py
import meshio
from meshio.xdmf import TimeSeriesWriter

from support_exudyn.postprocessing.export.meshes import MeshSeries, meshes_of
from support_exudyn.postprocessing.export.sampling import Sampling
from support_exudyn.postprocessing.export.whole_set import whole_set
from support_exudyn.scene.contract import Progress, silent
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

MESHES = Sampling(frames_per_second=25.0)
COMPRESSION: dict[str, Any] = {"compression": "gzip", "compression_opts": 4, "shuffle": True}
STEP = re.compile(r'file="((?:machine|pins)_\d{5,}\.vtu)"')  # in the index of an earlier export


def to_xdmf(
    result: Result, path: str | Path, sampling: Sampling = MESHES, progress: Progress = silent
) -> tuple[Path, ...]:
    """The machine and its pins as XDMF with HDF5, for ParaView's "XDMF Reader" and meshio.

    For a path `rise.xdmf` the files are, in one folder,

        rise.xdmf       the machine: a triangle mesh whose points move. Data of points: velocity_m_s, and
                        displacement_m since the first step. Of triangles: body and role.
        rise_pins.xdmf  the pins as points: force_N of the first body on the second, force_magnitude_N, depth_m
                        (negative: gap), slip_m_s, pin, with_clearance (1 or 0). Of an ideal pin depth and slip
                        are NaN. A clearance pin is at its journal's centre. In the plane a pin stands for
                        those of a pair.
        rise_mesh.h5    the numbers of both, to which they refer by this name
        rise_names.csv  what the numbers body, role and pin stand for

    ParaView moves the points itself. meshio's TimeSeriesReader gives those of the first step, to which
    displacement_m is to be added.

    Arguments:
        result: the run; it has recorded where its bodies are and how fast they move, and forces, depths and
            slips of its pins.
        path: ends in ".xdmf".
        sampling: which records are written.
        progress: is called with the share that is done.

    Returns the paths of what was written, the machine's first.

    Raises InputError if a channel is missing, no record is chosen, or the path ends otherwise; OSError if it
    cannot be written. After an error or an interruption nothing has changed.
    """
    path = Path(path)
    if path.suffix != ".xdmf" or ":" in path.stem:
        raise InputError(
            f"path = {str(path)!r}: allowed: names that end in .xdmf, by which readers know it, "
            "without ':', at which they part the name of the HDF5 file from the place in it"
        )
    records = sampling.records(result.time)
    series = meshes_of(result, records[0])
    store, table = f"{path.stem}_mesh.h5", f"{path.stem}_names.csv"
    indexes = [f"{path.stem}.xdmf", f"{path.stem}_pins.xdmf"][: len(series)]
    with whole_set(path.parent, (store, table, *indexes)) as folder:
        with h5py.File(folder / store, "w") as file:
            writers = [MovingMeshWriter(mesh, file, store) for mesh in series]
            for step, record in enumerate(records, 1):
                for writer in writers:
                    writer.write_step(float(result.time[record]), record)
                progress(step / len(records))
        _write_names(folder / table, series)
        for writer, index in zip(writers, indexes, strict=True):
            _write_xml(folder / index, writer.xdmf_file)
    return tuple(path.parent / name for name in (*indexes, store, table))


class MovingMeshWriter(TimeSeriesWriter):  # type: ignore[misc]  # meshio has no types
    """Writes a mesh whose points move; cells and what stays is written once.

    meshio's own writes the points once. Each step here is a whole grid with its points, so that it moves in
    ParaView without a filter; the cells and constant data of all steps are the same data set.

    Arguments:
        series: the mesh.
        store: file to which its data go, open.
        store_name: name by which the XDMF file refers to it, of the same folder.
    """

    def __init__(self, series: MeshSeries, store: h5py.File, store_name: str) -> None:
        super().__init__(f"{series.name}.xdmf")
        self.collection.set("Name", series.name)
        self.series, self.h5_file, self.h5_filename = series, store, store_name
        self._constants: list[ElementTree.Element] = []

    def write_step(self, time: float, record: int) -> None:
        """Write the mesh at a record, whose time [s] this is."""
        series, (points, data) = self.series, self.series.frame(record)
        grid = ElementTree.SubElement(self.collection, "Grid", Name=series.name, GridType="Uniform")
        ElementTree.SubElement(grid, "Time", Value=repr(time))
        if self._constants:
            grid.extend(self._constants)
        else:
            self.cells([(series.cell_type, series.cells)], grid)
            self.point_data(dict(series.point_constants), grid)
            self.cell_data({name: [data] for name, data in series.cell_constants.items()}, grid)
            self._constants = list(grid)[1:]
        self.points(grid, points)
        self.point_data(dict(data), grid)

    def numpy_to_xml_string(self, data: Any) -> str:
        """Put data into the HDF5 file; returns where they are."""
        name = f"{self.series.name}/data{self.data_counter}"
        self.data_counter += 1
        self.h5_file.create_dataset(name, data=data, **COMPRESSION)
        return f"{self.h5_filename}:/{name}"


def to_vtu(
    result: Result, folder: str | Path, sampling: Sampling = MESHES, progress: Progress = silent
) -> tuple[Path, ...]:
    """The machine and its pins as a VTU file per step, with PVD files of their times, for ParaView.

    In the folder: machine.pvd and pins.pvd, which ParaView opens; machine_00000.vtu and so on; names.csv.
    Fields are those of `to_xdmf`. Those of an earlier export are replaced, and removed if they were more; other
    files stay.

    Arguments and errors as with `to_xdmf`. Returns the paths of the PVD files, then of the table and the steps.
    """
    folder = Path(folder)
    records = sampling.records(result.time)
    series = meshes_of(result, records[0])
    steps = {mesh.name: [f"{mesh.name}_{step:05d}.vtu" for step in range(len(records))] for mesh in series}
    files = ["names.csv", *(name for of_mesh in steps.values() for name in of_mesh)]
    indexes = [f"{mesh.name}.pvd" for mesh in series]
    stale = []  # files of others that are called alike, which no index of ours names, stay
    for index in (folder / "machine.pvd", folder / "pins.pvd"):
        if index.is_file() and (named := STEP.findall(index.read_text(encoding="utf-8", errors="replace"))):
            stale += [index.name, *named]
    with whole_set(folder, [*files, *indexes], stale) as temporary:
        for step, record in enumerate(records):
            for mesh in series:
                points, data = mesh.frame(record)
                cells = {name: [of_cells] for name, of_cells in mesh.cell_constants.items()}
                written = meshio.Mesh(
                    points, [(mesh.cell_type, mesh.cells)], {**mesh.point_constants, **data}, cells
                )
                written.write(temporary / steps[mesh.name][step], file_format="vtu")
            progress((step + 1) / len(records))
        _write_names(temporary / "names.csv", series)
        for mesh in series:  # which file is of which time [s]
            root = ElementTree.Element("VTKFile", type="Collection", version="0.1")
            collection = ElementTree.SubElement(root, "Collection")
            for file, time in zip(steps[mesh.name], result.time[records].tolist(), strict=True):
                ElementTree.SubElement(collection, "DataSet", timestep=repr(time), part="0", file=file)
            _write_xml(temporary / f"{mesh.name}.pvd", root)
    return tuple(folder / name for name in (*indexes, *files))


def _write_xml(path: Path, root: ElementTree.Element) -> None:
    tree = ElementTree.ElementTree(root)
    ElementTree.indent(tree, " ")
    tree.write(path, encoding="utf-8", xml_declaration=True)


def _write_names(path: Path, meshes: Iterable[MeshSeries]) -> None:
    """Write what the numbers of meshes stand for as CSV with the columns field, id, name."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("field", "id", "name"))
        for mesh in meshes:
            for name, known in mesh.names.items():
                writer.writerows((name, number, one) for number, one in enumerate(known))
