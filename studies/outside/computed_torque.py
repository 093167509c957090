"""The torque by which the four-bar of Akhadkar, Acary and Brogliato follows a sine.

Computed torque with sliding-mode terms, from the four-bar with ideal pins, whose one coordinate is the crank's
angle q. M is its reduced inertia and g what weight asks for; q_d = A sin(w t), e = q - q_d:

    torque = M (q_d'' - lambda e') + M'/2 q' (q' - lambda e) - K e' - K lambda e + g

as the example of Siconos has it, with q' where the usual law has q_d' in the second term, and in M' the
rocker's inertia about its centre.
"""

import math

from support_exudyn import MomentLoad, value
from user_forces.kernel import kernel

CRANK, COUPLER, ROCKER, GROUND = 1.0, 4.0, 2.5, 3.0  # [m], each of 1 kg
GRAVITY = 9.81
AMPLITUDE, RATE = 6.0, 0.75 * math.pi  # of q_d [rad], [rad/s]
GAIN, SLOPE = 200.0, 10.0  # K [N m s], lambda [1/s]


@kernel
def closed(q: float) -> tuple[float, float]:
    """Angles of coupler and rocker with ideal pins [rad], coupler above."""
    x, y = GROUND - CRANK * math.cos(q), -CRANK * math.sin(q)
    reach = math.hypot(x, y)
    along = (COUPLER**2 - ROCKER**2 + reach**2) / (2.0 * reach)
    high = math.sqrt(COUPLER**2 - along**2)
    dx, dy = (along * x - high * y) / reach, (along * y + high * x) / reach
    return math.atan2(dy, dx), math.atan2(dy - y, dx - x)


@kernel
def torque(q: float, spin: float, t: float) -> float:
    """The torque on the crank [N m] at its angle [rad], angular velocity [rad/s] and time [s]."""
    a, f = closed(q)
    slant = math.sin(a - f)
    # turns of coupler and rocker per turn of the crank, and their change
    s, r = CRANK * math.sin(f - q) / (COUPLER * slant), CRANK * math.sin(a - q) / (ROCKER * slant)
    squared = slant * slant
    ds = (
        -CRANK * math.cos(f - q) / (COUPLER * slant)
        - CRANK * math.sin(f - q) * math.cos(a - f) / (COUPLER * squared) * s
        + CRANK * math.sin(a - q) / (COUPLER * squared) * r
    )
    dr = (
        -CRANK * math.cos(a - q) / (ROCKER * slant)
        - CRANK * math.sin(f - q) / (ROCKER * squared) * s
        + CRANK * math.sin(a - q) * math.cos(a - f) / (ROCKER * squared) * r
    )
    c, dc = math.cos(q - a), math.sin(a - q) * (1.0 - s)
    own, whole_coupler, whole_rocker = CRANK**2 / 3.0 + CRANK**2, COUPLER**2 / 3.0, ROCKER**2 / 3.0
    coupled = CRANK * COUPLER  # P in M: twice half the mass times both lengths
    inertia = own + whole_coupler * s * s + whole_rocker * r * r + coupled * c * s
    change = whole_coupler * s * ds + ROCKER**2 / 12.0 * 2.0 * r * dr + 0.5 * coupled * (c * ds + s * dc)
    weight = GRAVITY * (
        1.5 * CRANK * math.cos(q) + 0.5 * COUPLER * math.cos(a) * s + 0.5 * ROCKER * math.cos(f) * r
    )
    wanted, rate = AMPLITUDE * math.sin(RATE * t), AMPLITUDE * RATE * math.cos(RATE * t)
    off, off_rate = q - wanted, spin - rate
    return (
        inertia * (-(RATE**2) * wanted - SLOPE * off_rate)
        + change * spin * (spin - SLOPE * off)
        - GAIN * (off_rate + SLOPE * off)
        + weight
    )


@value
class ComputedTorque(MomentLoad):
    """The torque on a crank that starts at an angle.

    Arguments:
        start: angle of the crank in the start posture [rad].
    """

    start: float

    @staticmethod
    @kernel
    def action(t: float, turn: float, spin: float, start: float) -> tuple[float, ...]:
        """The torque, all of whose power is work; see `ActingLoad`."""
        moment = torque(start + turn, spin, t)
        return moment, 0.0, moment * spin, 0.0, moment
