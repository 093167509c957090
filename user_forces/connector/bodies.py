"""Bodies of a user's own model: frames of bore and journal on them, their pictures, their effective masses."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import exudyn
import exudyn.graphics as graphics
import numpy as np
import numpy.typing as npt

from user_forces.connector.item import OUTPUT, JointItem, Mount
from user_forces.contact_state import InverseMass
from user_forces.journal import JournalBearing, Slot
from user_forces.values.value import InputError

Array = npt.NDArray[np.float64]
REFERENCE = exudyn.ConfigurationType.Reference
ORIGIN = [0.0, 0.0, 0.0]
PLANAR, SPATIAL, GROUND = "RigidBody2D", "RigidBody", "Ground"
# of what the viewer shows: outer over inner radius of a bore, facets of a circle, length of a slot over its
# width, and radius of a corner over its clearance
WALL, TILES, WALL_LENGTH, CORNER = 1.25, 64, 10.0, 0.5
BORE_COLOUR, JOURNAL_COLOUR = [0.45, 0.5, 0.55, 1.0], [0.8, 0.5, 0.2, 1.0]
PARALLEL = 1e-9  # share of a direction that is across an axis, below which there is none


def mount(
    mbs: Any,
    end: tuple[Any, Sequence[float]],
    axis: Sequence[float],
    along: Sequence[float] | None = None,
    name: str = "end",
) -> Mount:
    """Where a bore or a journal is on its body.

    Arguments:
        mbs: the engine's system.
        end: body number, and the centre in the body's frame [m] (3).
        axis: of the bore, global frame (3).
        along: of a slot, global frame (3); by default any direction across the axis.
        name: of the end, for messages.

    Raises InputError if there is no such rigid body, if a centre does not have three numbers, or if an axis has
    no direction.
    """
    if not isinstance(end, (tuple, list)) or len(end) != 2:
        raise InputError(f"{name} = {end!r}: allowed: (body number, [x, y, z])")
    body, centre = end
    try:
        kind = mbs.GetObject(body)["objectType"]
    except (exudyn.ExudynError, TypeError, IndexError) as error:
        raise InputError(f"{name} = {end!r}: allowed: the number of a body of this model, [x, y, z]") from error
    if kind not in (PLANAR, SPATIAL, GROUND):
        raise InputError(
            f"{name} = {end!r}: is a {kind}; allowed: a rigid body, planar or spatial, or the ground"
        )
    place = _vector(centre, f"{name}: centre", "three numbers [m], in the frame of the body")
    z = _vector(axis, "axis", "three numbers, not all zero")
    size = float(np.linalg.norm(z))
    if not size > 0.0:
        raise InputError(f"axis = {list(axis)}: allowed: three numbers, not all zero")
    z = z / size
    x = _across(z) if along is None else _vector(along, "direction", "three numbers, not along the axis")
    across = x - (x @ z) * z
    if not float(np.linalg.norm(across)) > PARALLEL * float(np.linalg.norm(x)):
        raise InputError(f"direction = {list(x)}: allowed: three numbers, not along the axis")
    x = across / np.linalg.norm(across)
    frame = np.eye(4)
    frame[:3, :3] = _rotation(mbs, body, REFERENCE).T @ np.column_stack([x, np.cross(z, x), z])
    frame[:3, 3] = place
    return Mount(body, frame.tolist(), kind == GROUND)


def _vector(given: Any, name: str, allowed: str) -> Array:
    """Three finite numbers. Raises InputError that names what was given and what is allowed."""
    try:
        found = np.asarray(given, dtype=float)
    except (TypeError, ValueError):
        found = np.empty(0)
    if found.shape != (3,) or not np.isfinite(found).all():
        raise InputError(f"{name} = {given!r}: allowed: {allowed}")
    return found


def _across(z: Array) -> Array:
    """A direction across an axis: the global axis that is farthest from it."""
    return np.asarray(np.eye(3)[int(np.argmin(np.abs(z)))])


def _rotation(mbs: Any, body: Any, state: Any) -> Array:
    """Rotation matrix of a body, from its frame to the global one."""
    data = mbs.GetObject(body)
    if data["objectType"] == GROUND:
        return np.asarray(data["referenceRotation"])
    return np.asarray(mbs.GetObjectOutputBody(body, OUTPUT.RotationMatrix, ORIGIN, state)).reshape(3, 3)


def draw(mbs: Any, bore: Mount, journal: Mount, bearing: JournalBearing | Slot) -> None:
    """Add bore and journal, or slot and pin, to what Exudyn's viewer shows of their bodies.

    Arguments:
        mbs: the engine's system. bore, journal: where they are.
        bearing: their size. The bore is as long as its radius; a corner in a slot is a thin pin.
    """
    if isinstance(bearing, Slot):
        radius = bearing.radius or CORNER * bearing.clearance
        length, wall = WALL_LENGTH * (radius + bearing.clearance), bearing.clearance + bearing.radius
        walls = [
            graphics.Brick([0.0, side * (wall + 0.5 * radius), 0.0], [length, radius, radius], BORE_COLOUR)
            for side in (-1.0, 1.0)
        ]
    else:
        outer, radius = bearing.bore_radius, bearing.bore_radius - bearing.clearance
        ring = {"radius": WALL * outer, "radiusInner": outer, "nTiles": TILES}
        walls = [graphics.Cylinder([0.0, 0.0, -0.5 * outer], [0.0, 0.0, outer], color=BORE_COLOUR, **ring)]
    pin = graphics.Cylinder([0.0, 0.0, -radius], [0.0, 0.0, 2.0 * radius], radius, JOURNAL_COLOUR, TILES)
    for place, shapes in ((bore, walls), (journal, [pin])):
        there = np.asarray(place.frame)
        moved = [graphics.Move(shape, there[:3, 3], there[:3, :3]) for shape in shapes]
        shown = mbs.GetObjectParameter(place.item, "VgraphicsData")
        mbs.SetObjectParameter(place.item, "VgraphicsData", [*shown, *moved])


def free_inverse_mass(mbs: Any, bodies: tuple[Any, Any], item: JointItem, state: Any) -> InverseMass:
    """How a journal answers impulses in its bore's axes if both bodies were free: sum of 1/m + r x J^-1 r x.

    Joints make bodies heavier, so that steps that follow from these masses are rather too short.

    Arguments:
        mbs: the engine's system. bodies: of bore and journal. item: markers. state: of the engine.
    """
    axes = np.asarray(mbs.GetMarkerOutput(item.bore_marker, OUTPUT.RotationMatrix, state)).reshape(3, 3)
    total = np.zeros((3, 3))
    for body, marker in zip(bodies, (item.bore_marker, item.journal_marker), strict=True):
        data = mbs.GetObject(body)
        if data["objectType"] == GROUND:
            continue
        mass, inertia, centre = _inertia(data)
        turn = _rotation(mbs, body, state)
        place = np.asarray(mbs.GetMarkerOutput(marker, OUTPUT.Position, state))
        x, y, z = place - np.asarray(mbs.GetObjectOutputBody(body, OUTPUT.Position, centre, state))
        arm = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        if data["objectType"] == PLANAR:
            turning = np.diag([0.0, 0.0, 1.0 / inertia[2, 2]])
        else:
            turning = turn @ np.linalg.inv(inertia) @ turn.T
        total += np.eye(3) / mass + arm.T @ turning @ arm
    return InverseMass.of((axes.T @ total @ axes)[:2, :2])


def _inertia(data: dict[str, Any]) -> tuple[float, Array, list[float]]:
    """Mass [kg], inertia about the centre of mass in the body's frame (3, 3) [kg m^2], and that centre [m]."""
    mass, tensor = data["mass"], np.asarray(data["inertia"], dtype=float)
    centre = np.asarray(data.get("centerOfMass", ORIGIN), dtype=float)
    if tensor.ndim == 0:
        return float(mass), np.diag([0.0, 0.0, float(tensor)]), ORIGIN
    if tensor.ndim == 1:
        xx, yy, zz, yz, xz, xy = tensor.tolist()
        tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    shifted = tensor - float(mass) * ((centre @ centre) * np.eye(3) - np.outer(centre, centre))
    return float(mass), shifted, centre.tolist()
