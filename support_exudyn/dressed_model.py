"""The engine's model of a run with the look of its machine, for the engine's windows.

Only what is drawn is added: surfaces of the bodies, and bodies of the ground, which have no coordinates. The
equations stay those of the model that runs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

import exudyn
import numpy as np
import numpy.typing as npt
from exudyn.itemInterface import ObjectGround, VObjectGround
from trimesh import Trimesh

from support_exudyn.drawing.palette import COLOURS, Colour
from support_exudyn.drawing.shapes import tube
from support_exudyn.drawing.solid import Look, Role, Solid, Strut, solids_of
from support_exudyn.engine_scene import INITIAL
from support_exudyn.machine import GROUND
from support_exudyn.model import Model, model
from support_exudyn.scenario import Scenario
from support_exudyn.spatial.sections import ends
from support_exudyn.trajectory import Series
from user_forces.values import Vector3

SHARP = 0.6  # [rad]; where faces meet at a larger angle an edge is drawn
EDGE: Colour = (0.1, 0.1, 0.1)
BORE: Colour = (0.0, 0.0, 0.0)
PROUD = 0.02  # how far journals stand out of what they join, of its width
AROUND = 2.0  # radii around a pin within which that is looked for
CORNERS = 64  # of a bore's rim
SHOWN = exudyn.ConfigurationType.Visualization
Indices = npt.NDArray[np.int64]
POSITION = exudyn.OutputVariableType.Position


@dataclass(frozen=True)
class DressedModel:
    """A model and its look.

    scene: the model; its `release` ends it. look: all that is drawn, journals of loose pins with it.
    """

    scene: Model
    look: Look

    def place(self, body: str, point: Vector3) -> Series:
        """Where a point of the start posture is in the state that is shown [m]."""
        if body == GROUND:
            return np.array(point)
        item = self.scene.bodies[body]
        local = _local(self.scene, body, np.array([point]))[0]
        return np.array(self.scene.mbs.GetObjectOutputBody(item.object, POSITION, local, SHOWN))


def dressed(scenario: Scenario) -> DressedModel:
    """The model of a scenario, as `model` makes it, with the look of its machine."""
    scene, look = model(scenario), scenario.machine.look(scenario)
    rims = [_rim(pin, look) for pin in _loose_pins(scenario)]
    whole = Look(
        (*look.solids, *(_journal(pin, look) for pin in _loose_pins(scenario))), look.struts, look.floor
    )
    shown = DressedModel(scene, whole)
    for name, item in scene.bodies.items():
        drawn = [_of_solid(solid, _axes(scene, name)) for solid in solids_of(whole, name)]
        drawn += [_of_rim(rim, _axes(scene, name)) for body, rim in rims if body == name]
        scene.mbs.SetObjectParameter(item.object, "VgraphicsData", drawn)
    still = [_of_solid(solid) for solid in solids_of(whole, GROUND)]
    still += [_of_rim(rim) for body, rim in rims if body == GROUND]
    scene.mbs.AddObject(ObjectGround(visualization=VObjectGround(graphicsData=still)))
    moving = [part for strut in look.struts for part in _parts(shown, strut)]
    scene.mbs.AddObject(
        ObjectGround(
            visualization=VObjectGround(graphicsDataUserFunction=lambda mbs, item: [part() for part in moving])
        )
    )
    _assemble_again(scene.mbs)
    return shown


def _assemble_again(mbs: Any) -> None:
    """Tell the engine of what has come, and keep the initial state, which this would set back."""
    kept = mbs.systemData.GetSystemState(INITIAL)
    mbs.Assemble()
    mbs.systemData.SetSystemState(kept, INITIAL)


# --- what bodies show ---


class Axes(NamedTuple):
    """Of a body in the start posture: origin [m], and rotation (3, 3) to the ground's axes."""

    origin: Series
    turn: Series

    def local(self, points: Series) -> Series:
        """Points of the start posture (n, 3) in these axes."""
        found: Series = (points - self.origin) @ self.turn
        return found


STILL = Axes(np.zeros(3), np.eye(3))


def _axes(scene: Model, name: str) -> Axes:
    body = scene.bodies[name].body
    origin, angle = np.zeros(3), 0.0
    origin[: len(body.centre)] = body.centre
    if len(body.centre) == 2:  # in space bodies have the ground's axes at the start
        angle = body.angle
    c, s = np.cos(angle), np.sin(angle)
    return Axes(origin, np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]))


def _local(scene: Model, name: str, points: Series) -> Series:
    return _axes(scene, name).local(points)


class Surface(NamedTuple):
    """A surface with its sharp edges as the engine draws them, of one colour."""

    points: Series
    normals: Series
    faces: Indices
    edges: Indices
    colours: Series

    def moved(self, turn: Series, origin: Series) -> dict[str, Any]:
        """Turned, then moved."""
        return {
            "type": "TriangleList",
            "points": (self.points @ turn.T + origin).ravel(),
            "normals": (self.normals @ turn.T).ravel(),
            "triangles": self.faces,
            "edges": self.edges,
            "edgeColor": [*EDGE, 1.0],
            "colors": self.colours,
        }


