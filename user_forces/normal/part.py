"""A part of a contact: one section of a journal of finite length."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, cached_property

from pydantic import model_validator

from user_forces.kernel import Formula, kernel
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

    @staticmethod
    @kernel
    def force(whole: float, share: float) -> float:
        """The share [N] of the force of the whole [N]."""
        return share * whole

    @cached_property
    def force_formula(self) -> Formula:
        """Normal force [N] of the section."""
        return self._of(self.law.force_formula)

    @cached_property
    def elastic_formula(self) -> Formula:
        """Force [N] of the section at rest."""
        return self._of(self.law.elastic_formula)

    @cached_property
    def energy_formula(self) -> Formula:
        """Energy [J] stored in the section."""
        return self._of(self.law.energy_formula)

    def _of(self, whole: Formula) -> Formula:
        variables = 3 if whole is self.law.force_formula else 1
        return Formula(_share(self.force, whole.function, variables), (self.share, *whole.parameters))

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


@cache
def _share(force: Callable[..., float], whole: Callable[..., float], variables: int) -> Callable[..., float]:
    if variables == 1:

        def of_depth(depth: float, share: float, *parameters: float) -> float:
            return force(whole(depth, *parameters), share)

        return kernel(of_depth)

    def of_impact(depth: float, rate: float, impact_velocity: float, share: float, *parameters: float) -> float:
        return force(whole(depth, rate, impact_velocity, *parameters), share)

    return kernel(of_impact)
