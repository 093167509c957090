"""What a shield support looks like: boxes and plates around the pivots of the machine, columns with rods."""

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial

from shapely.geometry import Point, Polygon
from shapely.ops import unary_union
from trimesh import Trimesh

from support_exudyn.machines.four_bar_shield import FourBarShield
from support_exudyn.machines.shield_layout import TAIL
from support_exudyn.model.linkage import GROUND, lumped
from support_exudyn.model.plane_geometry import moved
from support_exudyn.model.to_space import SIDES, at, copies
from support_exudyn.postprocessing.look.plain import blocks, extent, springs
from support_exudyn.postprocessing.look.poses import planar_pins
from support_exudyn.postprocessing.look.shapes import (
    ROUND,
    Look,
    Role,
    Shape,
    Strut,
    bar,
    cylinder_and_rod,
    plate,
    together,
    tube,
)
from support_exudyn.scenario.scenario import Scenario
from user_forces.values.value import Vector2

UNDER = 0.043  # floor below the lowest pivot of the base, of the machine's extent
RAM = 0.6  # radius of a stabilising ram, of that of a column on the base


def look(scenario: Scenario) -> Look:
    """The look of a scenario whose machine is a shield support, of any size.

    Pivots, and distances of pairs where the machine knows them, are those of the machine; thicknesses and
    widths are shares of its extent. Cylinders and rods fit the stroke of the scenario's drives.
    """
    return _Support(scenario).look()


