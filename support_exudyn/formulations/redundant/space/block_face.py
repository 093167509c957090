"""The face of a falling block in space, which one point of the machine meets: a contact as in the plane.

The block is upright on its guide and does not turn, so its face is a plane that moves up and down, and all
that counts of the point is how far it is behind it. The point is free along the face and across the machine.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from support_exudyn.formulations.redundant.clearance.clearance_pin import ClearanceJoint, FindMass
from support_exudyn.formulations.redundant.clearance.connector import FaceConnector
from support_exudyn.formulations.redundant.clearance.connector_force import Relative
from support_exudyn.formulations.redundant.clearance.pin_motion import Motion
from support_exudyn.formulations.redundant.clearance.slot_frames import between
from support_exudyn.formulations.redundant.space.section_motion import BodyState
from support_exudyn.mechanics.space.constraints import BearingEnd
from support_exudyn.mechanics.space.kinetics import SpatialKinetics
from support_exudyn.mechanics.space.motion import COORDINATES
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.loads.falling_block import FallingBlock
from support_exudyn.model.spatial_linkage import ACROSS
from support_exudyn.model.to_space import at
from support_exudyn.scenario.solver_settings import SolverSettings
from user_forces.values.value import Vector3


@dataclass(frozen=True)
class FaceMover:
    """How the point of the machine moves at the face of a block.

    Arguments:
        data: the engine's, once it is assembled.
        block, body: the first coordinates of the block and of the body that it falls on.
        reference, point: where the block's contact measures from, and the point, start posture [m].
        arm: of the point in its body's axes [m].
        slope: of the face [rad].
    """

    data: Any
    block: int
    body: int
    reference: Vector3
    point: Vector3
    arm: Vector3
    slope: float

    def when(self, position: list[float], velocity: list[float]) -> tuple[Motion, Motion]:
        """The motions of block and point in the machine's plane; by the engine's coordinates and rates."""
        end = self.body + COORDINATES
        (dx, dy, _), (vx, vy, _) = BodyState.of(position[self.body : end], velocity[self.body : end]).point(
            self.arm
        )
        (x, y, _), (rx, ry, _) = self.point, self.reference
        bx, by, _ = position[self.block : self.block + 3]
        bvx, bvy, _ = velocity[self.block : self.block + 3]
        return (rx + bx, ry + by, bvx, bvy, self.slope, 0.0), (x + dx, y + dy, vx, vy, 0.0, 0.0)

    def now(self) -> tuple[Motion, Motion]:
        """See `Moving`."""
        data = self.data
        return self.when(data.GetODE2Coordinates().tolist(), data.GetODE2Coordinates_t().tolist())

    def relative(self, position: list[float], velocity: list[float]) -> Relative:
        """What counts of the point's motion, in the axes of the face."""
        return between(*self.when(position, velocity))[1]


class BlockFace(ClearanceJoint):
    """The face of a falling block over a run.

    Arguments:
        block: that falls. name: its own.
        connector, moving, find_inverse_mass, settings: as of ClearanceJoint.
    """

    def __init__(
        self,
        name: str,
        block: FallingBlock,
        connector: FaceConnector,
        moving: FaceMover,
        find_inverse_mass: FindMass,
        settings: SolverSettings,
    ) -> None:
        super().__init__(block.contact, connector, moving, lambda: 0.0, find_inverse_mass, settings)
        self.name, self.block, self.moving = name, block, moving

    @cached_property
    def ends(self) -> tuple[BearingEnd, BearingEnd]:
        """The block's place from which is measured, and the point of the machine."""
        return (
            BearingEnd(self.name, self.moving.reference, ACROSS),
            BearingEnd(self.block.body, self.moving.point, ACROSS),
        )

    def rate(self, kinetics: SpatialKinetics) -> Series:
        """Rows that give the point's velocity against the block, along the face and across, (2, 6 bodies)."""
        c, s = math.cos(self.moving.slope), math.sin(self.moving.slope)
        return np.array([[c, s], [-s, c]]) @ kinetics.bearing_rate(*self.ends)


def places(block: FallingBlock) -> tuple[Vector3, Vector3]:
    """Where the block's contact measures from, and the point that it falls on, start posture [m]."""
    return at(block.reference, block.lateral), at(block.point, block.lateral)
