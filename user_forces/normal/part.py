"""A part of a contact: one section of a journal of finite length."""

from __future__ import annotations

from pydantic import model_validator

from user_forces.normal.law import NormalLaw
from user_forces.values.value import Share, value

MOST_PARTS = 5


@value
class PartOf(NormalLaw):
    """A share of the force of a law, and nothing else changed.

    Of a journal in its bore the law gives the force per whole length. Cut across the axis, each section has its
    share of it at its own depth. The impact velocity stays that of the whole, so that sections at the
    same depth add up to the law.

    Arguments:
        law: of the whole.
        share: of the section, > 0 and <= 1.
    """

    law: NormalLaw
    share: Share

    @model_validator(mode="after")
    def _has_a_whole(self) -> PartOf:
        law: NormalLaw = self
        for _ in range(MOST_PARTS):
            if not isinstance(law, PartOf):
                return self
            law = law.law
        raise ValueError(
            f"law: is a part of a part, and so on; allowed: up to {MOST_PARTS - 1} parts of each other"
        )

    def __call__(self, depth: float, rate: float, impact_velocity: float) -> float:
        """Normal force [N] of the section."""
        return self.share * self.law(depth, rate, impact_velocity)

    def elastic_force(self, depth: float) -> float:
        """Force [N] at rest."""
        return self.share * self.law.elastic_force(depth)

    def elastic_energy(self, depth: float) -> float:
        """Energy [J] stored."""
        return self.share * self.law.elastic_energy(depth)

    @property
    def largest_depth(self) -> float:
        """The largest depth is that of the whole [m]."""
        return self.law.largest_depth

    def impact_time(self, speed: float, mass: float) -> float:
        """Duration [s] of an impact of the whole."""
        return self.law.impact_time(speed, mass)

    def initial_force(self, speed: float, mass: float) -> float:
        """Force [N] just after the impact."""
        return self.share * self.law.initial_force(speed, mass)
