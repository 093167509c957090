"""Runs that tests of the export share, and readers that know nothing of this program."""

from __future__ import annotations

import dataclasses
from functools import cache
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

import numpy as np
import vtk
from vtkmodules.util.numpy_support import vtk_to_numpy

from studies.common.paper_machine import oil_columns
from support_exudyn import CubicStep, Held, Result, Scenario, SolverSettings, UniformSpeed, simulate
from support_exudyn.model.linkage import GROUND
from support_exudyn.postprocessing.look.looks import look
from support_exudyn.postprocessing.look.shapes import Look
from tests.cases.run_cases import loose_slider_crank, loose_support, support

MOVING = UniformSpeed(stroke=0.05, start=0.0, end=0.2)  # [m] in [s]


@cache
def run(kind: str) -> Result:
    """A short run.

    The support with a clearance pin in "plane" or "space", there also "tilted" by actuators that are driven
    apart; with "ideal" pins; or the "slider-crank".
    """
    if kind == "tilted":
        return simulate(tilted())
    if kind == "slider-crank":
        return simulate(loose_slider_crank(2e-3, 0.03))
    if kind == "ideal":
        return simulate(support(drive=dataclasses.replace(MOVING, stroke=0.1), duration=0.06))
    if kind == "plane":
        return simulate(loose_support(1.5, 0.25, drive=MOVING, duration=0.1))
    return simulate(loose_support(1.5, 0.25, drive=MOVING, duration=0.02, dimensions=3))


def tilted() -> Scenario:
    """In space, on oil; the right front column lifts, the left one stays."""
    return loose_support(
        1.5,
        0.25,
        actuators=oil_columns(),
        drive=Held(),
        drives={"front_column_right": CubicStep(start=0.0, end=0.04, stroke=8e-3)},
        duration=0.05,
        dimensions=3,
        step=1e-3,
        solver=SolverSettings(impact_steps=64),
    )


class Read(NamedTuple):
    """A step of a file: its time [s], points (m, 3), cells (c, points each), and data by name."""

    time: float
    points: np.ndarray
    cells: np.ndarray
    point_data: dict[str, np.ndarray]
    cell_data: dict[str, np.ndarray]


def by_vtk(path: Path) -> list[Read]:
    """All steps of a PVD file. Its reader is ParaView's, and not in VTK; that of the files of the steps is."""
    steps = []
    for item in ElementTree.parse(path).getroot().iter("DataSet"):
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(path.parent / item.attrib["file"]))
        reader.Update()
        steps.append(_read(float(item.attrib["timestep"]), reader.GetOutput()))
    return steps


def _read(time: float, grid: vtk.vtkUnstructuredGrid) -> Read:
    def data(of: vtk.vtkDataSetAttributes) -> dict[str, np.ndarray]:
        return {of.GetArrayName(i): vtk_to_numpy(of.GetArray(i)).copy() for i in range(of.GetNumberOfArrays())}

    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(grid.GetNumberOfCells(), -1)
    points = vtk_to_numpy(grid.GetPoints().GetData()).copy()
    return Read(time, points, cells.copy(), data(grid.GetPointData()), data(grid.GetCellData()))


def points_of(read: Read, body: int) -> np.ndarray:
    """Which points belong to a body."""
    return np.unique(read.cells[read.cell_data["body"] == body])


def rigid(start: np.ndarray, now: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The rotation (3, 3) and shift (3,) that take points of a rigid body to where they are (Kabsch)."""
    a, b = start.mean(axis=0), now.mean(axis=0)
    u, _, v = np.linalg.svd((start - a).T @ (now - b))
    turn = (u @ np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ v))]) @ v).T
    return turn, b - turn @ a


@cache
def look_of(kind: str) -> Look:
    """What is drawn of a run's machine."""
    return look(run(kind).scenario)


@cache
def start_points(kind: str, body: str) -> np.ndarray:
    """Points of a body's surface in the start posture, in the order of the file."""
    return np.concatenate([shape.mesh.vertices for shape in look_of(kind).of(body)])


def moving_bodies(kind: str) -> list[str]:
    """Names of bodies that are drawn and move."""
    shapes = look_of(kind).shapes
    return list(dict.fromkeys(one.body for one in shapes if one.strut is None and one.body != GROUND))
