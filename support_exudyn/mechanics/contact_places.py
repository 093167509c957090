"""Where a linkage may make contact and part: journals in bores, corners in slots, falling blocks.

What integrates, records and judges contacts goes by these places, and does not ask of which kind they are. What
a contact did at the records follows from the motion of its bodies and what it remembers.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple, Protocol

import numpy as np

from support_exudyn.mechanics.body_motion import BodyMotion, Motion
from support_exudyn.mechanics.constraints import Shift, matrix
from support_exudyn.mechanics.kinetics import Matrix
from support_exudyn.mechanics.trajectory import ContactSeries, Series
from support_exudyn.model.guides import Guide, GuideContact
from support_exudyn.model.linkage import GROUND, Linkage, PinPlace, Slide
from support_exudyn.model.loads.falling_block import FallingBlock
from support_exudyn.model.pins import ClearancePin
from support_exudyn.model.plane_geometry import minus, plus, rotated
from support_exudyn.model.to_space import at
from user_forces.contact import SHALLOWEST, Contact
from user_forces.contact_state import PinMemory
from user_forces.values.value import Vector2

PLANE = np.eye(2)
PLAY = 1e-3  # [m] of a falling block, as of a pin


class HasValues(Protocol):
    """A channel of a run."""

    @property
    def values(self) -> Series:
        """Its values at the records (n,)."""


class RelativeMotion(NamedTuple):
    """A journal in its bore over time, shape (n,) each, SI, ground's axes.

    x, y, vx, vy: journal's centre minus bore's, and its rate. bore_spin, journal_spin: of their bodies.
    """

    x: Series
    y: Series
    vx: Series
    vy: Series
    bore_spin: Series
    journal_spin: Series


def series(contact: Contact, moving: RelativeMotion, memories: Series | Sequence[PinMemory]) -> ContactSeries:
    """The contact at every record from the journal's motion in its bore.

    memories: what the contact remembers at each record, PinMemory's fields (n, 6).
    """
    remembered = np.asarray(memories, dtype=np.float64)
    memory = dict(zip(PinMemory._fields, remembered.T, strict=True))
    closed = memory["in_contact"] > 0.5
    # the memory was taken at the same instant: no time has passed since
    now = memory["impact_velocity"], memory["deflection"], memory["slip"], np.zeros(closed.size)
    rows = np.column_stack([*moving, closed, *now])
    result, stored = contact.forces(rows)
    force: Any = result  # arrays in place of numbers
    return ContactSeries(
        force_x=force.force_x,
        force_y=force.force_y,
        normal_force=force.normal_force,
        friction_force=force.friction_force,
        depth=force.depth,
        slip=force.slip,
        impact_velocity=np.where(closed, memory["impact_velocity"], 0.0),
        eccentricity_x=moving.x,
        eccentricity_y=moving.y,
        stored=stored,
        deflection=force.deflection if contact.friction.has_state else None,
    )


def journal_arm(contact: Contact, depth: Series) -> Series:
    """Distance of the contact point from the journal's centre [m]."""
    return np.array([contact.bearing.contact_arms(d)[1] for d in depth.tolist()])


def contact_rate(motion: Motion, place: Any, axes: Matrix) -> Matrix:
    """The matrix of the eccentricity's rate, or of slip and depth in a slot, see `ContactPlace.rate`.

    place: a `ContactPlace`, or a section of a bearing in space, which has the same contact, bodies and points.
    """
    ends = place.bore, place.bore_point, place.journal, place.journal_point
    directions = [tuple(axis[: motion.SHIFTS].tolist()) for axis in axes.T[:2]]
    carrier = place.bore  # of the walls of a slot, whose turning moves them at the corner
    if not place.contact.bearing.is_slot:
        carrier = GROUND
        directions = [tuple(motion.carried(place.bore, axis)[0].tolist()) for axis in directions]
    rows = [Shift("", "", "across_1", *ends, axis, carrier) for axis in directions]
    return np.asarray(matrix(motion, rows)[0])


