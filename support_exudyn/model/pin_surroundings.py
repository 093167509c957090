"""What a machine knows of the contact in its pins: the length of each, and the links that its pins hold."""

import math
from collections.abc import Iterator

from support_exudyn.model.linkage import GROUND, Linkage, PinPlace
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
    linkage = machine.linkage()
    place = linkage.pins[pin]
    bodies = [name for name in (place.first, place.second) if name != GROUND]
    return in_series(
        bar_stiffness(linkage.bodies[name].mass, length, material)
        for name in bodies
        for length in _link_length(linkage, name)
    )


def _link_length(linkage: Linkage, body: str) -> Iterator[float]:
    """The distance of a body's two pins, if it is a link; else nothing."""
    pins = [pin for pin in linkage.pins.values() if body in (pin.first, pin.second)]
    held = [end for one in linkage.actuators.values() for end in (one.foot, one.head)]
    held += [end for one in linkage.slides.values() for end in (one.body, one.against)]
    if len(pins) == 2 and body not in held:
        yield math.dist(*(_point(pin, body) for pin in pins))


def _point(pin: PinPlace, body: str) -> tuple[float, float]:
    return pin.first_point if pin.first == body else pin.second_point
