"""Laws F = F_el (1 + chi rate / w): an elastic force that is larger on the way in than on the way out."""

from __future__ import annotations

import math
import warnings
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from functools import cache, cached_property
from typing import Any, ClassVar

from user_forces.kernel import Formula, kernel
from user_forces.normal.law import NormalLaw
from user_forces.roots import bracketed_root
from user_forces.values.units import MetresPerSecond
from user_forces.values.value import Fraction, Positive, value

REST_VELOCITY = 0.01  # [m/s], see the study `contact_laws`


@value
class Hysteresis(NormalLaw, ABC):
    """F = F_el(depth) (1 + chi rate / w) with a damping factor chi made from the restitution.

    What a free impact delivers depends on chi alone, not on F_el, masses or speed: with u = rate / v0 and m
    the reduced mass, m v0^2 u du = -F_el (1 + chi u) d(depth), and the depth is the same (zero) at impact,
    u = 1, and at separation, u = -e. So the integral of u / (1 + chi u) from -e to 1 vanishes:

        chi (1 + e) = ln((1 + chi) / (1 - chi e))

    `delivered_restitution` solves that for e. The force is a pressure throughout: 1 - chi e > 0.

    w = max(v0, rest velocity). v0 is the velocity of the last impact, kept for as long as the contact lasts; 0
    for a contact that is closed at the start. A free impact faster than the rest velocity therefore delivers e.
    Small vibrations of angular frequency omega about a depth d under a constant load have the damping ratio
    chi omega d / (2 n w), n the exponent of F_el at d. The study `contact_laws` measures the default.

    Arguments:
        restitution: e that is asked for [-].
        rest_velocity: smallest w [m/s], > 0.
    """

    removed: ClassVar[Mapping[str, str]] = {"damping_speed": "give rest_velocity"}

    restitution: Fraction
    rest_velocity: MetresPerSecond[Positive] = REST_VELOCITY

    @classmethod
    def of_earlier(cls, given: Mapping[str, Any]) -> Mapping[str, Any]:
        """The fields without those of earlier versions."""
        return without_damping_speed(given)

    @abstractmethod
    def factor(self, restitution: float) -> float:
        """Damping factor chi [-] >= 0 for a restitution [-]."""

    @cached_property
    def damping_factor(self) -> float:
        """Damping factor chi [-] of this law."""
        return self.factor(self.restitution)

    @property
    def delivered_restitution(self) -> float:
        """Restitution [-] that a free impact delivers."""
        return delivered_restitution(self.damping_factor)

    @staticmethod
    @kernel
    def force(
        elastic_force: float, rate: float, impact_velocity: float, damping_factor: float, rest_velocity: float
    ) -> float:
        """F_el (1 + chi rate / w) [N] for an elastic force [N] and a rate [m/s]."""
        w = impact_velocity if impact_velocity > rest_velocity else rest_velocity
        return elastic_force * (1.0 + damping_factor / w * rate)

    @cached_property
    def force_formula(self) -> Formula:
        """The force as a function of depth, rate and impact velocity, from the elastic force of the law."""
        elastic = self.elastic_formula
        own = self.damping_factor, self.rest_velocity
        return Formula(_damped(self.force, elastic.function), (*own, *elastic.parameters))


@cache
def _damped(force: Callable[..., float], elastic: Callable[..., float]) -> Callable[..., float]:
    def damped(
        depth: float, rate: float, impact_velocity: float, factor: float, rest: float, *others: float
    ) -> float:
        return force(elastic(depth, *others), rate, impact_velocity, factor, rest)

    return kernel(damped)


def without_damping_speed(given: Mapping[str, Any]) -> Mapping[str, Any]:
    """Fields of a law, or keys of a file, with the rest velocity that an earlier version's damping speed means.

    The floor of `ImpactVelocity` is the rest velocity. `IndentationVelocity`, which used an effective mass, is
    gone: a warning says that the default rest velocity takes its place.
    """
    old = given.get("damping_speed")
    kind = old.get("type") if isinstance(old, Mapping) else None
    if not isinstance(old, Mapping) or kind not in ("ImpactVelocity", "IndentationVelocity"):
        return given
    kept = {key: item for key, item in given.items() if key != "damping_speed"}
    if kind == "IndentationVelocity":
        warnings.warn(
            "damping_speed = IndentationVelocity is no longer there; the law damps with the default rest "
            f"velocity of {1e3 * REST_VELOCITY:g} mm/s",
            stacklevel=2,
        )
        return kept
    floors = {key.replace("floor", "rest_velocity"): item for key, item in old.items() if key != "type"}
    return kept | (floors or {"rest_velocity_mm_per_s": 1})


def delivered_restitution(damping_factor: float) -> float:
    """Restitution e that a free impact delivers for a damping factor chi >= 0.

        e = (1 + W0(-(1 + chi) exp(-(1 + chi)))) / chi,   W0 Lambert's function

    which is the root of chi (1 + e) = ln((1 + chi)/(1 - chi e)); see `Hysteresis`.
    """
    from scipy.special import lambertw  # a third of what importing this package takes

    chi = damping_factor
    if chi < 1e-5:  # the next term is smaller than 1e-10
        return 1.0 - 2.0 / 3.0 * chi
    argument = -(1.0 + chi) * math.exp(-(1.0 + chi))
    found = (1.0 + float(lambertw(argument).real)) / chi
    if chi < 1.0:  # Lambert's function loses half of its digits where its branches meet, at small chi
        found -= _imbalance(chi, found) * (1.0 - chi * found) / (chi * chi * found)
    return found


def exact_damping_factor(restitution: float) -> float:
    """Damping factor chi in [0, 1/e] with which a free impact delivers the restitution e, 0 < e <= 1.

    The inverse of `delivered_restitution`: the root of chi e - 1 + (1 + chi) exp(-chi (1 + e)), by Brent's
    method.
    """
    e = restitution
    if e > 1.0 - 1e-5:  # what is left out changes the restitution by less than 1e-10
        return 1.5 * (1.0 - e)
    if e > 0.5:
        # chi = 0 is a root too, so look above the first-order value 3/2 (1 - e), which is always smaller
        low, high = 1.4 * (1.0 - e), 3.0 * (1.0 - e)
        return bracketed_root(lambda chi: _imbalance(chi, e), low, high, xtol=1e-15, rtol=1e-14)

    def imbalance(chi: float) -> float:
        return chi * e - 1.0 + (1.0 + chi) * math.exp(-chi * (1.0 + e))

    return bracketed_root(imbalance, 1.0, (1.0 + 1e-15) / e, xtol=1e-15, rtol=1e-14)


def _imbalance(chi: float, e: float) -> float:
    """-chi (1 + e) + ln((1 + chi)/(1 - chi e)); its derivative by e is chi^2 e / (1 - chi e)."""
    return math.log1p(chi) - math.log1p(-chi * e) - chi * (1.0 + e)
