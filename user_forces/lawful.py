"""What no contact force can be: every law is looked at for it, wherever it is evaluated.

A force is a finite number. At rest a contact pushes. What a law takes besides its elastic part resists the
motion, and so does friction: damping and friction lose energy and never give any. A friction law with a state
is a spring, too, and may give back what it has stored: what it loses is looked at over longer times, in the
result checks.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from numbers import Real

import numpy as np

from user_forces.contact import Contact
from user_forces.friction.law import MOMENT, FrictionLaw
from user_forces.normal.law import NormalLaw
from user_forces.values.value import InputError, short

ROUNDING = 1e-9  # share of a force that a law may be off by from its own elastic part


AT_REST = (1e-9, 1e-7, 1e-5, 1e-4)  # depths [m] at which laws are called before a run,
RATES = (0.0, 1e-3, -1e-3, 0.1, -0.1)  # rates of the depth there [m/s]
SLIPS = (0.0, 1e-6, -1e-6, 1e-3, -1e-3, 0.1, -0.1, 1.0, -1.0)  # [m/s]
LOAD = 1e3  # [N]
LARGEST_COEFFICIENT = 5.0  # [-] of friction: dry metals in vacuum and soft rubber have less
ENERGY_SHARE, POINTS = 0.01, 16  # by which an energy may be off, and points of Gauss's rule
PROBED = (1.0, 1.001, 1.1)  # times the last depth and slip, where a run could not go on
SLOW = 0.1  # [m/s]
UNLAWFUL = "Mend the law, drive or load: what it gives is no force that could be. Its numbers are told above."


class LawError(ArithmeticError):
    """A law, a load or a drive gave what no force can be."""

    def at(self, name: str) -> LawError:
        """The error with the name of the pin or load at which it came up."""
        return LawError(f"{name}: {self}")


def check_laws(contact: Contact, name: str) -> None:
    """Raise LawError if a law of a contact is none, as far as calls before a run show; name: of the pin."""
    check_normal_law(contact, name)
    check_friction_law(contact.friction, name)


def check_normal_law(contact: Contact, name: str) -> None:
    """Raise LawError if a normal law gives no number, pulls at rest, drives, or its energy is not its work.

    It is called at depths of AT_REST, up to the depth for which it is valid, and at RATES.
    """
    law, said = contact.normal, f"{name}: {type(contact.normal).__name__}"
    for depth in AT_REST:
        at = f"at a depth of {depth:g} m"
        try:
            force = _number(law.elastic_force, (depth,), f"{said}.elastic_force", at)
            energy = _number(law.elastic_energy, (depth,), f"{said}.elastic_energy", at)
            forces = [
                _number(law, (depth, rate, SLOW), said, f"{at} and a rate of {rate:g} m/s") for rate in RATES
            ]
        except InputError:  # deeper than the law is valid
            return
        if not (force >= 0.0 <= energy):
            raise LawError(
                f"{said} has an elastic force of {force:.6g} N and an elastic energy of {energy:.6g} J {at}; "
                "allowed: >= 0"
            )
        for rate, asked in zip(RATES, forces, strict=True):
            normal = asked if asked > 0.0 or asked != asked else 0.0
            look(contact, depth, rate, 0.0, normal, 0.0, force, name)
        if is_own(law):
            _check_energy(law, depth, energy, said)


def _check_energy(law: NormalLaw, depth: float, energy: float, said: str) -> None:
    """Raise LawError unless the elastic energy is the integral of the elastic force, by Gauss's rule."""
    nodes, weights = np.polynomial.legendre.leggauss(POINTS)
    shares = 0.5 * (nodes + 1.0)  # the depth goes with the fourth power of these, so that forces are smooth
    known = zip(shares.tolist(), weights.tolist(), strict=True)
    work = sum(2.0 * depth * weight * t**3 * law.elastic_force(depth * t**4) for t, weight in known)
    if abs(energy - work) > ENERGY_SHARE * abs(work):
        raise LawError(
            f"{said}.elastic_energy is {energy:.6g} J at a depth of {depth:g} m, and the integral of "
            f"elastic_force up to there {work:.6g} J; allowed: the same within {ENERGY_SHARE:.0%}"
        )


