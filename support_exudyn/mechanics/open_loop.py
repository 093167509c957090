"""Why a drawn linkage does not close: the loop, how far it stays open, and what would help."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from support_exudyn.mechanics.closing import Conditions, gradually, nearest
from support_exudyn.mechanics.kinetics import Matrix
from support_exudyn.model.linkage import GROUND

Names = list[tuple[str, str]]  # of joints and driven parts: field of the linkage, name
TRIES = 8  # starts from which it is looked whether a linkage closes at all
FINEST = 1e-6  # of the way to what is asked for: by this its end is located
FIRM = 1e3  # how much more than a gap a driven value counts where the least gap is looked for


def refusal(conditions: Conditions) -> str:
    """The message on a drawing that cannot be closed.

    Of all joints and driven parts as many are left out as leave it open; what remains is told.
    """
    elsewhere, closes = closest(conditions)
    if closes:
        return _elsewhere(conditions, elsewhere)
    names = conditions.names
    for one in conditions.names:
        rest = [name for name in names if name != one]
        if rest and not closest(conditions.of(rest))[1]:
            names = rest
    core = conditions.of(names)
    loop = loop_of(core)
    if not core.driven:
        return (
            f"{loop} does not close: {_gap(core)} mm stay open at best{_sides(core)}; allowed: lengths that "
            "close; change one of them, or where the pins on the ground lie"
        )
    if len(core.driven) == 1:
        said = _reach(core, core.driven[0])
        return (
            f"{_asked(core, core.driven[0])}: {loop} does not close there: {_gap(core)} mm stay open at best"
            f"{said}; allowed: what the lengths of this loop let it reach"
        )
    driven, last = " and ".join(_asked(core, one) for one in core.driven), core.driven[-1]
    others = _rest(core, last)
    reach = "" if others is None else f"; else {last[1]} comes to {_told(core, last, others)}"
    return (
        f"{driven} fight: {loop} closes with either, not with both: {_gap(core)} mm stay open at best{reach}; "
        "allowed: values that fit each other; leave one of them out, it follows from the others"
    )


def closest(conditions: Conditions) -> tuple[Matrix, bool]:
    """Coordinates (n,) in which the least is open, from the drawing and other starts, and whether it closes."""
    best, least = np.zeros(3 * len(conditions.linkage.bodies)), math.inf
    for start in _starts(conditions):
        found = nearest(conditions, start)
        if conditions.closed(found):
            return found, True
        gap = float(np.linalg.norm(conditions.short(found)))
        if gap < least:
            best, least = found, gap
    return best, False


def loop_of(conditions: Conditions) -> str:
    """Bodies and joints around a loop in words; a list of them if they are no single loop."""
    edges = _edges(conditions)
    bodies = list(dict.fromkeys(body for ends in edges.values() for body in ends))
    if all(sum(body in ends for ends in edges.values()) == 2 for body in bodies):
        body, told, left = (GROUND if GROUND in bodies else bodies[0]), [], dict(edges)
        while left:
            name = next((name for name, ends in left.items() if body in ends), None)
            if name is None:  # two loops side by side
                break
            first, second = left.pop(name)
            told += [body, name]
            body = second if body == first else first
        else:
            return f"the loop {' - '.join([*told, body])}"
    return f"what joins {', '.join(bodies)} ({', '.join(edges)})"


def _edges(conditions: Conditions) -> dict[str, tuple[str, str]]:
    """The two bodies of each joint, by what it is called."""
    linkage = conditions.linkage
    edges = {f"pin {name}": (one.first, one.second) for name, one in linkage.pins.items()}
    edges |= {f"gear {name}": (one.first, one.second) for name, one in linkage.gears.items()}
    edges |= {f"guide {name}": (one.body, one.against) for name, one in linkage.slides.items()}
    edges |= {f"gear {name}": (one.first, one.second) for name, one in linkage.gears.items()}
    return edges | {f"actuator {name}": (one.foot, one.head) for name, one in linkage.actuators.items()}


def _starts(conditions: Conditions) -> Sequence[Matrix]:
    """The drawing, and postures around it in which every body is turned somewhere."""
    random = np.random.default_rng(1)
    count = len(conditions.linkage.bodies)
    starts = [np.zeros(3 * count)]
    for _ in range(TRIES - 1):
        start = random.uniform(-0.3, 0.3, 3 * count) * conditions.size
        start[2::3] = random.uniform(-math.pi, math.pi, count) * conditions.arms[2::3]
        starts.append(start)
    return starts


def _gap(conditions: Conditions) -> str:
    """How far pins and guides of a loop stay open in all at best [mm], driven parts held."""
    owners = conditions.kinetics.owners()
    firm = replace(conditions)
    firm.__dict__["counts"] = np.where(
        [kind in ("cranks", "actuators") for kind, _ in owners], FIRM * conditions.counts, conditions.counts
    )
    short = firm.short(closest(firm)[0])
    gaps: dict[tuple[str, str], list[float]] = {}
    for owner, one in zip(owners, short.tolist(), strict=True):
        if owner[0] in ("pins", "slides"):
            gaps.setdefault(owner, []).append(one)
    if not gaps:
        return "0"
    return f"{1e3 * sum(math.hypot(*one) for one in gaps.values()):.3g}"


def _sides(conditions: Conditions) -> str:
    """The bodies of a loop of pins with their lengths [mm] in it; nothing of another."""
    edges = _edges(conditions)
    if (
        conditions.linkage.slides
        or conditions.linkage.gears
        or len(edges) != len(set(edges.values()))
        or len(edges) < 2
    ):
        return ""
    points: dict[str, list[tuple[float, float]]] = {}
    for pin in conditions.linkage.pins.values():
        points.setdefault(pin.first, []).append(pin.first_point)
        points.setdefault(pin.second, []).append(pin.second_point)
    if conditions.linkage.actuators or any(len(found) != 2 for found in points.values()):
        return ""
    sides = {body: 1e3 * math.dist(*found) for body, found in points.items()}
    longest = max(sides, key=lambda body: sides[body])
    others = sum(sides.values()) - sides[longest]
    said = ", ".join(f"{body} {length:.4g}" for body, length in sides.items())
    return f" ({said} mm long; {longest} is longer than the others together, {others:.4g} mm)"


def _asked(conditions: Conditions, one: tuple[str, str]) -> str:
    """A driven part with the angle or length that is asked for."""
    kind, name = one
    if kind == "cranks":
        angle = conditions.linkage.bodies[name].angle + conditions.travels[name]
        return f"angle of {name} = {math.degrees(angle):.4g} degrees"
    length = conditions.linkage.actuators[name].start_length + conditions.travels[name]
    return f"length of {name} = {1e3 * length:.4g} mm"


def _told(conditions: Conditions, one: tuple[str, str], moved: Matrix) -> str:
    """The angle or the length of a driven part in a posture."""
    kind, name = one
    row = conditions.kinetics.owners().index(one)
    travel = conditions.travels[name] - float(conditions.short(moved)[row] / conditions.counts[row])
    if kind == "cranks":
        return f"{math.degrees(conditions.linkage.bodies[name].angle + travel):.4g} degrees"
    return f"{1e3 * (conditions.linkage.actuators[name].start_length + travel):.4g} mm"


def _rest(conditions: Conditions, one: tuple[str, str]) -> Matrix | None:
    """A posture in which all is met but one driven part; None if there is none."""
    rest = conditions.of([other for other in conditions.names if other != one])
    moved, closed = gradually(rest, np.zeros(3 * len(conditions.linkage.bodies)))
    if not closed:
        moved, closed = closest(rest)
    return moved if closed else None


def _reach(conditions: Conditions, one: tuple[str, str]) -> str:
    """How far a driven part comes on the way from the drawing to where it is asked for."""
    moved = _rest(conditions, one)
    if moved is None:
        return ""
    row, name = conditions.kinetics.owners().index(one), one[1]
    ahead = float(conditions.short(moved)[row] / conditions.counts[row])
    reached, step = 0.0, 0.125
    while step > FINEST and reached < 1.0:
        share = min(1.0, reached + step)
        asked = {**conditions.travels, name: conditions.travels[name] - (1.0 - share) * ahead}
        following, closed = gradually(replace(conditions, travels=asked), moved)
        if closed:
            reached, moved = share, following
        else:
            step /= 2.0
    return f"; from the drawing it comes as far as {_told(conditions, one, moved)}"


def _elsewhere(conditions: Conditions, found: Matrix) -> str:
    """That it closes, but not near the drawing."""
    turns = np.degrees(found[2::3] / conditions.arms[2::3])
    bodies = conditions.linkage.bodies
    told = ", ".join(
        f"{name} at {math.degrees(body.angle) + math.remainder(turn, 360.0):.4g} degrees"
        for (name, body), turn in zip(bodies.items(), turns.tolist(), strict=True)
    )
    driven = [_asked(conditions, one) for one in conditions.driven]
    reach = "".join(_reach(conditions, one) for one in conditions.driven[:1] if len(conditions.driven) == 1)
    return (
        f"{' and '.join(driven) or 'drawing'}: no way leads from the drawing to a closed posture{reach}; it "
        f"closes elsewhere, for instance with {told}; draw the bodies nearer to the posture that is meant"
    )
