"""A journal that flies freely in a free bore: the stand on which contact laws are tried.

    bore (mass M)
 .-----------.
|   .---.     |
|   | m | --> |        journal (mass m), at a speed along +x
|   '---'     |
 '-----------'
"""

from support_exudyn.model.linkage import Body, Linkage, PinPlace
from support_exudyn.model.machine import Machine
from user_forces.values.units import Kilograms, Metres, MetresPerSecond
from user_forces.values.value import NonNegative, Positive, value


@value
class ImpactStand(Machine):
    """Two free bodies, one with a bore and at rest, one with a journal that flies along +x in it.

    Pin: `pin` (bore and journal). Bodies: `bore`, `journal`. Centres of mass lie in the pin's centres, so the
    impact is central: the reduced mass is M m / (M + m) and nothing turns without friction.

    Arguments:
        bore_mass, journal_mass: M, m [kg], > 0.
        speed: of the journal at the start [m/s], >= 0.
        eccentricity: of the journal at the start, along +x [m], >= 0.
    """

    bore_mass: Kilograms[Positive]
    journal_mass: Kilograms[Positive]
    speed: MetresPerSecond[NonNegative]
    eccentricity: Metres[NonNegative] = 0.0

    @property
    def reduced_mass(self) -> float:
        """M m / (M + m) [kg]."""
        return self.bore_mass * self.journal_mass / (self.bore_mass + self.journal_mass)

    def linkage(self) -> Linkage:
        """Both bodies at the start."""
        centre = (self.eccentricity, 0.0)
        return Linkage(
            bodies={
                # nothing turns, so the inertia has no influence
                "bore": Body(mass=self.bore_mass, inertia=self.bore_mass, centre=(0.0, 0.0)),
                "journal": Body(
                    mass=self.journal_mass,
                    inertia=self.journal_mass,
                    centre=centre,
                    velocity=(self.speed, 0.0),
                ),
            },
            pins={"pin": PinPlace(first="bore", second="journal", first_point=(0.0, 0.0), second_point=centre)},
        )