def check_friction_law(law: FrictionLaw, name: str) -> None:
    """Raise LawError if a friction law gives no number, drives the slip, or exceeds LARGEST_COEFFICIENT.

    A law with a state may give back energy, so that of it numbers are checked only.
    """
    said = f"{name}: {type(law).__name__}"
    for slip in SLIPS:
        at = f"at a slip of {slip:g} m/s and {LOAD:g} N"
        force = _number(law, (slip, LOAD, 0.0), said, at)
        if law.has_state:
            _number(law.next_deflection, (0.0, slip, MOMENT), f"{said}.next_deflection", at)
        if (fault := _friction_fault(law, slip, LOAD, force)) is not None:
            raise LawError(f"{name}: {fault}")
        if is_own(law) and not law.has_state and abs(force) > LARGEST_COEFFICIENT * LOAD:
            raise LawError(
                f"{said} has a coefficient of {abs(force) / LOAD:.6g} {at}; "
                f"allowed: 0 to {LARGEST_COEFFICIENT:g}"
            )


def _number(function: Callable[..., object], arguments: tuple[float, ...], said: str, at: str) -> float:
    """A real number that a law gives. Raises LawError if it gives none, InputError if the law does."""
    try:
        found = function(*arguments)
    except (InputError, MemoryError):
        raise
    except Exception as error:  # whatever a user's class does wrong
        raise LawError(f"{said} fails {at}: {type(error).__name__}: {error}") from error
    if isinstance(found, bool) or not isinstance(found, Real):
        raise LawError(f"{said} gives {short(found)} {at}; allowed: a real number")
    return float(found)


def is_own(law: object) -> bool:
    """Whether a law, a load or a drive is of a user's class."""
    return type(law).__module__.partition(".")[0] not in ("user_forces", "support_exudyn")


def look(
    contact: Contact,
    depth: float,
    rate: float,
    slip: float,
    normal: float,
    friction: float,
    elastic: float = 0.0,
    pin: str = "",
) -> None:
    """Raise LawError if this cannot be the force of a contact that is pressed.

    Arguments:
        contact: whose laws are looked at.
        depth, rate, slip, normal, friction: see `ContactForce`.
        elastic: part of the normal force that is given back [N]; without it only the others are looked at.
        pin: where it is.
    """
    pressing = type(getattr(contact.normal, "law", contact.normal)).__name__
    at = f"at a depth of {depth:.6g} m and a rate of {rate:.6g} m/s"
    if not math.isfinite(normal) or not math.isfinite(elastic):
        said = f"{pressing} gives a force of {normal if elastic == elastic else elastic:g} N {at}"
    elif (fault := _friction_fault(contact.friction, slip, normal, friction)) is not None:
        said = fault
    elif elastic < 0.0:
        said = f"{pressing} pulls with {-elastic:.6g} N {at}, where at rest a contact pushes"
    elif elastic and (normal - elastic) * rate < -ROUNDING * (normal + elastic) * abs(rate):
        said = (
            f"{pressing} drives the motion instead of damping it: {normal:.6g} N {at}, of which "
            f"{elastic:.6g} N are elastic"
        )
    else:
        return
    raise LawError(f"{pin}: {said}" if pin else said)


def _friction_fault(law: FrictionLaw, slip: float, normal: float, friction: float) -> str | None:
    """Why this cannot be a friction force [N] at a slip [m/s] under a normal force [N]; None if it can."""
    rubbing = type(getattr(law, "law", law)).__name__
    if not math.isfinite(friction):
        return f"{rubbing} gives a force of {friction:g} N at a slip of {slip:.6g} m/s and {normal:.6g} N"
    if friction * slip > 0.0 and not law.has_state:
        return f"{rubbing} pushes along the slip: {friction:.6g} N at {slip:.6g} m/s, {normal:.6g} N pressed"
    return None
