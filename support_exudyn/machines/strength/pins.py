"""Stresses in a pin and its eyes, and their safety against yield.

A pin carries F on a middle eye of width b between two outer ones of width a, at gaps c, each pressed evenly:

    bearing pressure    p = F / (d min(b, 2 a))         against the yield stress of the eyes
    shear, two sections tau = F / (2 A), A = pi d^2/4   against yield stress / sqrt(3) (von Mises)
    bending             sigma = M / W, M = F (b + 2 a + 4 c) / 8, W = pi d^3/32   against that of the pin
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from support_exudyn.machines.machine_data import MachineData
from support_exudyn.machines.strength.strength_data import PinStrength


@dataclass(frozen=True)
class PinStresses:
    """Stresses of a pin under a force.

    Arguments:
        force: on all pins together that the plane takes as one [N].
        bearing, shear, bending: [Pa].
        safeties: yield over stress, of "bearing", "shear" and "bending" [-]; infinite without a force.
    """

    force: float
    bearing: float
    shear: float
    bending: float
    safeties: dict[str, float]

    @property
    def least(self) -> tuple[str, float]:
        """What yields first, and its safety."""
        return min(self.safeties.items(), key=lambda item: item[1])


def stresses(pin: PinStrength, diameter: float, force: float) -> PinStresses:
    """The stresses of a pin of this diameter [m] under a force on all of its kind together [N]."""
    one = force / pin.count
    bearing = one / (diameter * min(pin.middle, 2.0 * pin.outer))
    shear = one / (2.0 * 0.25 * math.pi * diameter**2)
    moment = one * (pin.middle + 2.0 * pin.outer + 4.0 * pin.gap) / 8.0
    bending = moment / (math.pi * diameter**3 / 32.0)
    pin_yield, eye_yield = pin.yields
    allowed = {
        "bearing": (eye_yield, bearing),
        "shear": (pin_yield / math.sqrt(3.0), shear),
        "bending": (pin_yield, bending),
    }
    safeties = {name: limit / stress if stress > 0.0 else math.inf for name, (limit, stress) in allowed.items()}
    return PinStresses(force, bearing, shear, bending, safeties)


def pin_data(data: MachineData, pin: str) -> tuple[PinStrength, float, bool] | None:
    """A pin's eyes, its diameter [m], and whether they are assumed; None if too little is known.

    Assumed of a pin whose length L alone is known: a middle eye of L/2 between two of L/4. A pin of a body that
    stands for two is two pins. Its diameter is that of the bore.
    """
    known = data.strength.pins.get(pin) if data.strength else None
    bore = data.bore_radii.get(pin)
    diameter = known.diameter if known and known.diameter else None if bore is None else 2.0 * bore
    if diameter is None:
        return None
    if known:
        return known, diameter, False
    width = data.machine.widths()
    length = width.lengths.get(pin) if width else None
    if width is None or length is None:
        return None
    place = data.machine.linkage().pins[pin]
    count = 2 if {place.first, place.second} & width.pairs.keys() else 1
    return PinStrength(middle=0.5 * length, outer=0.25 * length, count=count), diameter, True


def without_data(data: MachineData, pins: Iterable[str]) -> list[str]:
    """Names of the pins of which too little is known."""
    return [name for name in pins if pin_data(data, name) is None]
