"""How hard clearance pins are pressed, as a table: what `show`, `check` and the page of a run tell."""

import math
from collections.abc import Sequence
from typing import Any

from support_exudyn.files.own_modules import with_known_laws
from support_exudyn.postprocessing.figures.units import said
from support_exudyn.scenario.pin_pressure import PressedPin, pressed_pin
from support_exudyn.simulation.result import Result

HEADER: tuple[str, ...] = (
    "pin",
    ">force",
    ">peak pressure",
    ">of first yield",
    ">half angle",
    ">depth",
    ">stiffness",
    "contact",
)
STATIC = "clearance pins under their static load, start posture"
LARGEST = "clearance pins under their largest force"
DIGITS = 3  # of numbers of a theory that neglects edges, friction and roughness


def hardest_pressed(result: Result) -> list[PressedPin]:
    """Every clearance pin of a run under its largest force at any step."""
    pins, forces = with_known_laws(result.scenario.clearance_pins), result.largest_force
    return [
        pressed_pin(result.scenario.machine, name, pin, forces[name])
        for name, pin in pins.items()
        if name in forces
    ]


def rows(pins: Sequence[PressedPin]) -> list[tuple[str, ...]]:
    """Pin, force, pressure, its share of first yield, half contact angle, depth, stiffness, kind of contact."""
    return [
        (
            one.name,
            said(one.force, "N", DIGITS),
            "" if one.line is None else said(one.line.peak_pressure, "Pa", DIGITS),
            "" if math.isnan(one.yield_share) else f"{100.0 * one.yield_share:.{DIGITS}g} %",
            "" if one.line is None else f"{math.degrees(one.line.half_angle):.{DIGITS}g}°",
            said(one.depth, "m", DIGITS) if math.isfinite(one.depth) else "",
            f"{one.stiffness / 1e9:.{DIGITS}g} MN/mm" if math.isfinite(one.stiffness) else "",
            _kind(one),
        )
        for one in pins
    ]


def data(pins: Sequence[PressedPin]) -> list[dict[str, Any]]:
    """How hard each pin is pressed, as plain data in SI; what is not known is None."""
    return [
        {
            "pin": one.name,
            "force_N": one.force,
            "length_m": one.length,
            "peak_pressure_Pa": None if one.line is None else one.line.peak_pressure,
            "share_of_first_yield": _known(one.yield_share),
            "half_angle_rad": None if one.line is None else one.line.half_angle,
            "depth_m": _known(one.depth),
            "stiffness_N_per_m": _known(one.stiffness),
            "conformal": None if one.line is None else one.line.conformal,
        }
        for one in pins
    ]


def _known(number: float) -> float | None:
    return number if math.isfinite(number) else None


def warnings(pins: Sequence[PressedPin]) -> list[str]:
    """What yields, in sentences."""
    return [one.warning for one in pins if one.warning]


def _kind(one: PressedPin) -> str:
    if one.line is None:
        return "length unknown" if one.length is None else "beyond the theory"
    return "conformal" if one.line.conformal else "line"
