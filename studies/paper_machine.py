"""The paper's case: the reference support with a loose rear-link pin, and what the paper prints of it."""

from __future__ import annotations

from dataclasses import replace

from support_exudyn import ClearancePin, CubicStep, Scenario, reference_support
from user_forces import (
    STEEL,
    STEEL_35CRMO,
    Ambrosio,
    Frictionless,
    JournalBearing,
    JournalContact,
    LankaraniNikravesh,
    TouchSpeed,
    external_contact_stiffness,
)

LOOSE_PIN = "rear_base"
BORE_RADIUS = 0.0655  # [m], implied by Table 2
RESTITUTION = 0.9  # assumed; the paper gives none
SLIDING_COEFFICIENT = 0.25  # assumed: dry steel on steel

# printed values
STIFFNESS = {0.5: 861300.557, 1.0: 859629.849, 1.5: 857942.947, 2.0: 856239.607}  # Table 2, N/mm^1.5
MEAN_FORCE = {0.5: 51375.609, 1.0: 51491.566, 1.5: 51649.027, 2.0: 51795.195}  # Table 3, N
FORCE_SPREAD = {0.5: 6114.940, 1.0: 5938.103, 1.5: 6013.112, 2.0: 6188.895}  # Table 3, N
MEAN_ACCELERATION = {0.5: 0.0030, 1.0: -0.0515, 1.5: -0.2733, 2.0: -0.3219}  # section 4.1, deg/s^2


def bearing(clearance_mm: float) -> JournalBearing:
    """The rear-link pin with this radial clearance."""
    return JournalBearing(bore_radius=BORE_RADIUS, clearance=clearance_mm / 1e3)


def stiffness(clearance_mm: float) -> float:
    """Eq. 5 for this pin [N/m^1.5]: a bore in steel, a pin of 35CrMo."""
    return external_contact_stiffness(bearing(clearance_mm), STEEL, STEEL_35CRMO)


def loose_pin(clearance_mm: float, sliding_coefficient: float) -> ClearancePin:
    """The rear-link pin as a clearance pin; the bore is in the base."""
    normal = LankaraniNikravesh(
        stiffness=stiffness(clearance_mm), restitution=RESTITUTION, damping_speed=TouchSpeed(floor=1e-3)
    )
    friction = Ambrosio(sliding_coefficient=sliding_coefficient) if sliding_coefficient else Frictionless()
    return ClearancePin(contact=JournalContact(bearing=bearing(clearance_mm), normal=normal, friction=friction))


def ideal_rise(step: float) -> Scenario:
    """The rise of 500 mm from 3 to 5 s with ideal pins, drive mode 2."""
    return Scenario(machine=reference_support(), drive=CubicStep(), duration=5.0, step=step)


def loose_rise(clearance_mm: float, sliding_coefficient: float, step: float) -> Scenario:
    """The same with clearance in the rear-link pin, its journal concentric at the start."""
    return replace(ideal_rise(step), pins={LOOSE_PIN: loose_pin(clearance_mm, sliding_coefficient)})