class ContactPlace(ABC):
    """A place at which two bodies may make contact.

    of: what of the scenario it belongs to, such as "pins.rear_base". contact: geometry and laws. bore, journal:
    names of the body that encloses, and of that which is enclosed. bore_point, journal_point: their centres in
    the start posture [m]; of a slot a point of its middle line, and the corner. play: by how much the journal
    can go either way [m].
    """

    of: str
    contact: Contact
    bore: str
    journal: str
    bore_point: Vector2
    journal_point: Vector2
    play: float

    @property
    @abstractmethod
    def stem(self) -> str:
        """What its channels begin with, such as "pin.rear_base"."""

    @abstractmethod
    def axes(self, linkage: Linkage) -> float:
        """Angle [rad] of the bore's axes in the start posture."""

    def rate(self, motion: Motion, axes: Matrix = PLANE) -> Matrix:
        """The matrix of the eccentricity's rate, or of slip and depth in a slot (2, freedoms).

        motion: of one instant. axes: along what, two directions of the start posture that turn with the bore,
        in columns.
        """
        return contact_rate(motion, self, axes)

    @abstractmethod
    def series(self, motion: Any, memories: Series | Sequence[PinMemory]) -> ContactSeries:
        """The contact at every record, with the memory that it has there."""

    def push(self, motion: Motion, contact: ContactSeries) -> tuple[Series, Series]:
        """Force of the bore on the journal [N], and the contact point at which it acts [m], (n, d) each."""
        x, y = contact.eccentricity_x, contact.eccentricity_y
        away = np.maximum(np.sqrt(x * x + y * y), SHALLOWEST)  # there is no force in the middle
        arm = journal_arm(self.contact, contact.depth) / away
        point = motion.place(self.journal, self.journal_point)
        vectors = np.zeros((2, point.shape[1], motion.count))
        vectors[:, :2] = (contact.force_x, contact.force_y), (arm * x, arm * y)
        return vectors[0].T, point + vectors[1].T

    @abstractmethod
    def depth(self, channels: Mapping[str, HasValues]) -> Series | None:
        """The depth (n,) [m] among the channels of a run; None if it is not there."""

    @abstractmethod
    def loads(self, reactions: Mapping[str, Series]) -> Series:
        """Force on the contact (2,) [N], from what constraints carry in its place, by pin or slide."""


@dataclass(frozen=True)
class PinContactPlace(ContactPlace):
    """A clearance pin."""

    name: str
    place: PinPlace
    pin: ClearancePin

    def __post_init__(self) -> None:
        """Tell bore and journal by the pin."""
        ends = [(self.place.first, self.place.first_point), (self.place.second, self.place.second_point)]
        bore, journal = ends if self.pin.bore == "first" else ends[::-1]
        known = {
            "of": f"pins.{self.name}",
            "contact": self.pin.contact,
            "play": self.pin.contact.bearing.clearance,
        }
        known |= {"bore": bore[0], "bore_point": bore[1], "journal": journal[0], "journal_point": journal[1]}
        for name, item in known.items():
            object.__setattr__(self, name, item)

    def axes(self, linkage: Linkage) -> float:
        """Those of the bore's body."""
        return 0.0 if self.bore == GROUND else linkage.bodies[self.bore].angle

    def series(self, motion: BodyMotion, memories: Series | Sequence[PinMemory]) -> ContactSeries:
        """The journal in its bore."""
        bore, journal = motion.point(self.bore, self.bore_point), motion.point(self.journal, self.journal_point)
        x, y = (journal.position - bore.position).T
        vx, vy = (journal.velocity - bore.velocity).T
        return series(self.contact, RelativeMotion(x, y, vx, vy, bore.spin, journal.spin), memories)

    @property
    def stem(self) -> str:
        """That of the pin."""
        return f"pin.{self.name}"

    def depth(self, channels: Mapping[str, HasValues]) -> Series | None:
        """That of the pin."""
        found = channels.get(f"{self.stem}.depth")
        return None if found is None else found.values

    def loads(self, reactions: Mapping[str, Series]) -> Series:
        """Force of the ideal pin."""
        return reactions[self.of]


