"""Random choices, what is varied and how far, and a pin at a point of these ranges.

Every range has a part that is sensible. The study draws from the whole or from that part. The same numbers of a
generator give the same scene.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple, TypeVar

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

T = TypeVar("T")
LAWS: tuple[type[PowerLaw | PinInBore], ...] = (
    LankaraniNikravesh, Exact, HuntCrossley, Gonthier, Flores, PinInBore,
)  # fmt: skip
PAPER = paper_machine.stiffness(1.5)  # N/m^1.5
DEPTH = 1e-3  # [m] at which laws of all exponents have the same force
SLENDERNESS = 0.7 / paper_machine.BORE_RADIUS  # length of the pin over the radius of its bore
MODULUS = effective_modulus(STEEL, STEEL_35CRMO)
LARGEST_SPEED = 0.1  # of friction laws [m/s]
WITHOUT_FRICTION = 0.3  # share of the random scenes


class Span(NamedTuple):
    """A range, and what of it is sensible; its logarithm is drawn evenly, or the value itself if `even`."""

    low: float
    high: float
    sensible: tuple[float, float]
    even: bool = False


@dataclass(frozen=True)
class Draw:
    """Random choices.

    random: the generator of numbers. sensible: whether `size` keeps to the sensible part of every range.
    """

    random: np.random.Generator
    sensible: bool = False

    def even(self, low: float, high: float) -> float:
        """A number between two."""
        return float(self.random.uniform(low, high))

    def log(self, low: float, high: float) -> float:
        """A number between two whose logarithm is drawn evenly."""
        return low * math.pow(high / low, self.even(0.0, 1.0))

    def size(self, span: Span) -> float:
        """A number of a range."""
        low, high = span.sensible if self.sensible else span[:2]
        return low + self.even(0.0, 1.0) * (high - low) if span.even else self.log(low, high)

    def sizes(self, spans: Mapping[str, Span]) -> dict[str, Any]:
        """Numbers of several ranges, by their names."""
        return {name: self.size(span) for name, span in spans.items()}

    def chance(self, share: float) -> bool:
        """True in this share of all draws."""
        return self.even(0.0, 1.0) < share

    def pick(self, items: Sequence[T]) -> T:
        """One of several items."""
        return items[int(self.random.integers(len(items)))]

    def maybe(self, share: float, make: Callable[[], T]) -> T | None:
        """An element in this share of all draws, else none."""
        return make() if self.chance(share) else None


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
    law: type[PowerLaw | PinInBore] = LankaraniNikravesh
    step_s: float = 5e-4
    spectral_radius: float = 0.5
    bore: Literal["first", "second"] = "first"
    eccentricity: tuple[float, float] = (0.0, 0.0)  # in clearances
    bore_radius: float = paper_machine.BORE_RADIUS  # [m]

    @property
    def bearing(self) -> JournalBearing:
        """The journal and its bore."""
        return JournalBearing(bore_radius=self.bore_radius, clearance=self.clearance_m)

    @property
    def normal(self) -> NormalLaw:
        """The law of the normal force: that of the paper at a depth of 1 mm, whatever its exponent.

        A pin along its length has no exponent, and a modulus from a tenth to ten times that of steel.
        """
        if issubclass(self.law, PinInBore):
            return PinInBore(
                bearing=self.bearing,
                length=SLENDERNESS * self.bore_radius,
                effective_modulus=self.stiffness ** (1.0 / 3.0) * MODULUS,
                restitution=self.restitution,
            )
        stiffness = self.stiffness * PAPER * DEPTH ** (1.5 - self.exponent)
        return self.law(stiffness=stiffness, restitution=self.restitution, exponent=self.exponent)

    @property
    def pin(self) -> ClearancePin:
        """The clearance pin."""
        friction: Ambrosio | Frictionless = Frictionless()
        if self.mu != 0.0:
            friction = Ambrosio(
                sliding_coefficient=self.mu,
                static_speed=self.static_speed_m_s,
                dynamic_speed=self.dynamic_speed_m_s,
            )
        contact = JournalContact(bearing=self.bearing, normal=self.normal, friction=friction)
        x, y = (self.clearance_m * share for share in self.eccentricity)
        return ClearancePin(contact=contact, bore=self.bore, eccentricity=(x, y))


def drawn_point(of: Draw) -> Point:
    """A point of the ranges."""
    sizes = of.sizes(SPANS)
    static = sizes.pop("static_speed_m_s")
    dynamic = min(LARGEST_SPEED, static * sizes.pop("ramp"))
    if of.chance(WITHOUT_FRICTION):
        sizes["mu"] = 0.0
    return Point(
        **sizes,
        static_speed_m_s=static if dynamic > static and of.chance(0.9) else 0.0,
        dynamic_speed_m_s=dynamic,
        law=of.pick(LAWS),
        bore="first" if of.chance(0.5) else "second",
    )
