"""Why a drawn linkage does not close: the loop, how far it stays open, and what would help."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from support_exudyn.mechanics.closing import Conditions, nearest
from support_exudyn.mechanics.continuation import moved_on
from support_exudyn.mechanics.kinetics import Matrix
from support_exudyn.model.linkage import GROUND
from user_forces.values.value import Vector2

Names = list[tuple[str, str]]  # of joints and driven parts: field of the linkage, name
TRIES = 8  # starts from which it is looked whether a linkage closes at all
FEW = 4  # the same of some of its joints
FIRM = 1e3  # how much more than a gap a driven value counts where the least gap is looked for


def refusal(conditions: Conditions) -> str:
    """The message on a drawing that cannot be closed.

    Of all joints and driven parts as many are left out as leave it open; what remains is told.
    """
    elsewhere, closes = closest(conditions)
    if closes:
        return _elsewhere(conditions, elsewhere)
    core = _core(conditions)
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


def _core(conditions: Conditions) -> Conditions:
    """As few joints and driven parts as cannot be met together: those of one loop if one alone is open."""
    cranks = conditions.linkage.cranks
    names = conditions.names
    for loop in _loops(conditions):
        bodies = {body for name in loop for body in _ends(conditions, name)}
        driven = [("cranks", body) for body in cranks if body in bodies]
        for some in [loop, [*driven, *loop]] if driven else [loop]:
            if not _can_close(conditions.of(some)):
                names = some
                break
        else:
            continue
        break
    for one in list(names):
        rest = [name for name in names if name != one]
        if rest and not _can_close(conditions.of(rest)):
            names = rest
    return conditions.of(names)


def _can_close(conditions: Conditions) -> bool:
    """Whether some joints and driven parts can be met together, as far as a few starts tell."""
    sides = _polygon(conditions)
    if sides:
        return 2.0 * max(sides.values()) <= sum(sides.values())
    return closest(conditions, FEW)[1]


def _loops(conditions: Conditions) -> list[Names]:
    """The shortest loop through each joint, short ones first."""
    edges = {name: _ends(conditions, name) for name in conditions.names if name[0] != "cranks"}
    found: list[Names] = []
    for name, (first, last) in edges.items():
        ways: dict[str, Names] = {first: [name]}
        edge = [first]
        while edge and last not in ways:
            following = []
            for other, ends in edges.items():
                for here, there in (ends, ends[::-1]):
                    if other != name and here in edge and there not in ways:
                        ways[there] = [*ways[here], other]
                        following.append(there)
            edge = following
        if last in ways and set(ways[last]) not in map(set, found):
            found.append(ways[last])
    return sorted(found, key=len)


def _ends(conditions: Conditions, name: tuple[str, str]) -> tuple[str, str]:
    """The two bodies of a joint, or of a driven angle."""
    kind, part = name
    one = getattr(conditions.linkage, kind)[part]
    if kind == "actuators":
        return one.foot, one.head
    if kind == "slides":
        return one.body, one.against
    return (one.first, one.second) if kind in ("pins", "gears") else (one.body, GROUND)


def closest(conditions: Conditions, tries: int = TRIES) -> tuple[Matrix, bool]:
    """Coordinates (n,) in which the least is open, from so many starts, and whether it closes there."""
    best, least = np.zeros(3 * len(conditions.linkage.bodies)), math.inf
    for start in _starts(conditions, tries):
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
    words = {"pins": "pin", "slides": "guide", "gears": "gear", "actuators": "actuator"}
    names = [name for kind in words for name in conditions.names if name[0] == kind]
    return {f"{words[kind]} {name}": _ends(conditions, (kind, name)) for kind, name in names}


def _starts(conditions: Conditions, tries: int) -> Sequence[Matrix]:
    """The drawing, and postures around it in which every body is turned somewhere."""
    random = np.random.default_rng(1)
    count = len(conditions.linkage.bodies)
    starts = [np.zeros(3 * count)]
    for _ in range(tries - 1):
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


def _polygon(conditions: Conditions) -> dict[str, float]:
    """Lengths [m] of the bodies in a single loop of pins, by body; empty if it is something else."""
    linkage = conditions.linkage
    if linkage.slides or linkage.gears or linkage.actuators or linkage.cranks or not linkage.pins:
        return {}
    points: dict[str, list[Vector2]] = {}
    for pin in linkage.pins.values():
        points.setdefault(pin.first, []).append(pin.first_point)
        points.setdefault(pin.second, []).append(pin.second_point)
    if any(len(found) != 2 for found in points.values()) or len(_loops(conditions)) != 1:
        return {}
    return {body: math.dist(*found) for body, found in points.items()}


def _sides(conditions: Conditions) -> str:
    """The bodies of a loop of pins with their lengths [mm] in it; nothing of another."""
    sides = {body: 1e3 * length for body, length in _polygon(conditions).items()}
    if not sides:
        return ""
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
    moved, share = moved_on(rest, np.zeros(3 * len(conditions.linkage.bodies)))
    if share < 1.0:
        moved = closest(rest)[0]
    return moved if rest.closed(moved) else None


def _reach(conditions: Conditions, one: tuple[str, str]) -> str:
    """How far a driven part comes on the way from the drawing to where it is asked for."""
    moved = _rest(conditions, one)
    if moved is None:
        return ""
    moved = moved_on(conditions, moved)[0]
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
