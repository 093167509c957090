"""Which loads rigid bodies determine where constraints repeat each other, and which are shared at will.

Newton's and Euler's equations fix C^T lambda alone, see `reactions`. A load is a linear map of lambda; it is
determined if it is zero for all that C^T takes to zero: loads that the bearings put on each other, with no
other force to balance. Judged in the start posture.
"""

from collections.abc import Collection, Sequence
from functools import cached_property

import numpy as np

from support_exudyn.mechanics.space.constraints import SAME, TURNS, Constraint, all_rows, direction_of, matrix
from support_exudyn.mechanics.space.motion import COORDINATES, SpatialMotion, motion_of
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.spatial_linkage import SpatialLinkage

# how the meaning of a channel ends that holds one of many shares
UNDETERMINED = (
    "; rigid bodies do not determine it: of all that balance, that with the least sum of squares of all loads"
)


class Loads:
    """What can be told of the loads of a linkage.

    Arguments:
        linkage: what is held.
        with_clearance: planar pins with clearance. oil: planar actuators on oil.
    """

    def __init__(self, linkage: SpatialLinkage, with_clearance: Collection[str], oil: Collection[str]) -> None:
        rigid = [name for name, actuator in linkage.actuators.items() if actuator.actuator not in oil]
        self.linkage = linkage
        self.rows: Sequence[Constraint] = all_rows(linkage, list(with_clearance), rigid)

    @cached_property
    def start(self) -> SpatialMotion:
        """All bodies at rest in the start posture."""
        still = np.zeros(COORDINATES * len(self.linkage.bodies))
        return motion_of(self.linkage, still, still)

    @cached_property
    def unbalanced(self) -> Series:
        """An orthonormal basis of the lambda that do nothing to any body, (rows, how many)."""
        if not self.rows:
            return np.zeros((0, 0))
        left, sizes, _ = np.linalg.svd(matrix(self.start, self.rows)[0])
        return np.asarray(left[:, int((sizes > SAME * sizes[0]).sum()) :])

    def actuators(self, names: Sequence[str]) -> bool:
        """Whether the force of rigid actuators together is determined."""
        return self._fixed([1.0 if row.kind == "actuator" and row.name in names else 0.0 for row in self.rows])

    def forces(self, bearings: Sequence[str]) -> bool:
        """Whether the force of bearings together is determined, as a vector."""
        return all(map(self._fixed, self._map(bearings, tilt=False)))

    def moment(self, bearing: str) -> bool:
        """Whether the moment of a bearing is determined, as a vector."""
        return all(map(self._fixed, self._map([bearing], tilt=True)))

    def _map(self, bearings: Sequence[str], tilt: bool) -> Series:
        found = np.zeros((3, len(self.rows)))
        for n, row in enumerate(self.rows):
            if row.kind != "actuator" and row.name in bearings and (row.kind in TURNS) == tilt:
                found[:, n] = direction_of(self.start, self.linkage.bearings[row.name], row.kind)[0]
        return found

    def _fixed(self, load: Sequence[float] | Series) -> bool:
        """Whether a sum of lambda is the same for all that balance."""
        return bool(np.abs(np.asarray(load) @ self.unbalanced).max(initial=0.0) <= SAME)
