"""A contact's force as the engine's user function in Python: one flat function without calls of methods.

What changes from step to step (the touch, the state of friction) are names of the function's own module, which
are set before a step is tried; there it also leaves the arguments of its last call.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from support_exudyn.formulations.redundant.clearance.attachment import Attachment, Relative, rough_force
from support_exudyn.formulations.redundant.clearance.connector import displacement_scale
from support_exudyn.formulations.redundant.clearance.friction_line import straightened
from support_exudyn.mechanics.contact_state import Mobility, PinMemory
from user_forces.compilation.flat import Formulas, Line, compiled, depth_check, lines, needed, text, traceable
from user_forces.contact import JournalContact, SlipHistory
from user_forces.expressions.scalar import hypot, maximum
from user_forces.normal.law import Touch

MOTION = ["x", "y", "vx", "vy", "turning", "bore_spin"]
LINE = ["offset", "slope"]
MEMORY = ["speed", "mobility_xx", "mobility_xy", "mobility_yy", "deflection", "slip", "step"]


class PythonForce:
    """Force and moment of one clearance pin.

    Arguments:
        contact: bearing and laws.
        at: what the force acts on.
        bore_spin: gives that of the bore [rad/s], if both bodies move and there is friction.
        straight: whether friction follows a line, see `friction_line`, that is laid by `lay`.
    """

    def __init__(
        self, contact: JournalContact, at: Attachment, bore_spin: Callable[[], float], straight: bool = False
    ) -> None:
        self._has_state = contact.friction.has_state
        formulas = traceable(contact)
        if straight:
            formulas = straightened(formulas, *(Line(name, {}) for name in LINE))
        if at is Attachment.LINE:
            source = _line(formulas)
        elif at is Attachment.CENTRAL:
            source = _central(formulas)
        else:
            source = _space(formulas) if at is Attachment.SPACE else _rough(formulas, at)
        known = dict.fromkeys([*MEMORY, *LINE], 0.0)
        self._names = compiled(
            source, contact, find_spin=bore_spin, in_contact=False, last=(), calls=0, **known
        )
        self.function = self._names["force"]

    @property
    def calls(self) -> int:
        """How often the engine has asked."""
        return int(self._names["calls"])

    @property
    def last(self) -> tuple[Any, ...]:
        """What the engine handed over last.

        Depth and rate on a line; displacement and velocity, and with friction rotation and angular velocity.
        """
        found: tuple[Any, ...] = self._names["last"]
        return found

    def load(self, memory: PinMemory, mobility: Mobility, step: float, *others: float) -> None:
        """Set what the force depends on besides the motion.

        Arguments:
            memory: of the pin, at the start of the step.
            mobility: its, in the axes of the connector's displacement.
            step: its length [s].
        """
        names = self._names
        names["in_contact"], names["speed"] = memory[:2]
        names["mobility_xx"], names["mobility_xy"], names["mobility_yy"] = mobility
        if self._has_state:
            names["deflection"], names["slip"], names["step"] = memory.deflection, memory.slip, step

    def lay(self, offset: float, slope: float) -> None:
        """Set the line that friction follows."""
        self._names["offset"], self._names["slope"] = offset, slope


def _line(contact: JournalContact) -> list[str]:
    """Source of the force that depends on depth and rate alone."""
    formulas, (depth, rate, speed) = lines(["depth", "rate", "speed"])
    asked = text(contact.normal(depth, rate, Touch(speed, math.nan)))
    _, pressed = _parts(contact, formulas, "depth", asked)
    return [
        "def force(mbs, t, item, depth, rate, k, d, f):",
        "    global calls, last",
        "    calls += 1",
        "    last = depth, rate",
        "    if not in_contact or depth <= 0.0: return 0.0",
        *pressed,
        f"    return 0.0 if {asked} <= 0.0 else {asked}",  # what is no number is not cut
    ]


def _central(contact: JournalContact) -> list[str]:
    """Source of the force along the line of centres."""
    formulas, (x, y, vx, vy, speed, xx, xy, yy) = lines([*MOTION[:4], *MEMORY[:4]])
    eccentricity = hypot(x, y)
    depth = contact.bearing.depth(eccentricity)
    rate = (x * vx + y * vy) / eccentricity
    asked = contact.normal(depth, rate, Touch(speed, Mobility(xx, xy, yy).mass(x, y)))
    share = text(maximum(asked, 0.0) / eccentricity)
    apart, pressed = _parts(contact, formulas, text(depth), share)
    nothing = "return [0.0, 0.0, 0.0]"
    return [
        "def force(mbs, t, item, displacement, velocity, k, d, o):",
        "    global calls, last",
        "    calls += 1",
        "    last = displacement, velocity",
        f"    if not in_contact: {nothing}",
        "    x, y, _ = displacement",
        *apart,
        f"    if {text(depth)} <= 0.0: {nothing}",
        "    vx, vy, _ = velocity",
        *pressed,
        f"    return [{share} * x, {share} * y, 0.0]",
    ]


def _space(contact: JournalContact) -> list[str]:
    """Source of the force along the line between both centres in space."""
    formulas, (x, y, z, vx, vy, vz, speed, xx, xy, yy) = lines(["x", "y", "z", "vx", "vy", "vz", *MEMORY[:4]])
    eccentricity = hypot(hypot(x, y), z)
    depth = contact.bearing.depth(eccentricity)
    rate = (x * vx + y * vy + z * vz) / eccentricity
    asked = contact.normal(depth, rate, Touch(speed, Mobility(xx, xy, yy).mass(x, y)))
    share = text(maximum(asked, 0.0) / eccentricity)
    apart, pressed = _parts(contact, formulas, text(depth), share)
    nothing = "return [0.0, 0.0, 0.0, 0.0, 0.0, 0.0]"
    return [
        "def force(mbs, t, item, displacement, rotation, velocity, angular_velocity, k, d, j0, j1, o):",
        "    global calls, last",
        "    calls += 1",
        "    last = displacement, velocity",
        f"    if not in_contact: {nothing}",
        "    x, y, z = displacement",
        *apart,
        f"    if {text(depth)} <= 0.0: {nothing}",
        "    vx, vy, vz = velocity",
        *pressed,
        f"    return [{share} * x, {share} * y, {share} * z, 0.0, 0.0, 0.0]",
    ]


def _rough(contact: JournalContact, at: Attachment) -> list[str]:
    """Source of force and moment with friction."""
    formulas, (turn, dx, dy, x, y, *motion, speed, xx, xy, yy, deflection, slip, step) = lines(
        ["turn", "dx", "dy", *MOTION, *MEMORY]
    )
    placed = ["x, y, _ = displacement"]
    if at is Attachment.MIDDLE:
        scale = displacement_scale(turn)
        x, y = scale * dx, scale * dy
        placed = ["dx, dy, _ = displacement", "turn = rotation[2]", "bore_spin = find_spin()"]
    touch, history = Touch(speed, Mobility(xx, xy, yy).mass(x, y)), SlipHistory(deflection, slip, step)
    found, arm = rough_force(contact, at, Relative(x, y, *motion), touch, history)
    forces = f"{text(-found.force_x)}, {text(-found.force_y)}"
    moment = text(-arm * found.friction_force)
    apart, pressed = _parts(contact, formulas, text(found.depth), forces, moment)
    nothing = "return [0.0, 0.0, 0.0, 0.0, 0.0, 0.0]"
    return [
        "def force(mbs, t, item, displacement, rotation, velocity, angular_velocity, k, d, j0, j1, o):",
        "    global calls, last",
        "    calls += 1",
        "    last = displacement, velocity, rotation, angular_velocity",
        f"    if not in_contact: {nothing}",
        *(f"    {line}" for line in placed),
        *apart,
        f"    if {text(found.depth)} <= 0.0: {nothing}",
        "    vx, vy, _ = velocity",
        "    turning = angular_velocity[2]",
        *pressed,
        f"    return [{forces}, 0.0, 0.0, 0.0, {moment}]",
    ]


def _parts(
    contact: JournalContact, formulas: Formulas, depth: str, *wanted: str
) -> tuple[list[str], list[str]]:
    """Lines that give the depth, and those that only a pressed contact needs."""
    apart = needed(formulas, [depth])
    pressed = [f"    {line}" for line in needed(formulas, wanted) if line not in apart]
    return [f"    {line}" for line in apart], depth_check(contact, depth) + pressed
