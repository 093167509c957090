"""Postures of a linkage whose driven parts have moved and whose pins' two points lie apart."""

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from support_exudyn.mechanics.kinetics import Kinetics, Matrix, kinetics_of
from support_exudyn.model.linkage import GROUND, Linkage, PinPlace, turned_moments
from support_exudyn.model.plane_geometry import minus
from user_forces.values.value import InputError, Vector2

ROUNDS = 20
CLOSED = 1e-13  # [m]
ROUNDINGS = 8.0  # of the coordinates
LARGEST = 10.0  # [m], [rad]: in one search nothing moves so far


def missing(
    closed: Kinetics, position: Matrix, offsets: Mapping[str, Vector2], travels: Mapping[str, float]
) -> Matrix:
    """What each constraint is short of, in the order of `Kinetics.rows` (m,) [m], [rad].

    Arguments:
        closed: a linkage with all pins closed and all actuators rigid.
        position: coordinates of all bodies (n,).
        offsets: by pin, centre of its second body's point minus that of the first [m]; else as at the start.
        travels: by actuator and crank, how far it has moved from the start on [m], [rad]; else 0.
    """
    linkage = closed.linkage
    short: list[float] = []
    for name, place in linkage.pins.items():
        short += list(np.array(_offset(place, offsets.get(name))) - closed.relative(position, place)[0])
    for name, actuator in linkage.actuators.items():
        foot, head = (
            closed.point(position, body, point)[0]
            for body, point in ((actuator.foot, actuator.foot_point), (actuator.head, actuator.head_point))
        )
        short.append(actuator.start_length + travels.get(name, 0.0) - math.dist(foot, head))
    short += [
        travels.get(name, 0.0) - turn(closed, position, crank.body) for name, crank in linkage.cranks.items()
    ]
    for slide in linkage.slides.values():
        carrier = turn(closed, position, slide.against)
        angle = slide.direction + carrier
        ends = (closed.point(position, body, slide.point)[0] for body in (slide.body, slide.against))
        x, y = np.subtract(*ends)
        turned = carrier - turn(closed, position, slide.body)
        short += [math.sin(angle) * x - math.cos(angle) * y, turned][: slide.conditions]
    for gear in linkage.gears.values():
        first, second, carrier = (
            turn(closed, position, body) for body in (gear.first, gear.second, gear.carrier or GROUND)
        )
        short.append(gear.ratio * (first - carrier) - (second - carrier))
    return np.array(short)


def posture(
    closed: Kinetics, near: Matrix, offsets: Mapping[str, Vector2], travels: Mapping[str, float]
) -> Matrix | None:
    """Coordinates of all bodies (n,) with these offsets and travels, see `missing`; None if none are found.

    Each step of the search is the one of least mass times distance squared.

    near: coordinates from which they are looked for (n,).
    """
    enough = max(CLOSED, ROUNDINGS * math.ulp(closed.linkage.farthest))
    position = near
    for _ in range(ROUNDS):
        short = missing(closed, position, offsets, travels)
        if np.abs(short).max(initial=0.0) < enough:
            return position
        position = position + closed.respond(position, np.zeros_like(position), short)[0]
        if not np.abs(position - near).max() < LARGEST:
            return None
    return None


def turn(closed: Kinetics, position: Matrix, body: str) -> float:
    """Angle by which a body has turned since the start [rad]."""
    return 0.0 if body == GROUND else float(position[closed.first(body) + 2])


def laid_out(closed: Kinetics, position: Matrix) -> Linkage:
    """The linkage with its bodies at another position, which is its start posture from then on."""
    linkage = closed.linkage

    def at(body: str, point: Vector2) -> Vector2:
        x, y = closed.point(position, body, point)[0].tolist()
        return x, y

    bodies = {}
    for name, body in linkage.bodies.items():
        turned = turn(closed, position, name)
        moments = None if body.moments is None else turned_moments(body.moments, turned)
        bodies[name] = replace(body, centre=at(name, body.centre), angle=body.angle + turned, moments=moments)
    return replace(
        linkage,
        bodies=bodies,
        pins={
            name: replace(
                pin, first_point=at(pin.first, pin.first_point), second_point=at(pin.second, pin.second_point)
            )
            for name, pin in linkage.pins.items()
        },
        actuators={
            name: replace(one, foot_point=at(one.foot, one.foot_point), head_point=at(one.head, one.head_point))
            for name, one in linkage.actuators.items()
        },
        points={name: replace(one, point=at(one.body, one.point)) for name, one in linkage.points.items()},
        slides={
            name: replace(
                one,
                point=at(one.body, one.point),
                direction=one.direction + turn(closed, position, one.against),
                ends=None if one.ends is None else (at(one.against, one.ends[0]), at(one.against, one.ends[1])),
            )
            for name, one in linkage.slides.items()
        },
    )


def eccentric(linkage: Linkage, offsets: Mapping[str, Vector2]) -> Linkage:
    """The linkage with journals moved in their bores, all else held together.

    Of the postures in which the other pins are closed, guides are followed, and actuators and cranks are where
    they were, the one that is reached by the steps of least mass times distance squared.

    Arguments:
        offsets: for each pin that is moved, centre of its second body's point minus that of the first [m].

    Raises InputError if the linkage cannot be moved so.
    """
    moved = {name: offset for name, offset in offsets.items() if offset != (0.0, 0.0)}
    if not moved:
        return linkage
    closed = kinetics_of(linkage)
    position = posture(closed, np.zeros(3 * len(linkage.bodies)), moved, {})
    if position is not None:
        return laid_out(closed, position)
    raise InputError(
        f"eccentricity of {', '.join(moved)} = {', '.join(map(str, moved.values()))} m: the linkage cannot be "
        "laid out so; allowed: what actuators, guides and the other pins leave free, such as (0, 0)"
    )


def _offset(place: PinPlace, asked: Vector2 | None) -> Vector2:
    """Centre on the second body minus that on the first [m]; that of the machine where none is asked for."""
    return asked or minus(place.second_point, place.first_point)
