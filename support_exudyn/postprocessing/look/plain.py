"""The look of machines without a look of their own: plates around the points at which bodies are joined."""

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from shapely.geometry import Polygon, box
from shapely.ops import unary_union
from trimesh import Trimesh

from support_exudyn.model.linkage import GROUND, Linkage, Slide
from support_exudyn.model.loads.springs import SpringDamper
from support_exudyn.model.to_space import at, copies, pairs_of
from support_exudyn.postprocessing.look.poses import joined_points, planar_pins
from support_exudyn.postprocessing.look.shapes import (
    Look,
    Role,
    Shape,
    Strut,
    axle,
    bar,
    bored,
    hull,
    plate,
    together,
    tube,
)
from support_exudyn.scenario.scenario import Scenario
from user_forces.values.value import Vector2

MARGIN = 0.03  # of plates around their points, of the machine's extent
THICKNESS = 0.05  # of plates, of the machine's extent
WALL = 1.3  # radius of an eye, of its bore's
RAIL = 0.45  # half the length of a guide's rail, of the machine's extent
BORE = 0.35  # radius of bores of unknown size, of the margin
CYLINDER = 0.6  # length of a cylinder, of the actuator at the start


def look(scenario: Scenario) -> Look:
    """The look of a scenario's machine, from its linkage alone.

    Where the machine knows no widths, its bodies lie one behind the other, the ground behind all, so that each
    is seen.
    """
    linkage = scenario.linkage
    points = body_points(linkage)
    for load in scenario.acting_loads.values():
        if isinstance(load, SpringDamper):
            for name, end in ((load.body, load.point), (load.other, load.other_point)):
                points.setdefault(name, []).append(end)
    size = extent(linkage)
    margin, thickness = MARGIN * size, THICKNESS * size
    known = scenario.machine.widths() is not None
    # how far behind the plane each body is drawn [m]
    layers = {name: 0.0 if known else -1.1 * n * thickness for n, name in enumerate((*linkage.bodies, GROUND))}
    shapes = []
    for name, around in points.items():
        pins = [pin for pin, place in linkage.pins.items() if name in (place.first, place.second)]
        wide = max([margin, *(WALL * bore_radius(scenario, pin, margin) for pin in pins)])
        outline = _outline(scenario, name, around, wide, size)
        for pin in planar_pins(scenario).values():
            if pin.bore.body == name:
                outline = bored(outline, pin.bore.point[:2], bore_radius(scenario, pin.name, margin))
        if name == GROUND:
            shapes.append(Shape(name, GROUND, Role.BASE, plate(outline, layers[name], 0.5 * thickness)))
            continue
        for body, heights in body_copies(scenario, name):
            mesh = together(plate(outline, z + layers[name], thickness) for z in heights)
            shapes.append(Shape(body, body, Role.BODY, mesh))
    shapes += _pins(scenario, layers, thickness, margin)
    lowest = min(y for around in points.values() for _, y in around)
    for name in linkage.actuators:
        shapes += _actuator(scenario, name, 0.5 * margin)
    return Look((*shapes, *springs(scenario, 0.6 * margin)), lowest - margin)


def _outline(scenario: Scenario, body: str, around: Sequence[Vector2], wide: float, size: float) -> Polygon:
    """A plate around the points of a body; a block if it slides on the ground, which has a rail for it."""
    slides = [one for one in scenario.linkage.slides.values() if one.against == GROUND]
    if body == GROUND:
        on_rails = {slide.point for slide in slides}
        rest = [point for point in around if point not in on_rails]
        parts = [hull(rest, wide)] if rest else []
        parts += [_along(slide, RAIL * size, 0.5 * wide) for slide in slides]
    else:
        parts = [
            hull(around, wide),
            *(_along(one, 2.0 * wide, 1.2 * wide) for one in slides if one.body == body),
        ]
    whole = unary_union(parts)
    if isinstance(whole, Polygon):
        return whole
    (x, y), *others = [(part.centroid.x, part.centroid.y) for part in parts]
    return unary_union([whole, *(bar((x, y), other, 0.35 * wide) for other in others)])  # in one piece


def _along(slide: Slide, half_length: float, half_width: float) -> Polygon:
    """A bar along a guide, about its point."""
    x, y = slide.point
    u, v = half_length * math.cos(slide.direction), half_length * math.sin(slide.direction)
    return bar((x - u, y - v), (x + u, y + v), half_width)


