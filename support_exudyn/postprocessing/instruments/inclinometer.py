"""Inclinometers feel gravity and the acceleration of the place where they sit, and cannot tell them apart.

f = R^T (g - a)                what the body feels, its own axes: x along the line by which the machine
                               measures it, y across in the plane, z to the right
tilt = atan2(-f_x, -f_y)       the angle of the body from +x while it is at rest
"""

from typing import ClassVar, Literal

import numpy as np

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.instruments.felt import felt
from support_exudyn.postprocessing.instruments.instrument import Instrument
from support_exudyn.simulation.result import Result
from user_forces.values.units import Radians
from user_forces.values.value import NonNegative, value


@value
class Inclinometer(Instrument):
    """A device that takes the direction of what it feels for that of gravity, so that it errs in motion.

    The filter acts on what it feels, axis by axis. At rest it shows the angle of the body, in radians from the
    horizontal, positive counterclockwise; with gravity along -y that is the channel BODY.angle.

    Arguments:
        body: name of the body on which it sits; "ground" is the base of a machine.
        at: where: a traced point, pin or actuator whose point on this body it is; None: its centre of mass.
        direction: "forward", by default: in the plane; "sideways": how far the body's right side is down.
        rate, low_pass, noise [rad], resolution [rad]: see `Instrument`.
    """

    UNIT: ClassVar[str] = "rad"

    body: str
    at: str | None = None
    direction: Literal["forward", "sideways"] = "forward"
    noise: Radians[NonNegative] = 0.0
    resolution: Radians[NonNegative] = 0.0

    def signals(self, result: Result) -> Series:
        """What the body feels at the place (n, 3) [m/s^2], in its own axes."""
        return felt(result, self.body, self.at)

    def reading(self, signals: Series) -> Series:
        """The tilt (n,) [rad] that it takes the body to have."""
        x, y, z = signals.T
        if self.direction == "sideways":
            return np.asarray(np.arctan2(z, np.hypot(x, y)))
        return np.asarray(np.unwrap(np.arctan2(0.0 - x, -y)))  # of 0, not of -0
