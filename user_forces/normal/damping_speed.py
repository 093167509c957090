"""The speed that hysteresis damping is scaled with: what a contact does that does not part.

Laws of the form F = F_el (1 + chi rate / w) are made for a free impact, in which w is the approach speed v0.
A pin that is loaded hardly ever makes a free impact: it is pressed on, and with w = v0 it would stay damped as
its last touch happened to be, or without bound after a soft one. What w is then belongs to the law.
"""

from __future__ import annotations

from abc import ABC, abstractmethod

from user_forces.expressions.scalar import maximum, sqrt
from user_forces.normal.law import Touch
from user_forces.values.units import MetresPerSecond
from user_forces.values.value import Positive, Value, value

SMALLEST = 1e-12  # [m/s], only so that nothing is divided by zero


class DampingSpeed(Value, ABC):
    """Speed w > 0 of F = F_el (1 + chi rate / w).

    The contract: `damping_speed(touch, elastic_energy)` is touch.speed in a free impact, so that the law
    delivers its restitution, and never zero.
    """

    @abstractmethod
    def __call__(self, touch: Touch, elastic_energy: float) -> float:
        """w [m/s] at a depth at which this energy [J] is stored."""

    @property
    @abstractmethod
    def forgets(self) -> bool:
        """Whether the touch speed becomes 0 when a contact is pressed on again without having parted."""


@value
class DepthSpeed(DampingSpeed):
    """w = max(v0, sqrt(2 E / m)): a loaded contact is damped like an impact that goes as deep as it is now.

    E is the energy stored at the present depth, m the mass that moves with it: in a linkage that with all other
    pins closed that are pressed, each along its normal, when the contact began or was last pressed on again. A
    free impact stores at most m v0^2 / 2, so there w = v0 and nothing changes. Below the floor sqrt(2 E / m)
    the approach speed has no influence. When a contact, on its way out, is pressed on again, v0 is forgotten;
    the rate is zero then and with it the damping, so the force is continuous in time. Whether the pin parted
    for a moment or not makes no difference either: a soft new touch has v0 near zero too.

    With v0 = 0 and F_el = K depth^n the damping is alpha sqrt(m K) depth^((n-1)/2) rate with
    alpha = chi sqrt((n + 1)/2), the form that Tsuji, Tanaka and Ishida, Powder Technology 71 (1992) 239-250,
    give to contacts of grains. Small vibrations about any loaded depth then have the damping ratio
    chi sqrt((n + 1)/(8 n)), 0.46 chi for n = 1.5, whatever the load.
    """

    def __call__(self, touch: Touch, elastic_energy: float) -> float:
        """w [m/s] at a depth at which this energy [J] is stored."""
        return maximum(maximum(touch.speed, SMALLEST), sqrt(2.0 * elastic_energy / touch.mass))

    @property
    def forgets(self) -> bool:
        """The touch speed is forgotten."""
        return True


@value
class TouchSpeed(DampingSpeed):
    """w = max(v0, floor), as long as the contact lasts: the textbook behaviour.

    Published results are computed so. A pin that comes to rest stays damped as its last touch was, and the
    floor decides how a soft touch is damped; both are choices of the program, not of the law.

    Arguments:
        floor: smallest w [m/s], > 0.
    """

    floor: MetresPerSecond[Positive] = 1e-3

    def __call__(self, touch: Touch, elastic_energy: float) -> float:
        """w [m/s]; the energy is not used."""
        return maximum(touch.speed, self.floor)

    @property
    def forgets(self) -> bool:
        """The touch speed is kept."""
        return False
