"""The machine of a run as one surface mesh that moves."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from trimesh import Trimesh

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND
from support_exudyn.postprocessing.export.mesh_series import Frame, MeshSeries
from support_exudyn.postprocessing.export.names import ROLES, Named, numbered, role_names
from support_exudyn.postprocessing.look.looks import look
from support_exudyn.postprocessing.look.poses import Poses, strut_pose
from support_exudyn.postprocessing.look.solid import Look, Role, Solid, Strut
from support_exudyn.simulation.result import Result


class Part(NamedTuple):
    """A piece of the mesh that is moved as a whole."""

    body: str
    role: Role
    mesh: Trimesh


def parts_of(look: Look) -> list[Part]:
    """All solids, then cylinder and rod of every strut, which are bodies called "NAME cylinder", "NAME rod"."""
    solids = [Part(solid.body, solid.role, solid.mesh) for solid in look.solids]
    return solids + [part for strut in look.struts for part in _strut_parts(strut)]


def _strut_parts(strut: Strut) -> Iterator[Part]:
    yield Part(f"{strut.name} cylinder", Role.CYLINDER, strut.cylinder)
    yield Part(f"{strut.name} rod", Role.ROD, strut.rod)


class MachineMesh:
    """The surfaces of all bodies.

    Arguments:
        result: of the run; it has recorded where its bodies are and how fast they move.
        first: the record that displacements are seen from.
    """

    def __init__(self, result: Result, first: int = 0) -> None:
        self._look = look(result.scenario)
        self._poses = Poses(result)
        self._parts = parts_of(self._look)
        self._bodies = list(dict.fromkeys([GROUND, *(part.body for part in self._parts)]))
        self._start = self._moved(first)[0]

    @property
    def names(self) -> list[Named]:
        """Of bodies and roles; the ground is body 0."""
        return numbered("body", self._bodies) + role_names()

    @property
    def series(self) -> MeshSeries:
        """The mesh over time.

        Data of points: velocity_m_s, and displacement_m since the first record that is written. Of triangles:
        body and role, see `names`.
        """
        sizes = [len(part.mesh.vertices) for part in self._parts]
        firsts = np.cumsum([0, *sizes[:-1]])
        triangles = [part.mesh.faces + first for part, first in zip(self._parts, firsts, strict=True)]
        counts = [len(part.mesh.faces) for part in self._parts]
        bodies = [self._bodies.index(part.body) for part in self._parts]
        roles = [ROLES.index(part.role) for part in self._parts]
        return MeshSeries(
            name="machine",
            cell_type="triangle",
            cells=np.concatenate(triangles).astype(np.int32),
            frame=self.frame,
            cell_constants={
                "body": np.repeat(bodies, counts).astype(np.int32),
                "role": np.repeat(roles, counts).astype(np.int32),
            },
        )

    def frame(self, record: int) -> Frame:
        """The mesh at a record."""
        points, velocities = self._moved(record)
        return Frame(points, {"velocity_m_s": velocities, "displacement_m": points - self._start})

    def _moved(self, record: int) -> tuple[Series, Series]:
        """Positions [m] and velocities [m/s] of all points (m, 3)."""
        moved = [self._solid(solid, record) for solid in self._look.solids]
        for strut in self._look.struts:
            pose = strut_pose(strut, self._poses, record)
            moved += [pose.cylinder(strut.cylinder.vertices), pose.rod(strut.rod.vertices)]
        positions, velocities = zip(*moved, strict=True)
        return np.concatenate(positions), np.concatenate(velocities)

    def _solid(self, solid: Solid, record: int) -> tuple[Series, Series]:
        pose, points = self._poses.of(solid.body), np.asarray(solid.mesh.vertices)
        return pose.points(points, record), pose.velocities(points, record)
