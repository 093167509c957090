"""From a scenario to the numbers that the compiled functions work on."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from support_exudyn.drives import Drive, Stroke, UniformSpeed
from support_exudyn.linkages.hydraulic_support import BODIES, HydraulicSupport, Posture
from support_exudyn.machine import Part, lumped
from support_exudyn.pins import ClearancePin
from support_exudyn.plane import distance, minus, side
from support_exudyn.reduced import layout
from support_exudyn.reduced.posture import Vector
from support_exudyn.reduced.runge_kutta import Matrix
from support_exudyn.scenario import Scenario
from user_forces.friction.ambrosio import Ambrosio
from user_forces.normal.damping_speed import SMALLEST, DepthSpeed, TouchSpeed
from user_forces.normal.power_law import ElasticPower, PowerLaw
from user_forces.values import Vector2

SLOWEST_FALL = 1e-3  # [m/s], for scenes without gravity


def parameters(
    scenario: Scenario, machine: HydraulicSupport, start: Posture, pin: ClearancePin | None
) -> Vector:
    """The vector of parameters, see `layout`; the contact's are zero if there is no loose pin."""
    named = {
        **_geometry(machine, start),
        **_masses(machine),
        "GRAVITY_X": scenario.gravity[0],
        "GRAVITY_Y": scenario.gravity[1],
        **(_contact(pin) if pin else {}),
    }
    vector = np.zeros(layout.PARAMETERS)
    for name, number in named.items():
        vector[getattr(layout, name)] = number
    return vector


def _pair(name: str, vector: Vector2) -> dict[str, float]:
    return {f"{name}_X": vector[0], f"{name}_Y": vector[1]}


def _parts_of(vector: Vector2, base: Vector2) -> tuple[float, float]:
    """A vector in parts of another and of that turned by 90 degrees."""
    square = base[0] ** 2 + base[1] ** 2
    along = (vector[0] * base[0] + vector[1] * base[1]) / square
    return along, (vector[1] * base[0] - vector[0] * base[1]) / square


def _geometry(m: HydraulicSupport, start: Posture) -> Mapping[str, float]:
    front, rear = m.column_lengths(start)
    # centres of the circles about which the hinge turns on the columns
    about_front = minus(m.front_foot, minus(start.front_head, start.hinge))
    about_rear = minus(m.rear_foot, minus(start.rear_head, start.hinge))
    along, across = _parts_of(minus(m.rear_shield, m.hinge), minus(m.front_shield, m.hinge))
    return {
        **_pair("FRONT_HEAD", minus(m.front_head, m.hinge)),
        **_pair("REAR_HEAD", minus(m.rear_head, m.hinge)),
        **_pair("FRONT_FOOT", m.front_foot),
        **_pair("REAR_FOOT", m.rear_foot),
        **_pair("FRONT_BASE", m.front_base),
        **_pair("REAR_BASE", m.rear_base),
        **_pair("PIN", minus(m.rear_base, m.rear_shield)),
        "FRONT_LENGTH": front,
        "REAR_LENGTH": rear,
        "SHIELD_LENGTH": distance(m.hinge, m.front_shield),
        "LINK_LENGTH": distance(m.front_base, m.front_shield),
        "HINGE_SIDE": side(about_front, about_rear, start.hinge),
        "SHIELD_SIDE": side(start.hinge, m.front_base, start.front_shield),
        "SHIELD_PIN_ALONG": along,
        "SHIELD_PIN_ACROSS": across,
    }


def _masses(m: HydraulicSupport) -> Mapping[str, float]:
    lumps: dict[str, Part] = {name: lumped(m.parts[name]) for name in BODIES}
    found: dict[str, float] = {}
    for name, body in (
        ("CANOPY", "canopy"),
        ("SHIELD", "shield"),
        ("FRONT_LINK", "front_link"),
        ("REAR_LINK", "rear_link"),
    ):
        found |= {f"{name}_MASS": lumps[body].mass, f"{name}_INERTIA": lumps[body].inertia}
    shield = _parts_of(minus(lumps["shield"].centre, m.hinge), minus(m.front_shield, m.hinge))
    link = _parts_of(minus(lumps["front_link"].centre, m.front_base), minus(m.front_shield, m.front_base))
    return {
        **found,
        **_pair("CANOPY", minus(lumps["canopy"].centre, m.hinge)),
        **_pair("REAR_LINK", minus(lumps["rear_link"].centre, m.rear_shield)),
        "SHIELD_ALONG": shield[0],
        "SHIELD_ACROSS": shield[1],
        "LINK_ALONG": link[0],
        "LINK_ACROSS": link[1],
    }


