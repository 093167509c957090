"""The check of any machine, by its linkage alone: mobility, closure, how far its drive moves it, statics."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from support_exudyn.machines.check.report import CheckReport, CheckTable
from support_exudyn.machines.check.statics import Array, Statics, mobility, statics
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.mechanics.kinetics import Kinetics, kinetics_of
from support_exudyn.mechanics.postures import missing
from support_exudyn.model.linkage import Linkage
from user_forces.values.value import InputError

STEPS, TOLD = 360, 12  # postures between the ends, and rows of the table less one
SHARE = 0.3  # of an actuator's length: its stroke if nothing is said
ITERATIONS = 20  # of Newton's method
CLOSED = 1e-10  # of the machine's size: largest gap of a posture that is found
NEAR = 8.0  # how much farther than by its start's speed a body may go in a step
SMALLEST = 2.0**-12  # part of a step at which the way is given up
OPEN = 1e-9  # of the machine's size: gap at the start that is told


@dataclass(frozen=True)
class Moved:
    """A posture: what the driven part has moved [rad] or [m], the bodies' coordinates (3 bodies,), forces."""

    travel: float
    position: Array
    forces: Statics


@dataclass(frozen=True)
class MachineReport(CheckReport):
    """A check of any machine.

    Arguments:
        linkage: the mechanism.
        moved: postures in the order of their travel; the start alone if it cannot be moved here.
        drive: name of the driven part that moves it; empty if there is none, or more than one.
    """

    linkage: Linkage = field(repr=False)
    moved: Sequence[Moved] = field(repr=False)
    drive: str = ""

    @property
    def turns(self) -> bool:
        """Whether what moves it is a crank."""
        return self.drive in self.linkage.cranks

    def said(self, travel: float) -> str:
        """A travel with its unit."""
        return f"{math.degrees(travel):.1f} degrees" if self.turns else f"{1e3 * travel:.1f} mm"


def check_any(data: MachineData, stroke: float | None) -> MachineReport:
    """The report of a machine that nothing but its linkage is known of.

    Arguments:
        data: the machine.
        stroke: by how much its actuator is extended [m]; by default three tenths of its length.

    Raises InputError if a stroke is asked for where no single actuator is driven.
    """
    linkage = data.machine.linkage()
    kinetics, free = kinetics_of(linkage), mobility(linkage)
    driven = linkage.driven
    drive = driven[0] if len(driven) == 1 and free.left == 0 else ""
    if stroke is not None and drive not in linkage.actuators:
        raise InputError(f"stroke = {stroke} m: no single actuator drives this machine; allowed: none")
    start = np.zeros(3 * len(linkage.bodies))
    opened = {name: float(np.hypot(*kinetics.relative(start, pin)[0])) for name, pin in linkage.pins.items()}
    facts = [free.said()]
    if linkage.pins:
        facts.append(f"closure at the start: pins within {1e3 * max(opened.values()):.1e} mm")
    warnings = [
        f"pins.{name}: its two points are {1e3 * gap:.3g} mm apart at the start"
        for name, gap in opened.items()
        if gap > OPEN * _size(kinetics)
    ]
    notes = [f"assumed: {said}" for said in data.assumed]
    moved, ends = [Moved(0.0, start, statics(linkage, start))], (0.0, 0.0)
    goal = ends
    if free.left:
        warnings.append(
            f"{free.left} degrees of freedom are left with all driven parts held: no static forces; "
            "does a pin, a crank or an actuator miss?"
        )
    elif not drive:
        notes.append(
            f"driven parts: {len(driven)}; with one alone it would be moved, so here is its start posture"
        )
    else:
        goal = _goals(linkage, drive, stroke)
        moved, ends = _way(kinetics, drive, goal)
    report = MachineReport(
        name=data.name,
        kind=data.kind,
        facts=facts,
        sheets=[],
        warnings=warnings,
        notes=notes,
        numbers={},
        linkage=linkage,
        moved=moved,
        drive=drive,
    )
    locked = bool(drive) and not any(math.isclose(end, one) for end in ends for one in goal if one)
    if locked:
        where = " and ".join(report.said(end) for end in ends if end)
        warnings.append(f"{drive}: the linkage locks or opens {where} from the start: a dead centre")
    elif drive:
        way = "turns right round" if report.turns else f"extends by {report.said(ends[1] or ends[0])}"
        facts.append(f"{drive}: {way}, without a dead centre")
    sheets = []
    if not free.left:
        error = max(one.forces.error for one in moved)
        facts.append(f"static forces: under weight alone; numerical error below {max(error, 1e-12):.0e} N")
        sheets.append(_sheet(report))
    numbers = {
        "degrees_of_freedom": free.data(),
        "closure_m": opened,
        "drive": drive,
        "locks": locked,
        "travel": list(ends),
        "stations": [] if free.left else [_data(one) for one in _told(moved)],
    }
    return replace(report, sheets=sheets, numbers=numbers)


