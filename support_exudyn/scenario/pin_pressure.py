"""How hard a clearance pin is pressed: pressure against the yield strength, contact angle, depth, stiffness."""

from __future__ import annotations

import math
from dataclasses import dataclass

from support_exudyn.model.machine import Machine, contact_length
from support_exudyn.model.pins import ClearancePin
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scenario.timescales import loaded_contacts
from user_forces.conformal import LineContact, line_contact
from user_forces.materials import Material, effective_modulus
from user_forces.values.value import InputError

# peak pressure of a line contact over the yield strength in tension at which a body begins to yield, below its
# surface: by Tresca's criterion (Johnson, Contact Mechanics (1985), Eq. 6.4)
FIRST_YIELD = 1.67


@dataclass(frozen=True)
class PressedPin:
    """A clearance pin under a force.

    name: of the pin. force: [N]. length: of the contact [m], None if it is not known. line: the elastic contact
    along it; None without a length and if the force is beyond the theory. softest: the material that yields
    first; None if no yield strength is known. depth: under the law in use [m]; stiffness: the law's slope there
    [N/m]; both nan where the law cannot hold the force.
    """

    name: str
    force: float
    length: float | None
    line: LineContact | None
    softest: Material | None
    depth: float
    stiffness: float

    @property
    def yield_share(self) -> float:
        """Peak pressure over that at which the softer body begins to yield; nan if it is not known."""
        if self.line is None or self.softest is None or self.softest.yield_strength is None:
            return math.nan
        return self.line.peak_pressure / (FIRST_YIELD * self.softest.yield_strength)

    @property
    def warning(self) -> str | None:
        """That the law does not hold the force, or that the pin yields, in one sentence; None: neither."""
        if math.isnan(self.depth):
            return (
                f"{self.name}: its law does not hold {self.force / 1e3:.4g} kN; allowed: a larger clearance or "
                "length, or another law"
            )
        if not self.yield_share > 1.0 or self.line is None or self.softest is None:
            return None
        return (
            f"{self.name}: {self.force / 1e3:.4g} kN on {1e3 * (self.length or 0.0):.4g} mm press with "
            f"{self.line.peak_pressure / 1e6:.4g} MPa, {self.yield_share:.3g} times what {self.softest.name} "
            "bears before it yields: an elastic contact is too stiff there"
        )


def pressed_pin(machine: Machine, name: str, pin: ClearancePin, force: float) -> PressedPin:
    """A pin of a machine under a force [N] >= 0.

    Arguments:
        machine: that knows the pin's length, unless the pin or its law says it.
        name: of the pin.
        pin: its contact and materials.
        force: that presses it [N].
    """
    law_length = getattr(pin.contact.normal, "length", None)
    length = pin.length or law_length or contact_length(machine, name)
    materials = (pin.bore_material, pin.journal_material)
    modulus = getattr(pin.contact.normal, "effective_modulus", None) or effective_modulus(*materials)
    line = None
    if length is not None:
        try:
            line = line_contact(pin.contact.bearing, length, modulus, force)
        except InputError:  # beyond the theory
            line = None
    depth, stiffness = _under(pin, force)
    known = [one for one in materials if one.yield_strength is not None]
    softest = min(known, key=lambda one: one.yield_strength or 0.0, default=None)
    return PressedPin(name, force, length, line, softest, depth, stiffness)


def statically_pressed(scenario: Scenario) -> list[PressedPin]:
    """Every clearance pin under the largest static load of the start posture: weight, or weight and loads."""
    loads: dict[str, float] = {}
    pins = scenario.clearance_pins
    for one in loaded_contacts(scenario):
        if one.pin in pins:
            loads[one.pin] = max(one.load, loads.get(one.pin, 0.0))
    return [pressed_pin(scenario.machine, name, pins[name], load) for name, load in loads.items()]


def _under(pin: ClearancePin, force: float) -> tuple[float, float]:
    """Depth [m] and slope [N/m] of a pin's law under a force."""
    law = pin.contact.normal
    try:
        depth = law.resting_depth(force)
        if depth <= 0.0:
            return 0.0, 0.0
        return depth, (law.elastic_force(depth) - law.elastic_force(0.999 * depth)) / (0.001 * depth)
    except (InputError, ArithmeticError):
        return math.nan, math.nan
