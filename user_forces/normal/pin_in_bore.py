"""A pin in a bore as steel is: line contact over the pin's length, in series with pin and link."""

from __future__ import annotations

import math
from functools import cache, cached_property, lru_cache
from typing import Any, ClassVar, NamedTuple

import numpy as np
import numpy.typing as npt
from numpy.polynomial import chebyshev
from pydantic import model_validator

from user_forces.conformal import relative_depth, relative_load
from user_forces.kernel import Formula, kernel
from user_forces.normal.cylinders import CylinderLaw
from user_forces.normal.power_laws import PowerLaw
from user_forces.values.units import NewtonsPerMetre
from user_forces.values.value import Positive, Value, is_kind_of, kinds_of, known_class, value

DEGREE = 16  # of the polynomial that stands for the inverted law
SHALLOWEST = 1e-6  # depth over clearance below which the force is linear in the depth
LOWEST = math.log(SHALLOWEST)
WIDEST = math.radians(60.0)  # half angle up to which the law is valid
NARROWEST = 1e-9  # half angle [rad] below all that a force makes
TABLE, BESIDE = 200, 1e-4  # half angles at which the law is known; what a second guess is beside the first
SECANTS = 6
FORCES = ("force", "elastic", "energy")

Array = npt.NDArray[np.float64]


def lends_damping(law: type[object]) -> bool:
    """Whether a law of K depth^n is nothing but a damping factor, which another elastic force can have too."""
    return issubclass(law, PowerLaw) and all(getattr(law, name) is getattr(PowerLaw, name) for name in FORCES)


@value
class PinInBore(CylinderLaw):
    """F = F_el (1 + chi rate / w), F_el that of a pin over its length, held by pin and link.

        depth = p D(half angle) / (2 E*) + L p / k,    F_el = L p

    p is the load per length, the half angle follows from it, and D is the elastic solution, see
    `user_forces.conformal`: Johnson's line contact at small angles, Persson's conformal contact beyond. k is
    the stiffness with which pin and link give besides. Valid for half angles up to 60 degrees.

    The law is inverted once, when it is made: F_el / depth is a polynomial in the logarithm of the depth. It is
    within 1e-4 of the closed form, and closer the more pin and link give. The energy is the exact integral of
    that force. Below a millionth of the clearance the force is linear in the depth.

    Arguments:
        bearing: radii R2 of the bore, R1 of the pin, and clearance dR = R2 - R1 [m].
        length: L of the contact, along the axis [m], > 0.
        effective_modulus: E* [Pa], see `user_forces.effective_modulus`.
        restitution: e [-], > 0 and <= 1.
        rest_velocity: smallest w [m/s], > 0; see `Hysteresis`.
        backing_stiffness: k of pin and link, in series with the contact [N/m], > 0; None: they are rigid.
        damping: the law whose damping factor chi it has; "Exact" delivers the restitution asked for.

    Source: Johnson, Contact Mechanics (1985), section 5.6; Persson, Chalmers (1964).
    """

    TITLE: ClassVar[str] = "Pin in bore"

    backing_stiffness: NewtonsPerMetre[Positive] | None = None
    damping: str = "Exact"

    @model_validator(mode="after")
    def _damping_is_known(self) -> PinInBore:
        law = known_class(self.damping)
        if law is None or not is_kind_of(law, PowerLaw) or not lends_damping(law):
            known = [name for name, law in kinds_of(PowerLaw).items() if lends_damping(law)]
            raise ValueError(
                f"damping = {self.damping!r}: allowed: {', '.join(sorted(known))}; one's own is imported first"
            )
        _ = self._lender  # held, so that another process that is sent the law imports a class of one's own
        return self

    def factor(self, restitution: float) -> float:
        """The damping factor of the law that `damping` names."""
        return float(self._lender(stiffness=1.0, restitution=restitution).damping_factor)

    @cached_property
    def _lender(self) -> type[Any]:
        """The class that `damping` names."""
        return Value.of_name(self.damping)

    @property
    def largest_depth(self) -> float:
        """Depth [m] at a half contact angle of 60 degrees."""
        return self.bearing.clearance * math.exp(self._inverse.highest)

    @cached_property
    def elastic_formula(self) -> Formula:
        """F_el [N], see `pin_force`."""
        return Formula(pin_force, (*self._scales, *self._inverse.force))

    @cached_property
    def energy_formula(self) -> Formula:
        """Integral of the force [J], see `pin_energy`."""
        stiffness, clearance, middle, half = self._scales
        shallow = SHALLOWEST * clearance
        linear = 0.5 * polynomial(-1.0, 0, self._inverse.force)
        rest = shallow * shallow * (linear - polynomial(-1.0, 0, self._inverse.energy))
        return Formula(pin_energy, (stiffness, shallow, middle, half, linear, rest, *self._inverse.energy))

    @property
    def _scales(self) -> tuple[float, float, float, float]:
        """Stiffness [N/m], clearance [m], middle and half width of the inverted law's logarithm of depth."""
        middle, half = 0.5 * (self._inverse.highest + LOWEST), 0.5 * (self._inverse.highest - LOWEST)
        return self._stiffness, self.bearing.clearance, math.log(self.bearing.clearance) + middle, half

    @cached_property
    def _stiffness(self) -> float:
        """2 E* L [N/m]."""
        return 2.0 * self.effective_modulus * self.length

    @cached_property
    def _inverse(self) -> _Inverse:
        return _inverse(0.0 if self.backing_stiffness is None else self._stiffness / self.backing_stiffness)


