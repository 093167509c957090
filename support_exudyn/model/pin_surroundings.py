"""What a machine knows of the contact in its pins: the length of each, and the links that its pins hold."""

import math

from support_exudyn.model.linkage import GROUND
from support_exudyn.model.machine import Machine
from user_forces.backing import bar_stiffness, in_series
from user_forces.materials import Material


def contact_length(machine: Machine, pin: str) -> float | None:
    """Length of the contact in a pin, along its axis [m]; None if the machine does not know it.

    Where a body stands for two, such as a pair of links, the pin stands for two as well, and their lengths add
    up.
    """
    width = machine.widths()
    place = machine.linkage().pins.get(pin)
    length = None if width is None or place is None else width.lengths.get(pin)
    if width is None or place is None or length is None:
        return None
    return 2.0 * length if {place.first, place.second} & width.pairs.keys() else length


def links_stiffness(machine: Machine, pin: str, material: Material) -> float:
    """Stiffness [N/m] of the links that a pin joins, along their axes and in series; inf where it joins none.

    A link is a body that is held by two pins and nothing else. Its section is that of its mass.
    """
    linkage, lengths = machine.linkage(), []
    for name in (body for body, _ in linkage.pins[pin].sides if body != GROUND):
        ends = [
            (part, point)
            for (part, _), sides in linkage.joints.items()
            for body, point in sides
            if body == name
        ]
        if [part for part, _ in ends] == ["pins", "pins"]:
            length = math.dist(*(point for _, point in ends))
            lengths.append(bar_stiffness(linkage.bodies[name].mass, length, material))
    return in_series(lengths)
