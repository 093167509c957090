"""The check of a machine by its linkage: mobility, closure, the way of its driven parts, statics."""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from support_exudyn.machines.check.drive_way import TURN, DriveWay, Moved, way_of
from support_exudyn.machines.check.freedoms import (
    SHARED,
    Movement,
    RepeatedConditions,
    floating,
    listed,
    movements,
    repeated,
)
from support_exudyn.machines.check.joint_warnings import of_joints
from support_exudyn.machines.check.report import CheckReport, CheckTable
from support_exudyn.machines.check.statics import mobility, statics
from support_exudyn.machines.check.support_rules import Findings, support_findings
from support_exudyn.machines.check.transmission import (
    DEFINITION,
    LEAST,
    TransmissionAngle,
    transmission_angles,
)
from support_exudyn.machines.four_bar_shield import FourBarShield
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.mechanics.closing import Conditions, beside
from support_exudyn.model.linkage import GROUND, Linkage
from support_exudyn.model.loads.load import ActingLoad
from user_forces.values.value import InputError

STEPS, TOLD = 180, 12  # postures to each end of a way, and rows of its table less one
STEPS_OF_SEVERAL, TOLD_OF_SEVERAL = 60, 6  # the same where several parts are driven
STEPS_OF_SUPPORTS, TOLD_OF_SUPPORTS = 100, 10  # the same of supports
SHARE = 0.3  # of an actuator's length: its stroke either way where none is known
OPEN = 1e-9  # of the machine's size: gap at the start that is reported
NEAR = 0.1  # [m] of travel: a dead centre so near to the used range is a warning
FARTHER = 3.0  # times the shortest column of a support: no farther is a dead centre searched for


def check_machine(data: MachineData, stroke: float | None = None) -> CheckReport:
    """The report of a machine before a run.

    Arguments:
        data: the machine as its file describes it.
        stroke: by how much its actuators extend from the start on [m]; by default that of the file, otherwise
            three tenths of the shortest column of a support, or of the length of another actuator either way.

    Raises InputError if a stroke is given where no actuator alone, or the columns of a support, are driven.
    """
    machine = data.machine
    linkage, loads = machine.linkage(), machine.loads
    support = machine if isinstance(machine, FourBarShield) else None
    driven = [(name,) for name in linkage.driven] if support is None else [support.alike]
    if stroke is not None and not (len(driven) == 1 and driven[0][0] in linkage.actuators):
        raise InputError(f"stroke = {stroke} m: no single actuator drives this machine; allowed: none")
    conditions = Conditions(linkage if support is None else support.led_linkage())
    start = np.zeros(3 * len(linkage.bodies))
    loose = movements(conditions, start)
    aside = beside(conditions, [one.rates * conditions.arms for one in loose])
    singular = len(movements(conditions, aside)) < len(loose)
    again = repeated(conditions, aside if singular else start)
    used = stroke or data.stroke or (support.usual_stroke if support else None)
    steps = STEPS_OF_SUPPORTS if support else STEPS_OF_SEVERAL if len(driven) > 1 else STEPS
    farther, count = (FARTHER * support.shortest_column, TOLD_OF_SUPPORTS) if support else (0.0, TOLD)
    ways: list[DriveWay] = []
    if not loose and not any(one.driven for one in again):
        goals = [_goal(linkage, one[0], used) for one in driven]
        ways = [
            way_of(conditions, linkage, one, goal, steps, loads, farther)
            for one, goal in zip(driven, goals, strict=True)
        ]
    at_rest = Moved(0.0, start, statics(linkage, start, loads=loads))
    transmission = {way.drive: list(transmission_angles(conditions, way)) for way in ways}
    found = support_findings(data, support, ways[0]) if support and ways else Findings()
    numbers = {
        "degrees_of_freedom": mobility(linkage).data(),
        "closure_m": _gaps(conditions, linkage),
        "movements": [one.data() for one in loose],
        **_numbers(linkage, ways, transmission, [] if loose else [at_rest], count),
        "repeated_conditions": [[f"{kind}.{name}" for kind, name in one.parts] for one in again],
        **({"stroke_m": used} if used is not None and not linkage.cranks else {}),
        **found.numbers,
        "file_numbers": {key: one.data() for key, one in data.sourced.items()},
    }
    moved = [one for way in ways for one in way.moved] or ([] if loose else [at_rest])
    facts, warnings = _sentences(data, conditions, moved, again, loose, singular)
    for way in ways:
        angles = transmission[way.drive]
        facts += [*_way_facts(way), *(one.said(way) for one in angles)]
        warnings += [*_way_warnings(way), *_poor_angles(way, angles)]
    return CheckReport(
        name=data.name,
        kind=data.kind or type(machine).__name__,
        facts=[*facts, *[DEFINITION] * any(transmission.values()), *_static_facts(loads, moved), *found.facts],
        sheets=[*_sheets(ways, numbers), *_sourced(data)],
        warnings=[*warnings, *found.warnings],
        notes=[*_notes(data, linkage, ways, stroke), *found.notes, *_sources(data)],
        numbers=numbers,
        linkage=linkage,
        start=at_rest,
        loads=loads,
        ways=ways,
        transmission=transmission,
        blocks=data.blocks,
    )


