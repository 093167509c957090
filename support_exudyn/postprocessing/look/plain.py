"""What a machine looks like that says no more of it: plates around the points at which bodies are joined."""

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from shapely.geometry import Polygon, box
from shapely.ops import unary_union

from support_exudyn.model.linkage import GROUND, LinearActuator, Linkage, Slide
from support_exudyn.model.loads.springs import SpringDamper
from support_exudyn.model.to_space import at, copies
from support_exudyn.postprocessing.look.poses import named_ends, planar_pins
from support_exudyn.postprocessing.look.shapes import bar, bored, hull, plate, together, tube
from support_exudyn.postprocessing.look.slots import sliding_block, slot_walls
from support_exudyn.postprocessing.look.solid import DrawnActuator, Look, Role, Solid
from support_exudyn.postprocessing.look.springs import springs
from support_exudyn.scenario.scenario import Scenario
from user_forces.values.value import Vector2

MARGIN = 0.03  # of plates around their points, of the machine's extent
THICKNESS = 0.05  # of plates, of the machine's extent
WALL = 1.3  # radius of an eye, of its bore's
RAIL = 0.45  # half the length of a guide's rail, of the machine's extent
BORE = 0.35  # radius of bores where nobody says it, of the margin
CYLINDER = 0.6  # length of a cylinder, of the actuator at the start


def look(scenario: Scenario) -> Look:
    """The look of a scenario's machine, from its linkage alone.

    Where the machine knows no widths, its bodies lie one behind the other, the ground behind all, so that each
    is seen.
    """
    linkage = scenario.linkage
    points = joined_points(linkage)
    for load in scenario.acting_loads.values():
        if isinstance(load, SpringDamper):
            for name, end in ((load.body, load.point), (load.other, load.other_point)):
                points.setdefault(name, []).append(end)
    size = extent(linkage)
    margin, thickness = MARGIN * size, THICKNESS * size
    layers = _layers(scenario, 1.1 * thickness)
    solids = []
    for name, around in points.items():
        pins = [pin for pin, place in linkage.pins.items() if name in (place.first, place.second)]
        wide = max([margin, *(WALL * bore_radius(scenario, pin, margin) for pin in pins)])
        outline = _outline(scenario, name, around, wide, size)
        for pin in planar_pins(scenario).values():
            if pin.bore.body == name:
                outline = bored(outline, pin.bore.point[:2], bore_radius(scenario, pin.name, margin))
        if name == GROUND:
            solids.append(Solid(name, GROUND, Role.BASE, plate(outline, layers[name], 0.5 * thickness)))
            continue
        for body, heights in body_copies(scenario, name):
            mesh = together(plate(outline, z + layers[name], thickness) for z in heights)
            solids.append(Solid(body, body, Role.BODY, mesh))
    solids += _pins(scenario, layers, thickness, margin)
    lowest = min(y for around in points.values() for _, y in around)
    actuators = [strut for name in linkage.actuators for strut in _struts(scenario, name, 0.5 * margin)]
    struts = (*actuators, *springs(scenario, 0.6 * margin))
    return Look(tuple(solids), struts, lowest - margin)


def _layers(scenario: Scenario, apart: float) -> dict[str, float]:
    """How far behind the plane each body is drawn, by its name [m]."""
    names = [*scenario.linkage.bodies, GROUND]
    known = scenario.machine.widths() is not None
    return {name: 0.0 if known else -n * apart for n, name in enumerate(names)}


def _outline(scenario: Scenario, body: str, around: Sequence[Vector2], wide: float, size: float) -> Polygon:
    """A plate around the points of a body; a block if it slides on the ground, which has a rail for it."""
    slides, guides = scenario.linkage.slides, scenario.guides
    loose = {name: slides[name] for name, guide in guides.items() if not guide.holds}
    fixed = [slide for name, slide in slides.items() if name not in loose]
    carried = {name: slide for name, slide in loose.items() if slide.against == body}
    parts = [wall for name, one in carried.items() for wall in slot_walls(one, guides[name], 2.0 * RAIL * size)]
    if body == GROUND:
        rails = [one for one in fixed if one.against == GROUND]
        on_rails = {slide.point for slide in (*rails, *carried.values())}
        rest = [point for point in around if point not in on_rails]
        main = [hull(rest, wide)] if rest else []
        main += [_along(slide, RAIL * size, 0.5 * wide) for slide in rails]
    else:
        main = [hull(around, wide)]
        main += [
            _along(one, 2.0 * wide, 1.2 * wide) for one in fixed if one.body == body and one.against == GROUND
        ]
        own = (name for name, slide in loose.items() if slide.body == body)
        main += [block for name in own for block in sliding_block(slides[name], guides[name])]
    parts = [*main, *parts]
    whole = unary_union(parts)
    return whole if isinstance(whole, Polygon) else unary_union([whole, _joining(parts, 0.35 * wide)])