def _surface(mesh: Trimesh, colour: Colour) -> Surface:
    """Smooth where its faces are nearly in line."""
    smooth = mesh.smooth_shaded
    corners = mesh.vertices[mesh.face_adjacency_edges[mesh.face_adjacency_angles > SHARP]].reshape(-1, 3)
    points = np.vstack([smooth.vertices, corners])
    normals = np.vstack([smooth.vertex_normals, np.tile([0.0, 0.0, 1.0], (len(corners), 1))])
    edges = np.arange(len(smooth.vertices), len(points), dtype=np.int64)
    return Surface(points, normals, smooth.faces.ravel(), edges, np.tile([*colour, 1.0], len(points)))


def _of_solid(solid: Solid, axes: Axes = STILL) -> dict[str, Any]:
    mesh = solid.mesh.copy()
    mesh.vertices = axes.local(mesh.vertices)
    return _surface(mesh, COLOURS[solid.role]).moved(np.eye(3), np.zeros(3))


def _of_rim(points: Series, axes: Axes = STILL) -> dict[str, Any]:
    return {"type": "Line", "color": [*BORE, 1.0], "data": axes.local(points).ravel()}


# --- columns ---


def _parts(shown: DressedModel, strut: Strut) -> Iterator[Callable[[], dict[str, Any]]]:
    """Cylinder and rod of a column; called, they are where the state that is shown has them."""
    cylinder = _surface(strut.cylinder, COLOURS[Role.CYLINDER])
    rod = _surface(strut.rod, COLOURS[Role.ROD])

    def line() -> tuple[Series, Series]:
        return shown.place(strut.foot, strut.foot_point), shown.place(strut.head, strut.head_point)

    def from_foot() -> dict[str, Any]:
        foot, head = line()
        return cylinder.moved(along(head - foot), foot)

    def from_head() -> dict[str, Any]:
        foot, head = line()
        return rod.moved(along(head - foot), head)

    yield from_foot
    yield from_head


def along(direction: Series) -> Series:
    """Rotation (3, 3) to axes whose x is a direction and whose z is as near to the ground's as can be."""
    x = direction / np.linalg.norm(direction)
    y = np.cross([0.0, 0.0, 1.0] if abs(x[2]) < 0.99 else [0.0, 1.0, 0.0], x)
    y /= np.linalg.norm(y)
    turn: Series = np.column_stack([x, y, np.cross(x, y)])
    return turn


# --- loose pins ---


class LoosePlace(NamedTuple):
    """Bore and journal of a loose pin: bodies, centres in the start posture, radii [m]."""

    name: str
    bore_body: str
    bore: Vector3
    bore_radius: float
    journal_body: str
    journal: Vector3
    journal_radius: float


def _loose_pins(scenario: Scenario) -> Iterator[LoosePlace]:
    """All of them; in space one for each bearing."""
    if scenario.dimensions == 3:
        for name, bearing in scenario.space.bearings.items():
            if bearing.pin in scenario.clearance_pins:
                pin = scenario.clearance_pins[bearing.pin]
                bore, journal = ends(bearing, pin.bore)
                radius, gap = pin.contact.bearing.bore_radius, pin.contact.bearing.clearance
                yield LoosePlace(name, bore.body, bore.point, radius, journal.body, journal.point, radius - gap)
        return
    for name, pin in scenario.clearance_pins.items():
        place = scenario.linkage.pins[name]
        both = [(place.first, (*place.first_point, 0.0)), (place.second, (*place.second_point, 0.0))]
        (bore_body, at_bore), (journal_body, at_journal) = both if pin.bore == "first" else both[::-1]
        radius, gap = pin.contact.bearing.bore_radius, pin.contact.bearing.clearance
        yield LoosePlace(name, bore_body, at_bore, radius, journal_body, at_journal, radius - gap)


def _reach(pin: LoosePlace, look: Look) -> tuple[float, float]:
    """From where to where along the pin there is something that it joins [m], a little more."""
    nearby = [np.array([pin.bore[2] - pin.bore_radius, pin.bore[2] + pin.bore_radius])]
    for body in (pin.bore_body, pin.journal_body):
        for solid in solids_of(look, body):
            points = solid.mesh.vertices
            apart = np.hypot(points[:, 0] - pin.bore[0], points[:, 1] - pin.bore[1])
            nearby.append(points[apart < AROUND * pin.bore_radius, 2])
    heights = np.concatenate(nearby)
    more = PROUD * float(np.ptp(heights))
    return float(heights.min()) - more, float(heights.max()) + more


def _journal(pin: LoosePlace, look: Look) -> Solid:
    low, high = _reach(pin, look)
    x, y, _ = pin.journal
    mesh = tube((x, y, low), (x, y, high), pin.journal_radius)
    return Solid(f"journal of {pin.name}", pin.journal_body, Role.PIN, mesh)


def _rim(pin: LoosePlace, look: Look) -> tuple[str, Series]:
    """Body of a bore, and its rim on the side from which one looks."""
    low, _ = _reach(pin, look)
    angle = np.linspace(0.0, 2.0 * np.pi, CORNERS + 1)
    x, y, _ = pin.bore
    round_ = (
        x + pin.bore_radius * np.cos(angle),
        y + pin.bore_radius * np.sin(angle),
        np.full_like(angle, low),
    )
    return pin.bore_body, np.column_stack(round_)