def _goal(linkage: Linkage, drive: str, stroke: float | None) -> tuple[float, float]:
    """Ends of the travel that is tried, downwards and upwards: a revolution each, or a stroke."""
    if drive in linkage.cranks:
        return -TURN, TURN
    if stroke is None:
        share = SHARE * linkage.actuators[drive].start_length
        return -share, share
    return min(0.0, stroke), max(0.0, stroke)


def _stations(way: DriveWay, count: int) -> list[Moved]:
    """The postures of a table: the first, the last, and so many more less one between."""
    near = 1e-6 * (way.ends[1] - way.ends[0])
    singular = [one.travel for one in way.points if one.what != "turns back"]  # where forces have no bound
    moved = [one for one in way.moved if all(abs(one.travel - end) > near for end in singular)] or way.moved
    chosen = dict.fromkeys(round(n) for n in np.linspace(0, len(moved) - 1, min(len(moved), count + 1)))
    return [moved[n] for n in chosen]


# --- sentences ---


def _sentences(
    data: MachineData,
    conditions: Conditions,
    moved: Sequence[Moved],
    again: Sequence[RepeatedConditions],
    loose: Sequence[Movement],
    singular: bool,
) -> tuple[list[str], list[str]]:
    """Facts and warnings on the linkage.

    Arguments:
        moved: postures in which forces are known.
        again: conditions that repeat others.
        loose: movements with all driven parts held; singular: they end beside the start posture.
    """
    linkage, loads = data.machine.linkage(), data.machine.loads
    opened = _gaps(conditions, linkage)
    facts, warnings = [mobility(linkage).said()], []
    if opened:
        facts.append(f"closure at the start: pins within {1e3 * max(opened.values()):.1e} mm")
    warnings += [
        f"pins.{name}: its two points are {1e3 * gap:.3g} mm apart at the start"
        for name, gap in opened.items()
        if gap > OPEN * conditions.size
    ]
    warnings += [one.said() + ("" if one.driven else f"; {SHARED}") for one in again]
    acted = {body for name, one in loads.items() for body in (one.body, one.against(name))}
    under_loads = bool(loads) and all(set(one.bodies) & acted for one in loose)
    freedoms = _freedoms(linkage, loose, singular, under_loads)
    warned = singular or (linkage.driven and not under_loads)
    (warnings if warned else facts).extend(freedoms)
    more, doubts = of_joints(linkage, moved)
    return [*facts, *more], [*warnings, *data.warnings, *doubts]


def _static_facts(loads: Mapping[str, ActingLoad], moved: Sequence[Moved]) -> Iterator[str]:
    """Under what the static forces are, if there are any, and how exact."""
    if moved:
        error = float(np.median([one.forces.error for one in moved]))  # at a dead centre forces have no bound
        under = f"weight and {listed(list(loads))}, once come on" if loads else "weight alone"
        yield f"static forces: under {under}; numerical error below {max(error, 1e-12):.0e} N"


def _gaps(conditions: Conditions, linkage: Linkage) -> dict[str, float]:
    """How far the two points of each pin are apart at the start [m]."""
    start = np.zeros(3 * len(linkage.bodies))
    gaps = {name: conditions.kinetics.relative(start, pin)[0] for name, pin in linkage.pins.items()}
    return {name: float(np.hypot(*gap)) for name, gap in gaps.items()}