@kernel
def pin_force(
    depth: float, stiffness: float, clearance: float, middle: float, half: float, *coefficients: float
) -> float:
    """Elastic force [N] of a pin in its bore: stiffness times depth times a polynomial in its logarithm."""
    x = max((math.log(depth) - middle) / half, -1.0)
    return stiffness * depth * polynomial(x, 0, coefficients)


@kernel
def pin_energy(
    depth: float,
    stiffness: float,
    shallow: float,
    middle: float,
    half: float,
    linear: float,
    rest: float,
    *coefficients: float,
) -> float:
    """Integral of `pin_force` [J].

    Arguments:
        shallow: depth [m] below which the force is linear in the depth.
        linear: energy over stiffness and squared depth there.
        rest: energy over stiffness [m^2] by which the polynomial misses that at this depth.
        coefficients: of the energy.
    """
    if depth < shallow:
        return stiffness * depth * depth * linear
    x = max((math.log(depth) - middle) / half, -1.0)
    return stiffness * (depth * depth * polynomial(x, 0, coefficients) + rest)


@kernel
def polynomial(x: float, first: int, coefficients: tuple[float, ...]) -> float:
    """The sum of DEGREE + 1 coefficients from a place on times powers of x, by Horner's scheme."""
    total = coefficients[first + DEGREE]
    for n in range(DEGREE - 1, -1, -1):
        total = total * x + coefficients[first + n]
    return total


class _Inverse(NamedTuple):
    """The inverted law, for depths over the clearance from SHALLOWEST to exp(highest).

    force: F_el / (2 E* L depth), as coefficients of the powers of x, which goes from -1 to 1 as the logarithm
    of the depth does. energy: the same of the energy over 2 E* L depth^2.
    """

    highest: float
    force: tuple[float, ...]
    energy: tuple[float, ...]


@cache
def _table() -> tuple[Array, Array, Array]:
    """Logarithms of half angles, and loads and depths there, see `relative_load` and `relative_depth`."""
    logarithms = np.linspace(math.log(NARROWEST), math.log(WIDEST), TABLE)
    angles = np.exp(logarithms)
    return logarithms, relative_load(angles), relative_depth(angles)


@lru_cache(maxsize=256)
def _inverse(backing: float) -> _Inverse:
    """The inverted law; backing: 2 E* L / k, the part of the depth that pin and link add."""

    def logarithm(angles: Array) -> Array:
        return np.asarray(np.log(relative_load(angles) * (relative_depth(angles) + backing)))

    highest = float(logarithm(np.array([WIDEST]))[0])
    half = 0.5 * (highest - LOWEST)
    nodes = chebyshev.chebpts1(DEGREE + 1)
    wanted = LOWEST + half * (nodes + 1.0)
    known, loads, depths = _table()
    logarithms = np.log(loads * (depths + backing))
    # the secant method, in logarithms: next to a straight line, so that its errors vanish after some rounds
    before, now = np.interp(wanted, logarithms, known), np.interp(wanted + BESIDE, logarithms, known)
    missed = logarithm(np.exp(before)) - wanted
    for _ in range(SECANTS):
        misses = logarithm(np.exp(now)) - wanted
        apart = misses - missed
        step = np.where(apart == 0.0, 0.0, misses * (now - before) / np.where(apart == 0.0, 1.0, apart))
        before, now, missed = now, now - step, misses
    ratios = 1.0 / (relative_depth(np.exp(now)) + backing)
    force = chebyshev.cheb2poly(chebyshev.chebfit(nodes, ratios, DEGREE))
    energy = np.zeros(DEGREE + 1)
    carried = 0.0
    for n in range(DEGREE, -1, -1):  # of 2 Q + dQ/ds = P, s the logarithm of the depth
        energy[n] = 0.5 * (force[n] - carried)
        carried = n * energy[n] / half
    return _Inverse(highest, tuple(force.tolist()), tuple(energy.tolist()))
