"""Thicknesses and widths of a shield support that is known by its pivots."""

import math
from dataclasses import dataclass

from support_exudyn.machines.four_bar_shield import FourBarShield
from support_exudyn.model.linkage import GROUND
from support_exudyn.postprocessing.look.plain import extent
from support_exudyn.scenario.scenario import Scenario

GAP = 0.1  # between plates that pass each other, of their thickness


@dataclass(frozen=True)
class Sizes:
    """The sizes that are not among the dimensions of the machine, and those of its width [m].

    Arguments:
        length: extent of the machine, which what nobody knows is a share of.
        pin, eye: radii of a pin, and of the eye about it.
        plate: thickness of a plate.
        column: radius of a cylinder.
        canopy, shield, rear_link, front_link: widths of bodies; of a front link, of each.
        front_links, columns: half the distances of both front links, and of both columns of a pair.
    """

    length: float
    pin: float
    eye: float
    plate: float
    column: float
    canopy: float
    shield: float
    rear_link: float
    front_link: float
    front_links: float
    columns: float

    @property
    def bracket(self) -> float:
        """The distance from the plane of the base's plates that carry the links: just outside of these."""
        outside = max(self.front_links + 0.5 * self.front_link, 0.5 * self.rear_link)
        return outside + (0.5 + GAP) * self.plate

    @property
    def cheek(self) -> float:
        """The distance from the plane of the side plates of shield and tail beam: outside of the base's."""
        return max(0.5 * (self.shield - self.plate), self.bracket + (1.0 + GAP) * self.plate)

    @property
    def base(self) -> float:
        """Half its width."""
        return max(self.bracket + 0.5 * self.plate, self.columns + 1.35 * self.column)

    @property
    def roof(self) -> float:
        """Half the width of the canopy, which covers everything."""
        return max(0.5 * self.canopy, self.cheek + 0.5 * self.plate, self.columns + 1.35 * self.column)


def sizes(scenario: Scenario) -> Sizes:
    """The sizes of a scenario's machine: its own widths, where it knows them; the rest by its pivots."""
    linkage = scenario.linkage
    length = extent(linkage)
    columns = {name: linkage.actuators[name] for name in standing(scenario)}
    shortest = min(column.start_length for column in columns.values())
    feet = [column.foot_point for column in columns.values()]
    width = scenario.machine.widths()
    known = width.spreads if width else {}

    def wide(body: str, share: float) -> float:
        """The width of a body over whose width the mass is spread evenly."""
        return known[body] * math.sqrt(12.0) if known.get(body) else share * length

    apart = (width.actuators.get(next(iter(columns))) if width else None) or 0.077 * length
    # so thick that two pairs one behind the other have room
    beside = max(0.3 * math.dist(*feet), 0.03 * shortest) if len(feet) == 2 else math.inf
    eye = min(0.027 * length, 0.45 * _distance_of_eyes(scenario))
    return Sizes(
        length=length,
        pin=min(0.6 * eye, _bore(scenario) or 0.6 * eye),
        eye=eye,
        plate=0.009 * length,
        column=min(0.085 * shortest, beside, 0.8 * apart),
        canopy=wide("canopy", 0.285),
        shield=wide("shield", 0.275),
        rear_link=wide("rear_link", 0.175),
        front_link=wide("front_link", 0.03),
        front_links=(width.pairs.get("front_link") if width else None) or 0.1 * length,
        columns=apart,
    )


def standing(scenario: Scenario) -> tuple[str, ...]:
    """Names of the columns that stand on the base; the others stand on the shield beam."""
    machine = scenario.machine
    assert isinstance(machine, FourBarShield)  # whose sizes these are
    return tuple(name for name, strut in machine.STRUTS.items() if strut.foot[0] == GROUND)


def _distance_of_eyes(scenario: Scenario) -> float:
    """The smaller distance of two eyes, on the shield beam or the base [m], but not next to nothing."""
    pins = scenario.linkage.pins
    on_shield = math.dist(pins["rear_shield"].second_point, pins["front_shield"].second_point)
    on_base = math.dist(pins["rear_base"].first_point, pins["front_base"].first_point)
    return max(min(on_shield, on_base), 0.02 * extent(scenario.linkage))


def _bore(scenario: Scenario) -> float | None:
    """The radius of its clearance pins' bores [m]; None without one."""
    radii = [pin.contact.bearing.bore_radius for pin in scenario.clearance_pins.values()]
    return max(radii, default=None)