def _freedoms(linkage: Linkage, loose: Sequence[Movement], singular: bool, under_loads: bool) -> Iterator[str]:
    """Movements with all driven parts held: free if nothing is driven, else a freedom too many."""
    groups = floating(linkage)
    for group in groups:
        yield f"bodies.{listed(group)}: nothing joins {'it' if len(group) == 1 else 'them'} to the ground"
    hanging = [name for group in groups for name in group]
    loose = [one for one in loose if not set(one.bodies) <= set(hanging)]
    if not loose:
        return
    ways = "; ".join(one.said() for one in loose)
    count = "one way" if len(loose) == 1 else f"{len(loose)} ways"
    if singular:
        yield (
            f"the start posture is a dead centre, in which it can move in {count} for a moment: {ways}; no "
            "way of a drive is computed; start it a little beside"
        )
    elif under_loads:
        yield f"it moves under its loads in {count}: {ways}"
    elif not linkage.driven:
        yield f"it moves freely in {count}: {ways}"
    else:
        verb = "degree of freedom is" if len(loose) == 1 else "degrees of freedom are"
        yield (
            f"{len(loose)} {verb} left with all driven parts held: {ways}; no static forces; does a pin, a "
            "crank or an actuator miss?"
        )


def _way_facts(way: DriveWay) -> Iterator[str]:
    """How far driven parts move the linkage, and where parts turn back on the way."""
    low, high = (way.shown(end) for end in way.ends)
    if way.right_round:
        yield f"{way.drive}: turns right round, without a dead centre"
    else:
        without = "" if way.locks else " without a dead centre"
        yield f"{way.drive}: moves from {low:.2f} to {high:.2f} {way.unit}{without}"
    for one in way.points:
        if one.what == "turns back":
            yield f"{way.at(one.travel)}: {one.part} turns back{_why(one.why)}"
    for end, limit in zip(way.ends, way.beyond, strict=True):
        if limit is not None:
            yield _limit(way, end, limit.travel, limit.why)


def _way_warnings(way: DriveWay) -> Iterator[str]:
    for one in way.points:
        if one.what == "dead centre":
            yield f"{way.at(one.travel)}: dead centre{_why(one.why)}; the linkage locks or opens there"
        if one.what == "change point":
            yield (
                f"{way.at(one.travel)}: change point{_why(one.why)}; from there the linkage could go on in "
                "another way"
            )
    for end, limit in zip(way.ends, way.beyond, strict=True):
        if limit is not None and not way.locks and abs(limit.travel - end) < NEAR:
            yield _limit(way, end, limit.travel, limit.why)


def _limit(way: DriveWay, end: float, travel: float, why: str) -> str:
    """The dead centre beyond an end of a way in a sentence."""
    side = "above" if travel >= end else "below"
    return (
        f"{1e3 * abs(travel - end):.1f} mm of travel {side} the used range: dead centre{_why(why)} "
        f"({way.at(travel)})"
    )


def _why(reason: str) -> str:
    return f": {reason}" if reason else ""


def _poor_angles(way: DriveWay, angles: Sequence[TransmissionAngle]) -> Iterator[str]:
    """Warnings of transmission angles that come near a straight line on a way."""
    least = math.degrees(LEAST)
    for one in angles:
        if one.worst < LEAST:
            yield (
                f"{one.said(way)}; {least:.0f} to {180.0 - least:.0f} degrees are usual: nearer to a straight "
                "line forces grow, and play is felt"
            )


def _notes(
    data: MachineData, linkage: Linkage, ways: Sequence[DriveWay], stroke: float | None
) -> Iterator[str]:
    """Assumptions."""
    for said in data.assumed:
        yield f"assumed: {said}"
    if len(ways) > 1:
        yield "several parts are driven: the way of each is that with the others held where they start"
    tried = [way.drive for way in ways if way.drives[0] in linkage.actuators]
    if tried and stroke is None and data.stroke is None:
        yield (
            f"no stroke is known of {listed(tried)}: {100.0 * SHARE:.0f} % of the length at the start were "
            "tried"
        )


def _sources(data: MachineData) -> Iterator[str]:
    for name, said in data.sources.items():
        yield f"source of {name}: {said}"


# --- tables and numbers ---


def _sheets(ways: Sequence[DriveWay], numbers: Mapping[str, Any]) -> Iterator[CheckTable]:
    """Postures of a single way, and static forces over each way; numbers: of `_numbers`."""
    if not ways and numbers["stations"]:
        yield _forces("start", [("", numbers["stations"][0])])
    for way in ways:
        rows = [(f"{way.shown(one['travel']):.1f}", one) for one in numbers["drives"][way.drive]["stations"]]
        first = f"{way.label} [{way.unit}]"
        if len(ways) == 1:
            yield _postures(first, rows)
        yield _forces(first, rows)


