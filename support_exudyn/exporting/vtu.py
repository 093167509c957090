"""Moving meshes as one VTU file per step, by meshio, and a PVD file that tells their times."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from xml.etree import ElementTree

import meshio

from support_exudyn.exporting.mesh_series import MeshSeries


def step_name(series: str, step: int) -> str:
    """File of a step."""
    return f"{series}_{step:05d}.vtu"


def write_step(path: Path, series: MeshSeries, record: int) -> None:
    """The mesh at a record."""
    frame = series.frame(record)
    meshio.Mesh(
        frame.points,
        [(series.cell_type, series.cells)],
        point_data={**series.point_constants, **frame.data},
        cell_data={name: [data] for name, data in series.cell_constants.items()},
    ).write(path, file_format="vtu")


def write_index(path: Path, files: Sequence[str], times: Sequence[float]) -> None:
    """A PVD file: which file of its folder is of which time [s]."""
    root = ElementTree.Element("VTKFile", type="Collection", version="0.1")
    collection = ElementTree.SubElement(root, "Collection")
    for file, time in zip(files, times, strict=True):
        ElementTree.SubElement(collection, "DataSet", timestep=repr(time), part="0", file=file)
    tree = ElementTree.ElementTree(root)
    ElementTree.indent(tree, " ")
    tree.write(path, encoding="utf-8", xml_declaration=True)
