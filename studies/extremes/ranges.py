"""What the extremes are: ranges of all that is varied, and the box of what is physically sensible."""

import math
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from studies.common import paper_machine
from support_exudyn import ClearancePin
from user_forces import (
    STEEL,
    STEEL_35CRMO,
    Ambrosio,
    Exact,
    Flores,
    Frictionless,
    Gonthier,
    HuntCrossley,
    JournalBearing,
    JournalContact,
    LankaraniNikravesh,
    NormalLaw,
    PinInBore,
    effective_modulus,
)
from user_forces.normal.power_laws import PowerLaw

POWER_LAWS: tuple[type[PowerLaw], ...] = (LankaraniNikravesh, Exact, HuntCrossley, Gonthier, Flores)
LAWS = (*(law.__name__ for law in POWER_LAWS), PinInBore.__name__)
PAPER = paper_machine.stiffness(1.5)  # N/m^1.5
DEPTH = 1e-3  # [m] at which laws of all exponents press alike
BORE_RADIUS = paper_machine.BORE_RADIUS
SLENDERNESS = 0.7 / BORE_RADIUS  # length of the pin over the radius of its bore
MODULUS = effective_modulus(STEEL, STEEL_35CRMO)


class Span(NamedTuple):
    """A range, and what of it is physically sensible; logarithmic unless said otherwise."""

    low: float
    high: float
    sensible: tuple[float, float]
    even: bool = False

    def draw(self, share: float, box: bool) -> float:
        """The value at a share of the range, 0 to 1."""
        low, high = self.sensible if box else (self.low, self.high)
        if self.even:
            return low + share * (high - low)
        return low * math.pow(high / low, share)


SPANS = {
    "clearance_m": Span(1e-6, 2e-2, (5e-5, 5e-3)),
    "stiffness": Span(1e-3, 1e3, (1e-2, 1e2)),  # times the paper's
    "restitution": Span(0.01, 1.0, (0.05, 1.0), even=True),
    "mu": Span(0.0, 1.5, (0.0, 0.5), even=True),
    "static_speed_m_s": Span(1e-7, 0.1, (1e-7, 0.1)),
    "ramp": Span(1.01, 1e3, (1.01, 1e3)),  # dynamic over static speed
    "exponent": Span(1.0, 2.2, (1.0, 2.2), even=True),
    "step_s": Span(1e-6, 1e-2, (1e-5, 1e-3)),
    "spectral_radius": Span(0.0, 1.0, (0.0, 1.0), even=True),
}
LARGEST_SPEED = 0.1  # of friction laws [m/s]
WITHOUT_FRICTION = 0.3  # share of the random scenes


@dataclass(frozen=True)
class Point:
    """One choice of everything that is varied of a pin and of the steps; SI, see SPANS for the names."""

    clearance_m: float = 1.5e-3
    stiffness: float = 1.0
    restitution: float = 0.9
    mu: float = 0.0
    static_speed_m_s: float = 1e-4
    dynamic_speed_m_s: float = 1e-2
    exponent: float = 1.5
    law: str = "LankaraniNikravesh"
    step_s: float = 5e-4
    spectral_radius: float = 0.5
    bore: Literal["first", "second"] = "first"
    eccentricity: tuple[float, float] = (0.0, 0.0)  # in clearances
    bore_radius: float = BORE_RADIUS  # [m]
    pace: float = 1.0  # by which runs are as long, in time and steps

    @property
    def pin(self) -> ClearancePin:
        """The clearance pin."""
        c = self.clearance_m
        x, y = self.eccentricity
        bearing = JournalBearing(bore_radius=self.bore_radius, clearance=c)
        contact = JournalContact(bearing=bearing, normal=self.normal, friction=self.friction)
        return ClearancePin(contact=contact, bore=self.bore, eccentricity=(c * x, c * y))

    @property
    def normal(self) -> NormalLaw:
        """The law of the normal force: as strong as the paper's at a depth of 1 mm, whatever its exponent.

        A pin along its length has no exponent, and a modulus from a tenth to ten times that of steel.
        """
        if self.law == PinInBore.__name__:
            return PinInBore(
                bearing=JournalBearing(bore_radius=self.bore_radius, clearance=self.clearance_m),
                length=SLENDERNESS * self.bore_radius,
                effective_modulus=self.stiffness ** (1.0 / 3.0) * MODULUS,
                restitution=self.restitution,
            )
        kind = next(law for law in POWER_LAWS if law.__name__ == self.law)
        stiffness = self.stiffness * PAPER * DEPTH ** (1.5 - self.exponent)
        return kind(stiffness=stiffness, restitution=self.restitution, exponent=self.exponent)

    @property
    def friction(self) -> Ambrosio | Frictionless:
        """The law of friction."""
        if self.mu == 0.0:
            return Frictionless()
        return Ambrosio(
            sliding_coefficient=self.mu,
            static_speed=self.static_speed_m_s,
            dynamic_speed=self.dynamic_speed_m_s,
        )


def drawn(random: np.random.Generator, box: bool) -> Point:
    """A random point, of the whole range or of the box."""
    shares = random.uniform(size=len(SPANS))
    found = {
        name: span.draw(float(share), box) for (name, span), share in zip(SPANS.items(), shares, strict=True)
    }
    static = found.pop("static_speed_m_s")
    dynamic = min(LARGEST_SPEED, static * found.pop("ramp"))
    if random.uniform() < WITHOUT_FRICTION:
        found["mu"] = 0.0
    return Point(
        **found,  # type: ignore[arg-type]
        static_speed_m_s=static if dynamic > static and random.uniform() < 0.9 else 0.0,
        dynamic_speed_m_s=dynamic,
        law=LAWS[random.integers(len(LAWS))],
        bore="first" if random.uniform() < 0.5 else "second",
    )
