"""What no contact force can be: every law is looked at for it, wherever it is evaluated.

A force is a finite number. At rest a contact pushes. What a law takes besides its elastic part resists the
motion, and so does friction: damping and friction lose energy and never give any. A friction law with a state
is a spring, too, and may give back what it has stored: what it loses is looked at over longer times, in the
result checks.
"""

from __future__ import annotations

import math

from user_forces.contact import Contact
from user_forces.values.value import InputError

ROUNDING = 1e-9  # share of a force that a law may be off by from its own elastic part


AT_REST = (1e-9, 1e-7, 1e-5, 1e-4)  # depths [m] at which laws are looked at before a run
PROBED = (1.0, 1.001, 1.1)  # times the last depth and slip, where a run could not go on
SLOW = 0.1  # [m/s]
UNLAWFUL = "Mend the law, drive or load: what it gives is no force that could be. Its numbers are told above."


class LawError(ArithmeticError):
    """A law, a load or a drive gave what no force can be."""

    def at(self, name: str) -> LawError:
        """The error with the name of the pin or load at which it came up."""
        return LawError(f"{name}: {self}")


def look_at_rest(contact: Contact, pin: str) -> None:
    """Raise LawError if the elastic part of a pin's normal law pulls, or has stored less than nothing."""
    law = contact.normal
    for depth in AT_REST:
        try:
            force, energy = law.elastic_force(depth), law.elastic_energy(depth)
            pressed = law(depth, 0.0, SLOW)
        except InputError:  # deeper than the law is valid
            return
        except ArithmeticError as error:
            raise LawError(f"{pin}: {type(law).__name__} fails at a depth of {depth:g} m: {error}") from error
        if depth == AT_REST[0]:
            look(contact, depth, 0.0, 0.0, pressed, 0.0, pin=pin)
        if not (force >= 0.0 <= energy):
            raise LawError(
                f"{pin}: {type(law).__name__} has an elastic force of {force:.6g} N and an elastic energy of "
                f"{energy:.6g} J at a depth of {depth:g} m; allowed: >= 0"
            )


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
    pressing, rubbing = (type(getattr(law, "law", law)).__name__ for law in (contact.normal, contact.friction))
    at = f"at a depth of {depth:.6g} m and a rate of {rate:.6g} m/s"
    if not math.isfinite(normal) or not math.isfinite(elastic):
        said = f"{pressing} gives a force of {normal if elastic == elastic else elastic:g} N {at}"
    elif not math.isfinite(friction):
        said = f"{rubbing} gives a force of {friction:g} N at a slip of {slip:.6g} m/s and {normal:.6g} N"
    elif elastic < 0.0:
        said = f"{pressing} pulls with {-elastic:.6g} N {at}, where at rest a contact pushes"
    elif elastic and (normal - elastic) * rate < -ROUNDING * (normal + elastic) * abs(rate):
        said = (
            f"{pressing} drives the motion instead of damping it: {normal:.6g} N {at}, of which "
            f"{elastic:.6g} N are elastic"
        )
    elif friction * slip > 0.0 and not contact.friction.has_state:
        said = f"{rubbing} pushes along the slip: {friction:.6g} N at {slip:.6g} m/s, {normal:.6g} N pressed"
    else:
        return
    raise LawError(f"{pin}: {said}" if pin else said)
