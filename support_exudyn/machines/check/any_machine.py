"""The check of any machine, by its linkage alone: mobility, closure, the way of each drive, statics."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
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
from support_exudyn.machines.check.statics import DegreesOfFreedom, mobility, statics
from support_exudyn.machines.check.transmission import (
    DEFINITION,
    LEAST,
    TransmissionAngle,
    transmission_angles,
)
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.mechanics.closing import Conditions, beside
from support_exudyn.mechanics.continuation import conditions_of
from support_exudyn.model.linkage import GROUND, Linkage
from support_exudyn.model.loads.load import ActingLoad
from user_forces.values.value import InputError

STEPS, TOLD = 180, 12  # postures to each end of a way, and rows of its table less one
STEPS_OF_SEVERAL, TOLD_OF_SEVERAL = 60, 6  # the same where several parts are driven
SHARE = 0.3  # of an actuator's length: its stroke either way if nothing is said
OPEN = 1e-9  # of the machine's size: gap at the start that is told


@dataclass(frozen=True)
class MachineReport(CheckReport):
    """A check of any machine.

    Arguments:
        linkage: the mechanism.
        start: its start posture, with the forces there.
        loads: that act on it besides its weight, by name.
        ways: of each driven part, the others held; none where driven parts do not determine the posture.
        transmission: angles of these ways, by driven part.
        loose: ways in which it can move with all driven parts held.
        blocks: length along and height across of what slides in a guide [m], by guide.
    """

    linkage: Linkage = field(repr=False)
    start: Moved = field(repr=False)
    loads: Mapping[str, ActingLoad] = field(repr=False)
    ways: Sequence[DriveWay] = field(repr=False)
    transmission: Mapping[str, Sequence[TransmissionAngle]] = field(repr=False)
    loose: Sequence[Movement] = field(repr=False)
    blocks: Mapping[str, tuple[float, float]] = field(repr=False)


@dataclass(frozen=True)
class _Found:
    """What has been found out about a machine, before it is put in words.

    Arguments:
        data: the machine. tried: stroke that is asked for or that the file says [m], if any.
        linkage: the mechanism. conditions: of it. free: its mobility. again: conditions that repeat others.
        loose: ways in which it moves with all driven parts held; singular: they end beside the start posture.
        opened: how far the two points of each pin are apart at the start [m].
        ways: of driven parts. angles: transmission angles of them. stations: postures that are told of them.
        at_rest: the start posture.
    """

    data: MachineData
    tried: float | None
    linkage: Linkage
    conditions: Conditions
    free: DegreesOfFreedom
    again: Sequence[RepeatedConditions]
    loose: Sequence[Movement]
    singular: bool
    opened: Mapping[str, float]
    ways: Sequence[DriveWay]
    angles: Mapping[str, Sequence[TransmissionAngle]]
    stations: Mapping[str, Sequence[Moved]]
    at_rest: Moved

    @property
    def loads(self) -> Mapping[str, ActingLoad]:
        """Loads that act on it besides its weight, by name."""
        return self.data.machine.loads

    @property
    def sole(self) -> DriveWay | None:
        """The way of the driven part, if there is one alone."""
        return self.ways[0] if len(self.ways) == 1 else None


def check_any(data: MachineData, stroke: float | None) -> MachineReport:
    """The report of a machine that nothing but its linkage is known of.

    Arguments:
        data: the machine.
        stroke: by how much its actuator is extended [m]; by default what the file says, else three tenths of
            its length either way.

    Raises InputError if a stroke is asked for where no single actuator is driven.
    """
    found = _find(data, stroke)
    facts, warnings = _said(found)
    if found.loose or found.ways:
        sheets = [_sheet(way, found.stations[way.drive]) for way in found.ways]
    else:
        sheets = [_table(found.linkage, "start", [("", found.at_rest)])]
    return MachineReport(
        name=data.name,
        kind=data.kind,
        facts=facts,
        sheets=sheets,
        warnings=warnings,
        notes=list(_notes(data, found.linkage, found.ways, stroke)),
        numbers=_numbers(found),
        linkage=found.linkage,
        start=found.at_rest,
        loads=found.loads,
        ways=found.ways,
        transmission=found.angles,
        loose=found.loose,
        blocks=data.blocks,
    )


def _find(data: MachineData, stroke: float | None) -> _Found:
    """Find out all that `check_any` tells. Arguments, and what is raised, as there."""
    linkage, loads = data.machine.linkage(), data.machine.loads
    driven = linkage.driven
    if stroke is not None and not (len(driven) == 1 and driven[0] in linkage.actuators):
        raise InputError(f"stroke = {stroke} m: no single actuator drives this machine; allowed: none")
    conditions = conditions_of(linkage)
    start = np.zeros(3 * len(linkage.bodies))
    loose = movements(conditions, start)
    aside = beside(conditions, [one.rates * conditions.arms for one in loose])
    singular = len(movements(conditions, aside)) < len(loose)
    again = repeated(conditions, aside if singular else start)
    several, tried = len(driven) > 1, stroke or data.stroke
    steps, told = (STEPS_OF_SEVERAL, TOLD_OF_SEVERAL) if several else (STEPS, TOLD)
    ways = []
    if not loose and not any(one.driven for one in again):
        ways = [way_of(conditions, one, _goal(linkage, one, tried), steps, loads) for one in driven]
    return _Found(
        data=data,
        tried=tried,
        linkage=linkage,
        conditions=conditions,
        free=mobility(linkage),
        again=again,
        loose=loose,
        singular=singular,
        opened={
            name: float(np.hypot(*conditions.kinetics.relative(start, pin)[0]))
            for name, pin in linkage.pins.items()
        },
        ways=ways,
        angles={way.drive: list(transmission_angles(conditions, way)) for way in ways},
        stations={way.drive: _told(way, told) for way in ways},
        at_rest=Moved(0.0, start, statics(linkage, start, loads=loads)),
    )


def _said(found: _Found) -> tuple[list[str], list[str]]:
    """What has been found out, in words: facts and warnings."""
    facts, warnings = [found.free.said()], []
    if found.opened:
        facts.append(f"closure at the start: pins within {1e3 * max(found.opened.values()):.1e} mm")
    warnings += [
        f"pins.{name}: its two points are {1e3 * gap:.3g} mm apart at the start"
        for name, gap in found.opened.items()
        if gap > OPEN * found.conditions.size
    ]
    warnings += [_repeats(one) for one in found.again]
    acted = {body for name, one in found.loads.items() for body in (one.body, one.against(name))}
    under_loads = bool(found.loads) and all(set(one.bodies) & acted for one in found.loose)
    freedoms = _freedoms(found.conditions, found.loose, found.singular, under_loads)
    warned = found.singular or (found.linkage.driven and not under_loads)
    (warnings if warned else facts).extend(freedoms)
    moved = [one for way in found.ways for one in way.moved] or ([] if found.loose else [found.at_rest])
    more, doubts = of_joints(found.linkage, moved)
    facts += more
    warnings += [*found.data.warnings, *doubts]
    for way in found.ways:
        facts += [*_way_facts(way), *(one.said(way) for one in found.angles[way.drive])]
        warnings += [*_way_warnings(way), *_poor_angles(way, found.angles[way.drive])]
    if any(found.angles.values()):
        facts.append(DEFINITION)
    if not found.loose:
        facts.append(_under(moved, list(found.loads)))
    return facts, warnings


def _numbers(found: _Found) -> dict[str, Any]:
    """What has been found out, as plain data."""
    sole = found.sole
    shown = found.stations[sole.drive] if sole else [found.at_rest]
    known_stroke = found.tried is not None and not found.linkage.cranks
    return {
        "degrees_of_freedom": found.free.data(),
        "closure_m": found.opened,
        "repeated_conditions": [[f"{kind}.{name}" for kind, name in one.parts] for one in found.again],
        "movements": [one.data() for one in found.loose],
        "drive": sole.drive if sole else "",
        "cranks": {name: {"body": one.body, "on": GROUND} for name, one in found.linkage.cranks.items()},
        **({"stroke_m": found.tried} if known_stroke else {}),
        "locks": any(way.locks for way in found.ways),
        "travel": list(sole.ends) if sole else [0.0, 0.0],
        "stations": [] if found.loose else [_data(one) for one in shown],
        "drives": {
            way.drive: _drive(way, found.angles[way.drive], found.stations[way.drive]) for way in found.ways
        },
    }


def _poor_angles(way: DriveWay, angles: Sequence[TransmissionAngle]) -> Iterator[str]:
    """Warnings of transmission angles that come near a straight line on a way."""
    least = math.degrees(LEAST)
    for one in angles:
        if one.worst < LEAST:
            yield (
                f"{one.said(way)}; {least:.0f} to {180.0 - least:.0f} degrees are usual: nearer to a straight "
                "line forces grow, and play is felt"
            )


def _under(moved: Sequence[Moved], loads: Sequence[str]) -> str:
    """Under what the static forces are, and their numerical error."""
    error = float(np.median([one.forces.error for one in moved]))  # at a dead centre forces have no bound
    under = f"weight and {listed(loads)}, once come on" if loads else "weight alone"
    return f"static forces: under {under}; numerical error below {max(error, 1e-12):.0e} N"


def _drive(way: DriveWay, angles: Sequence[TransmissionAngle], stations: Sequence[Moved]) -> dict[str, Any]:
    """The way of a driven part as plain data."""
    return {
        **way.data(),
        "transmission_angles": [one.data() for one in angles],
        "stations": [_data(one) for one in stations],
    }


def _goal(linkage: Linkage, drive: str, stroke: float | None) -> tuple[float, float]:
    """Ends of the travel that is tried, downwards and upwards: a revolution each, or a stroke."""
    if drive in linkage.cranks:
        return -TURN, TURN
    if stroke is None:
        share = SHARE * linkage.actuators[drive].start_length
        return -share, share
    return min(0.0, stroke), max(0.0, stroke)


def _repeats(one: RepeatedConditions) -> str:
    return one.said() + ("" if one.driven else f"; {SHARED}")


def _freedoms(
    conditions: Conditions, loose: Sequence[Movement], singular: bool, under_loads: bool
) -> Iterator[str]:
    """What can move with all driven parts held: of itself if nothing is driven, else a freedom too many."""
    linkage = conditions.linkage
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
            "way of a drive is told; start it a little beside"
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
    """How far a driven part moves the linkage, and where parts turn back on its way."""
    low, high = (way.shown(end) for end in way.ends)
    if way.right_round:
        yield f"{way.drive}: turns right round, without a dead centre"
    elif way.locks:
        yield f"{way.drive}: moves from {low:.2f} to {high:.2f} {way.unit}"
    else:
        yield f"{way.drive}: moves from {low:.2f} to {high:.2f} {way.unit} without a dead centre"
    for one in way.points:
        why = f": {one.why}" if one.why else ""
        if one.what == "turns back":
            yield f"{way.at(one.travel)}: {one.part} turns back{why}"


def _way_warnings(way: DriveWay) -> Iterator[str]:
    for one in way.points:
        why = f": {one.why}" if one.why else ""
        if one.what == "dead centre":
            yield f"{way.at(one.travel)}: dead centre{why}; the linkage locks or opens there"
        if one.what == "change point":
            yield f"{way.at(one.travel)}: change point{why}; from there the linkage could go on in another way"


def _notes(
    data: MachineData, linkage: Linkage, ways: Sequence[DriveWay], stroke: float | None
) -> Iterator[str]:
    """What was assumed, and what is not known."""
    for said in data.assumed:
        yield f"assumed: {said}"
    if len(ways) > 1:
        yield "several parts are driven: the way of each is that with the others held where they start"
    tried = [way.drive for way in ways if way.drive in linkage.actuators]
    if tried and stroke is None and data.stroke is None:
        yield (
            f"no stroke is said of {listed(tried)}: {100.0 * SHARE:.0f} % of the length at the start were "
            "tried either way"
        )
    for name, said in data.sources.items():
        yield f"source of {name}: {said}"


def _told(way: DriveWay, count: int) -> list[Moved]:
    """Those of a table: the first, the last, and some between."""
    near = 1e-6 * (way.ends[1] - way.ends[0])
    singular = [one.travel for one in way.points if one.what != "turns back"]  # where forces have no bound
    moved = [one for one in way.moved if all(abs(one.travel - end) > near for end in singular)] or way.moved
    chosen = dict.fromkeys(round(n) for n in np.linspace(0, len(moved) - 1, min(len(moved), count + 1)))
    return [moved[n] for n in chosen]


def _sheet(way: DriveWay, told: Sequence[Moved]) -> CheckTable:
    rows = [(f"{way.shown(one.travel):.1f}", one) for one in told]
    return _table(way.linkage, f"{way.drive} [{way.unit}]", rows)


def _table(linkage: Linkage, first: str, told: Sequence[tuple[str, Moved]]) -> CheckTable:
    held = (*linkage.actuators, *linkage.cranks, *linkage.slides, *linkage.gears)
    title = (
        "static forces [N]; of actuators their push, of cranks and gears the moment [N m], of guides the force "
        "across"
    )
    rows = []
    for where, one in told:
        forces = {**one.forces.actuators, **one.forces.cranks, **one.forces.slides, **one.forces.gears}
        rows.append(
            (
                where,
                *(f"{float(np.hypot(*one.forces.pins[name])):.4g}" for name in linkage.pins),
                *(f"{forces[name]:.4g}" for name in held),
            )
        )
    return CheckTable(title, (first, *linkage.pins, *held), rows)


def _data(one: Moved) -> dict[str, Any]:
    forces = one.forces
    return {
        "travel": one.travel,
        "pins_N": {name: force.tolist() for name, force in forces.pins.items()},
        "actuators_N": forces.actuators,
        "cranks_N_m": forces.cranks,
        "guides_N": forces.slides,
        "gears_N_m": forces.gears,
    }
