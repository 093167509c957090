r"""A four-bar shield support on one pair of legs, both sides lumped into one plane.

        I___Q_______________T      canopy, on the shield's hinge I, with its tip T
       / `-´     L                 stabilising ram P-Q between shield beam and canopy
    D /  P      /
    C*----.    /                   leg F-L between base and canopy
     \     \  /                    shield beam C-D-I with tail beam
      \     \/
       B    /A                     rear link B-C, front link A-D
    =======F============= base (ground)

x forward (towards the coal face), y up. With all pins ideal the lengths of leg and ram fix the posture. Unless
a scenario drives it otherwise, the ram follows the leg so that the canopy keeps level.
"""

import math
from collections.abc import Mapping
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from support_exudyn.machines.four_bar_shield import FourBarShield
from support_exudyn.machines.shield_layout import ShieldColumn
from support_exudyn.model.drives.coupled_drive import following
from support_exudyn.model.drives.drive import Drive, Held
from support_exudyn.model.linkage import GROUND
from user_forces.values.units import Metres
from user_forces.values.value import InputError, Vector2, value

MOST_REMEMBERED = 64
STRIDE = 0.02  # [m] from one level posture to the next


@value
class TwoLegShield(FourBarShield):
    """Pivots, parts and start height of a two-leg shield support.

    Columns: `leg` and `ram`. Arguments: those of `FourBarShield`, and in the same reference posture
        leg_foot, leg_head: F and L, ends of the legs on base and canopy [m].
        ram_foot, ram_head: P and Q, ends of the stabilising ram on shield beam and canopy [m].
    """

    STRUTS: ClassVar[Mapping[str, ShieldColumn]] = {
        "leg": ShieldColumn(foot=(GROUND, "leg_foot"), head=("canopy", "leg_head")),
        "ram": ShieldColumn(foot=("shield", "ram_foot"), head=("canopy", "ram_head")),
    }

    leg_foot: Metres[Vector2]
    leg_head: Metres[Vector2]
    ram_foot: Metres[Vector2]
    ram_head: Metres[Vector2]

    @property
    def leaders(self) -> Mapping[str, str]:
        """The ram follows the leg."""
        return {"ram": "leg"}

    def coupled_drive(self, name: str, lead: Drive, duration: float) -> Drive:
        """The drive of the ram that keeps the canopy level while the leg is driven."""
        if name != "ram":
            return super().coupled_drive(name, lead, duration)
        for key, found in self._known:  # no mapping: a drive of one's own may have a field without a hash
            if key == (lead, duration):
                return found
        low, high = lead.span(duration)
        size = math.hypot(*self.hinge)
        drive: Drive = Held() if low == high == 0.0 else following(lead, duration, self.level_ram, size)
        if len(self._known) == MOST_REMEMBERED:
            self._known.clear()
        self._known.append(((lead, duration), drive))
        return drive

    def __getstate__(self) -> dict[str, Any]:
        """What is sent to another process: all but the remembered drives."""
        return {name: item for name, item in vars(self).items() if name != "_known"}

    @cached_property
    def _known(self) -> list[tuple[tuple[Drive, float], Drive]]:
        """Drives of the ram by that of the leg and for how long; scenarios ask again and again."""
        return []

    def level_ram(self, leg: np.ndarray) -> np.ndarray:
        """Extensions of the ram [m] that keep the canopy level, for extensions of the leg [m], shape (n,).

        Raises InputError if the leg cannot extend so far.
        """
        start = self.start()
        at_start = self.column_lengths(start)[1]
        found = np.empty(leg.size)
        order = np.argsort(np.abs(leg))
        for side in (leg >= 0.0, leg < 0.0):
            reached, posture = 0.0, start
            for n in order[side[order]]:
                for stop in np.linspace(reached, leg[n], 2 + int(abs(leg[n] - reached) / STRIDE))[1:]:
                    following = self.extended(float(stop), posture)
                    if following is None:
                        raise InputError(
                            f"leg extension = {float(leg[n]):.6g} m: the leg cannot close the linkage there; "
                            f"allowed: up to {reached:.3f} m from the start posture"
                        )
                    reached, posture = float(stop), following
                found[n] = self.column_lengths(posture)[1] - at_start
        return found
