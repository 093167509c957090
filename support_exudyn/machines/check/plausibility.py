"""What a colleague would ask about a support's file: units, masses, pivots, what is missing."""

import math
from collections.abc import Iterator, Mapping
from typing import Any

from support_exudyn.machines.four_bar_shield import FourBarShield
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.machines.shield_layout import BODIES, TAIL, TAIL_PLACES
from support_exudyn.model.linkage import GROUND, lumped
from support_exudyn.model.plane_geometry import distance
from user_forces.values.value import Vector2

SMALL, LARGE = 0.3, 30.0  # [m] extent of a support; beyond, its pivots are perhaps not in mm
LIGHT, HEAVY = 3.0, 3000.0  # [kg/m^3] mass over the cube of the extent; supports have 50 to 200
OUTSIDE = 0.5  # of the extent of a body's pivots: how far outside of them its centre of mass may lie
WIDE = 0.5  # of the distance of two pins of a body: the bores of both together


def suspicions(data: MachineData, machine: FourBarShield[Any]) -> Iterator[str]:
    """The generator says what looks wrong in the data themselves, in sentences with the keys of the file."""
    pivots = {name: getattr(machine, name) for name in machine.pivots() if getattr(machine, name) is not None}
    size = extent(pivots)
    if size < SMALL:
        yield f"pivots_mm: they lie within {1e3 * size:.3g} mm; are they given in metres?"
    if size > LARGE:
        yield f"pivots_mm: they lie {size:.3g} m apart; are they given in mm?"
    yield from _masses(machine, size)
    yield from _centres(machine)
    yield from _bores(data, machine)
    turned = math.degrees(machine.start().rear_link)
    if abs(turned) > 30.0:
        yield (
            f"start_hinge_height_mm: the rear link starts {turned:.0f} degrees from the posture in which the "
            "pivots are given; is the height that of the hinge, above the pivots' origin?"
        )


def missing(data: MachineData, machine: FourBarShield[Any]) -> Iterator[str]:
    """The generator says what cannot be done for want of data, and what was assumed."""
    for said in data.assumed:
        yield f"assumed: {said}"
    if data.stroke is None:
        yield "no stroke_mm: nobody knows how far the columns extend in use"
    if not data.bore_radii:
        yield "no [bore_radius_mm]: a scenario that gives a pin a clearance has to say its bore's radius"
    if machine.widths() is None:
        yield "no [width_mm]: it can be run in its plane only"
    without = [name for name in machine.STRUTS if name not in data.actuators]
    if without:
        yield f"no [columns.{without[0]}]: {' and '.join(without)} cannot be modelled as two bodies"
    tail = [part for part in machine.parts["shield"] if part.name == TAIL]
    if not tail or any(getattr(machine, name) is None for name in TAIL_PLACES):
        yield "no tail_beam with hinge and jack: the tail beam is part of the shield beam, if there is one"


def extent(pivots: Mapping[str, Vector2]) -> float:
    """The larger of length and height of all pivots [m]."""
    spans = [max(axis) - min(axis) for axis in zip(*pivots.values(), strict=True)]
    return float(max(spans))


def _masses(machine: FourBarShield[Any], size: float) -> Iterator[str]:
    masses = {f"{body}[{n}]": part.mass for body in BODIES for n, part in enumerate(machine.parts[body])}
    total = sum(masses.values())
    density = total / size**3
    if density < LIGHT:
        yield f"masses: {total:.4g} kg in all is little for a support of {size:.2g} m; are they in tonnes?"
    if density > HEAVY:
        yield f"masses: {total:.4g} kg in all is much for a support of {size:.2g} m; are they in grams?"
    for name, mass in masses.items():
        if mass > total - mass:
            yield f"parts.{name}: {mass:.4g} kg is more than all others together ({total - mass:.4g} kg)"


def _centres(machine: FourBarShield[Any]) -> Iterator[str]:
    corners: dict[str, list[Vector2]] = {
        "rear_link": [machine.rear_base, machine.rear_shield],
        "front_link": [machine.front_base, machine.front_shield],
        "shield": [machine.rear_shield, machine.front_shield, machine.hinge],
        "canopy": [machine.hinge, machine.tip],
    }
    for strut in machine.STRUTS.values():
        for body, pivot in strut:
            if body != GROUND:
                corners[body].append(getattr(machine, pivot))
    for body, points in corners.items():
        centre = lumped(machine.parts[body]).centre
        size = max(max(axis) - min(axis) for axis in zip(*points, strict=True))
        for along, (low, high) in zip(centre, map(_ends, zip(*points, strict=True)), strict=True):
            if not low - OUTSIDE * size <= along <= high + OUTSIDE * size:
                where = f"({1e3 * centre[0]:.0f}, {1e3 * centre[1]:.0f}) mm"
                yield f"parts.{body}: its centre of mass, {where}, lies far outside of its pivots"
                break


def _ends(values: tuple[float, ...]) -> tuple[float, float]:
    return min(values), max(values)


def _bores(data: MachineData, machine: FourBarShield[Any]) -> Iterator[str]:
    places = {**{name: name for name in data.bore_radii}, "shield_canopy": "hinge", "shield_tail": "tail_hinge"}
    sides = (
        ("rear_base", "rear_shield"),
        ("front_base", "front_shield"),
        ("rear_shield", "front_shield"),
        ("rear_shield", "shield_canopy"),
    )
    for one, other in sides:
        if one not in data.bore_radii and other not in data.bore_radii:
            continue
        apart = distance(getattr(machine, places.get(one, one)), getattr(machine, places.get(other, other)))
        radii = data.bore_radii.get(one, 0.0) + data.bore_radii.get(other, 0.0)
        if radii > WIDE * apart:
            yield (
                f"bore_radius_mm: those of {one} and {other} are {1e3 * radii:.3g} mm together, and the pins "
                f"{1e3 * apart:.4g} mm apart; are they diameters?"
            )
