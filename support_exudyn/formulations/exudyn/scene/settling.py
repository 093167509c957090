"""Springs that centre free journals while a static equilibrium is sought, in place of the contacts' forces."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from user_forces.connector.attachment import connector_kernel
from user_forces.connector.contact_connector import ContactConnector
from user_forces.kernel import kernel


@kernel
def centring_force(depth: float, elastic: float, pull: float, slack: float) -> float:
    """Force [N] of a contact's elastic part [N] and of a spring [N/m] that carries nothing at a depth [m]."""
    return pull * (depth - slack) + elastic


@contextmanager
def settling(
    pin: ContactConnector, load: float, share: Callable[[], float], hangs: tuple[float, float] | None
) -> Iterator[None]:
    """Replace a contact by its elastic part and a spring that pulls a free journal to the middle.

    Arguments:
        pin: the contact.
        load: that is to be held [N].
        share: of the clearance by which the load may press the contact, and of the load that the spring holds
            at the wall; asked at every evaluation.
        hangs: stiffness [N/m] and depth [m] of the spring by which a block hangs, whatever the share.
    """
    contact, clearance = pin.contact, pin.contact.bearing.clearance
    kinematics, known = contact.bearing.kinematics, contact.bearing.constants

    def force(
        x: float, y: float, vx: float, vy: float, bore_spin: float, journal_spin: float, *memory: Any
    ) -> tuple[float, ...]:
        depth, rate, slip, nx, ny, arm = kinematics(x, y, vx, vy, bore_spin, journal_spin, *known)
        pull, slack = (share() * load / clearance, -clearance) if hangs is None else hangs
        elastic = contact.normal.force_in_search(depth, load, share() * clearance) if depth > 0.0 else 0.0
        normal = centring_force(depth, elastic, pull, slack)
        return depth, rate, slip, normal, 0.0, -normal * nx, -normal * ny, arm, False, 0.0

    if pin.item.on_line:

        def tension(mbs: Any, t: float, item: int, depth: float, rate: float, *settings: Any) -> float:
            return float(force(clearance + depth, 0.0, 0.0, 0.0, 0.0, 0.0)[3])

        with acting(pin, tension):
            yield
        return
    in_axes = connector_kernel(force, pin.item.at, contact.bearing.is_slot)

    def user_function(
        mbs: Any,
        t: float,
        item: int,
        displacement: list[float],
        rotation: list[float],
        velocity: list[float],
        angular_velocity: list[float],
        *settings: Any,
    ) -> list[float]:
        motion = *displacement, *velocity, rotation[2], angular_velocity[2], 0.0
        fx, fy, fz, moment, *_ = in_axes(*motion, True, 0.0, 0.0, 0.0, 0.0, ())
        return [fx, fy, fz, 0.0, 0.0, moment]

    with acting(pin, user_function):
        yield


@contextmanager
def acting(pin: ContactConnector, function: Callable[..., Any]) -> Iterator[None]:
    """Let another user function give the force of a contact for as long as this lasts."""
    pin.item.set_force(function)
    try:
        yield
    finally:
        pin.item.set_force(pin.user_function)
