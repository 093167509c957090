"""A linkage closed from a drawing in which its parts lie roughly where they belong."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import replace

import numpy as np

from support_exudyn.mechanics.closing import NONE, Conditions, moved_on, nearest
from support_exudyn.mechanics.kinetics import Matrix, joints_of, kinetics_of
from support_exudyn.mechanics.postures import laid_out
from support_exudyn.model.linkage import Crank, Linkage
from user_forces.values.value import InputError, Vector2

NUDGE = 0.02  # of the drawing's size
APART = 5.0 * NUDGE  # of the drawing's size: postures farther apart are on two branches
SINGULAR = 1e-6  # singular values of a posture's conditions below this are none: a dead centre
TRIES, FEW = 8, 4  # starts from which all joints, or some of them, are closed
WORDS = {"pins": "pin", "slides": "guide", "gears": "gear", "actuators": "actuator", "cranks": "crank"}


def assembled(
    drawing: Linkage,
    angles: Mapping[str, float] = NONE,
    lengths: Mapping[str, float] = NONE,
    *,
    origins: Mapping[str, Vector2] = NONE,
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

    Raises InputError that names the joints and driven parts that cannot be met together, a body without a
    joint, or what the drawing leaves open.
    """
    _check_asked(drawing, angles, lengths, origins, held)
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
    conditions = Conditions(asked, travels, origins, dict.fromkeys(drawing.pins, (0.0, 0.0)))
    closed = laid_out(kinetics_of(drawing), _posture_of(conditions) / conditions.arms)
    # without the rounding of both points of a pin, and of the angles that are given
    bodies = {name: replace(one, angle=angles.get(name, one.angle)) for name, one in closed.bodies.items()}
    pins = {name: replace(pin, second_point=pin.first_point) for name, pin in closed.pins.items()}
    return replace(closed, bodies=bodies, pins=pins)


def _check_asked(
    drawing: Linkage,
    angles: Mapping[str, float],
    lengths: Mapping[str, float],
    origins: Mapping[str, Vector2],
    held: Collection[str],
) -> None:
    """Raise InputError where what is given is of nothing that is there, or a body has no joint."""
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
    joined = {name for name, _ in joints_of(drawing)} | {one.body for one in drawing.cranks.values()} | {*held}
    if loose := [name for name in drawing.bodies if name not in joined]:
        raise InputError(
            f"bodies.{', bodies.'.join(loose)}: {'hangs' if len(loose) == 1 else 'hang'} in the air: no pin, "
            "guide or actuator joins it to another body; allowed: bodies with a joint; add one, or leave the "
            "body out"
        )


def _posture_of(conditions: Conditions) -> Matrix:
    """Coordinates, counted by arms (n,), in which a drawing is closed; see `assembled`."""
    drawn = conditions.still
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
        raise InputError(_refusal(conditions))
    if max(np.abs(way - ways[0]).max() for way in ways) > APART * conditions.size:
        turns = np.degrees([way[2::3] / conditions.arms[2::3] for way in ways])
        most = int(np.argmax(np.ptp(turns, axis=0)))  # the body that differs most
        name, body = list(conditions.linkage.bodies.items())[most]
        one, other = (math.degrees(body.angle) + turn for turn in (turns[:, most].min(), turns[:, most].max()))
        raise InputError(
            "drawing: it lies in line or in a dead centre and does not say which posture is meant: "
            f"bodies.{name} could stand at {one:.4g} or at {other:.4g} degrees; draw it a little to the side "
            "that is meant"
        )
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


# --- what does not close ---