def _size(kinetics: Kinetics) -> float:
    linkage = kinetics.linkage
    points = [body.centre for body in linkage.bodies.values()]
    points += [pin.first_point for pin in linkage.pins.values()]
    return max(float(np.ptp(np.array(points), axis=0).max()), 1e-9)


def _goals(linkage: Linkage, drive: str, stroke: float | None) -> tuple[float, float]:
    """Ends of the travel that is tried, downwards and upwards: a revolution each, or a stroke."""
    if drive in linkage.cranks:
        return -2.0 * math.pi, 2.0 * math.pi
    stroke = SHARE * linkage.actuators[drive].start_length if stroke is None else stroke
    return min(0.0, stroke), max(0.0, stroke)


def _way(kinetics: Kinetics, drive: str, goal: tuple[float, float]) -> tuple[list[Moved], tuple[float, float]]:
    """Postures in the order of their travel, and the ends that were reached.

    A crank that turns right round one way need not be turned the other.
    """
    start = np.zeros(3 * len(kinetics.bodies))

    def forces(travel: float, position: Array) -> Moved:
        return Moved(travel, position, statics(kinetics.linkage, position))

    up = [forces(*one) for one in _march(kinetics, drive, goal[1], start)]
    end = up[-1].travel if up else 0.0
    down: list[Moved] = []
    if not (goal[1] and math.isclose(end, goal[1])):
        down = [forces(*one) for one in _march(kinetics, drive, goal[0], start)]
    low = down[-1].travel if down else 0.0
    return [*down[::-1], forces(0.0, start), *up], (low, end)


def _march(kinetics: Kinetics, drive: str, goal: float, start: Array) -> Iterator[tuple[float, Array]]:
    """Travel and coordinates, step by step as far as the linkage closes on the same way."""
    if goal == 0.0:
        return
    usual, reached, position = goal / STEPS, 0.0, start
    for number in range(1, STEPS + 1):
        wanted = goal * number / STEPS
        while reached != wanted:
            step = wanted - reached
            while (found := _closed(kinetics, drive, reached + step, position, step)) is None:
                step /= 2.0
                if abs(step) < SMALLEST * abs(usual):
                    if reached != goal * (number - 1) / STEPS:
                        yield reached, position
                    return
            reached, position = (wanted if step == wanted - reached else reached + step), found
        yield reached, position


def _closed(kinetics: Kinetics, drive: str, travel: float, near: Array, step: float) -> Array | None:
    """The posture for a travel near another one, by Newton's method; None if there is none."""
    position, size = near.copy(), _size(kinetics)
    rates = kinetics.rates(lambda name: 1.0 if name == drive else 0.0)
    speed = np.linalg.lstsq(kinetics.rows(near), rates, rcond=None)[0]
    scale = np.tile([1.0 / size, 1.0 / size, 1.0], len(kinetics.bodies))
    position += speed * step
    for _ in range(ITERATIONS):
        short = missing(kinetics, position, {}, {drive: travel})
        if np.abs(short).max() < CLOSED * size:
            turned = float(np.abs(scale * (position - near)).max())
            at_first = abs(step) if drive in kinetics.linkage.cranks else abs(step) / size
            usual = float(np.abs(scale * speed).max()) * abs(step)
            return position if turned <= NEAR * at_first + 1.5 * min(usual, 0.05) else None
        position = position + np.linalg.lstsq(kinetics.rows(position), short, rcond=None)[0]
    return None


def _told(moved: Sequence[Moved]) -> list[Moved]:
    """Those of a table: the first, the last, and some between."""
    chosen = dict.fromkeys(round(n) for n in np.linspace(0, len(moved) - 1, min(len(moved), TOLD + 1)))
    return [moved[n] for n in chosen]


def _sheet(report: MachineReport) -> CheckTable:
    linkage, unit = report.linkage, "degrees" if report.turns else "mm"
    held = (*linkage.actuators, *linkage.cranks, *linkage.slides, *linkage.gears)
    title = (
        "static forces [N]; of actuators their push, of cranks and gears the moment [N m], of guides the force "
        "across"
    )
    rows = []
    for one in _told(report.moved):
        forces = {**one.forces.actuators, **one.forces.cranks, **one.forces.slides, **one.forces.gears}
        rows.append(
            (
                f"{math.degrees(one.travel) if report.turns else 1e3 * one.travel:.1f}",
                *(f"{float(np.hypot(*one.forces.pins[name])):.4g}" for name in linkage.pins),
                *(f"{forces[name]:.4g}" for name in held),
            )
        )
    first = f"{report.drive} [{unit}]" if report.drive else "start"
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
