"""The face of a falling block in space, which one point of the machine meets: a contact as in the plane.

The block is upright on its guide and does not turn, so its face is a plane that moves up and down, and all
that counts of the point is how far it is behind it. The point is free along the face and across the machine.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from support_exudyn.mechanics.body_motion import SpatialMotion
from support_exudyn.mechanics.kinetics import bearing_rate
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.loads.falling_block import FallingBlock
from support_exudyn.model.spatial_linkage import ACROSS, BearingEnd
from support_exudyn.model.to_space import at
from user_forces.connector.contact_connector import ContactConnector
from user_forces.values.value import Vector3


@dataclass(frozen=True)
class BlockFace:
    """The face of a falling block.

    name: of the block. block: its data. contact: in the engine.
    """

    name: str
    block: FallingBlock
    contact: ContactConnector

    @property
    def ends(self) -> tuple[BearingEnd, BearingEnd]:
        """The block's place from which is measured, and the point of the machine."""
        reference, point = places(self.block)
        return BearingEnd(self.name, reference, ACROSS), BearingEnd(self.block.body, point, ACROSS)

    def rate(self, motion: SpatialMotion) -> Series:
        """Rows that give the point's velocity against the block, along the face and across, (2, 6 bodies)."""
        c, s = math.cos(self.block.slope), math.sin(self.block.slope)
        return np.array([[c, s], [-s, c]]) @ bearing_rate(motion, *self.ends)


def places(block: FallingBlock) -> tuple[Vector3, Vector3]:
    """Where the block's contact measures from, and the point that it falls on, start posture [m]."""
    return at(block.reference, block.lateral), at(block.point, block.lateral)