def _postures(first: str, rows: Sequence[tuple[str, Mapping[str, Any]]]) -> CheckTable:
    one = rows[0][1]
    heads = [f"{name} {axis}" for name in one["points_m"] for axis in "xy"]
    heads += [*one["angles_rad"], *(f"{name} [mm]" for name in one["lengths_m"])]
    table = []
    for where, one in rows:
        cells = [f"{round(1e3 * x, 1) + 0.0:.1f}" for point in one["points_m"].values() for x in point]
        cells += [f"{round(math.degrees(angle), 2) + 0.0:.2f}" for angle in one["angles_rad"].values()]
        cells += [f"{1e3 * length:.1f}" for length in one["lengths_m"].values()]
        table.append((where, *cells))
    return CheckTable("postures: points [mm], bodies [degrees from +x]", (first, *heads), table)


def _forces(first: str, rows: Sequence[tuple[str, Mapping[str, Any]]]) -> CheckTable:
    title = (
        "static forces [N]; of actuators their push, of cranks and gears the moment [N m], of guides the force "
        "across"
    )
    table = []
    for where, one in rows:
        forces = {name: math.hypot(*force) for name, force in one["pins_N"].items()}
        cells = {**forces, **one["actuators_N"], **one["cranks_N_m"], **one["guides_N"], **one["gears_N_m"]}
        table.append((where, *(f"{force:.4g}" for force in cells.values())))
    return CheckTable(title, (first, *cells), table)


def _sourced(data: MachineData) -> Iterator[CheckTable]:
    """The numbers with a range or a source: a table for every source, with the keys of the file."""
    by_source: dict[str, list[tuple[str, ...]]] = {}
    for key, one in data.sourced.items():
        row = (key, *("-" if item is None else str(item) for item in (one.value, one.low, one.high)))
        by_source.setdefault(one.source or "their source is not said", []).append(row)
    for source, rows in by_source.items():
        yield CheckTable(f"numbers of the file: {source}", ("key", "value", "from", "to"), rows)


def _numbers(
    linkage: Linkage,
    ways: Sequence[DriveWay],
    transmission: Mapping[str, Sequence[TransmissionAngle]],
    start: Sequence[Moved],
    count: int,
) -> dict[str, Any]:
    """The ways of driven parts as plain data, or the start posture; count: of postures less one of a way."""
    drives = {
        way.drive: {
            **way.data(),
            "transmission_angles": [one.data() for one in transmission[way.drive]],
            "stations": [_data(linkage, one) for one in _stations(way, count)],
        }
        for way in ways
    }
    sole = ways[0] if len(ways) == 1 else None
    return {
        "drive": sole.drive if sole else "",
        "cranks": {name: {"body": one.body, "on": GROUND} for name, one in linkage.cranks.items()},
        "locks": any(way.locks for way in ways),
        "travel": list(sole.ends) if sole else [0.0, 0.0],
        "stations": drives[sole.drive]["stations"] if sole else [_data(linkage, one) for one in start],
        "drives": drives,
    }


def _posture(linkage: Linkage, one: Moved) -> dict[str, Any]:
    """Traced points, angles of bodies, lengths and angles of actuators in a posture."""
    closed = Conditions(linkage).kinetics
    points = {name: closed.point(one.position, it.body, it.point)[0] for name, it in linkage.points.items()}
    struts = {
        name: closed.point(one.position, it.head, it.head_point)[0]
        - closed.point(one.position, it.foot, it.foot_point)[0]
        for name, it in linkage.actuators.items()
    }
    turns = one.position[2::3].tolist()
    return {
        "points_m": {name: point.tolist() for name, point in points.items()},
        "angles_rad": {
            name: body.angle + turn for (name, body), turn in zip(linkage.bodies.items(), turns, strict=True)
        },
        "lengths_m": {name: float(np.hypot(*strut)) for name, strut in struts.items()},
        "actuators_rad": {name: math.atan2(strut[1], strut[0]) for name, strut in struts.items()},
    }


def _data(linkage: Linkage, one: Moved) -> dict[str, Any]:
    forces = one.forces
    return {
        "travel": one.travel,
        **_posture(linkage, one),
        "pins_N": {name: force.tolist() for name, force in forces.pins.items()},
        "actuators_N": forces.actuators,
        "cranks_N_m": forces.cranks,
        "guides_N": forces.slides,
        "gears_N_m": forces.gears,
    }