@dataclass(frozen=True)
class GuideContactPlace(ContactPlace):
    """A corner of a block, or a round pin, in a guide with clearance."""

    name: str
    slide: Slide
    part: GuideContact
    play: float

    def __post_init__(self) -> None:
        """Tell corner and middle line by the slide."""
        slide, (point, middle, contact) = self.slide, self.part
        guide = self.name.rpartition(".")[0]
        known: dict[str, object] = {"of": f"guides.{guide}", "contact": contact}
        known |= {"bore": slide.against, "journal": slide.body}
        known["bore_point"] = plus(slide.point, rotated((0.0, middle), slide.direction))
        known["journal_point"] = plus(slide.point, rotated(point, slide.direction))
        for name, item in known.items():
            object.__setattr__(self, name, item)

    def axes(self, linkage: Linkage) -> float:
        """Along the guide and across."""
        del linkage
        return self.slide.direction

    def series(self, motion: Motion, memories: Series | Sequence[PinMemory]) -> ContactSeries:
        """The corner between the walls, in the ground's axes."""
        corner, origin = (
            motion.point(self.journal, self.journal_point),
            motion.point(self.bore, self.bore_point),
        )
        along, across = (motion.carried(self.bore, one) for one in self._directions(motion.SHIFTS))
        apart, rate = corner.position - origin.position, corner.velocity - origin.velocity
        x, y = _dot(apart, along), _dot(apart, across)
        # in space only blocks have such a contact, which do not turn
        spins = [one.spin if motion.SHIFTS == 2 else one.spin[:, 2] for one in (origin, corner)]
        rise = _dot(rate, across) - spins[0] * x
        moving = RelativeMotion(np.zeros_like(x), y, _dot(rate, along), rise, *spins)
        found = series(self.contact, moving, memories)
        force = found.force_x[:, None] * along + found.force_y[:, None] * across
        return replace(
            found,
            force_x=force[:, 0],
            force_y=force[:, 1],
            eccentricity_x=y * across[:, 0],
            eccentricity_y=y * across[:, 1],
        )

    @property
    def stem(self) -> str:
        """That of the corner."""
        return f"guide.{self.name}"

    def depth(self, channels: Mapping[str, HasValues]) -> Series | None:
        """A gap that is negative."""
        found = channels.get(f"{self.stem}.gap")
        return None if found is None else -found.values

    def loads(self, reactions: Mapping[str, Series]) -> Series:
        """Its part of the ideal guide's force and moment: two corners carry both."""
        force, moment = (*reactions[self.of], 0.0)[:2]
        arm = abs(self.part.point[0])
        share = abs(force) if arm == 0.0 else 0.5 * (abs(force) + abs(moment) / arm)
        across = np.array([-math.sin(self.slide.direction), math.cos(self.slide.direction)])
        return np.asarray(share * across)

    def _directions(self, dimensions: int) -> list[tuple[float, ...]]:
        """Of the guide and across it, start posture."""
        c, s = math.cos(self.slide.direction), math.sin(self.slide.direction)
        return [(c, s, 0.0)[:dimensions], (-s, c, 0.0)[:dimensions]]


@dataclass(frozen=True)
class BlockContactPlace(GuideContactPlace):
    """The face of a falling block, which a point of the machine may meet: a slot with one wall.

    The block is the bore. It has no play; that by which steps and errors go is the depth of its first blow, or
    PLAY if that is less.
    """

    @property
    def stem(self) -> str:
        """The block's name."""
        return self.name

    def __post_init__(self) -> None:
        """Tell of what load it is."""
        super().__post_init__()
        object.__setattr__(self, "of", f"loads.{self.name}")

    def loads(self, reactions: Mapping[str, Series]) -> Series:
        """Nothing: no joint stands in its place."""
        del reactions
        return np.zeros(2)

    def in_space(self, lateral: float) -> BlockContactPlace:
        """The same face, so far to the right [m]."""
        found = replace(self)
        for end in ("bore_point", "journal_point"):
            object.__setattr__(found, end, at(getattr(self, end), lateral))
        return found


def contact_places(
    linkage: Linkage, pins: Mapping[str, ClearancePin], guides: Mapping[str, Guide]
) -> dict[str, ContactPlace]:
    """All places by name: of pins, then of guides, as "guide.upper_left"."""
    found: dict[str, ContactPlace] = {n: PinContactPlace(n, linkage.pins[n], pin) for n, pin in pins.items()}
    return found | dict(_of_guides(linkage, guides))


def _of_guides(linkage: Linkage, guides: Mapping[str, Guide]) -> Iterator[tuple[str, ContactPlace]]:
    for name, guide in guides.items():
        for part, contact in guide.contacts().items():
            slide = linkage.slides[name]
            play = contact.contact.bearing.clearance - abs(contact.point[1])
            yield f"{name}.{part}", GuideContactPlace(f"{name}.{part}", slide, contact, play)


def _dot(one: Series, other: Series) -> Series:
    found: Series = np.einsum("ni,ni->n", one, other)
    return found


def block_places(blocks: Mapping[str, FallingBlock], gravity: Vector2) -> dict[str, BlockContactPlace]:
    """The faces of blocks by the blocks' names, under gravity [m/s^2]."""
    return {
        name: BlockContactPlace(
            name,
            Slide(body=block.body, point=block.reference, direction=block.slope, against=name),
            GuideContact(rotated(minus(block.point, block.reference), -block.slope), 0.0, block.contact),
            min(block.first_depth(gravity) or PLAY, PLAY),
        )
        for name, block in blocks.items()
    }
