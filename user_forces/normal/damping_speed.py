"""The speed that hysteresis damping is scaled with: what a contact does that does not part.

Laws of the form F = F_el (1 + chi rate / w) are made for a free impact, in which w is the initial impact
velocity v0. A pin that is loaded hardly ever makes a free impact: it is pressed on, and with w = v0 it would
stay damped as its last impact happened to be, or without bound after a soft one. What w is then belongs to the
law.
"""

from abc import ABC, abstractmethod

from user_forces.expressions.scalar import maximum, sqrt
from user_forces.normal.law import Impact
from user_forces.values.units import MetresPerSecond
from user_forces.values.value import Positive, Value, value

SMALLEST = 1e-12  # [m/s], only so that nothing is divided by zero


class DampingSpeed(Value, ABC):
    """Speed w > 0 of F = F_el (1 + chi rate / w).

    The contract: `damping_speed(impact, elastic_energy)` is impact.speed in a free impact, so that the law
    delivers its restitution, and never zero.
    """

    @abstractmethod
    def __call__(self, impact: Impact, elastic_energy: float) -> float:
        """w [m/s] at a depth at which this energy [J] is stored."""

    @property
    @abstractmethod
    def forgets(self) -> bool:
        """Whether the impact velocity becomes 0 when a contact is pressed on again without having separated."""


@value
class IndentationVelocity(DampingSpeed):
    """w = max(v0, sqrt(2 E / m)): a loaded contact is damped like an impact that goes as deep as it is now.

    E is the energy stored at the present depth, m the mass that moves with it: in a linkage that with all other
    pins closed that are pressed, each along its normal, when the contact began or was last pressed on again. A
    free impact stores at most m v0^2 / 2, so there w = v0 and nothing changes. Below the floor sqrt(2 E / m)
    the initial impact velocity has no influence. When a contact, on its way out, is pressed on again, v0 is
    forgotten; the rate is zero then and with it the damping, so the force is continuous in time. Whether the
    pin parted for a moment or not makes no difference either: a soft new impact has v0 near zero too.

    With v0 = 0 and F_el = K depth^n the damping is alpha sqrt(m K) depth^((n-1)/2) rate with
    alpha = chi sqrt((n + 1)/2), the form that Tsuji, Tanaka and Ishida, Powder Technology 71 (1992) 239-250,
    give to contacts of grains. Small vibrations about any loaded depth then have the damping ratio
    chi sqrt((n + 1)/(8 n)), 0.46 chi for n = 1.5, whatever the load.
    """

    def __call__(self, impact: Impact, elastic_energy: float) -> float:
        """w [m/s] at a depth at which this energy [J] is stored."""
        return maximum(maximum(impact.speed, SMALLEST), sqrt(2.0 * elastic_energy / impact.mass))

    @property
    def forgets(self) -> bool:
        """The impact velocity is forgotten."""
        return True


@value
class ImpactVelocity(DampingSpeed):
    """w = max(v0, floor), as long as the contact lasts: the textbook behaviour.

    Published results are computed so. A pin that comes to rest stays damped as its last impact was, and the
    floor decides how a soft impact is damped; both are choices of the program, not of the law.

    Arguments:
        floor: smallest w [m/s], > 0.
    """

    floor: MetresPerSecond[Positive] = 1e-3

    def __call__(self, impact: Impact, elastic_energy: float) -> float:
        """w [m/s]; the energy is not used."""
        return maximum(impact.speed, self.floor)

    @property
    def forgets(self) -> bool:
        """The impact velocity is kept."""
        return False
