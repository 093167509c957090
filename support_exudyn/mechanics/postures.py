"""Linkages that start otherwise: at other coordinates, with journals out of their middles, or moving."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from support_exudyn.mechanics.closing import Conditions, newton
from support_exudyn.mechanics.kinetics import Kinetics, Matrix, kinetics_of
from support_exudyn.model.linkage import Body, Linkage, Slide, turned_moments
from user_forces.values.value import InputError, Vector2

ROUNDS = 20
FARTHEST = 10.0  # [m]: no body moves so far
AT_ODDS = 1e-9  # of the fastest rate: by more the joints do not allow what is asked for


def laid_out(closed: Kinetics, position: Matrix) -> Linkage:
    """The linkage with its bodies at another position, which is its start posture from then on."""
    linkage, motion = closed.linkage, closed.motion(position)

    def at(body: str, point: Vector2) -> Vector2:
        x, y = motion.place(body, point)[0].tolist()
        return x, y

    def turned(name: str, body: Body) -> Body:
        turn = float(motion.turn(name)[0])
        moments = None if body.moments is None else turned_moments(body.moments, turn)
        return replace(body, centre=at(name, body.centre), angle=body.angle + turn, moments=moments)

    def slid(slide: Slide) -> Slide:
        ends = slide.ends and (at(slide.against, slide.ends[0]), at(slide.against, slide.ends[1]))
        direction = slide.direction + float(motion.turn(slide.against)[0])
        return replace(slide, point=at(slide.body, slide.point), direction=direction, ends=ends)

    return replace(
        linkage,
        bodies={name: turned(name, body) for name, body in linkage.bodies.items()},
        pins={
            name: replace(one, first_point=at(*one.sides[0]), second_point=at(*one.sides[1]))
            for name, one in linkage.pins.items()
        },
        actuators={
            name: replace(one, foot_point=at(*one.sides[0]), head_point=at(*one.sides[1]))
            for name, one in linkage.actuators.items()
        },
        points={name: replace(one, point=at(one.body, one.point)) for name, one in linkage.points.items()},
        slides={name: slid(one) for name, one in linkage.slides.items()},
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
    conditions = Conditions(linkage)
    kinetics, targets = conditions.kinetics, conditions.targets({}, moved)
    light = conditions.arms / np.sqrt(kinetics.mass() + kinetics.stand_in)
    found = newton(conditions, conditions.still, targets, FARTHEST, rounds=ROUNDS, light=light)
    if found is not None:
        return laid_out(kinetics, found / conditions.arms)
    raise InputError(
        f"eccentricity of {', '.join(moved)} = {', '.join(map(str, moved.values()))} m: the linkage cannot be "
        "laid out so; allowed: what actuators, guides and the other pins leave free, such as (0, 0)"
    )


def set_moving(linkage: Linkage, spins: Mapping[str, float]) -> Linkage:
    """The linkage with the velocities that belong to angular velocities of some bodies [rad/s], by name.

    Pins, guides, gears and driven parts hold; driven parts stand still. What that leaves open moves with the
    least kinetic energy.

    Raises InputError if the joints do not allow these velocities together.
    """
    if not spins:
        return linkage
    kinetics = kinetics_of(linkage)
    still = np.zeros(3 * len(linkage.bodies))
    held = kinetics.rows(still)
    asked = np.array([kinetics.turning(still.size, body) for body in spins])
    rows, rates = np.vstack([held, asked]), np.array([0.0] * len(held) + list(spins.values()))
    light = 1.0 / np.sqrt(kinetics.mass() + kinetics.stand_in)
    velocity = light * np.linalg.lstsq(rows * light, rates, rcond=None)[0]
    wrong = np.abs(rows @ velocity - rates).max()
    if wrong > AT_ODDS * np.abs(rates).max():
        said = ", ".join(f"{name} = {spin:.6g} rad/s" for name, spin in spins.items())
        raise InputError(
            f"angular velocities at the start, {said}: the joints do not allow them; allowed: of one body for "
            "each freedom that no drive moves"
        )
    return replace(
        linkage,
        bodies={
            name: replace(body, velocity=tuple(rate[:2].tolist()), spin=float(rate[2]))
            for (name, body), rate in zip(linkage.bodies.items(), velocity.reshape(-1, 3), strict=True)
        },
    )
