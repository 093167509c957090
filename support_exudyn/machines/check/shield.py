"""The check of a shield support."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from support_exudyn.machines.check.plausibility import missing, suspicions
from support_exudyn.machines.check.report import CheckReport, CheckTable
from support_exudyn.machines.check.shield_stroke import (
    WANDER,
    Limit,
    Shield,
    Station,
    limit,
    stations,
    usual_stroke,
)
from support_exudyn.machines.check.statics import mobility
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.model.linkage import GROUND

RULE = "MT/T 556-1996, 4.6.4"
NEAR = 0.1  # [m] of height: so near to a dead centre one is warned
SHARP = math.radians(20.0)  # transmission angle below which pin forces grow out of hand
FLAT = math.radians(45.0)  # of a column to the floor
TILT = math.radians(1.0)  # of the canopy
STAGES = 1.9  # longest to shortest of a column with one stage
HELD = 0.05  # of the machine's weight: a pull below that is nothing to speak of
FINE = 101  # postures for the smallest and the largest


@dataclass(frozen=True)
class ShieldReport(CheckReport):
    """A check of a shield support.

    Arguments:
        machine: the support.
        fine: postures over the stroke, from the start on.
        limits: where its way ends "above" and "below" the used range; None: not near.
    """

    machine: Shield = field(repr=False)
    fine: Sequence[Station] = field(repr=False)
    limits: Mapping[str, Limit | None] = field(repr=False)


def check_shield(data: MachineData, machine: Shield, stroke: float | None) -> ShieldReport:
    """The report of a support before it is run; stroke: see `check_machine`."""
    used = stroke if stroke is not None else data.stroke if data.stroke is not None else usual_stroke(machine)
    fine = stations(machine, used, FINE)
    told = fine[:: (FINE - 1) // 10]
    free = mobility(machine.linkage())
    ends = (fine[0], fine[-1]) if fine[-1].posture.hinge[1] >= fine[0].posture.hinge[1] else (fine[-1], fine[0])
    limits = {"above": limit(machine, ends, True), "below": limit(machine, ends, False)}
    tips = [station.posture.tip[0] for station in fine]
    wander = max(tips) - min(tips)
    residual = max(station.residual for station in fine)
    error = max(station.forces.error for station in fine)
    facts = [
        free.said(),
        f"used range: hinge {_mm(ends[0].posture.hinge[1])} to {_mm(ends[1].posture.hinge[1])} mm, "
        f"tip {_mm(ends[0].posture.tip[1])} to {_mm(ends[1].posture.tip[1])} mm above the origin "
        f"(stroke {_mm(used)} mm)",
        f"closure: links and columns keep their lengths within {1e3 * residual:.1e} mm at {FINE} postures",
        f"tip wander: x from {_mm(min(tips))} to {_mm(max(tips))} mm, {_mm(wander)} mm; {RULE} allows "
        f"{_mm(WANDER)} mm: {'met' if wander <= WANDER else 'NOT met'}",
        *(_limit_said(where, found) for where, found in limits.items()),
        f"static forces: under weight alone, columns without mass; numerical error below {_bound(error)} kN",
    ]
    warnings = [*_warnings(machine, fine, used, wander, limits), *suspicions(data, machine)]
    sources = [f"source of {name}: {said}" for name, said in data.sources.items()]
    return ShieldReport(
        name=data.name,
        kind=data.kind,
        facts=facts,
        sheets=_sheets(machine, told),
        warnings=warnings,
        notes=[*missing(data, machine), *sources],
        numbers={
            "degrees_of_freedom": free.data(),
            "stroke_m": used,
            "tip_x_least_m": min(tips),
            "tip_x_largest_m": max(tips),
            "tip_wander_m": wander,
            "tip_wander_allowed_m": WANDER,
            "closure_residual_m": residual,
            "force_error_N": error,
            "dead_centres": {where: _limit_data(found) for where, found in limits.items()},
            "stations": [_station_data(station) for station in told],
        },
        machine=machine,
        fine=fine,
        limits=limits,
    )


# --- tables ---


def _sheets(machine: Shield, told: Sequence[Station]) -> list[CheckTable]:
    columns, pins = tuple(machine.STRUTS), tuple(machine.linkage().pins)

    def row(station: Station, *cells: str) -> tuple[str, ...]:
        return (_mm(station.stroke), _mm(station.posture.hinge[1]), *cells)

    posture = CheckTable(
        "posture, by stroke [mm] (angles from +x in degrees)",
        (
            *("stroke", "hinge y", "tip x", "tip y", "canopy", "rear_link", "front_link", "shield", *columns),
            *(f"{name} [mm]" for name in columns),
        ),
        [
            row(
                station,
                _mm(station.posture.tip[0]),
                _mm(station.posture.tip[1]),
                f"{math.degrees(station.posture.canopy):.3f}",
                *(_degrees(angle) for angle in station.links.values()),
                *(_degrees(station.columns[name]) for name in columns),
                *(_mm(station.lengths[name]) for name in columns),
            )
            for station in told
        ],
    )
    forces = CheckTable(
        "static forces [kN], columns: push, negative: pull; angles in pins: shield beam to link [degrees]",
        (*("stroke", "hinge y", *pins, *columns), *("angle rear_shield", "angle front_shield")),
        [
            row(
                station,
                *(_kilonewton(float(np.hypot(*station.forces.pins[name]))) for name in pins),
                *(_kilonewton(station.forces.actuators[name]) for name in columns),
                *(_degrees(station.transmission[pin]) for pin in ("rear_shield", "front_shield")),
            )
            for station in told
        ],
    )
    return [posture, forces]


def _mm(length: float) -> str:
    return f"{1e3 * length:.1f}"


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle):.2f}"


def _kilonewton(force: float) -> str:
    return f"{1e-3 * force:.2f}"


def _bound(error: float) -> str:
    """A force that is not exceeded [kN], rounded up to a power of ten."""
    return f"{10.0 ** math.ceil(math.log10(max(1e-3 * error, 1e-15))):.0e}"


def _limit_said(where: str, found: Limit | None) -> str:
    if found is None:
        return f"{where} the used range: no dead centre within three lengths of a column"
    return (
        f"{where} the used range: way ends at a hinge height of {_mm(found.height)} mm, "
        f"{_mm(found.margin)} mm away ({found.why})"
    )


def _limit_data(found: Limit | None) -> dict[str, Any] | None:
    if found is None:
        return None
    return {
        "hinge_height_m": found.height,
        "margin_m": found.margin,
        "stroke_m": found.stroke,
        "why": found.why,
    }


def _station_data(station: Station) -> dict[str, Any]:
    posture = station.posture
    return {
        "stroke_m": station.stroke,
        "hinge_y_m": posture.hinge[1],
        "tip_x_m": posture.tip[0],
        "tip_y_m": posture.tip[1],
        "canopy_rad": posture.canopy,
        "links_rad": station.links,
        "columns_rad": station.columns,
        "lengths_m": station.lengths,
        "transmission_rad": station.transmission,
        "pins_N": {name: force.tolist() for name, force in station.forces.pins.items()},
        "columns_N": station.forces.actuators,
    }


# --- warnings ---


def _warnings(
    machine: Shield, fine: Sequence[Station], stroke: float, wander: float, limits: dict[str, Limit | None]
) -> Iterator[str]:
    if wander > WANDER:
        yield f"the tip wanders {_mm(wander)} mm over the used height; {RULE} allows {_mm(WANDER)} mm"
    for where, found in limits.items():
        if found is not None and found.margin < NEAR:
            yield f"{_mm(found.margin)} mm {where} the used range the way ends: {found.why}"
    for pin in ("rear_shield", "front_shield"):
        worst = min(fine, key=lambda one: min(one.transmission[pin], math.pi - one.transmission[pin]))
        angle = worst.transmission[pin]
        if min(angle, math.pi - angle) < SHARP:
            yield (
                f"{pin}: link and shield beam are nearly in line ({_degrees(angle)} degrees at stroke "
                f"{_mm(worst.stroke)} mm); small errors of length move the shield far"
            )
    yield from _column_warnings(machine, fine)
    tilt = max(fine, key=lambda one: abs(one.posture.canopy))
    if abs(tilt.posture.canopy) > TILT:
        yield (
            f"the canopy tilts by {math.degrees(tilt.posture.canopy):.2f} degrees at stroke {_mm(tilt.stroke)} "
            "mm if the columns extend alike"
        )
    heights = [one.posture.hinge[1] for one in fine]
    if stroke > 0.0 and heights[-1] <= heights[0]:
        yield "extending the columns lowers the hinge: the four-bar is assembled the other way round"
    if any(one.crossed for one in fine):
        yield "rear and front link cross each other: are two pivots mixed up, or is it the other assembly?"


def _column_warnings(machine: Shield, fine: Sequence[Station]) -> Iterator[str]:
    weight = 9.81 * sum(part.mass for parts in machine.parts.values() for part in parts)
    for name, strut in machine.STRUTS.items():
        pulls = [one for one in fine if one.forces.actuators[name] < -HELD * weight]
        both = strut.foot[0] != GROUND  # a ram works both ways
        if pulls and not both:
            worst = min(pulls, key=lambda one: one.forces.actuators[name])
            yield (
                f"{name} pulls instead of pushing between stroke {_mm(pulls[0].stroke)} and "
                f"{_mm(pulls[-1].stroke)} mm, by up to {_kilonewton(-worst.forces.actuators[name])} kN"
            )
        slopes = [math.asin(abs(math.sin(one.columns[name]))) for one in fine]
        if not both and min(slopes) < FLAT:
            yield f"{name} stands at only {_degrees(min(slopes))} degrees to the floor"
        if not both and min(math.sin(one.columns[name]) for one in fine) <= 0.0:
            yield f"{name}: its head is below its foot"
        lengths = [one.lengths[name] for one in fine]
        ratio = max(lengths) / min(lengths)
        if ratio > STAGES:
            yield (
                f"{name} grows from {_mm(min(lengths))} to {_mm(max(lengths))} mm, {ratio:.2f} times as long; "
                f"a cylinder of one stage manages less than {STAGES:g} times"
            )
