"""Cases that several tests share."""

from __future__ import annotations

import numpy as np

from support_exudyn import (
    Body,
    ClearancePin,
    CubicStep,
    Linkage,
    Machine,
    PinPlace,
    Scenario,
    Steady,
    ravn_slider_crank,
    reference_support,
)
from user_forces import (
    STEEL,
    STEEL_35CRMO,
    Ambrosio,
    Frictionless,
    JournalBearing,
    JournalContact,
    LankaraniNikravesh,
    Material,
    external_contact_stiffness,
    internal_contact_stiffness,
    value,
)

PIN = "rear_base"
FORCE = "pin.rear_base.force"


def paper_contact(clearance_mm: float, sliding_coefficient: float) -> JournalContact:
    """The paper's pin: Lankarani-Nikravesh with restitution 0.9, stiffness of Eq. 5, textbook damping."""
    bearing = JournalBearing(bore_radius=0.0655, clearance=clearance_mm / 1e3)
    stiffness = external_contact_stiffness(bearing, STEEL, STEEL_35CRMO)
    friction = Ambrosio(sliding_coefficient=sliding_coefficient) if sliding_coefficient else Frictionless()
    return JournalContact(
        bearing=bearing,
        normal=LankaraniNikravesh(stiffness=stiffness, restitution=0.9, rest_velocity=1e-3),
        friction=friction,
    )


def support(**changes: object) -> Scenario:
    """The rise of the reference support with ideal pins, changed as asked."""
    fields = {"machine": reference_support(), "drive": CubicStep(), "duration": 5.0, "record_period": 1e-3}
    return Scenario(**fields | changes)


def loose_support(clearance_mm: float = 1.5, sliding_coefficient: float = 0.0, **changes: object) -> Scenario:
    """The same with clearance in the rear-link pin."""
    pin = ClearancePin(contact=paper_contact(clearance_mm, sliding_coefficient))
    return support(pins={PIN: pin}, **changes)


@value
class Pair(Machine):
    """Two free bodies joined by one pin."""

    one: Body
    two: Body
    one_point: tuple[float, float]
    two_point: tuple[float, float]

    def linkage(self) -> Linkage:
        place = PinPlace(first="one", second="two", first_point=self.one_point, second_point=self.two_point)
        return Linkage(bodies={"one": self.one, "two": self.two}, pins={"pin": place})


# --- the slider-crank of the field ---

CRANK_SPEED = 5000.0 * 2.0 * np.pi / 60.0  # [rad/s]
SLIDER_PIN = "slider_pin"


def slider_crank_contact(sliding_coefficient: float = 0.0) -> JournalContact:
    """Bearing 10 mm, journal 9.5 mm, steel; Lankarani-Nikravesh 0.9, internal-contact stiffness, textbook."""
    bearing = JournalBearing(bore_radius=0.01, clearance=0.0005)
    steel = Material(name="steel", elastic_modulus=207e9, poisson_ratio=0.3, density=7800.0)
    stiffness = internal_contact_stiffness(bearing, steel, steel)
    return JournalContact(
        bearing=bearing,
        normal=LankaraniNikravesh(stiffness=stiffness, restitution=0.9, rest_velocity=1e-3),
        friction=Ambrosio(sliding_coefficient=sliding_coefficient) if sliding_coefficient else Frictionless(),
    )


def slider_crank(duration: float, **changes: object) -> Scenario:
    """Ravn's slider-crank at 5000 rpm from angle 0, without gravity, with ideal pins, changed as asked."""
    fields: dict[str, object] = {
        "machine": ravn_slider_crank(),
        "drive": Steady(rate=CRANK_SPEED),
        "duration": duration,
        "step": 1e-6,
        "record_period": 1e-5,
        "gravity": (0.0, 0.0),
    }
    return Scenario(**fields | changes)


def loose_slider_crank(duration: float, sliding_coefficient: float = 0.0, **changes: object) -> Scenario:
    """The same with clearance in the slider's pin, the bore in the slider."""
    pin = ClearancePin(contact=slider_crank_contact(sliding_coefficient))
    return slider_crank(duration, pins={SLIDER_PIN: pin}, **changes)
