"""Moving meshes as one VTU file per step, by meshio, and a PVD file that tells their times."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from xml.etree import ElementTree

import meshio

from support_exudyn.files.whole_file import contents
from support_exudyn.postprocessing.export.mesh_series import MeshSeries
from user_forces.values.value import InputError

LARGEST_INDEX = 200_000_000  # bytes


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


def earlier(folder: Path, series: str) -> set[str]:
    """Files of an earlier export, as the index of a series names them; none if there is no such index."""
    index = f"{series}.pvd"
    try:
        text = contents(folder / index, LARGEST_INDEX).decode("utf-8", "replace")
    except (OSError, InputError):
        return set()
    steps = re.findall(rf'file="({series}_\d{{5,}}\.vtu)"', text)
    return {index, *steps} if steps else set()


def write_index(path: Path, files: Sequence[str], times: Sequence[float]) -> None:
    """A PVD file: which file of its folder is of which time [s]."""
    root = ElementTree.Element("VTKFile", type="Collection", version="0.1")
    collection = ElementTree.SubElement(root, "Collection")
    for file, time in zip(files, times, strict=True):
        ElementTree.SubElement(collection, "DataSet", timestep=repr(time), part="0", file=file)
    tree = ElementTree.ElementTree(root)
    ElementTree.indent(tree, " ")
    tree.write(path, encoding="utf-8", xml_declaration=True)
