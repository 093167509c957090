"""Ideal bearings in the engine: the joint with the fewest constraints that holds what is to be held."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

import numpy as np
from exudyn.itemInterface import ObjectJointGeneric, ObjectJointRevoluteZ, ObjectJointSpherical

from support_exudyn.mechanics.space.constraints import Kind, frame_of
from support_exudyn.model.linkage import GROUND
from support_exudyn.model.spatial_linkage import Bearing

SHIFTS: tuple[Kind, ...] = ("across_1", "across_2", "along")
TILTS: tuple[Kind, ...] = ("tilt_1", "tilt_2")


def joint(bearing: Bearing, held: Collection[Kind], markers: list[Any]) -> Any:
    """The engine's joint that holds these; markers: of both bodies, their z along the bearing."""
    if all(kind in held for kind in SHIFTS + TILTS):
        return ObjectJointRevoluteZ(markerNumbers=markers)
    shifts = [int(kind in held) for kind in SHIFTS]
    tilts = [int(kind in held) for kind in TILTS]
    if not any(tilts) and _in_ground_axes(bearing, held):
        return ObjectJointSpherical(markerNumbers=markers, constrainedAxes=shifts)
    return ObjectJointGeneric(markerNumbers=markers, constrainedAxes=[*shifts, *tilts, 0])


def _in_ground_axes(bearing: Bearing, held: Collection[Kind]) -> bool:
    """Whether its directions may be those of the ground, in which the spherical joint counts.

    They are if the first body is the ground; if it turns, both directions across z span the same plane as long
    as it turns about z, which a body does whose bearing has nothing to hold along it.
    """
    if not np.array_equal(frame_of(bearing.first_axis), np.eye(3)):
        return False
    return bearing.first == GROUND or "along" not in held
