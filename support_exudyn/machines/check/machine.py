"""The check of a machine by its linkage: mobility, closure, the way of its driven parts, statics."""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from support_exudyn.machines.check.drive_way import TURN, DriveWay, Moved, WayPoint, way_of
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
STEPS_OF_SEVERAL = 60  # the same where several parts are driven
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
    linkage, loads = data.machine.linkage(), data.machine.loads
    support = data.machine if isinstance(data.machine, FourBarShield) else None
    driven = [(name,) for name in linkage.driven] if support is None else [support.alike]
    if stroke is not None and not (len(driven) == 1 and driven[0][0] in linkage.actuators):
        raise InputError(f"stroke = {stroke} m: no single actuator drives this machine; allowed: none")
    used = stroke or data.stroke or (support.usual_stroke if support else None)
    conditions = Conditions(linkage if support is None else support.led_linkage())
    freedoms = _freedoms_at_start(conditions)
    ways = []
    if freedoms.can_be_driven:
        steps = STEPS_OF_SUPPORTS if support else STEPS_OF_SEVERAL if len(driven) > 1 else STEPS
        farther = FARTHER * support.shortest_column if support else 0.0
        ways = [
            way_of(conditions, linkage, one, _goal(linkage, one[0], used), steps, loads, farther)
            for one in driven
        ]
    start = Moved(0.0, conditions.still, statics(linkage, conditions.still, loads=loads))
    balanced = [] if freedoms.loose else [start]
    moved = [one for way in ways for one in way.moved] or balanced
    transmission = {way.drive: list(transmission_angles(conditions, way)) for way in ways}
    found = support_findings(data, support, ways[0]) if support and ways else Findings()

    facts, warnings = _start_sentences(conditions, linkage, loads, freedoms)
    parts = [of_joints(linkage, moved), ([], data.warnings)]
    parts += [_way_sentences(way, transmission[way.drive]) for way in ways]
    for more, doubts in parts:
        facts, warnings = [*facts, *more], [*warnings, *doubts]
    if any(transmission.values()):
        facts.append(DEFINITION)
    facts += _force_facts(loads, moved)

    count = TOLD_OF_SUPPORTS if support else TOLD
    numbers = {
        "degrees_of_freedom": mobility(linkage).data(),
        "closure_m": _gaps(conditions, linkage),
        "movements": [one.data() for one in freedoms.loose],
        **_numbers(conditions, linkage, ways, transmission, balanced, count),
        "repeated_conditions": [[f"{kind}.{name}" for kind, name in one.parts] for one in freedoms.repeated],
        **({"stroke_m": used} if used is not None and not linkage.cranks else {}),
        **found.numbers,
        "file_numbers": {key: one.data() for key, one in data.sourced.items()},
    }
    return CheckReport(
        name=data.name,
        kind=data.kind or type(data.machine).__name__,
        facts=[*facts, *found.facts],
        sheets=[*_sheets(ways, numbers), *_sourced(data)],
        warnings=[*warnings, *found.warnings],
        notes=[
            *_notes(data, ways, stroke),
            *found.notes,
            *(f"source of {k}: {v}" for k, v in data.sources.items()),
        ],
        numbers=numbers,
        linkage=linkage,
        start=start,
        loads=loads,
        ways=ways,
        transmission=transmission,
    )


class _Freedoms(NamedTuple):
    """What joints and driven parts leave open in the start posture, or hold twice.

    Arguments:
        loose: movements with all driven parts held.
        singular: whether some of them end next to the start posture.
        repeated: conditions that repeat others, there or, if that posture is singular, next to it.
    """

    loose: Sequence[Movement]
    singular: bool
    repeated: Sequence[RepeatedConditions]

    @property
    def can_be_driven(self) -> bool:
        """Whether the driven parts alone decide where all bodies are, and do not hold each other."""
        return not self.loose and not any(one.driven for one in self.repeated)


def _freedoms_at_start(conditions: Conditions) -> _Freedoms:
    loose = movements(conditions, conditions.still)
    aside = beside(conditions, [one.rates * conditions.arms for one in loose])
    singular = len(movements(conditions, aside)) < len(loose)
    return _Freedoms(loose, singular, repeated(conditions, aside if singular else conditions.still))


def _goal(linkage: Linkage, drive: str, stroke: float | None) -> tuple[float, float]:
    """Ends of the travel that is tried, downwards and upwards: a revolution each, or a stroke."""
    if drive in linkage.cranks:
        return -TURN, TURN
    if stroke is None:
        share = SHARE * linkage.actuators[drive].start_length
        return -share, share
    return min(0.0, stroke), max(0.0, stroke)


