"""Moving meshes as XDMF with HDF5, by meshio's writer of time series, whose mesh here moves."""

from __future__ import annotations

from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import h5py
from meshio.xdmf import TimeSeriesWriter

from support_exudyn.files.whole_file import contents
from support_exudyn.postprocessing.export.mesh_series import MeshSeries
from user_forces.values.value import InputError

LARGEST_INDEX = 1_000_000_000  # bytes
COMPRESSION: dict[str, Any] = {"compression": "gzip", "compression_opts": 4, "shuffle": True}


def refers(path: Path, store: str) -> bool:
    """Whether a file is one of `MovingMeshWriter`, whose data are in the HDF5 file of this name."""
    try:
        return f">{store}:/".encode() in contents(path, LARGEST_INDEX)
    except (OSError, InputError):
        return False


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
        self.series = series
        self.h5_file = store
        self.h5_filename = store_name
        self._constants: list[ElementTree.Element] = []

    def write_step(self, time: float, record: int) -> None:
        """The mesh at a record, whose time [s] this is."""
        series, frame = self.series, self.series.frame(record)
        grid = ElementTree.SubElement(self.collection, "Grid", Name=series.name, GridType="Uniform")
        ElementTree.SubElement(grid, "Time", Value=repr(time))
        if self._constants:
            grid.extend(self._constants)
        else:
            self.cells([(series.cell_type, series.cells)], grid)
            self.point_data(dict(series.point_constants), grid)
            self.cell_data({name: [data] for name, data in series.cell_constants.items()}, grid)
            self._constants = list(grid)[1:]
        self.points(grid, frame.points)
        self.point_data(dict(frame.data), grid)

    def numpy_to_xml_string(self, data: Any) -> str:
        """Put data into the HDF5 file; returns where they are."""
        name = f"{self.series.name}/data{self.data_counter}"
        self.data_counter += 1
        self.h5_file.create_dataset(name, data=data, **COMPRESSION)
        return f"{self.h5_filename}:/{name}"

    def write_index(self, path: Path) -> None:
        """The XML of all steps so far."""
        tree = ElementTree.ElementTree(self.xdmf_file)
        ElementTree.indent(tree, " ")
        tree.write(path, encoding="utf-8", xml_declaration=True)
