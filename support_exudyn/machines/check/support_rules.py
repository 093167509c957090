"""Rules for four-bar shield supports: tip, canopy, links and columns over the stroke; doubts about the file."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from support_exudyn.machines.check.drive_way import DriveWay
from support_exudyn.machines.four_bar_shield import FourBarShield
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND
from support_exudyn.model.plane_geometry import distance

RULE, WANDER = "MT/T 556-1996, 4.6.4", 0.080  # [m] that the tip may wander
FLAT = math.radians(45.0)  # of a column to the floor
TILT = math.radians(1.0)  # of the canopy
STAGES = 1.9  # longest to shortest of a column with one stage
HELD = 0.05  # of the machine's weight: a smaller pull is negligible
SMALL = 0.3  # [m] extent of a support: below, its pivots are perhaps in metres
LIGHT = 3.0  # [kg/m^3] mass over the cube of the extent: below, masses are perhaps in tonnes; it is 50 to 200
WIDE = 0.5  # of the distance of two pins of a body: the bores of both together


@dataclass(frozen=True)
class Findings:
    """Sentences and numbers of a check that concern a kind of machine alone, see `CheckReport`."""

    facts: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    numbers: dict[str, Any] = field(default_factory=dict)


def support_findings(data: MachineData, machine: FourBarShield, way: DriveWay) -> Findings:
    """The findings on a support.

    Arguments:
        data: the machine's file.
        machine: the support.
        way: of its columns, which extend alike.
    """
    tip = way.motion.place("canopy", way.linkage.points["tip"].point)[:, 0]
    wander, allowed = float(np.ptp(tip)), f"{RULE} allows {_mm(WANDER)} mm"
    met = "met" if wander <= WANDER else "NOT met"
    doubts = [f"the tip wanders {_mm(wander)} mm over the used height; {allowed}"] * (wander > WANDER)
    doubts += _posture_doubts(way)
    for name in machine.STRUTS:
        doubts += _column_doubts(way, name)
    return Findings(
        facts=[
            f"tip wander: x from {_mm(tip.min())} to {_mm(tip.max())} mm, {_mm(wander)} mm; {allowed}: {met}"
        ],
        warnings=[*doubts, *_file_doubts(data, machine)],
        notes=list(_missing(data, machine)),
        numbers={"tip_wander_m": wander, "tip_wander_allowed_m": WANDER},
    )


def _posture_doubts(way: DriveWay) -> Iterator[str]:
    """Warnings on canopy, hinge and links over the stroke."""
    motion, pins = way.motion, way.linkage.pins
    tilt = motion.turn("canopy")
    worst = int(np.argmax(np.abs(tilt)))
    if abs(tilt[worst]) > TILT:
        yield (
            f"the canopy tilts by {math.degrees(tilt[worst]):.2f} degrees at stroke "
            f"{_mm(way.moved[worst].travel)} mm if the columns extend alike"
        )
    heights = motion.place("canopy", pins["shield_canopy"].second_point)[:, 1]
    if way.ends[1] > way.ends[0] and heights[-1] <= heights[0]:
        yield "extending the columns lowers the hinge: the four-bar is assembled the other way round"
    b, a = (np.array(pins[name].first_point) for name in ("rear_base", "front_base"))
    c, d = (motion.place("shield", pins[name].second_point) for name in ("rear_shield", "front_shield"))
    if np.any((_turn(b, c, a) * _turn(b, c, d) < 0.0) & (_turn(a, d, b) * _turn(a, d, c) < 0.0)):
        yield "rear and front link cross each other: are two pivots mixed up, or is it the other assembly?"


def _turn(start: Series, end: Series, point: Series) -> Series:
    """Positive where a point lies left of the line from start to end, (2,) or (n, 2) each."""
    (x, y), (u, v) = np.transpose(end - start), np.transpose(point - start)
    return np.asarray(x * v - y * u)


def _column_doubts(way: DriveWay, name: str) -> Iterator[str]:
    """Warnings on a column over the stroke: pull, slope and length."""
    strut = way.linkage.actuators[name]
    x, rise = way.motion.span(strut).T
    lengths = np.hypot(x, rise)
    if strut.foot == GROUND:  # a ram works both ways
        weight = 9.81 * sum(body.mass for body in way.linkage.bodies.values())
        pushes = [one.forces.actuators[name] for one in way.moved]
        pulls = [one.travel for one, push in zip(way.moved, pushes, strict=True) if push < -HELD * weight]
        if pulls:
            yield (
                f"{name} pulls instead of pushing between stroke {_mm(pulls[0])} and {_mm(pulls[-1])} mm, by "
                f"up to {-1e-3 * min(pushes):.2f} kN"
            )
        slope = math.asin(float(np.min(np.abs(rise) / lengths)))
        if slope < FLAT:
            yield f"{name} stands at only {math.degrees(slope):.2f} degrees to the floor"
        if rise.min() <= 0.0:
            yield f"{name}: its head is below its foot"
    ratio = float(lengths.max() / lengths.min())
    if ratio > STAGES:
        yield (
            f"{name} grows from {_mm(lengths.min())} to {_mm(lengths.max())} mm, {ratio:.2f} times as long; a "
            f"cylinder of one stage manages less than {STAGES:g} times"
        )


def _file_doubts(data: MachineData, machine: FourBarShield) -> Iterator[str]:
    """Warnings on units and bores, with the keys of the file."""
    pivots = {name: point for name in machine.pivots() if (point := getattr(machine, name)) is not None}
    size = float(np.ptp(list(pivots.values()), axis=0).max())
    if size < SMALL:
        yield f"pivots_mm: they lie within {1e3 * size:.3g} mm; are they given in metres?"
    total = sum(part.mass for parts in machine.parts.values() for part in parts)
    if total < LIGHT * size**3:
        yield f"masses: {total:.4g} kg in all is little for a support of {size:.2g} m; are they in tonnes?"
    places = {**pivots, "shield_canopy": machine.hinge}
    for one, other in (
        ("rear_base", "rear_shield"),
        ("front_base", "front_shield"),
        ("rear_shield", "front_shield"),
        ("rear_shield", "shield_canopy"),
    ):
        radii = sum(data.bore_radii[name] for name in (one, other) if name in data.bore_radii)
        apart = distance(places[one], places[other])
        if radii > WIDE * apart:
            yield (
                f"bore_radius_mm: those of {one} and {other} are {1e3 * radii:.3g} mm together, and the pins "
                f"{1e3 * apart:.4g} mm apart; are they diameters?"
            )


def _missing(data: MachineData, machine: FourBarShield) -> Iterator[str]:
    """Notes on what cannot be done for want of data."""
    if not data.bore_radii:
        yield "no [bore_radius_mm]: a scenario that gives a pin a clearance has to say its bore's radius"
    if machine.widths() is None:
        yield "no [width_mm]: it can be run in its plane only"
    if without := [name for name in machine.STRUTS if name not in data.actuators]:
        yield f"no [columns.{without[0]}]: {' and '.join(without)} cannot be modelled as two bodies"


def _mm(length: float) -> str:
    return f"{1e3 * length:.1f}"