def _gaps(conditions: Conditions, linkage: Linkage) -> dict[str, float]:
    """How far the two points of each pin are apart at the start [m]."""
    gaps = {name: conditions.kinetics.relative(conditions.still, pin)[0] for name, pin in linkage.pins.items()}
    return {name: float(np.hypot(*gap)) for name, gap in gaps.items()}


# --- sentences ---


def _start_sentences(
    conditions: Conditions, linkage: Linkage, loads: Mapping[str, ActingLoad], freedoms: _Freedoms
) -> tuple[list[str], list[str]]:
    """Facts and warnings on the start posture: degrees of freedom, closure, what repeats and what moves."""
    facts, gaps = [mobility(linkage).said()], _gaps(conditions, linkage)
    if gaps:
        facts.append(f"closure at the start: pins within {1e3 * max(gaps.values()):.1e} mm")
    warnings = [
        f"pins.{name}: its two points are {1e3 * gap:.3g} mm apart at the start"
        for name, gap in gaps.items()
        if gap > OPEN * conditions.size
    ]
    warnings += [one.said() + ("" if one.driven else f"; {SHARED}") for one in freedoms.repeated]
    acted = {body for name, one in loads.items() for body in (one.body, one.against(name))}
    under_loads = bool(loads) and all(set(one.bodies) & acted for one in freedoms.loose)
    warned = freedoms.singular or (linkage.driven and not under_loads)
    (warnings if warned else facts).extend(_freedoms(linkage, freedoms.loose, freedoms.singular, under_loads))
    return facts, warnings


def _freedoms(linkage: Linkage, loose: Sequence[Movement], singular: bool, under_loads: bool) -> Iterator[str]:
    """Movements with all driven parts held: free if nothing is driven, else a freedom too many."""
    groups = floating(linkage)
    for group in groups:
        yield f"bodies.{listed(group)}: nothing joins {'it' if len(group) == 1 else 'them'} to the ground"
    hanging = {name for group in groups for name in group}
    loose = [one for one in loose if not one.bodies.keys() <= hanging]
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


def _way_sentences(way: DriveWay, angles: Sequence[TransmissionAngle]) -> tuple[list[str], list[str]]:
    """Facts and warnings on how far driven parts move the linkage, and on its transmission angles."""
    low, high = (way.shown(end) for end in way.ends)
    without = "" if way.locks else " without a dead centre"
    facts, warnings = [f"{way.drive}: moves from {low:.2f} to {high:.2f} {way.unit}{without}"], []
    if way.right_round:
        facts = [f"{way.drive}: turns right round, without a dead centre"]
    for one in way.points:
        where = way.at(one.travel)
        if one.what == "turns back":
            facts.append(f"{where}: {one.part} turns back{one.reason}")
        elif one.what == "dead centre":
            warnings.append(f"{where}: dead centre{one.reason}; the linkage locks or opens there")
        else:
            warnings.append(
                f"{where}: change point{one.reason}; from there the linkage could go on in another way"
            )
    for end, limit in zip(way.ends, way.beyond, strict=True):
        if limit is not None:
            facts.append(_limit(way, end, limit))
            if not way.locks and abs(limit.travel - end) < NEAR:
                warnings.append(_limit(way, end, limit))
    least = math.degrees(LEAST)
    for angle in angles:
        facts.append(angle.said(way))
        if angle.worst < LEAST:
            warnings.append(
                f"{angle.said(way)}; {least:.0f} to {180.0 - least:.0f} degrees are usual: nearer to a "
                "straight line forces grow, and play is felt"
            )
    return facts, warnings


def _force_facts(loads: Mapping[str, ActingLoad], moved: Sequence[Moved]) -> Iterator[str]:
    """Under what the static forces of postures are, if there are any, and how exact."""
    if moved:
        error = float(np.median([one.forces.error for one in moved]))  # at a dead centre forces have no bound
        under = f"weight and {listed(list(loads))}, once come on" if loads else "weight alone"
        yield f"static forces: under {under}; numerical error below {max(error, 1e-12):.0e} N"


def _limit(way: DriveWay, end: float, limit: WayPoint) -> str:
    """The dead centre beyond an end of a way in a sentence."""
    side = "above" if limit.travel >= end else "below"
    return (
        f"{1e3 * abs(limit.travel - end):.1f} mm of travel {side} the used range: dead centre{limit.reason} "
        f"({way.at(limit.travel)})"
    )


