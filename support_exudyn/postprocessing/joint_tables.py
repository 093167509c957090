"""What contacts, pins and legs are and did, as tables: laws, contact pressures, vibration, events of oil."""

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from support_exudyn.files.own_modules import NotImported, with_known_laws
from support_exudyn.postprocessing.figures.units import amount
from support_exudyn.postprocessing.result_table import ResultTable
from support_exudyn.scenario.pin_pressure import PressedPin, pressed_pin
from support_exudyn.scenario.pin_stability import PinOutlook
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.result import Result
from support_exudyn.simulation.slow_slip import FULL
from user_forces.catalogue import title
from user_forces.friction.law import FrictionLaw
from user_forces.friction.laws import Frictionless
from user_forces.normal.law import NormalLaw

DIGITS = 3  # of numbers of a theory that neglects edges, friction and roughness
STATIC = "clearance pins under their static load, start posture"
FILLED = "filled"  # what ends where a cavity begins, see `OilEvent`


# --- laws ---


def contact_lines(scenario: Scenario) -> list[str]:
    """A line for each kind of contact: its laws, the delivered restitution, and the joints that have it."""
    joints: dict[str, dict[str, None]] = {}  # names, each once, by what their contact is
    for place in scenario.contact_places.values():
        contact = place.contact
        parts = (_of_normal(contact.normal), _of_friction(contact.friction))
        joints.setdefault("; ".join(filter(None, parts)), {})[place.of] = None
    for name, law in scenario.friction_laws.items():
        joints.setdefault(f"ideal, {_of_friction(law)}", {})[name] = None
    return [f"{', '.join(names)}: {text}" for text, names in joints.items()]


def _of_normal(law: NormalLaw) -> str:
    """Name of a normal law, and the restitution that a free impact delivers."""
    damping = getattr(law, "damping", "")
    name = title(type(law)) + (f" ({damping})" if isinstance(damping, str) and damping else "")
    restitution, delivered = getattr(law, "restitution", None), getattr(law, "delivered_restitution", None)
    if delivered is None:
        return f"{name}, whose restitution depends on mass and speed"
    text = f"{name}, restitution {restitution:g} specified, {delivered:.3f} delivered"
    rest = getattr(law, "rest_velocity", None)
    return text if rest is None else f"{text} by free impacts faster than {1e3 * rest:g} mm/s"


def _of_friction(law: FrictionLaw) -> str:
    """Name of a friction law, and from which slip on it is full; empty for none."""
    if isinstance(law, Frictionless):
        return ""
    name = f"friction {title(type(law))}"
    if isinstance(law, NotImported):
        return name
    if law.has_state:
        return f"{name}, which can stick"
    return f"{name}, full above a slip of {1e3 * law.slip_speed(FULL):.3g} mm/s"


# --- contact pressures ---


def hardest_pressed(result: Result) -> list[PressedPin]:
    """Every clearance pin of a run under its largest force at any step."""
    pins, forces = with_known_laws(result.scenario.clearance_pins), result.largest_force
    machine = result.scenario.machine
    return [pressed_pin(machine, name, pin, forces[name]) for name, pin in pins.items() if name in forces]


def pressure_table(title: str, pins: Sequence[PressedPin]) -> ResultTable:
    """Pin, force, pressure, its share of first yield, half contact angle, depth, stiffness, kind of contact."""
    rows: list[tuple[str, ...]] = []
    for one in pins:
        kind = "length unknown" if one.length is None else "beyond the theory"
        line = one.line
        rows.append((
            one.name,
            amount(one.force, "N", DIGITS),
            amount(line.peak_pressure, "Pa", DIGITS) if line else "",
            _known(one.yield_share, lambda share: f"{100.0 * share:.{DIGITS}g} %"),
            f"{math.degrees(line.half_angle):.{DIGITS}g}°" if line else "",
            _known(one.depth, lambda depth: amount(depth, "m", DIGITS)),
            _known(one.stiffness, lambda stiffness: f"{stiffness / 1e9:.{DIGITS}g} MN/mm"),
            kind if line is None else "conformal" if line.conformal else "line",
        ))  # fmt: skip
    numbers = (">force", ">peak pressure", ">of first yield", ">half angle", ">depth", ">stiffness")
    notes = [f"warning: {one.warning}" for one in pins if one.warning]
    return ResultTable(title, ("pin", *numbers, "contact"), rows, "\n".join(notes))


def pressure_data(pins: Sequence[PressedPin]) -> list[dict[str, Any]]:
    """How hard each pin is pressed, as plain data in SI; what is not known is None."""
    return [
        {
            "pin": one.name,
            "force_N": one.force,
            "length_m": one.length,
            "peak_pressure_Pa": one.line and one.line.peak_pressure,
            "share_of_first_yield": _finite(one.yield_share),
            "half_angle_rad": one.line and one.line.half_angle,
            "depth_m": _finite(one.depth),
            "stiffness_N_per_m": _finite(one.stiffness),
            "conformal": one.line and one.line.conformal,
        }
        for one in pins
    ]


