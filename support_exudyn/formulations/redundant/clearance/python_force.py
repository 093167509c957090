"""A contact's force as the engine's user function in Python: one flat function without calls of methods.

What changes from step to step (the impact, the state of friction) are names of the function's own module, which
are set before a step is tried; there it also leaves the arguments of its last call.
"""

from collections.abc import Callable, Sequence
from typing import Any

from support_exudyn.formulations.redundant.clearance.connector_force import (
    Attachment,
    Relative,
    displacement_scale,
    in_slot,
    line_force,
    rough_force,
    slot_directions,
    straightened,
)
from support_exudyn.mechanics.contact_state import PinMemory
from user_forces.compilation.flat import (
    Formulas,
    SourceLine,
    compiled,
    depth_check,
    lines,
    needed,
    text,
    traceable,
)
from user_forces.contact import Contact, SlipHistory

MOTION = ["x", "y", "vx", "vy", "turning", "bore_spin"]
LINE = ["offset", "slope"]
RIGID = "displacement, rotation, velocity, angular_velocity, k, d, j0, j1, o"  # of the rigid-body connector
MEMORY = ["speed", "deflection", "slip", "step"]


class PythonForce:
    """Force and moment of one clearance pin.

    Arguments:
        contact: bearing and laws.
        at: what the force acts on.
        bore_spin: gives that of the bore [rad/s], if both bodies move and there is friction.
        straight: whether friction follows a line, see `friction_line`, that is laid by `lay`.
    """

    def __init__(
        self, contact: Contact, at: Attachment, bore_spin: Callable[[], float], straight: bool = False
    ) -> None:
        self._has_state = contact.friction.has_state
        formulas = traceable(contact)
        if straight:
            formulas = straightened(formulas, *(SourceLine(name, {}) for name in LINE))
        if at is Attachment.LINE:
            source = _line(formulas)
        else:
            source = _in_slot(formulas, at) if contact.bearing.is_slot else _rough(formulas, at)
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

    def load(self, memory: PinMemory, step: float, *others: float) -> None:
        """Set what the force depends on besides the motion.

        Arguments:
            memory: of the pin, at the start of the step.
            step: its length [s].
        """
        names = self._names
        names["in_contact"], names["speed"] = memory[:2]
        if self._has_state:
            names["deflection"], names["slip"], names["step"] = memory.deflection, memory.slip, step

    def lay(self, offset: float, slope: float) -> None:
        """Set the line that friction follows."""
        self._names["offset"], self._names["slope"] = offset, slope


def _line(contact: Contact) -> list[str]:
    """Source of the force that depends on depth and rate alone."""
    formulas, (depth, rate, speed) = lines(["depth", "rate", "speed"])
    force = text(line_force(contact, depth, rate, speed))
    return _source(contact, formulas, "depth, rate, k, d, f", "depth, rate", "depth", force, "0.0")


def _rough(contact: Contact, at: Attachment) -> list[str]:
    """Source of force and moment with friction."""
    formulas, (turn, dx, dy, x, y, *motion, speed, deflection, slip, step) = lines(
        ["turn", "dx", "dy", *MOTION, *MEMORY]
    )
    placed = ["x, y, _ = displacement"]
    if at is Attachment.MIDDLE:
        scale = displacement_scale(turn)
        x, y = scale * dx, scale * dy
        placed = ["dx, dy, _ = displacement", "turn = rotation[2]", "bore_spin = find_spin()"]
    history = SlipHistory(deflection, slip, step)
    found, arm = rough_force(contact, at, Relative(x, y, *motion), speed, history)
    moment = text(-arm * found.friction_force)
    forces = [text(-found.force_x), text(-found.force_y)]
    return _source(
        contact,
        formulas,
        RIGID,
        "displacement, velocity, rotation, angular_velocity",
        text(found.depth),
        _vector([*forces, "0.0", "0.0", "0.0", moment], 6),
        _vector([], 6),
        placed=placed,
        moving=["vx, vy, _ = velocity", "turning = angular_velocity[2]"],
    )


def _in_slot(contact: Contact, at: Attachment) -> list[str]:
    """Source of force and moment at a corner in its slot."""
    formulas, (turn, dx, dy, *motion, speed, deflection, slip, step) = lines(
        ["turn", "dx", "dy", *MOTION[2:], *MEMORY]
    )
    placed = ["dx, dy, _ = displacement"]
    half, x, y = 0.0, dx, dy
    if at is Attachment.MIDDLE:
        half, scale = 0.5 * turn, displacement_scale(turn)
        x, y = scale * dx, scale * dy
        placed += ["turn = rotation[2]", "bore_spin = find_spin()"]
    along, moving = in_slot(at, Relative(x, y, *motion), half)
    history = SlipHistory(deflection, slip, step)
    found, arm = rough_force(contact, at, moving, speed, history)
    side = contact.bearing.outwards(0.0, moving.y)[2]
    both = zip(*slot_directions(at, along, side, arm, half), strict=True)
    force = [text(found.normal_force * normal + found.friction_force * across) for normal, across in both]
    return _source(
        contact,
        formulas,
        RIGID,
        "displacement, velocity, rotation, angular_velocity",
        text(found.depth),
        _vector([*force[:2], "0.0", "0.0", "0.0", force[2]], 6),
        _vector([], 6),
        placed=placed,
        moving=["vx, vy, _ = velocity", "turning = angular_velocity[2]"],
    )


def _source(
    contact: Contact,
    formulas: Formulas,
    arguments: str,
    told: str,
    depth: str,
    force: str,
    nothing: str,
    *,
    placed: Sequence[str] = (),
    moving: Sequence[str] = (),
) -> list[str]:
    """Lines of the user function.

    Arguments:
        contact: bearing and laws. formulas: of all that follows.
        arguments: the engine's, after those that all its functions have; told: those that are kept.
        depth, force: the names of what follows from them; nothing: the force of surfaces that are apart.
        placed, moving: lines that name what the depth follows from, and what the force needs besides.
    """
    apart = needed(formulas, [depth])
    pressed = [line for line in needed(formulas, [force]) if line not in apart]
    body = [
        "global calls, last",
        "calls += 1",
        f"last = {told}",
        f"if not in_contact: return {nothing}",
        *placed,
        *apart,
        f"if {depth} <= 0.0: return {nothing}",
        *moving,
    ]
    return [
        f"def force(mbs, t, item, {arguments}):",
        *(f"    {line}" for line in body),
        *depth_check(contact, depth),
        *(f"    {line}" for line in pressed),
        f"    return {force}",
    ]


def _vector(parts: Sequence[str], size: int) -> str:
    """Source of a list of so many numbers, zero where no part is given."""
    return f"[{', '.join([*parts, *['0.0'] * size][:size])}]"
