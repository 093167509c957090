"""A linkage whose clearance journals do not start in the middle of their bores."""

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
LARGEST = 10.0  # [m], [rad]: nothing moves so far


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
    enough = max(CLOSED, ROUNDINGS * math.ulp(linkage.farthest))
    position = np.zeros(3 * len(linkage.bodies))
    for _ in range(ROUNDS):
        missing = _missing(closed, position, moved)
        if np.abs(missing).max() < enough:
            return _laid_out(closed, position)
        position = position + closed.respond(position, np.zeros_like(position), missing)[0]
        if not np.abs(position).max() < LARGEST:
            break
    raise InputError(
        f"eccentricity of {', '.join(moved)} = {', '.join(map(str, moved.values()))} m: the linkage cannot be "
        "laid out so; allowed: what actuators, guides and the other pins leave free, such as (0, 0)"
    )


def _missing(closed: Kinetics, position: Matrix, offsets: Mapping[str, Vector2]) -> Matrix:
    """What each constraint is short of, in the order of `Kinetics.rows` [m], [rad]."""
    linkage = closed.linkage
    missing: list[float] = []
    for name, place in linkage.pins.items():
        missing += list(np.array(_offset(place, offsets.get(name))) - closed.relative(position, place)[0])
    for actuator in linkage.actuators.values():
        foot, head = (
            closed.point(position, body, point)[0]
            for body, point in ((actuator.foot, actuator.foot_point), (actuator.head, actuator.head_point))
        )
        missing.append(actuator.start_length - math.dist(foot, head))
    missing += [-_turn(closed, position, crank.body) for crank in linkage.cranks.values()]
    for slide in linkage.slides.values():
        carrier = _turn(closed, position, slide.against)
        angle = slide.direction + carrier
        ends = (closed.point(position, body, slide.point)[0] for body in (slide.body, slide.against))
        x, y = np.subtract(*ends)
        missing += [math.sin(angle) * x - math.cos(angle) * y, carrier - _turn(closed, position, slide.body)]
    return np.array(missing)


def _offset(place: PinPlace, asked: Vector2 | None) -> Vector2:
    """Centre on the second body minus that on the first [m]; that of the machine where none is asked for."""
    return asked or minus(place.second_point, place.first_point)


def _turn(closed: Kinetics, position: Matrix, body: str) -> float:
    return 0.0 if body == GROUND else float(position[closed.bodies[body].first + 2])


def _laid_out(closed: Kinetics, position: Matrix) -> Linkage:
    """The linkage with its bodies at another position, which is its start posture from then on."""
    linkage = closed.linkage

    def at(body: str, point: Vector2) -> Vector2:
        x, y = closed.point(position, body, point)[0].tolist()
        return x, y

    bodies = {}
    for name, body in linkage.bodies.items():
        turn = _turn(closed, position, name)
        moments = None if body.moments is None else turned_moments(body.moments, turn)
        bodies[name] = replace(body, centre=at(name, body.centre), angle=body.angle + turn, moments=moments)
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
                direction=one.direction + _turn(closed, position, one.against),
            )
            for name, one in linkage.slides.items()
        },
    )
