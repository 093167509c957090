"""What a shield support looks like: proportions of a real one about the pivots of the machine."""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial

import numpy as np
from shapely.geometry import MultiPolygon, Point, Polygon, box
from shapely.ops import unary_union
from trimesh import Trimesh

from support_exudyn.machines.four_bar_shield import FourBarShield
from support_exudyn.machines.shield_layout import TAIL
from support_exudyn.model.actuators import CylinderAndRod
from support_exudyn.model.linkage import GROUND, LinearActuator, lumped
from support_exudyn.model.plane_geometry import minus, moved, parts_of
from support_exudyn.model.to_space import LEFT, RIGHT, SIDES, at
from support_exudyn.postprocessing.look.plain import blocks
from support_exudyn.postprocessing.look.poses import planar_pins
from support_exudyn.postprocessing.look.shapes import ROUND, bar, cylinder_and_rod, plate, together, tube
from support_exudyn.postprocessing.look.shield_sizes import Sizes, sizes, standing
from support_exudyn.postprocessing.look.solid import DrawnActuator, Look, Role, Solid
from support_exudyn.postprocessing.look.springs import springs
from support_exudyn.scenario.scenario import Scenario
from user_forces.values.value import Vector2

UNDER = 0.043  # floor under the lowest point of the base, of the machine's extent
RAM = 0.6  # radius of a stabilising ram, of that of a column on the base
PROUD = 0.4  # by how much pins stand out of their plates, of a plate's thickness


def look(scenario: Scenario) -> Look:
    """The look of a scenario whose machine is a shield support, of any size.

    Pivots, and widths where the machine knows them, are those of the machine; plates, eyes and the like follow
    from their distances. Cylinders and rods fit the stroke of the scenario's drives.
    """
    return _Support(scenario).look()