class _Support:
    """Makes the parts of one support, start posture."""

    def __init__(self, scenario: Scenario) -> None:
        self.scenario, linkage, machine = scenario, scenario.linkage, scenario.machine
        assert isinstance(machine, FourBarShield)  # whose look this is
        width = machine.widths()
        self.first: dict[str, Vector2] = {name: pin.first_point for name, pin in linkage.pins.items()}
        self.second: dict[str, Vector2] = {name: pin.second_point for name, pin in linkage.pins.items()}
        standing = [linkage.actuators[name] for name, one in machine.STRUTS.items() if one.foot[0] == GROUND]
        self.columns = {name: column for name, column in linkage.actuators.items() if column.driven}
        self.feet = [column.foot_point for column in standing]
        # half the distances of pairs, radii, and distances of plates from the plane of symmetry [m]
        self.apart = dict(width.actuators) if width else {}
        self.length = length = extent(linkage)
        self.usual_apart = next(iter(self.apart.values()), 0.077 * length)
        self.pair = (width.pairs.get("front_link") if width else None) or 0.1 * length
        bores = [pin.contact.bearing.bore_radius for pin in scenario.clearance_pins.values()]
        near = min(math.dist(self.second["rear_shield"], self.second["front_shield"]),
                   math.dist(self.first["rear_base"], self.first["front_base"]))  # fmt: skip
        self.eye = min(0.027 * length, 0.45 * max(near, 0.02 * length))
        self.pin = min(0.6 * self.eye, max(bores, default=math.inf))
        self.plate = 0.009 * length
        shortest = min(column.start_length for column in standing)
        aside = max(0.3 * math.dist(*self.feet), 0.03 * shortest) if len(standing) == 2 else math.inf
        self.column = min(0.085 * shortest, aside, 0.8 * self.usual_apart)
        self.bracket = max(self.pair + 0.015 * length, 0.0875 * length) + 0.6 * self.plate
        self.cheek = max(0.133 * length, self.bracket + 1.1 * self.plate)
        outside = self.usual_apart + 1.35 * self.column
        self.half_base = max(self.bracket + 0.5 * self.plate, outside)
        self.half_roof = max(0.1425 * length, self.cheek + 0.5 * self.plate, outside)
        pivots = (*self.feet, self.first["rear_base"], self.first["front_base"])
        self.floor = min(y for _, y in pivots) - UNDER * length

    def look(self) -> Look:
        """All of it."""
        link = bar(self.second["front_base"], self.first["front_shield"], 0.8 * self.eye)
        rear = bar(self.second["rear_base"], self.first["rear_shield"], self.eye)
        shapes = [
            Shape("base", GROUND, Role.BASE, self._base()),
            Shape("rear_link", "rear_link", Role.LINK, plate(rear, 0.0, 0.175 * self.length)),
            *self._of_pair("front_link", Role.LINK, lambda z: plate(link, z, 0.03 * self.length)),
            Shape("shield", "shield", Role.SHIELD, self._shield()),
            Shape("canopy", "canopy", Role.CANOPY, self._canopy()),
            *self._tail(),
            *self._pins(),
            *self._columns(),
            *blocks(self.scenario),
            *springs(self.scenario, self.column),
        ]
        return Look(tuple(shapes), self.floor)

    def _base(self) -> Trimesh:
        """A box on the floor, and plates that carry the links."""
        eye, floor, rear, front = self.eye, self.floor, self.first["rear_base"], self.first["front_base"]
        top = floor + 0.85 * (min(y for _, y in self.feet) - floor)
        places = [rear[0], front[0], *(x for x, _ in self.feet)]
        left, right, high = min(places) - 2.4 * eye, max(places) + 2.6 * self.column, top - floor
        skid = Polygon([
            (left, floor + 0.25 * high), (left + 0.4 * high, floor), (right - 0.8 * high, floor),
            (right, floor + 0.55 * high), (right, floor + 0.85 * high), (right - 0.3 * high, top), (left, top),
        ])  # fmt: skip
        ends = [(min(rear[0], front[0]) - 1.6 * eye, top), (max(rear[0], front[0]) + 2.2 * eye, top)]
        bracket = _round([(rear, 1.15 * eye), (front, 1.15 * eye), *((end, 0.3 * high) for end in ends)])
        return together([plate(skid, 0.0, 2.0 * self.half_base), *_both(bracket, self.bracket, self.plate)])

    def _shield(self) -> Trimesh:
        """Side plates around its pins and feet of rams, and a cover towards the goaf."""
        eye, rear, hinge = self.eye, self.second["rear_shield"], self.first["shield_canopy"]
        back, high = _across(rear, hinge), (0.2 * rear[0] + 0.8 * hinge[0], 0.2 * rear[1] + 0.8 * hinge[1])
        low, high = _off(rear, back, 1.2 * eye), _off(high, back, 1.2 * eye)
        rams = [ram.foot_point for ram in self.columns.values() if ram.foot_point not in self.feet]
        eyes = [(point, 1.1 * eye) for point in (rear, self.second["front_shield"], hinge, *rams)]
        cheek = _round([*eyes, (low, 0.4 * eye), (high, 0.4 * eye)])
        cover = plate(bar(low, high, 0.4 * eye), 0.0, 2.0 * self.cheek - 0.5 * self.plate)
        return together([*_both(cheek, self.cheek, self.plate), cover])

    def _canopy(self) -> Trimesh:
        """A flat box that tapers to the tip, with lugs of the hinge below it."""
        eye, hinge, tip = self.eye, self.second["shield_canopy"], self.scenario.linkage.points["tip"].point
        heads = [column.head_point for column in self.columns.values()]
        highest = max(hinge[1], *(y for _, y in heads))
        top = max(tip[1], highest + 1.5 * eye)
        bottom = max(highest + 0.35 * eye, top - 2.4 * eye)
        high, places = top - bottom, [hinge[0], *(x for x, _ in heads)]
        rear, last = min(places) - 2.2 * eye, max(places) + 1.8 * self.column
        front = max(tip[0], last + eye)
        beam = Polygon([
            (rear, top), (front, top), (front, top - 0.35 * high), (last + 0.35 * (front - last), bottom),
            (rear + high, bottom), (rear, top - 0.5 * high),
        ])  # fmt: skip
        lug = _round([(hinge, eye), ((hinge[0], bottom + 0.3 * high), 0.6 * eye)])
        lugs = _both(lug, self.cheek - 1.3 * self.plate, self.plate)
        return together([plate(beam, 0.0, 2.0 * self.half_roof), *lugs])

    def _tail(self) -> Iterator[Shape]:
        """The tail beam, from the lower end of the shield beam on; nothing if the machine has none."""
        machine, linkage = self.scenario.machine, self.scenario.linkage
        assert isinstance(machine, FourBarShield)
        if TAIL in linkage.bodies:
            yield Shape(
                TAIL, TAIL, Role.TAIL, self._beam(self.second["shield_tail"], linkage.bodies[TAIL].centre)
            )
        elif tail := [part for part in machine.parts["shield"] if part.name == TAIL]:
            start, rear = machine.start(), self.second["rear_shield"]
            hinge = machine.tail_hinge or machine.rear_shield
            # where the points are, also with journals that start out of the middle
            ends = (moved(end, machine.rear_shield, rear, start.shield) for end in (hinge, lumped(tail).centre))
            yield Shape(TAIL, "shield", Role.TAIL, self._beam(*ends))

    def _beam(self, near: Vector2, centre: Vector2) -> Trimesh:
        """A tail beam from its hinge, with its centre of mass in the middle."""
        eye, far = self.eye, (2.0 * centre[0] - near[0], 2.0 * centre[1] - near[1])
        back = _across(far, near)
        low, high = _off(far, back, 0.5 * eye), _off(near, back, 0.9 * eye)
        cheek = _round([(near, 0.8 * eye), (far, 0.35 * eye), (low, 0.3 * eye), (high, 0.35 * eye)])
        z = self.cheek - 1.2 * self.plate  # between those of the shield beam
        return together([*_both(cheek, z, self.plate), plate(bar(low, high, 0.3 * eye), 0.0, 2.0 * z)])

    def _pins(self) -> Iterator[Shape]:
        """Round pins through their plates, each on the body that has the journal."""
        for name, pin in planar_pins(self.scenario).items():
            if name.endswith(("_foot", "_head")):
                continue  # balls
            body, centre = pin.journal.body, pin.journal.point[:2]
            end = (self.bracket if name in ("rear_base", "front_base") else self.cheek) + 0.9 * self.plate
            if body == "front_link":
                short = partial(self._short_pin, centre, end)
                yield from self._of_pair(body, Role.PIN, short, f"pin_{name}")
            else:
                yield Shape(f"pin_{name}", body, Role.PIN, tube(at(centre, -end), at(centre, end), self.pin))

    def _short_pin(self, centre: Vector2, end: float, z: float) -> Trimesh:
        """A pin through one front link and the plates next to it, by the place of the link."""
        inner = self.pair - 0.015 * self.length - 1.2 * self.plate
        return tube(at(centre, math.copysign(inner, z)), at(centre, math.copysign(end, z)), self.pin)

    def _columns(self) -> Iterator[Shape]:
        """Both columns of each pair, and a jack in the middle; cylinder and rod as long as drives need them."""
        scenario = self.scenario
        for name, column in scenario.linkage.actuators.items():
            parts = scenario.space.parts_of_actuator(name) if scenario.dimensions == 3 else (name,)
            spans = [scenario.drive_of(one).span(scenario.duration) for one in parts]
            shortest = column.start_length + min(low for low, _ in spans)
            longest = column.start_length + max(high for _, high in spans)
            radius = self.column * (1.0 if column.foot_point in self.feet else RAM)
            if not column.driven:
                radius = min(0.4 * self.column, 0.1 * shortest)
            meshes = cylinder_and_rod(shortest, longest, radius)
            for side, z, _ in copies(self.apart.get(name, self.usual_apart) if column.driven else None):
                bodies = scenario.space.bodies if scenario.dimensions == 3 else {}
                foot, head = (end + side * (end + side in bodies) for end in (column.foot, column.head))
                ends = at(column.foot_point, z), at(column.head_point, z)
                yield from Strut(f"{name}{side}", foot, head, *ends).shapes(*meshes)

    def _of_pair(
        self, body: str, role: Role, mesh: Callable[[float], Trimesh], name: str = ""
    ) -> Iterator[Shape]:
        """A front link with two surfaces in the plane, two bodies in space; mesh: by its distance from it."""
        name, sides = name or body, copies(self.pair)
        if self.scenario.dimensions == 3 and body + sides[0][0] in self.scenario.space.bodies:
            yield from (Shape(name + side, body + side, role, mesh(z)) for side, z, _ in sides)
        else:
            yield Shape(name, body, role, together(mesh(z) for _, z, _ in sides))


def _both(outline: Polygon, z: float, thickness: float) -> list[Trimesh]:
    """Two plates of an outline, on both sides of the plane at a distance of it [m]."""
    return [plate(outline, side * z, thickness) for side in SIDES.values()]


def _round(circles: Sequence[tuple[Vector2, float]]) -> Polygon:
    """The hull of circles."""
    return unary_union([Point(c).buffer(radius, quad_segs=ROUND) for c, radius in circles]).convex_hull


def _across(a: Vector2, b: Vector2) -> Vector2:
    """Unit vector at right angles to the line from a to b, to its left."""
    length = math.dist(a, b) or 1.0
    return -(b[1] - a[1]) / length, (b[0] - a[0]) / length


def _off(point: Vector2, along: Vector2, distance: float) -> Vector2:
    """A point moved along a unit vector."""
    return point[0] + distance * along[0], point[1] + distance * along[1]
