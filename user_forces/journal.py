r"""Geometry of a journal in a bore, in the plane.

      bore, radius R2, centre O2
    .-----------.
  .'             '.
 /     O2 +--e     \         e      from the bore's centre to the journal's centre
|          \ .--.   |        c      clearance R2 - R1
|           ( O1 )  |        depth  |e| - c, positive in contact
 \           '--'  /         n      e / |e|, towards the bore's wall
  '.              .'         t      n turned by +90 degrees
    '-----------'
"""

from __future__ import annotations

from pydantic import model_validator

from user_forces.values.units import Metres
from user_forces.values.value import Positive, Value, value


@value
class JournalBearing(Value):
    """Bore and journal of a pin.

    Arguments:
        bore_radius: R2 [m], > 0.
        clearance: radial clearance c [m], > 0 and < bore_radius.
    """

    bore_radius: Metres[Positive]
    clearance: Metres[Positive]

    @model_validator(mode="after")
    def _journal_has_a_radius(self) -> JournalBearing:
        if self.clearance >= self.bore_radius:
            raise ValueError(
                f"clearance = {self.clearance} m: leaves no journal in a bore of radius {self.bore_radius} m; "
                f"allowed: > 0 and < {self.bore_radius} m (is it given in mm?)"
            )
        return self

    @property
    def journal_radius(self) -> float:
        """R1 = R2 - c [m] (Eq. 1 of the paper)."""
        return self.bore_radius - self.clearance

    def depth(self, eccentricity: float) -> float:
        """Depth |e| - c [m] for an eccentricity |e| [m] (Eq. 3 of the paper); negative: a gap."""
        return eccentricity - self.clearance

    def contact_arms(self, depth: float) -> tuple[float, float]:
        """Distances [m] of the contact point from the centres of bore and journal, both along n.

        The contact point lies midway in the overlap, so that one point serves both bodies:
        R2 + depth/2 and R1 - depth/2, whose difference is the eccentricity.
        """
        bore_arm = self.bore_radius + 0.5 * depth
        return bore_arm, bore_arm - depth - self.clearance