def _refusal(conditions: Conditions) -> str:
    """The message on a drawing that cannot be closed: the fewest parts that cannot be met together."""
    elsewhere = _closest(conditions, TRIES)
    if conditions.closed(elsewhere):
        turns = np.degrees(elsewhere[2::3] / conditions.arms[2::3]).tolist()
        angles = ", ".join(
            f"{name} at {math.degrees(body.angle) + math.remainder(turn, 360.0):.4g} degrees"
            for (name, body), turn in zip(conditions.linkage.bodies.items(), turns, strict=True)
        )
        return (
            f"{_asked(conditions) or 'drawing'}: no way leads from the drawing to a closed posture; it closes "
            f"elsewhere, for instance with {angles}; draw the bodies nearer to the posture that is meant"
        )
    core = conditions
    for part in conditions.names:
        rest = core.of([name for name in core.names if name != part])
        if rest.names and not rest.closed(_closest(rest, FEW)):
            core = rest
    joints = ", ".join(f"{WORDS[kind]} {name}" for kind, name in core.names if (kind, name) not in core.driven)
    if not core.driven:
        short, rows = core.short(_closest(core, TRIES)), core.kinetics.owners()
        gaps = [math.hypot(*short[[one == part for one in rows]]) for part in core.names if part[0] != "gears"]
        points: dict[str, list[Vector2]] = {}  # of each body in the chain
        for body, point in (side for pin in core.linkage.pins.values() for side in pin.sides):
            points.setdefault(body, []).append(point)
        sides = {body: 1e3 * math.dist(*ends) for body, ends in points.items() if len(ends) == 2}
        lengths = ", ".join(f"{body} {length:.4g}" for body, length in sides.items())
        return (
            f"the chain of {joints} does not close: {1e3 * sum(gaps):.3g} mm stay open at best"
            + (f" (between pins: {lengths} mm)" if lengths else "")
            + "; allowed: lengths that close; change one of them, or where the pins on the ground lie"
        )
    last = core.driven[-1]
    rest = core.of([name for name in core.names if name != last])
    moved, share = moved_on(rest, core.still)
    moved = moved if share == 1.0 else _closest(rest, TRIES)
    if len(core.driven) > 1:
        comes = f"; with the others {last[1]} comes to {_value(core, last, moved)}"
        return (
            f"{_asked(core)} contradict each other through {joints}{comes if rest.closed(moved) else ''}; "
            "allowed: values that fit each other; leave one of them out, it follows from the others"
        )
    reach = _value(core, last, moved_on(core, moved)[0])
    return (
        f"{_asked(core)}: the chain of {joints} does not close there; from the drawing it comes as far as "
        f"{reach}; allowed: what the lengths of these parts let it reach"
    )


def _closest(conditions: Conditions, tries: int) -> Matrix:
    """The posture (n,) in which the least is open, from the drawing and from others drawn around it."""
    random = np.random.default_rng(1)
    bodies = len(conditions.linkage.bodies)
    start, best, least = conditions.still, conditions.still, math.inf
    for _ in range(tries):
        found = nearest(conditions, start)
        gap = float(np.linalg.norm(conditions.short(found)))
        if gap < least:
            best, least = found, gap
        if conditions.closed(found):
            break
        start = random.uniform(-0.3, 0.3, 3 * bodies) * conditions.size
        start[2::3] = random.uniform(-math.pi, math.pi, bodies) * conditions.arms[2::3]
    return best


def _asked(conditions: Conditions) -> str:
    """The angles and lengths that are given, in words."""
    linkage, found = conditions.linkage, []
    for kind, name in conditions.driven:
        travel = conditions.travels[name]
        if kind == "cranks":
            found.append(f"angle of {name} = {math.degrees(linkage.bodies[name].angle + travel):.4g} degrees")
        else:
            found.append(f"length of {name} = {1e3 * (linkage.actuators[name].start_length + travel):.4g} mm")
    return " and ".join(found)


def _value(conditions: Conditions, part: tuple[str, str], moved: Matrix) -> str:
    """The angle or the length of a driven part in a posture."""
    (kind, name), kinetics = part, conditions.kinetics
    value = float(kinetics.values(moved / conditions.arms)[kinetics.owners().index(part)])
    if kind == "cranks":
        return f"{math.degrees(conditions.linkage.bodies[name].angle + value):.4g} degrees"
    return f"{1e3 * value:.4g} mm"