def _along(slide: Slide, half_length: float, half_width: float) -> Polygon:
    """A bar along a guide, about its point."""
    x, y = slide.point
    u, v = half_length * math.cos(slide.direction), half_length * math.sin(slide.direction)
    return bar((x - u, y - v), (x + u, y + v), half_width)


def _joining(parts: Sequence[Polygon], half_width: float) -> Polygon:
    """Bars from the first part to all others, so that the ground is in one piece."""
    (x, y), *others = [(part.centroid.x, part.centroid.y) for part in parts]
    return unary_union([bar((x, y), other, half_width) for other in others])


def _pins(scenario: Scenario, layers: Mapping[str, float], thickness: float, margin: float) -> Iterator[Solid]:
    """Journals, through both bodies and a little out of them, on the one that has not the bore."""
    for name, pin in planar_pins(scenario).items():
        body, centre, with_clearance = pin.journal.body, pin.journal.point[:2], pin.with_clearance
        radius = (
            with_clearance.contact.bearing.journal_radius
            if with_clearance
            else 0.97 * bore_radius(scenario, name, margin)
        )
        ends = [layers[pin.first.body], layers[pin.second.body]]
        near, far = min(ends) - 0.5 * thickness, max(ends) + 0.6 * thickness
        on_ground = [(GROUND, [z for _, z, _ in copies(None)])]
        copied = on_ground if body == GROUND else body_copies(scenario, body)
        for one, heights in copied:
            mesh = together(tube(at(centre, z + near), at(centre, z + far), radius) for z in heights)
            yield Solid(f"pin_{name}{one.removeprefix(body)}", one, Role.PIN, mesh)


def joined_points(linkage: Linkage) -> dict[str, list[Vector2]]:
    """The points of every body, and of the ground, at which something is joined or traced, start posture."""
    joined: dict[str, list[Vector2]] = {name: [body.centre] for name, body in linkage.bodies.items()}
    slides = [(slide.against, slide.point) for slide in linkage.slides.values()]
    for body, (x, y) in (*((body, point) for _, body, point in named_ends(linkage)), *slides):
        joined.setdefault(body, []).append((x, y))
    return joined


def extent(linkage: Linkage) -> float:
    """The longest side of the box around all points of a linkage [m]; 1 if there is but one."""
    points = np.array([point for around in joined_points(linkage).values() for point in around])
    return float(np.ptp(points, axis=0).max()) or 1.0


def bore_radius(scenario: Scenario, pin: str, margin: float) -> float:
    """The radius of a pin's bore [m], as far as the scenario knows it."""
    with_clearance = scenario.clearance_pins.get(pin)
    if with_clearance is not None:
        return with_clearance.contact.bearing.bore_radius
    ideal = scenario.friction_pins.get(pin)
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
    """Half the distance of bodies that there are two of [m], those of actuators in two bodies among them."""
    width = scenario.machine.widths()
    if width is None:
        return {}
    of_actuators = {
        body: width.actuators[name]
        for slide in scenario.linkage.slides.values()
        for name, actuator in scenario.linkage.actuators.items()
        if name in width.actuators and {actuator.foot, actuator.head} == {slide.against, slide.body}
        for body in (slide.against, slide.body)
    }
    return {**width.pairs, **of_actuators}


def _struts(scenario: Scenario, name: str, radius: float) -> Iterator[DrawnActuator]:
    """An actuator as cylinder and rod; radius: of the cylinder [m]."""
    actuator: LinearActuator = scenario.linkage.actuators[name]
    width = scenario.machine.widths()
    pairs = _pairs(scenario)
    reach = math.dist(actuator.foot_point, actuator.head_point)
    cylinder = tube((0.0, 0.0, 0.0), (CYLINDER * reach, 0.0, 0.0), radius)
    rod = tube((-0.9 * reach, 0.0, 0.0), (0.0, 0.0, 0.0), 0.65 * radius)
    for side, z, _ in copies(width.actuators.get(name) if width else None):
        part = side if scenario.dimensions == 3 else ""
        foot, head = (
            actuator.foot + part * (actuator.foot in pairs),
            actuator.head + part * (actuator.head in pairs),
        )
        ends = at(actuator.foot_point, z), at(actuator.head_point, z)
        yield DrawnActuator(name + side, foot, head, *ends, cylinder, rod)


def blocks(scenario: Scenario) -> list[Solid]:
    """A cube for each falling block, of its mass and density, where it starts."""
    found = []
    for name, block in scenario.blocks.items():
        x, y = scenario.linkage.bodies[name].centre
        half = 0.5 * block.side
        aside = block.lateral if scenario.dimensions == 3 else 0.0
        mesh = plate(box(x - half, y - half, x + half, y + half), aside, block.side)
        found.append(Solid(name, name, Role.ROCK, mesh))
    return found