def _contact(pin: ClearancePin) -> Mapping[str, float]:
    bearing, law, friction = pin.contact.bearing, pin.contact.normal, pin.contact.friction
    assert isinstance(law, ElasticPower)  # checked before
    found = {
        "CLEARANCE": bearing.clearance,
        "BORE_RADIUS": bearing.bore_radius,
        "STIFFNESS": law.stiffness,
        "EXPONENT": law.exponent,
        "SPEED_FLOOR": SMALLEST,
        "STATIC_SPEED": 0.0,
        "DYNAMIC_SPEED": 1.0,
        "JOURNAL_ON_LINK": float(pin.bore == "first"),  # the base is the first body
    }
    if isinstance(law, PowerLaw):
        found["DAMPING_FACTOR"] = law.damping_factor
        found["BY_DEPTH"] = float(isinstance(law.damping_speed, DepthSpeed))
        if isinstance(law.damping_speed, TouchSpeed):
            found["SPEED_FLOOR"] = law.damping_speed.floor
    if isinstance(friction, Ambrosio):
        found["SLIDING_COEFFICIENT"] = friction.sliding_coefficient
        found["STATIC_SPEED"] = friction.static_speed
        found["DYNAMIC_SPEED"] = friction.dynamic_speed
    return found


def segments(drive: Drive, duration: float) -> Matrix:
    """The drive between its breaks, one segment a row, see `layout`.

    Arguments:
        drive: Held, or a Stroke: CubicStep or UniformSpeed.
        duration: of the run [s].
    """
    inner = sorted({t for t in drive.breaks if 0.0 < t < duration})
    edges = [0.0, *inner, duration]
    rows = np.zeros((len(edges) - 1, layout.SEGMENT))
    rows[:, layout.WIDTH] = 1.0
    for row, begin, end in zip(rows, edges, edges[1:], strict=False):
        row[layout.BEGIN], row[layout.END] = begin, end
        row[layout.JUMP] = drive.speed_jump(begin)
        if isinstance(drive, Stroke):
            _fill(row, drive, 0.5 * (begin + end))
    return rows


def _fill(row: Vector, drive: Stroke, t: float) -> None:
    """Polynomial of the segment that time t [s] lies in."""
    if t >= drive.end:
        row[layout.A0] = drive.stroke
    elif t > drive.start:
        row[layout.ORIGIN], row[layout.WIDTH] = drive.start, drive.end - drive.start
        if isinstance(drive, UniformSpeed):
            row[layout.A1] = drive.stroke
        else:
            row[layout.A2], row[layout.A3] = 3.0 * drive.stroke, -2.0 * drive.stroke


def record_times(duration: float, period: float) -> Vector:
    """Times of the records [s]: multiples of the period from 0 on, and the end."""
    count = math.floor(duration / period + 1e-9)
    times: Vector = np.arange(count + 1, dtype=np.float64) * period
    if duration - times[-1] > 1e-9 * period:
        return np.append(times, duration)
    times[-1] = duration
    return times


def error_weights(scenario: Scenario, start: Posture, clearance: float, tolerance: float) -> Vector:
    """One over the largest error of a step, for each component of the state.

    `tolerance` times: the clearance at the end of the rear link, for turns; the speed of a fall through half of
    it, for rates; the weight of all bodies times the clearance, for energies.
    """
    machine = scenario.machine.linkage()
    speed = max(math.sqrt(math.hypot(*scenario.gravity) * clearance), SLOWEST_FALL)
    lever = math.dist(start.rear_shield, machine.pins["rear_base"].first_point)
    turn, rate = lever / clearance / tolerance, lever / speed / tolerance
    energy = 1.0 / (sum(body.mass for body in machine.bodies.values()) * speed**2 * tolerance)
    return np.array([turn, turn, rate, rate, energy, energy], dtype=np.float64)
