"""Bodies of a user's own model: frames of a bore and a journal on them, and how they answer impulses."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import exudyn
import numpy as np
import numpy.typing as npt

from user_forces.connector.item import OUTPUT, JointItem, Mount
from user_forces.contact_state import InverseMass
from user_forces.values.value import InputError

Array = npt.NDArray[np.float64]
REFERENCE = exudyn.ConfigurationType.Reference
ORIGIN = [0.0, 0.0, 0.0]
PLANAR, GROUND = "RigidBody2D", "Ground"


def mount(
    mbs: Any, end: tuple[Any, Sequence[float]], axis: Sequence[float], along: Sequence[float] | None = None
) -> Mount:
    """Where a bore or a journal is on its body.

    Arguments:
        mbs: the engine's system.
        end: body number, and the centre in the body's frame [m] (3).
        axis: of the bore, global frame (3).
        along: of a slot, global frame (3); by default any direction across the axis.

    Raises InputError if a centre does not have three numbers, or the axis no direction.
    """
    body, centre = end
    place = np.asarray(centre, dtype=float)
    z = np.asarray(axis, dtype=float)
    size = float(np.linalg.norm(z)) if z.shape == (3,) else 0.0
    if place.shape != (3,) or not np.isfinite(place).all():
        raise InputError(f"centre = {list(centre)}: allowed: three numbers [m], in the frame of the body")
    if not size > 0.0:
        raise InputError(f"axis = {list(axis)}: allowed: three numbers, not all zero")
    z = z / size
    x = np.asarray(along if along is not None else _across(z), dtype=float)
    x = x - (x @ z) * z
    if not float(np.linalg.norm(x)) > 0.0:
        raise InputError(f"direction = {list(x)}: allowed: three numbers, not along the axis")
    x = x / np.linalg.norm(x)
    frame = np.eye(4)
    frame[:3, :3] = _rotation(mbs, body, REFERENCE).T @ np.column_stack([x, np.cross(z, x), z])
    frame[:3, 3] = place
    return Mount(body, frame.tolist(), mbs.GetObject(body)["objectType"] == GROUND)


def _across(axis: Array) -> Array:
    """A direction across an axis: the global axis that is farthest from it."""
    return np.asarray(np.eye(3)[int(np.argmin(np.abs(axis)))])


def _rotation(mbs: Any, body: Any, state: Any) -> Array:
    """Rotation matrix of a body, from its frame to the global one."""
    if mbs.GetObject(body)["objectType"] == GROUND:
        return np.eye(3)
    return np.asarray(mbs.GetObjectOutputBody(body, OUTPUT.RotationMatrix, ORIGIN, state)).reshape(3, 3)


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
        mass, inertia, centre = _inertia(data, body)
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


def _inertia(data: dict[str, Any], body: Any) -> tuple[float, Array, list[float]]:
    """Mass [kg], inertia about the centre of mass in the body's frame (3, 3) [kg m^2], and that centre [m]."""
    mass, inertia = data.get("mass", data.get("physicsMass")), data.get("inertia", data.get("physicsInertia"))
    if mass is None or inertia is None:
        raise InputError(
            f"body {body} = {data['objectType']}: has no mass and inertia; allowed: rigid bodies and the ground"
        )
    centre = np.asarray(data.get("centerOfMass", data.get("physicsCenterOfMass", ORIGIN)), dtype=float)
    tensor = np.asarray(inertia, dtype=float)
    if tensor.ndim == 0:
        return float(mass), np.diag([0.0, 0.0, float(tensor)]), ORIGIN
    if tensor.ndim == 1:
        xx, yy, zz, yz, xz, xy = tensor.tolist()
        tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    shifted = tensor - float(mass) * ((centre @ centre) * np.eye(3) - np.outer(centre, centre))
    return float(mass), shifted, centre.tolist()