class _Support:
    """Makes the parts of one support, start posture."""

    def __init__(self, scenario: Scenario) -> None:
        self.scenario = scenario
        self.sizes: Sizes = sizes(scenario)
        linkage = scenario.linkage
        self.on_first: dict[str, Vector2] = {name: pin.first_point for name, pin in linkage.pins.items()}
        self.on_second: dict[str, Vector2] = {name: pin.second_point for name, pin in linkage.pins.items()}
        self.columns = {name: column for name, column in linkage.actuators.items() if column.driven}
        self.jacks = {name: column for name, column in linkage.actuators.items() if not column.driven}
        self.standing = standing(scenario)  # on the base
        feet = [self.columns[name].foot_point for name in self.standing]
        lowest = min(y for _, y in (*feet, self.on_first["rear_base"], self.on_first["front_base"]))
        self.floor = lowest - UNDER * self.sizes.length

    def _beside(self, name: str) -> float:
        """Half the distance of both columns of a pair [m]."""
        width = self.scenario.machine.widths()
        return (width.actuators.get(name) if width else None) or self.sizes.columns

    def look(self) -> Look:
        """All of it."""
        solids = [
            Solid("base", GROUND, Role.BASE, self._base()),
            Solid("rear_link", "rear_link", Role.LINK, self._rear_link()),
            *self._front_links(),
            Solid("shield", "shield", Role.SHIELD, self._shield()),
            Solid("canopy", "canopy", Role.CANOPY, self._canopy()),
            *self._tail(),
            *self._pins(),
            *blocks(self.scenario),
        ]
        struts: list[DrawnActuator] = springs(self.scenario, self.sizes.column)
        for name, column in {**self.columns, **self.jacks}.items():
            if isinstance(self.scenario.actuators.get(name), CylinderAndRod):
                solids.extend(self._column_bodies(name, column))
            else:
                struts.extend(self._struts(name, column))
        return Look(tuple(solids), tuple(struts), self.floor)

    # --- bodies ---

    def _base(self) -> Trimesh:
        """Two skids, a bridge between them, plates that carry the links, and sockets of the columns."""
        s, floor = self.sizes, self.floor
        rear, front = self.on_first["rear_base"], self.on_first["front_base"]
        feet = {name: self.columns[name].foot_point for name in self.standing}
        top = floor + 0.85 * (min(y for _, y in feet.values()) - floor)
        left = min(rear[0], front[0], *(x for x, _ in feet.values())) - 2.4 * s.eye
        right = max(rear[0], front[0], *(x for x, _ in feet.values())) + 2.6 * s.column
        high = top - floor
        skid = Polygon(
            [
                (left, floor + 0.25 * high), (left + 0.4 * high, floor), (right - 0.8 * high, floor),
                (right, floor + 0.55 * high), (right, floor + 0.85 * high), (right - 0.3 * high, top),
                (left, top),
            ]
        )  # fmt: skip
        wide = s.base - 0.35 * max(s.columns - s.column, 0.2 * s.base)
        bridge = box(left + 0.2 * high, floor + 0.3 * high, max(rear[0], front[0]) + s.eye, top)
        ends = [(min(rear[0], front[0]) - 1.6 * s.eye, top), (max(rear[0], front[0]) + 2.2 * s.eye, top)]
        bracket = _round([(rear, 1.15 * s.eye), (front, 1.15 * s.eye), *((end, 0.3 * high) for end in ends)])
        parts = [*_both(skid, s.base - 0.5 * wide, wide), plate(bridge, 0.0, 2.0 * (s.base - 0.5 * wide))]
        parts += _both(bracket, s.bracket, s.plate)
        inner = s.front_links - 0.5 * s.front_link - (0.5 + 0.1) * s.plate
        if inner > 0.5 * s.plate:  # the other plate of the front links' clevis
            clevis = _round([(front, 1.15 * s.eye), ((front[0], top), s.eye)])
            parts += _both(clevis, inner, s.plate)
        for name, (x, y) in feet.items():
            for side in SIDES.values():
                z = side * self._beside(name)
                parts.append(tube((x, 0.5 * (floor + top), z), (x, y + 0.1 * s.column, z), 1.3 * s.column))
        return together(parts)

    def _rear_link(self) -> Trimesh:
        """Two beams with eyes, and a plate between them."""
        s, a, b = self.sizes, self.on_second["rear_base"], self.on_first["rear_shield"]
        cheeks = bar(a, b, s.eye)
        web = bar(_between(a, b, 0.22), _between(a, b, 0.78), 0.7 * s.eye)
        wide = 0.3 * s.rear_link
        beams = _both(cheeks, 0.5 * (s.rear_link - wide), wide)
        return together([*beams, plate(web, 0.0, s.rear_link - wide)])

    def _front_links(self) -> Iterator[Solid]:
        """Two bars, each with bosses about its pins."""
        s, a, b = self.sizes, self.on_second["front_base"], self.on_first["front_shield"]
        link = _union([bar(a, b, 0.72 * s.eye), _round([(a, s.eye)]), _round([(b, s.eye)])])
        pair = self.sizes.front_links
        yield from self._of_pair("front_link", Role.LINK, lambda z: plate(link, z, s.front_link), pair)

    def _shield(self) -> Trimesh:
        """Side plates about the three pins, a cover towards the goaf, and a box in between."""
        s = self.sizes
        rear, front = self.on_second["rear_shield"], self.on_second["front_shield"]
        hinge = self.on_first["shield_canopy"]
        back = _across(rear, hinge)
        low = _off(rear, back, 1.2 * s.eye)
        high = _off(_between(rear, hinge, 0.8), back, 1.2 * s.eye)
        eyes = [(rear, 1.1 * s.eye), (front, 1.1 * s.eye), (hinge, 1.1 * s.eye)]
        cheek = _round([*eyes, (low, 0.4 * s.eye), (high, 0.4 * s.eye)])
        beam = bar(_between(rear, hinge, 0.5), _between(rear, hinge, 0.86), 0.75 * s.eye)
        inside = 2.0 * s.cheek - 0.5 * s.plate
        covers = [plate(bar(low, high, 0.4 * s.eye), 0.0, inside), plate(beam, 0.0, inside)]
        return together([*_both(cheek, s.cheek, s.plate), *self._lugs(rear, hinge), *covers])

    def _lugs(self, rear: Vector2, hinge: Vector2) -> list[Trimesh]:
        """Plates of the shield beam that carry the feet of rams, on both sides of each."""
        s, found = self.sizes, []
        for name, column in self.columns.items():
            if name in self.standing:
                continue
            share, _ = parts_of(minus(column.foot_point, rear), minus(hinge, rear))
            root = _between(rear, hinge, min(0.9, max(0.1, share)))
            lug = _round([(column.foot_point, 0.7 * s.eye), (root, 1.4 * s.eye)])
            for side in SIDES.values():
                for apart in (-1.0, 1.0):
                    z = side * self._beside(name) + apart * (self._radius(name) + 0.7 * s.plate)
                    found.append(plate(lug, z, s.plate))
        return found

    def _canopy(self) -> Trimesh:
        """A flat box that tapers to the tip, with sockets of the columns and lugs of the hinge under it."""
        s, hinge = self.sizes, self.on_second["shield_canopy"]
        pairs = {name: column.head_point for name, column in self.columns.items()}
        heads = list(pairs.values())
        tip = self.scenario.linkage.points["tip"].point
        top = canopy_top(self.scenario)
        highest = max(hinge[1], *(y for _, y in heads))
        bottom = max(highest + 0.35 * s.eye, top - 2.4 * s.eye)
        high = top - bottom
        rear = min(hinge[0], *(x for x, _ in heads)) - 2.2 * s.eye
        last = max(hinge[0], *(x for x, _ in heads)) + 1.8 * s.column
        front = max(tip[0], last + s.eye)
        beam = Polygon(
            [
                (rear, top), (front, top), (front, top - 0.35 * high), (last + 0.35 * (front - last), bottom),
                (rear + high, bottom), (rear, top - 0.5 * high),
            ]
        )  # fmt: skip
        rib = box(rear + 1.4 * high, bottom - 0.45 * s.eye, last, bottom + 0.3 * high)
        parts = [plate(beam, 0.0, 2.0 * s.roof), plate(rib, 0.0, 1.1 * s.columns)]
        lug = _round([(hinge, s.eye), ((hinge[0] - 0.3 * s.eye, bottom + 0.2 * high), 1.1 * s.eye)])
        lug = lug.intersection(box(rear - s.eye, hinge[1] - 2.0 * s.eye, front, top - 0.2 * high))
        for inset in (1.3, 5.0):
            parts += _both(lug, s.cheek - inset * s.plate, s.plate)
        for name, (x, y) in pairs.items():
            for side in SIDES.values():
                z = side * self._beside(name)
                parts.append(tube((x, y + 0.25 * s.column, z), (x, bottom + 0.2 * high, z), 1.15 * s.column))
        return together(parts)

    def _tail(self) -> Iterator[Solid]:
        """The tail beam, hanging from the lower end of the shield beam; nothing if the machine has none."""
        machine, linkage = self.scenario.machine, self.scenario.linkage
        assert isinstance(machine, FourBarShield)  # whose look this is
        if TAIL in linkage.bodies:
            near, centre = self.on_second["shield_tail"], linkage.bodies[TAIL].centre
            yield Solid(TAIL, TAIL, Role.TAIL, self._beam(near, centre))
            return
        tail = [part for part in machine.parts["shield"] if part.name == TAIL]
        if not tail:
            return
        start, rear = machine.start(), self.on_second["rear_shield"]

        def at_start(point: Vector2) -> Vector2:
            """Where a point of the shield beam is, also with journals that start out of the middle."""
            return moved(point, machine.rear_shield, rear, start.shield)

        hinge, centre = machine.tail_hinge or machine.rear_shield, lumped(tail).centre
        yield Solid(TAIL, "shield", Role.TAIL, self._beam(at_start(hinge), at_start(centre)))

    def _beam(self, near: Vector2, centre: Vector2) -> Trimesh:
        """A tail beam from its hinge, with its centre of mass in the middle."""
        s = self.sizes
        far = (2.0 * centre[0] - near[0], 2.0 * centre[1] - near[1])
        back = _across(far, near)
        low, high = _off(far, back, 0.5 * s.eye), _off(near, back, 0.9 * s.eye)
        cheek = _round([(near, 0.8 * s.eye), (far, 0.35 * s.eye), (low, 0.3 * s.eye), (high, 0.35 * s.eye)])
        cover = bar(low, high, 0.3 * s.eye)
        z = s.cheek - (1.0 + 0.2) * s.plate  # between those of the shield beam
        return together([*_both(cheek, z, s.plate), plate(cover, 0.0, 2.0 * z)])

    # --- pins ---

    def _pins(self) -> Iterator[Solid]:
        """Round pins through their plates, each on the body that has the journal."""
        s = self.sizes
        out = 0.5 * s.plate + PROUD * s.plate
        reach = {"rear_base": s.bracket, "front_base": s.bracket}
        for name, pin in planar_pins(self.scenario).items():
            if name.endswith(("_foot", "_head")):
                continue  # balls
            body, centre = pin.journal.body, pin.journal.point[:2]
            end = reach.get(name, s.cheek) + out
            if body == "front_link":
                inner = s.front_links - 0.5 * s.front_link - 1.2 * s.plate
                short = partial(_short_pin, centre, inner, end, s.pin)
                yield from self._of_pair(body, Role.PIN, short, s.front_links, f"pin_{name}")
            else:
                yield Solid(f"pin_{name}", body, Role.PIN, _rod(centre, -end, end, s.pin))

    # --- columns ---

    def _stroke(self, name: str, column: LinearActuator) -> tuple[float, float]:
        """The shortest and the longest that it becomes [m], as its drive says."""
        space = self.scenario.dimensions == 3
        drives = [
            self.scenario.drive_of(one)
            for one in (self.scenario.space.parts_of_actuator(name) if space else (name,))
        ]
        spans = [drive.span(self.scenario.duration) for drive in drives]
        start = column.start_length
        return start + min(low for low, _ in spans), start + max(high for _, high in spans)

    def _meshes(self, name: str, column: LinearActuator) -> tuple[Trimesh, Trimesh]:
        shortest, longest = self._stroke(name, column)
        radius = self._radius(name) if column.driven else min(0.4 * self.sizes.column, 0.1 * shortest)
        return cylinder_and_rod(shortest, longest, radius)

    def _radius(self, name: str) -> float:
        """The radius of a cylinder [m]; a ram's is smaller than that of a column on the base."""
        return self.sizes.column if name in self.standing else RAM * self.sizes.column

    def _struts(self, name: str, column: LinearActuator) -> Iterator[DrawnActuator]:
        """Both columns of a pair, or the jack in the middle."""
        cylinder, rod = self._meshes(name, column)
        sides = SIDES.items() if column.driven else (("", 0.0),)
        for side, sign in sides:
            z = sign * self._beside(name)
            foot, head = at(column.foot_point, z), at(column.head_point, z)
            label = f"{name}_{side}" if side else name
            yield DrawnActuator(label, column.foot, column.head, foot, head, cylinder, rod)

    def _column_bodies(self, name: str, column: LinearActuator) -> Iterator[Solid]:
        """The shapes of a column without mass, on the bodies that this one is made of."""
        cylinder, rod = self._meshes(name, column)
        for body, role, mesh, end in (
            (f"{name}_cylinder", Role.CYLINDER, cylinder, column.foot_point),
            (f"{name}_rod", Role.ROD, rod, column.head_point),
        ):
            yield from self._of_pair(body, role, partial(_placed, mesh, column, end), self._beside(name))

    # --- bodies that there are two of ---

    def _of_pair(
        self, body: str, role: Role, mesh: Callable[[float], Trimesh], apart: float, name: str = ""
    ) -> Iterator[Solid]:
        """One body with two surfaces in the plane, two bodies in space; mesh: by where it stands beside it."""
        name = name or body
        if self.scenario.dimensions == 3 and f"{body}_{LEFT}" in self.scenario.space.bodies:
            for side in (LEFT, RIGHT):
                yield Solid(f"{name}_{side}", f"{body}_{side}", role, mesh(SIDES[side] * apart))
            return
        yield Solid(name, body, role, together(mesh(sign * apart) for sign in SIDES.values()))


