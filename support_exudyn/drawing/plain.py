"""What a machine looks like that says no more of it: plates around the points at which bodies are joined."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterator, Mapping

import numpy as np

from support_exudyn.drawing.shapes import bored, hull, plate, together, tube
from support_exudyn.drawing.solid import Look, Role, Solid, Strut
from support_exudyn.machine import GROUND, Column, Linkage
from support_exudyn.scenario import Scenario
from support_exudyn.spatial.lift import at, copies
from user_forces.values import Vector2

MARGIN = 0.03  # of plates around their points, of the machine's extent
THICKNESS = 0.05  # of plates, of the machine's extent
BORE = 0.35  # radius of bores where nobody says it, of the margin
CYLINDER = 0.6  # length of a cylinder, of the column at the start


def look(scenario: Scenario) -> Look:
    """The look of a scenario's machine, from its linkage alone."""
    linkage = scenario.linkage
    points = joined_points(linkage)
    size = extent(linkage)
    margin, thickness = MARGIN * size, THICKNESS * size
    solids = []
    for name, around in points.items():
        outline = hull(around, margin)
        for pin, place in linkage.pins.items():
            for body, centre in ((place.first, place.first_point), (place.second, place.second_point)):
                if body == name:
                    outline = bored(outline, centre, min(bore_radius(scenario, pin, margin), 0.9 * margin))
        if name == GROUND:
            solids.append(Solid(name, GROUND, Role.BASE, plate(outline, 0.0, 0.5 * thickness)))
            continue
        for body, heights in body_copies(scenario, name):
            mesh = together(plate(outline, z, thickness) for z in heights)
            solids.append(Solid(body, body, Role.BODY, mesh))
    lowest = min(y for around in points.values() for _, y in around)
    return Look(tuple(solids), struts(scenario, 0.5 * margin), lowest - margin)


def joined_points(linkage: Linkage) -> dict[str, list[Vector2]]:
    """The points of every body, and of the ground, at which something is joined or traced, start posture."""
    found: dict[str, list[Vector2]] = defaultdict(list)
    for name, body in linkage.bodies.items():
        found[name].append(body.centre)
    for pin in linkage.pins.values():
        found[pin.first].append(pin.first_point)
        found[pin.second].append(pin.second_point)
    for column in linkage.columns.values():
        found[column.foot].append(column.foot_point)
        found[column.head].append(column.head_point)
    for point in linkage.points.values():
        found[point.body].append(point.point)
    for slide in linkage.slides.values():
        found[slide.against].append(slide.point)
    return dict(found)


def extent(linkage: Linkage) -> float:
    """The longest side of the box around all points of a linkage [m]; 1 if there is but one."""
    points = np.array([point for around in joined_points(linkage).values() for point in around])
    return float(np.ptp(points, axis=0).max()) or 1.0


def bore_radius(scenario: Scenario, pin: str, margin: float) -> float:
    """Of a pin's bore [m], as far as the scenario knows it."""
    loose = scenario.clearance_pins.get(pin)
    if loose is not None:
        return loose.contact.bearing.bore_radius
    ideal = scenario.friction_pins.get(pin)
    return ideal.radius if ideal is not None and ideal.radius is not None else BORE * margin


def body_copies(scenario: Scenario, name: str) -> list[tuple[str, list[float]]]:
    """By what names the channels know a body of the plane, each with where it stands beside the plane [m].

    In the plane a pair has one name and two places; in space two names.
    """
    sides = copies(_pairs(scenario).get(name))
    if scenario.dimensions == 3:
        return [(name + side, [z]) for side, z, _ in sides]
    return [(name, [z for _, z, _ in sides])]


def _pairs(scenario: Scenario) -> Mapping[str, float]:
    """Half the distance of bodies that there are two of [m], those of columns in two bodies among them."""
    width = scenario.machine.widths()
    if width is None:
        return {}
    of_columns = {
        body: width.columns[name]
        for slide in scenario.linkage.slides.values()
        for name, column in scenario.linkage.columns.items()
        if name in width.columns and {column.foot, column.head} == {slide.against, slide.body}
        for body in (slide.against, slide.body)
    }
    return {**width.pairs, **of_columns}


def struts(scenario: Scenario, radius: float) -> tuple[Strut, ...]:
    """All columns as cylinder and rod; radius: of the cylinder [m]."""
    return tuple(strut for name in scenario.linkage.columns for strut in _struts(scenario, name, radius))


def _struts(scenario: Scenario, name: str, radius: float) -> Iterator[Strut]:
    column: Column = scenario.linkage.columns[name]
    width = scenario.machine.widths()
    pairs = _pairs(scenario)
    reach = math.dist(column.foot_point, column.head_point)
    cylinder = tube((0.0, 0.0, 0.0), (CYLINDER * reach, 0.0, 0.0), radius)
    rod = tube((-0.9 * reach, 0.0, 0.0), (0.0, 0.0, 0.0), 0.65 * radius)
    for side, z, _ in copies(width.columns.get(name) if width else None):
        part = side if scenario.dimensions == 3 else ""
        yield Strut(
            name + side,
            column.foot + part * (column.foot in pairs),
            column.head + part * (column.head in pairs),
            at(column.foot_point, z),
            at(column.head_point, z),
            cylinder,
            rod,
        )
