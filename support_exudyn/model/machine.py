"""What the engine needs to know of a machine: bodies, pins and actuators in their start posture."""

import math
from abc import ABC, abstractmethod
from collections.abc import Collection, Mapping

from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.linkage import GROUND, Linkage
from support_exudyn.model.loads.load import ActingLoad
from support_exudyn.model.spatial_linkage import SpatialLinkage
from support_exudyn.model.to_space import Width, lift
from user_forces.backing import bar_stiffness, in_series
from user_forces.materials import Material
from user_forces.values.value import InputError, Value


class Machine(Value, ABC):
    """A machine is its dimensions and masses; it knows how to lay itself out as a linkage.

    It does not draw itself: pictures show plates around its joints, or the look that is registered for its
    class with `postprocessing.look.looks.look_of`.
    """

    @abstractmethod
    def linkage(self) -> Linkage:
        """The mechanism in its start posture."""

    @property
    def loads(self) -> Mapping[str, ActingLoad]:
        """What acts on it by its own making besides its weight, such as its springs, by name; here nothing.

        A scenario's own loads come on top, see `ScenarioData.acting_loads`.
        """
        return {}

    def widths(self) -> Width | None:
        """The machine's lateral dimensions; None if it is known in its plane only."""
        return None

    def in_space(self, linkage: Linkage) -> SpatialLinkage:
        """The mechanism in space, from that in the plane and the lateral dimensions.

        Raises InputError if there are none.
        """
        width = self.widths()
        if width is None:
            raise InputError(
                f"{type(self).__name__}: knows no lateral dimensions; allowed: machines with a Width"
            )
        return lift(linkage, width)

    @property
    def jacks(self) -> Mapping[str, str]:
        """Parts that can be bodies of their own, each with the name of the jack that locks it; here none."""
        return {}

    def detailed(self, actuators: Collection[str], parts: Collection[str]) -> Linkage:
        """The mechanism for a scenario that models more of it.

        Arguments:
            actuators: names of those that get a mass of their own: the parts that stand for it are left out.
            parts: names of those, among `jacks`, that are to be bodies with a hinge and a jack, which is a
                actuator that is not driven.

        By default the same as `linkage`. Raises InputError if the machine lacks data for it.
        """
        del actuators, parts
        return self.linkage()

    @property
    def leaders(self) -> Mapping[str, str]:
        """Driven parts that follow another unless a scenario says how they move, each with that; here none."""
        return {}

    def coupled_drive(self, name: str, lead: Drive, duration: float) -> Drive:
        """The drive of a part of `leaders` while what it follows is driven by `lead`, for so long [s].

        By default `lead` itself. Raises InputError if it cannot follow.
        """
        del name, duration
        return lead


# --- what a machine knows of its pins ---


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