def canopy_top(scenario: Scenario) -> float:
    """Height of the canopy's upper face in the start posture, where it is level [m]."""
    linkage, s = scenario.linkage, sizes(scenario)
    heads = [column.head_point for column in linkage.actuators.values() if column.driven]
    highest = max(linkage.pins["shield_canopy"].second_point[1], *(y for _, y in heads))
    return max(linkage.points["tip"].point[1], highest + 1.5 * s.eye)


def _placed(mesh: Trimesh, column: LinearActuator, end: Vector2, z: float) -> Trimesh:
    """A surface along a column from one of its ends, where it stands beside the plane."""
    (x, y), (u, v) = column.foot_point, column.head_point
    length = math.hypot(u - x, v - y)
    c, s = (u - x) / length, (v - y) / length
    placed: Trimesh = mesh.copy()
    placed.apply_transform(
        np.array([[c, -s, 0.0, end[0]], [s, c, 0.0, end[1]], [0.0, 0.0, 1.0, z], [0.0, 0.0, 0.0, 1.0]])
    )
    return placed


def _both(outline: Polygon, z: float, thickness: float) -> list[Trimesh]:
    """Two plates of an outline, one on either side of the plane at a distance of it [m]."""
    return [plate(outline, side * z, thickness) for side in SIDES.values()]