def _pins(scenario: Scenario, layers: Mapping[str, float], thickness: float, margin: float) -> Iterator[Shape]:
    """Journals, through both bodies and a little out of them, on the body without the bore."""
    for name, pin in planar_pins(scenario).items():
        body, centre, loose = pin.journal.body, pin.journal.point[:2], pin.with_clearance
        radius = 0.97 * bore_radius(scenario, name, margin)
        if loose is not None:
            radius = loose.contact.bearing.journal_radius
        ends = [layers[pin.first.body], layers[pin.second.body]]
        near, far = min(ends) - 0.5 * thickness, max(ends) + 0.6 * thickness
        for one, heights in [(GROUND, [0.0])] if body == GROUND else body_copies(scenario, body):
            mesh = together(tube(at(centre, z + near), at(centre, z + far), radius) for z in heights)
            yield Shape(f"pin_{name}{one.removeprefix(body)}", one, Role.PIN, mesh)


def _actuator(scenario: Scenario, name: str, radius: float) -> Iterator[Shape]:
    """An actuator as cylinder and rod; radius: of the cylinder [m]."""
    actuator, width = scenario.linkage.actuators[name], scenario.machine.widths()
    pairs = _pairs(scenario)
    meshes = _telescope(math.dist(actuator.foot_point, actuator.head_point), radius)
    for side, z, _ in copies(width.actuators.get(name) if width else None):
        part = side if scenario.dimensions == 3 else ""
        foot, head = (body + part * (body in pairs) for body in (actuator.foot, actuator.head))
        strut = Strut(name + side, foot, head, at(actuator.foot_point, z), at(actuator.head_point, z))
        yield from strut.shapes(*meshes)


def body_points(linkage: Linkage) -> dict[str, list[Vector2]]:
    """The centre of every body, and its points, and the ground's, at which something is joined or traced."""
    points = joined_points(linkage)
    for slide in linkage.slides.values():
        points[slide.against].append(slide.point)
    for name, body in linkage.bodies.items():
        points[name].append(body.centre)
    return {name: around for name, around in points.items() if around}


def extent(linkage: Linkage) -> float:
    """The longest side of the box around all points of a linkage [m]; 1 if there is but one."""
    points = np.array([point for around in body_points(linkage).values() for point in around])
    return float(np.ptp(points, axis=0).max()) or 1.0


def bore_radius(scenario: Scenario, pin: str, margin: float) -> float:
    """The radius of a pin's bore [m], as far as the scenario knows it."""
    loose, ideal = scenario.clearance_pins.get(pin), scenario.friction_pins.get(pin)
    if loose is not None:
        return loose.contact.bearing.bore_radius
    return ideal.radius if ideal is not None and ideal.radius is not None else BORE * margin


def body_copies(scenario: Scenario, name: str) -> list[tuple[str, list[float]]]:
    """The names by which channels know a body of the plane, each with its distances from the plane [m].

    In the plane a pair has one name and two places; in space two names.
    """
    sides = copies(_pairs(scenario).get(name))
    if scenario.dimensions == 3:
        return [(name + side, [z]) for side, z, _ in sides]
    return [(name, [z for _, z, _ in sides])]


def _pairs(scenario: Scenario) -> Mapping[str, float]:
    """Half the distance of bodies that there are two of [m]."""
    width = scenario.machine.widths()
    return {} if width is None else pairs_of(scenario.linkage, width)


# --- springs, falling blocks ---


def springs(scenario: Scenario, radius: float) -> Iterator[Shape]:
    """Each spring and damper between two points, as cylinder and rod; radius: of the cylinder [m]."""
    sides = 1.0 if scenario.dimensions == 3 else 0.0  # by which lateral places count
    for name, load in scenario.acting_loads.items():
        if isinstance(load, SpringDamper):
            foot, head = at(load.other_point, sides * load.other_lateral), at(load.point, sides * load.lateral)
            meshes = _telescope(math.dist(foot, head), radius)
            yield from Strut(name, load.other, load.body, foot, head).shapes(*meshes)


def _telescope(length: float, radius: float) -> tuple[Trimesh, Trimesh]:
    """Cylinder and rod of a strut of this length at the start [m], whose stroke is not known."""
    return axle(0.0, CYLINDER * length, radius), axle(-0.9 * length, 0.0, 0.5 * radius)


def blocks(scenario: Scenario) -> list[Shape]:
    """A cube for each falling block, of its mass and density, where it starts."""
    shapes = []
    for name, block in scenario.blocks.items():
        x, y = scenario.linkage.bodies[name].centre
        half = 0.5 * block.side
        aside = block.lateral if scenario.dimensions == 3 else 0.0
        mesh = plate(box(x - half, y - half, x + half, y + half), aside, block.side)
        shapes.append(Shape(name, name, Role.ROCK, mesh))
    return shapes
