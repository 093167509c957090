"""Cases that several tests share."""

from __future__ import annotations

from support_exudyn import (
    Body,
    ClearancePin,
    CubicStep,
    Linkage,
    Machine,
    PinPlace,
    Scenario,
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
    external_contact_stiffness,
    value,
)

PIN = "rear_base"
FORCE = "pin.rear_base.force"


def paper_contact(clearance_mm: float, sliding_coefficient: float) -> JournalContact:
    """The paper's pin: Lankarani-Nikravesh with restitution 0.9, stiffness of Eq. 5."""
    bearing = JournalBearing(bore_radius=0.0655, clearance=clearance_mm / 1e3)
    stiffness = external_contact_stiffness(bearing, STEEL, STEEL_35CRMO)
    friction = Ambrosio(sliding_coefficient=sliding_coefficient) if sliding_coefficient else Frictionless()
    return JournalContact(
        bearing=bearing,
        normal=LankaraniNikravesh(stiffness=stiffness, restitution=0.9),
        friction=friction,
    )


def support(**changes: object) -> Scenario:
    """The rise of the reference support with ideal pins, changed as asked."""
    fields = {"machine": reference_support(), "drive": CubicStep(), "duration": 5.0} | changes
    return Scenario(**fields)


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
