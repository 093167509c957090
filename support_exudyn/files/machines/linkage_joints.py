"""What joins and moves the bodies of linkages in files: pins, guides, gears, actuators, cranks."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated

from pydantic import Field

from support_exudyn.files.machines.linkage_bodies import DrawnBody
from support_exudyn.files.machines.parts import ColumnData, check_known
from support_exudyn.model.actuators import CylinderAndRod
from support_exudyn.model.linkage import GROUND, Gear, LinearActuator, PinPlace, Slide
from support_exudyn.model.plane_geometry import direction
from user_forces.values.units import Kilograms, Metres, Radians
from user_forces.values.value import InputError, Positive, Real, Value, Vector2, value

MASSES = ("cylinder_mass", "cylinder_length", "rod_mass", "rod_length")
Flag = Annotated[bool, Field(strict=True)]


@value
class LinkagePinData(Value):
    """A pin of a linkage that does not have the name of its point.

    Arguments:
        at: name of the point.
        bodies: first and second body, one of them may be "ground"; the pin force is that of the first on the
            second.
    """

    at: str
    bodies: tuple[str, str]


@value
class LinkageGuideData(Value):
    """A straight guide of a linkage: a block, or a point of a body, slides along a line of another body.

    Arguments:
        body: what slides.
        at: the point of it that stays on the line.
        on: the body that carries the line, or "ground".
        along: two points of that body, between which the line goes; of a slot these are its ends, at which a
            run is refused.
        through: a point of that body through which the line goes; where `at` is drawn if nothing is said.
        direction: of the line [rad], from +x of the frame of that body, which is the drawing's unless it has
            one of its own; 0 if nothing is said.
        turns: whether the body may turn about the point, as a pin does in a slot; a block does not.
        block: its length along and height across the guide [m], > 0, around the point; for clearance.
    """

    body: str
    at: str
    on: str = GROUND
    along: tuple[str, str] | None = None
    through: str | None = None
    direction: Radians[Real] | None = None
    turns: Flag = False
    block: Metres[tuple[Positive, Positive]] | None = None


@value
class LinkageGearData(Value):
    """A pair of gears, or a belt: the second body turns by `ratio` times what the first does.

    Arguments:
        bodies: first and second, which pins or guides hold in their places.
        ratio: [-], not 0; negative for gears that mesh outside, 1 for equal angles.
        carrier: the body that carries both axes, against which the turns count; by default the body, or the
            ground, on which pins hold both wheels.
    """

    bodies: tuple[str, str]
    ratio: Real = 1.0
    carrier: str | None = None


@value
class LinkageActuatorData(Value):
    """A linear actuator of a linkage; with masses for scenarios that model it as two bodies.

    Arguments:
        bodies: on which foot and head stand, one of them may be "ground".
        at: the points where they do.
        driven: whether it follows a drive; one that does not keeps its length.
        cylinder_mass, rod_mass: [kg], > 0; all four or none of the masses and lengths.
        cylinder_length, rod_length: of uniform bars from foot and head on [m], > 0.
    """

    bodies: tuple[str, str]
    at: tuple[str, str]
    driven: Flag = True
    cylinder_mass: Kilograms[Positive] | None = None
    cylinder_length: Metres[Positive] | None = None
    rod_mass: Kilograms[Positive] | None = None
    rod_length: Metres[Positive] | None = None

    def column(self, where: str) -> CylinderAndRod | None:
        """The actuator as two bodies; None without masses. Raises InputError if some of them are missing."""
        given = {name: getattr(self, name) for name in MASSES if getattr(self, name) is not None}
        if missing := [name for name in MASSES if given and name not in given]:
            key = f"{missing[0]}_{'kg' if 'mass' in missing[0] else 'mm'}"
            raise InputError(f"{where}.{key}: missing; allowed: masses and lengths of both, or none")
        return ColumnData(**given).column() if given else None


class DrawnPoints:
    """Points of bodies by name, in the drawing.

    Arguments:
        bodies: by name. drawn: points of the drawing [m], by name, among them those of the ground.
    """

    def __init__(self, bodies: Mapping[str, DrawnBody], drawn: Mapping[str, Vector2]) -> None:
        self.bodies, self.drawn = bodies, drawn

    def body(self, name: str, where: str) -> str:
        """The name of a body. Raises InputError if there is none; where: what asks, in the file."""
        check_known(where, name, (GROUND, *self.bodies), "there is no such body")
        return name

    def moving(self, name: str, where: str) -> str:
        """The name of a body that is not the ground."""
        check_known(where, name, self.bodies, "no moving body")
        return name

    def place(self, body: str, point: str, where: str) -> Vector2:
        """Where a point of a body lies in the drawing [m]."""
        if self.body(body, where) != GROUND:
            return self.bodies[body].place(point, self.drawn, where)
        check_known(where, point, self.drawn, "drawing_mm has no such point")
        return self.drawn[point]

    def pin(self, name: str, data: LinkagePinData | tuple[str, str]) -> PinPlace:
        """A pin; one that is a list of two bodies stands at the point of its name."""
        where = f"pins.{name}"
        if isinstance(data, LinkagePinData):
            bodies, at, key = data.bodies, data.at, f"{where}.at"
        else:
            bodies, at, key = data, name, where
        first, second = (self.body(one, where) for one in bodies)
        if first == second:
            raise InputError(f"{where} = {list(bodies)}: allowed: two different bodies")
        return PinPlace(
            first=first,
            second=second,
            first_point=self.place(first, at, key),
            second_point=self.place(second, at, key),
        )

    def guide(self, name: str, data: LinkageGuideData) -> tuple[Slide, Vector2]:
        """A guide, and a point through which its line goes in the drawing [m]."""
        where = f"guides.{name}"
        body, on = self.moving(data.body, f"{where}.body"), self.body(data.on, f"{where}.on")
        if body == on:
            raise InputError(f"{where}.on = {on!r}: is what slides; allowed: another body")
        point = self.place(body, data.at, f"{where}.at")
        for other in ("through", "direction"):
            if data.along is not None and getattr(data, other) is not None:
                raise InputError(f"{where}.along and {where}.{other}: allowed: one of them")
        ends = None
        if data.along is not None:
            first, second = data.along
            ends = self.place(on, first, f"{where}.along"), self.place(on, second, f"{where}.along")
            if ends[0] == ends[1]:
                raise InputError(f"{where}.along = {list(data.along)}: allowed: two points at different places")
            angle, origin = direction(*ends), ends[0]
        else:
            carrier = 0.0 if on == GROUND else self.bodies[on].angle
            angle = carrier + (data.direction or 0.0)
            drawn = self.drawn.get(data.at, point)
            origin = drawn if data.through is None else self.place(on, data.through, f"{where}.through")
        slide = Slide(body=body, point=point, direction=angle, against=on, turns=data.turns, ends=ends)
        return slide, origin

    def gear(self, name: str, data: LinkageGearData) -> Gear:
        """A pair of gears."""
        first, second = (self.moving(one, f"gears.{name}.bodies") for one in data.bodies)
        carrier = None if data.carrier is None else self.body(data.carrier, f"gears.{name}.carrier")
        return Gear(first=first, second=second, ratio=data.ratio, carrier=carrier)

    def actuator(self, name: str, data: LinkageActuatorData) -> LinearActuator:
        """An actuator."""
        where = f"actuators.{name}"
        foot, head = (self.body(one, f"{where}.bodies") for one in data.bodies)
        if foot == head:
            raise InputError(f"{where}.bodies = {list(data.bodies)}: allowed: two different bodies")
        ends = [self.place(body, at, f"{where}.at") for body, at in zip((foot, head), data.at, strict=True)]
        if ends[0] == ends[1]:
            raise InputError(f"{where}.at = {list(data.at)}: allowed: two points at different places")
        return LinearActuator(foot=foot, head=head, foot_point=ends[0], head_point=ends[1], driven=data.driven)