def _notes(data: MachineData, ways: Sequence[DriveWay], stroke: float | None) -> Iterator[str]:
    """Assumptions."""
    yield from (f"assumed: {said}" for said in data.assumed)
    if len(ways) > 1:
        yield "several parts are driven: the way of each is that with the others held where they start"
    tried = [way.drive for way in ways if not way.turns]
    if tried and stroke is None and data.stroke is None:
        yield (
            f"no stroke is known of {listed(tried)}: {100.0 * SHARE:.0f} % of the length at the start were "
            "tried"
        )


# --- tables and numbers ---


def _sheets(ways: Sequence[DriveWay], numbers: Mapping[str, Any]) -> Iterator[CheckTable]:
    """Postures of a single way, and static forces over each way; numbers: of `_numbers`."""
    if not ways and numbers["stations"]:
        yield _forces("start", [("", numbers["stations"][0])])
    for way in ways:
        rows = [(f"{way.shown(one['travel']):.1f}", one) for one in numbers["drives"][way.drive]["stations"]]
        first = f"{way.label} [{way.unit}]"
        if len(ways) == 1:
            one = rows[0][1]
            heads = [f"{name} {axis}" for name in one["points_m"] for axis in "xy"]
            heads += [*one["angles_rad"], *(f"{name} [mm]" for name in one["lengths_m"])]
            table = []
            for where, one in rows:
                cells = [f"{round(1e3 * x, 1) + 0.0:.1f}" for point in one["points_m"].values() for x in point]
                cells += [f"{round(math.degrees(turn), 2) + 0.0:.2f}" for turn in one["angles_rad"].values()]
                cells += [f"{1e3 * length:.1f}" for length in one["lengths_m"].values()]
                table.append((where, *cells))
            yield CheckTable("postures: points [mm], bodies [degrees from +x]", (first, *heads), table)
        yield _forces(first, rows)


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
    conditions: Conditions,
    linkage: Linkage,
    ways: Sequence[DriveWay],
    transmission: Mapping[str, Sequence[TransmissionAngle]],
    start: Sequence[Moved],
    count: int,
) -> dict[str, Any]:
    """The ways of driven parts as plain data, or the start posture; count: of postures less one of a way."""
    drives = {}
    for way in ways:
        near = 1e-6 * (way.ends[1] - way.ends[0])
        singular = [one.travel for one in way.points if one.what != "turns back"]  # where forces have no bound
        moved = [one for one in way.moved if all(abs(one.travel - end) > near for end in singular)] or way.moved
        chosen = dict.fromkeys(round(n) for n in np.linspace(0, len(moved) - 1, min(len(moved), count + 1)))
        drives[way.drive] = {
            **way.data(),
            "transmission_angles": [one.data() for one in transmission[way.drive]],
            "stations": [_station(conditions, linkage, moved[n]) for n in chosen],
        }
    sole = ways[0] if len(ways) == 1 else None
    rest = [_station(conditions, linkage, one) for one in start]
    return {
        "drive": sole.drive if sole else "",
        "cranks": {name: {"body": one.body, "on": GROUND} for name, one in linkage.cranks.items()},
        "locks": any(way.locks for way in ways),
        "travel": list(sole.ends) if sole else [0.0, 0.0],
        "stations": drives[sole.drive]["stations"] if sole else rest,
        "drives": drives,
    }


def _station(conditions: Conditions, linkage: Linkage, one: Moved) -> dict[str, Any]:
    """Traced points, angles of bodies, lengths and angles of actuators in a posture, and the forces there."""
    motion, forces = conditions.kinetics.motion(one.position), one.forces
    struts = {name: motion.span(it)[0] for name, it in linkage.actuators.items()}
    turns = one.position[2::3].tolist()
    return {
        "travel": one.travel,
        "points_m": {name: motion.place(it.body, it.point)[0].tolist() for name, it in linkage.points.items()},
        "angles_rad": {
            name: body.angle + turn for (name, body), turn in zip(linkage.bodies.items(), turns, strict=True)
        },
        "lengths_m": {name: float(np.hypot(*strut)) for name, strut in struts.items()},
        "actuators_rad": {name: math.atan2(strut[1], strut[0]) for name, strut in struts.items()},
        "pins_N": {name: force.tolist() for name, force in forces.pins.items()},
        "actuators_N": forces.actuators,
        "cranks_N_m": forces.cranks,
        "guides_N": forces.slides,
        "gears_N_m": forces.gears,
    }
