"""What a channel is: its unit, its meaning, what of a run it needs, and how it follows from that.

Channels are known before a run, so that nothing is kept or computed that nobody asks for. `channel_table` has
those of all parts of a linkage, by name.
"""

from collections.abc import Callable, Collection, Iterable
from dataclasses import dataclass
from difflib import get_close_matches
from enum import Flag, auto
from fnmatch import fnmatchcase
from typing import Any

from support_exudyn.mechanics.observed_run import Trajectory
from support_exudyn.mechanics.trajectory import Series


class DataNeeds(Flag):
    """Parts of an `Trajectory`.

    JOINTS: forces of ideal pins, cranks, guides and rigid actuators; CONTACTS: clearance joints and others
    whose force follows from the motion; OIL: actuators on oil; INTEGRALS: work and losses so far, which have to
    be followed at every step; LOADS: what acts on the machine besides its weight.
    """

    NOTHING = 0
    POSITION = auto()
    VELOCITY = auto()
    ACCELERATION = auto()
    JOINTS = auto()
    CONTACTS = auto()
    OIL = auto()
    INTEGRALS = auto()
    LOADS = auto()


EVERYTHING = ~DataNeeds.NOTHING
MOTION = DataNeeds.POSITION | DataNeeds.VELOCITY
CONTACT = MOTION | DataNeeds.CONTACTS
OIL = MOTION | DataNeeds.OIL
LOADED = MOTION | DataNeeds.LOADS
FOLLOWING = DataNeeds.ACCELERATION | DataNeeds.JOINTS
ALL_CHANNELS = ("*",)  # the pattern that asks for everything


def with_causes(needed: DataNeeds) -> DataNeeds:
    """What has to be known for parts of a run: also what accelerations and reactions follow from."""
    return needed | CONTACT | OIL | LOADED if needed & FOLLOWING else needed


@dataclass(frozen=True)
class ChannelDefinition:
    """A channel before its run: unit, meaning, the parts of a run it needs, and its values (n,) from these.

    vector: of a magnitude the components (n, d), which have no kinks where it has them; else None.
    """

    unit: str
    meaning: str
    needs: DataNeeds
    values: Callable[[Trajectory], Series]
    vector: Callable[[Trajectory], Series] | None = None


ChannelDefinitions = dict[str, ChannelDefinition]
Row = tuple[str, str, str, Callable[[Any], Series]]


def table(
    prefix: str, needs: DataNeeds, source: Callable[[Any], Any], rows: Iterable[Row]
) -> ChannelDefinitions:
    """Channels of a part of a run, "PREFIX.NAME".

    Arguments:
        prefix: what their names begin with.
        needs: what all of them need.
        source: gives the part of a run, such as a contact.
        rows: name, unit, meaning, and what gives the values (n,) from that part.
    """
    return {
        f"{prefix}.{name}": ChannelDefinition(unit, meaning, needs, lambda run, of=of: of(source(run)))  # type: ignore[misc]
        for name, unit, meaning, of in rows
    }


def named(field: str, name: str) -> Callable[[Any], Any]:
    """What gives the part of this name among those of a field of a run."""
    return lambda run: getattr(run, field)[name]


def chosen(names: Iterable[str], patterns: Iterable[str]) -> list[str]:
    """Time, and the names that a pattern matches, in their order."""
    if patterns == ALL_CHANNELS:
        return list(names)
    return [name for name in names if name == "time" or any(fnmatchcase(name, p) for p in patterns)]


def check_patterns(names: Collection[str], patterns: Iterable[str]) -> None:
    """Raise ValueError for a pattern that matches none of the names."""
    for pattern in patterns:
        if not any(fnmatchcase(name, pattern) for name in names):
            near = get_close_matches(pattern, names, 3, 0.4) or list(names)[1:4]
            raise ValueError(
                f"channels = {pattern!r}: matches no channel; allowed: names of channels, or patterns of them "
                f"such as 'pin.*', among them {', '.join(near)}"
            )