def _finite(number: float) -> float | None:
    return number if math.isfinite(number) else None


def _known(number: float, words: Callable[[float], str]) -> str:
    return words(number) if math.isfinite(number) else ""


# --- friction-induced vibration ---


def stability_table(outlooks: Sequence[PinOutlook]) -> ResultTable:
    """Pin, verdict, growth rate, frequency, travel of the drive there, friction there and the critical one."""
    rows: list[tuple[str, ...]] = []
    for one, data in zip(outlooks, stability_data(outlooks), strict=True):
        pin = f"{one.pin}, if it had such play" if one.assumed else one.pin
        if data["growth_rate_per_s"] is None:
            rows.append((pin, "nowhere at rest", "", "", "", "", ""))
            continue
        vibrates = any(found is not None and not found.stable for found in one.found)
        # without rounding where nothing grows
        growth = min(data["growth_rate_per_s"], 0.0) if one.stable else data["growth_rate_per_s"]
        rows.append((
            pin,
            "vibrates" if vibrates else "stable" if one.stable else "in part nowhere at rest",
            f"{growth:.{DIGITS}g} /s",
            amount(data["frequency_Hz"], "Hz", DIGITS) if data["frequency_Hz"] else "none",
            f"{math.degrees(data['travel']):.0f} deg" if one.turns else f"{1e3 * data['travel']:.0f} mm",
            f"{data['friction']:.{DIGITS}g}",
            _known(one.critical_friction, lambda friction: f"{friction:.{DIGITS}g}") or "none up to 1",
        ))  # fmt: skip
    title = "friction-induced vibration of loaded pins, at the worst posture of the stroke"
    header = ("pin", "sliding", ">growth rate", ">frequency", ">worst at", ">friction", ">vibrates from")
    return ResultTable(title, header, rows)


def stability_data(outlooks: Sequence[PinOutlook]) -> list[dict[str, Any]]:
    """Whether friction makes each pin vibrate, as plain data in SI; missing values are None."""
    found = []
    for one in outlooks:
        pin = None if one.worst is None else one.found[one.worst]
        data: dict[str, Any] = {"pin": one.pin, "assumed": one.assumed, "stable": one.stable}
        data |= {"growth_rate_per_s": None, "critical_friction": _finite(one.critical_friction)}
        if one.worst is not None and pin is not None:
            data |= {
                "growth_rate_per_s": pin.growth,
                "frequency_Hz": pin.frequency,
                "time_s": float(one.times[one.worst]),
                "travel": float(one.travels[one.worst]),
                "friction": pin.friction,
                "beyond_painleve": pin.normal_mobility < 0.0,
            }
        found.append(data)
    return found


# --- hydraulic legs ---


def leg_table(result: Result, after: float = 0.0, until: float = float("inf")) -> ResultTable:
    """What happened in every leg between two times [s]: leg, what, how often, when first and last.

    Rows name the beginning of an event; of cavities, when they began.
    """
    rows: list[tuple[str, ...]] = []
    for name, events in result.oil_events.items():
        begun: dict[str, list[float]] = {}
        for event in events:
            if after <= event.time <= until and event.begins != event.what.endswith(FILLED):
                begun.setdefault(event.what, []).append(event.time)
        for what, times in begun.items():
            cavity = f"cavity in the {what.removesuffix(FILLED).strip()}" if what.endswith(FILLED) else what
            rows.append((name, cavity, str(len(times)), amount(times[0], "s", 6), amount(times[-1], "s", 6)))
        if not begun:
            rows.append((name, "nothing opened, boiled or met a stop", "", "", ""))
    return ResultTable("hydraulic legs", ("leg", "what", ">times", ">first", ">last"), rows)


# --- warnings ---


def joint_warnings_of(result: Result) -> list[str]:
    """Warnings on the joints of a planar run, with its numbers as far as they were recorded."""
    from support_exudyn.machines.check.joint_warnings import guide_warnings, joint_warnings  # slow to import
    from support_exudyn.mechanics.body_motion import BodyMotion

    linkage, channels = result.scenario.linkage, result.channels
    moments = {
        name: float(np.abs(result[f"{name}.moment"]).max())
        for name in linkage.gears
        if f"{name}.moment" in channels
    }
    warnings = list(joint_warnings(linkage, moments))
    starts = {
        f"{name}.{key}": value
        for name, body in linkage.bodies.items()
        for key, value in (("x", body.centre[0]), ("y", body.centre[1]), ("angle", body.angle))
    }
    if linkage.slides and starts.keys() <= channels.keys():
        position = np.column_stack([result[name] - start for name, start in starts.items()])
        warnings += guide_warnings(BodyMotion(linkage, position, np.zeros_like(position)))
    return warnings
