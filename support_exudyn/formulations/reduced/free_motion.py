"""What the contact and the equations of motion need of a machine, whatever its free coordinates are."""

from __future__ import annotations

import math
from typing import NamedTuple

from support_exudyn.formulations.compiled import inlined
from support_exudyn.formulations.reduced.drive import Vector
from support_exudyn.formulations.reduced.layout import (
    FORCE_X,
    FORCE_Y,
    FRICTION,
    JOURNAL_ARM,
    OFFSET_X,
    OFFSET_Y,
)


class PinState(NamedTuple):
    """The loose pin: where the journal is, how it moves, and how that depends on the free coordinates. SI.

    x, y, vx, vy: journal's centre minus bore's, and its rate, ground's axes. bore_spin, journal_spin: of their
    bodies. cos_bore, sin_bore: turn of the bore's axes. x1, y1, x2, y2: rate of x, y by the rates of the first
    and second coordinate. bore1, bore2, journal1, journal2: of the spins likewise.
    """

    x: float
    y: float
    vx: float
    vy: float
    bore_spin: float
    journal_spin: float
    cos_bore: float
    sin_bore: float
    x1: float
    y1: float
    x2: float
    y2: float
    bore1: float
    bore2: float
    journal1: float
    journal2: float


class Balance(NamedTuple):
    """The two equations M q'' = Q without the contact: entries of M and Q."""

    m11: float
    m12: float
    m22: float
    q1: float
    q2: float


@inlined
def solved(law: Balance, q1: float, q2: float) -> tuple[float, float]:
    """q'' from M q'' = (q1, q2)."""
    scale = 1.0 / (law.m11 * law.m22 - law.m12 * law.m12)
    return (law.m22 * q1 - law.m12 * q2) * scale, (law.m11 * q2 - law.m12 * q1) * scale


@inlined
def accelerations(pin: PinState, law: Balance, contact: Vector) -> tuple[float, float]:
    """q'' under the contact's force, which acts at one point of space on both bodies."""
    fx, fy, friction = contact[FORCE_X], contact[FORCE_Y], contact[FRICTION]
    journal = friction * contact[JOURNAL_ARM]
    bore = journal + friction * math.sqrt(contact[OFFSET_X] ** 2 + contact[OFFSET_Y] ** 2)
    q1 = law.q1 + fx * pin.x1 + fy * pin.y1 + journal * pin.journal1 - bore * pin.bore1
    q2 = law.q2 + fx * pin.x2 + fy * pin.y2 + journal * pin.journal2 - bore * pin.bore2
    return solved(law, q1, q2)


@inlined
def closing_rates(pin: PinState, x: float, y: float) -> tuple[float, float]:
    """Rates of the free coordinates that take a velocity or acceleration x, y from the journal."""
    det = pin.x1 * pin.y2 - pin.y1 * pin.x2
    return -(x * pin.y2 - y * pin.x2) / det, -(y * pin.x1 - x * pin.y1) / det


@inlined
def closing_force(pin: PinState, law: Balance, first: float, second: float) -> tuple[float, float]:
    """Force [N] on the journal at its centre under which these are the accelerations."""
    q1 = law.m11 * first + law.m12 * second - law.q1
    q2 = law.m12 * first + law.m22 * second - law.q2
    det = pin.x1 * pin.y2 - pin.y1 * pin.x2
    return (q1 * pin.y2 - q2 * pin.y1) / det, (q2 * pin.x1 - q1 * pin.x2) / det


@inlined
def mobility(pin: PinState, law: Balance) -> tuple[float, float, float]:
    """xx, xy, yy [1/kg] of the velocity that an impulse gives the journal, in the bore's axes."""
    c, s = pin.cos_bore, pin.sin_bore
    x1, x2 = c * pin.x1 + s * pin.y1, c * pin.x2 + s * pin.y2
    y1, y2 = c * pin.y1 - s * pin.x1, c * pin.y2 - s * pin.x2
    ax, bx = solved(law, x1, x2)
    ay, by = solved(law, y1, y2)
    return x1 * ax + x2 * bx, x1 * ay + x2 * by, y1 * ay + y2 * by