def _short_pin(centre: Vector2, inner: float, end: float, radius: float, z: float) -> Trimesh:
    """A pin through one front link and the plates beside it, by where this stands."""
    return _rod(centre, math.copysign(inner, z), math.copysign(end, z), radius)


def _rod(centre: Vector2, first: float, last: float, radius: float) -> Trimesh:
    """A pin across the plane."""
    return tube(at(centre, first), at(centre, last), radius)


def _round(circles: Sequence[tuple[Vector2, float]]) -> Polygon:
    """The hull of circles."""
    return _union([Point(centre).buffer(radius, quad_segs=ROUND) for centre, radius in circles]).convex_hull


def _union(outlines: Iterable[Polygon]) -> Polygon:
    """Outlines that may overlap, as one; of several that do not, their hull."""
    whole = unary_union(list(outlines))
    return whole.convex_hull if isinstance(whole, MultiPolygon) else whole


def _between(a: Vector2, b: Vector2, share: float) -> Vector2:
    """A point on the way from a to b."""
    return a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])


def _across(a: Vector2, b: Vector2) -> Vector2:
    """Unit vector at right angles to the way from a to b, to its left."""
    length = math.dist(a, b) or 1.0
    return -(b[1] - a[1]) / length, (b[0] - a[0]) / length


def _off(point: Vector2, along: Vector2, distance: float) -> Vector2:
    """A point moved along a unit vector."""
    return point[0] + distance * along[0], point[1] + distance * along[1]
