"""The user function of a clearance joint: displacement and velocity in, kernel, six numbers out.

Exudyn's rigid-body connector hands over how the journal's marker moves against the bore's, and takes force and
moment in the same axes. The kernel computes kinematics, normal law and friction law, see `connector_kernel`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from user_forces.connector.attachment import Attachment, compiled_kernel, compiled_line_kernel
from user_forces.contact import Contact


class ConnectorForce:
    """Force and moment of a contact for the engine, with what they depend on besides the motion.

    closed, speed: whether the surfaces are in contact, and the velocity of their impact [m/s]. deflection [m],
    slip [m/s], step [s]: of a friction law with a state at the start of the step, and its length.
    last: what the kernel gave last. turn: between the marker frames then [rad], [rad/s]. along: of the
    journal's marker along the axis [m], [m/s].
    """

    def __init__(self, contact: Contact, at: Attachment, bore_spin: Callable[[], float]) -> None:
        self.contact, self.kernel = contact, compiled_kernel(contact.force_kernel, at, contact.bearing.is_slot)
        self.constants: Any = np.array(contact.constants)
        self.closed, self.speed, self.deflection, self.slip, self.step = False, 0.0, 0.0, 0.0, 0.0
        self.last: tuple[float, ...] = ()
        self.turn = self.along = 0.0, 0.0
        self.calls = 0
        self._spin = bore_spin if at is Attachment.MIDDLE else float  # else zero, which is not used
        self._own = self.kernel, self.constants

    def use(self, kernel: Callable[..., Any] | None = None, constants: Any = None) -> None:
        """Let another kernel act with its constants, or that of the contact again."""
        self.kernel, self.constants = self._own if kernel is None else (kernel, constants)

    def __call__(
        self,
        mbs: Any,
        t: float,
        item: int,
        displacement: list[float],
        rotation: list[float],
        velocity: list[float],
        angular_velocity: list[float],
        *settings: Any,
    ) -> list[float]:
        """Force [N] and moment [N m] that pull the markers together, in the connector's axes."""
        x, y, z = displacement
        vx, vy, vz = velocity
        self.calls += 1
        self.turn, self.along = (rotation[2], angular_velocity[2]), (z, vz)
        self.last = force = self.kernel(
            x, y, z, vx, vy, vz, rotation[2], angular_velocity[2], self._spin(),
            self.closed, self.speed, self.deflection, self.slip, self.step, self.constants,
        )  # fmt: skip
        if math.isnan(force[7]):
            self.contact.normal.check(force[4])
        return [force[0], force[1], force[2], 0.0, 0.0, force[3]]


class LineForce(ConnectorForce):
    """The force of a contact without friction, for the engine's spring-damper between two points.

    It is handed depth and rate alone, which costs the engine less than the motion of two frames.
    """

    def __init__(self, contact: Contact, at: Attachment, bore_spin: Callable[[], float]) -> None:
        super().__init__(contact, at, bore_spin)
        self.kernel = compiled_line_kernel(contact.force_kernel)
        self._own = self.kernel, self.constants

    def __call__(self, mbs: Any, t: float, item: int, depth: float, rate: float, *settings: Any) -> Any:  # type: ignore[override]
        """Force [N] that pulls the markers together, at a depth [m] and its rate [m/s]."""
        self.calls += 1
        self.last = force = self.kernel(depth, rate, self.closed, self.speed, self.constants)
        if math.isnan(force[0]):
            self.contact.normal.check(depth)
        return force[0]
