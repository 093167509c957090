"""A linkage closed from a drawing in which its parts lie roughly where they belong."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from support_exudyn.mechanics.closing import Conditions, nearest
from support_exudyn.mechanics.continuation import moved_on
from support_exudyn.mechanics.kinetics import Matrix, joints_of, kinetics_of
from support_exudyn.mechanics.open_loop import refusal
from support_exudyn.mechanics.postures import laid_out
from support_exudyn.model.linkage import Body, Crank, Linkage
from user_forces.values.value import InputError, Vector2

NONE: Mapping[str, float] = MappingProxyType({})
NO_POINTS: Mapping[str, Vector2] = MappingProxyType({})
NUDGE = 0.02  # of the drawing's size
APART = 5.0 * NUDGE  # of the drawing's size: postures farther apart are on two branches
SINGULAR = 1e-6  # singular values of a posture's conditions below this are none: a dead centre


def assembled(
    drawing: Linkage,
    angles: Mapping[str, float] = NONE,
    lengths: Mapping[str, float] = NONE,
    *,
    origins: Mapping[str, Vector2] = NO_POINTS,
    held: Collection[str] = (),
) -> Linkage:
    """The linkage in the posture in which its joints are closed, on the branch of its drawing.

    What is open is closed gradually, each step the one of least movement, so that the way from the drawing is
    continuous. Where no such way leads on, the posture is searched for that is nearest to closed. Where the
    drawing lies in a dead centre, a little to both sides has to lead to the same posture.

    Arguments:
        drawing: bodies roughly where they belong; the two points of a pin may lie apart, points beside their
            guides. Points of one body lie to each other as they are to be. So do a body and the line of a guide
            along which it does not turn.
        angles: of bodies that stand at a certain angle [rad], as `Body.angle`.
        lengths: of actuators that have a certain length [m]; others come out as the joints leave them.
        origins: by guide, a point of its line on the body that carries it [m], as drawn; by default
            `Slide.point`, which is then on both bodies.
        held: bodies that need no joint, such as those on springs.

    Returns the linkage laid out there; its pins' two points coincide, points of guides lie on their lines.

    Raises InputError that names the loop that does not close, driven parts that fight, a body without a
    joint, or what the drawing leaves open.
    """
    _check_asked(drawing, angles, lengths, origins)
    check_hanging(drawing, held)
    asked = replace(
        drawing,
        cranks={body: Crank(body=body) for body in angles},
        actuators={name: one for name, one in drawing.actuators.items() if name in lengths},
    )
    travels = {
        body: math.remainder(angle - drawing.bodies[body].angle, 2.0 * math.pi)
        for body, angle in angles.items()
    }
    travels |= {name: length - drawing.actuators[name].start_length for name, length in lengths.items()}
    conditions = Conditions(asked, travels, origins)
    found = posture_of(conditions)
    return _with_exact_numbers(laid_out(kinetics_of(drawing), found / conditions.arms), angles)


def posture_of(conditions: Conditions) -> Matrix:
    """Coordinates, counted by arms (n,), in which a drawing is closed; see `assembled`."""
    drawn = np.zeros(3 * len(conditions.linkage.bodies))
    if conditions.closed(drawn):
        return drawn
    found = _from(conditions, drawn)
    if found is not None and _rank(conditions, drawn) == _rank(conditions, found):
        return found
    # the drawing lies in a dead centre, or no way leads on: is the posture the same from both sides?
    aside = NUDGE * conditions.size * np.random.default_rng(0).normal(size=drawn.size)
    sides = (found, _from(conditions, aside), _from(conditions, -aside))
    ways = [way for way in sides if way is not None]
    if not ways:
        raise InputError(refusal(conditions))
    if max(np.abs(way - ways[0]).max() for way in ways) > APART * conditions.size:
        raise InputError(_ambiguous(conditions, ways))
    return ways[0]


def _from(conditions: Conditions, start: Matrix) -> Matrix | None:
    """Coordinates (n,) of the posture that a start leads to; None if it leads to none."""
    found, share = moved_on(conditions, start)
    if share < 1.0 and conditions.driven:  # its gaps first, then what is driven
        undriven = conditions.of([one for one in conditions.names if one not in conditions.driven])
        found, share = moved_on(undriven, start)
        if share == 1.0:
            found, share = moved_on(conditions, found)
    if share < 1.0:
        found = nearest(conditions, start)
    return found if conditions.closed(found) else None


def _rank(conditions: Conditions, moved: Matrix) -> int:
    return int(np.linalg.matrix_rank(conditions.rows(moved), tol=SINGULAR))


def check_hanging(linkage: Linkage, held: Collection[str] = ()) -> None:
    """Raise InputError that names bodies that no pin, guide, actuator or crank joins to anything.

    held: bodies that need no joint.
    """
    joined = {name for name, _ in joints_of(linkage)} | {one.body for one in linkage.cranks.values()}
    loose = [name for name in linkage.bodies if name not in joined and name not in held]
    if loose:
        raise InputError(
            f"bodies.{', bodies.'.join(loose)}: {'hangs' if len(loose) == 1 else 'hang'} in the air: no pin, "
            "guide or actuator joins it to another body; allowed: bodies with a joint; add one, or leave the "
            "body out"
        )


def _check_asked(
    drawing: Linkage,
    angles: Mapping[str, float],
    lengths: Mapping[str, float],
    origins: Mapping[str, Vector2],
) -> None:
    """Raise InputError where an angle, a length or a line is of something that is not there."""
    for what, asked, known in (
        ("angle", angles, drawing.bodies),
        ("length", lengths, drawing.actuators),
        ("line", origins, drawing.slides),
    ):
        for name in asked:
            if name not in known:
                raise InputError(f"{what} of {name!r}: no such part; allowed: {', '.join(known) or 'none'}")
    for name, length in lengths.items():
        if not length > 0.0:
            raise InputError(f"length of {name} = {1e3 * length:g} mm: allowed: > 0 mm")
        if drawing.actuators[name].start_length == 0.0:
            raise InputError(
                f"actuators.{name}: its ends lie at one point of the drawing, so it has no direction; allowed: "
                "ends that lie apart; draw them roughly where they belong"
            )


def _ambiguous(conditions: Conditions, ways: list[Matrix]) -> str:
    """That a drawing leaves open which posture is meant, shown with the body that differs most."""
    turns = np.array([way[2::3] / conditions.arms[2::3] for way in ways])
    most = int(np.argmax(np.ptp(turns, axis=0)))
    name, body = list(conditions.linkage.bodies.items())[most]
    one, other = (math.degrees(body.angle + turn) for turn in (turns[:, most].min(), turns[:, most].max()))
    return (
        "drawing: it lies in line or in a dead centre and does not say which posture is meant: "
        f"bodies.{name} could stand at {one:.4g} or at {other:.4g} degrees; draw it a little to the side that "
        "is meant"
    )


def _with_exact_numbers(linkage: Linkage, angles: Mapping[str, float]) -> Linkage:
    """The linkage with pins' points at one place, and angles as they were asked for."""

    def exact(name: str, body: Body) -> Body:
        return replace(body, angle=angles.get(name, body.angle))

    return replace(
        linkage,
        bodies={name: exact(name, body) for name, body in linkage.bodies.items()},
        pins={name: replace(pin, second_point=pin.first_point) for name, pin in linkage.pins.items()},
    )
