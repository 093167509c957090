"""Flows of a hydraulic leg: through inlet, check valve and line, and out by relief valves; what they take.

Every flow between two chambers moves as much oil as it takes, and what it carries along: B (1 - exp(-p/B))
per volume W, so that what a resistance takes is never negative, and energies add up. Where oil comes from or
goes to a tank or a pump of constant pressure p_s, the resistance takes Q (p_s - p), and the source gives what
is left.
"""

import math

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.scene.compilation import compiled, inlined
from support_exudyn.scene.hydraulics.oil import enthalpy, weight
from support_exudyn.scene.hydraulics.records import (
    CHECK,
    LET_IN,
    LINE_LOSS,
    RELIEF,
    RELIEVED,
    VALVE_LOSS,
    YIELD,
    YIELD_LOSS,
    YIELDED,
    Records,
)

SEAT = 100.0  # a poppet's seat is so many times as stiff as its spring, and critically damped
DRAINED = 0.1  # of the opening pressure, below which an open poppet passes less, and nothing without pressure
OPEN = -1e300  # a gap that nothing closes
CLOSED = 1e-12  # opening of an inlet, of either sign, that is rounding


@inlined
def orifice(drop: float, smooth: float) -> float:
    """Root of a pressure drop [Pa^0.5] with its sign, laminar below `smooth` [Pa]."""
    size = drop * drop + smooth * smooth
    return float(drop / math.sqrt(math.sqrt(size))) if size > 0.0 else 0.0


@inlined
def integrate(legs: Records, n: int, what: int, rate: float, slope: Series) -> None:
    """Write the rate of an integral of a leg, if the leg has that integral."""
    place = legs[n].integrals[what]
    if place >= 0:
        slope[place] = rate


@inlined
def checked(legs: Records, n: int, ahead: float, pilot: float) -> tuple[float, float]:
    """Pressure drop that moves oil into the piston side [Pa], and the share of its flow that passes.

    A check valve lets oil out only as far as the pilot pressure releases it, see `CheckValve`.

    Arguments:
        legs, n: records, and which leg. ahead: pressure before the piston side less that in it [Pa].
        pilot: pressure that releases the valve [Pa].
    """
    leg = legs[n]
    if leg.check == 0:
        return ahead, 1.0
    if ahead > leg.cracking:
        return ahead - leg.cracking, 1.0
    share = min(1.0, max(0.0, (leg.pilot_ratio * pilot - leg.pressure) / leg.pilot_range))
    return min(0.0, ahead), float(share)


@inlined
def through(law: int, modulus: float, flow: float, before: float, after: float) -> float:
    """Oil that a flow [m^3/s] moves between two chambers, as volume without pressure [m^3/s]."""
    return flow * weight(law, before if flow > 0.0 else after, modulus)


@compiled
def let_in(legs: Records, n: int, supply: float, shared: bool, slope: Series, gaps: Series) -> None:
    """Flows through the inlet of a cylinder to the line or the piston side, and to the rod side; their losses.

    Arguments:
        legs, n: records, and which leg. supply: the pump's pressure [Pa].
        shared: the pump's line counts its oil, too, so that what is drawn from it brings its pressure's work.
        slope: rates of the states, which are written. gaps: of this leg.
    """
    leg = legs[n]
    law, modulus, node = leg.law, leg.modulus, leg.line_pressure
    opening = leg.opening if abs(leg.opening) >= CLOSED else 0.0
    at, rod_at = (supply, leg.tank) if opening >= 0.0 else (leg.tank, supply)
    wide = leg.flow_factor * abs(opening)
    ahead, share = at - node, 1.0
    if leg.line < 0:  # else the check valve is behind the line
        if leg.check != 0:
            gaps[CHECK] = ahead - leg.cracking if opening > 0.0 else OPEN
        ahead, share = checked(legs, n, ahead, rod_at)
    leg.flow = share * wide * orifice(ahead, leg.smooth)
    moved = leg.flow * weight(law, node, modulus)
    leg.rod_flow = wide * orifice(rod_at - leg.rod_pressure, leg.smooth)
    rod_moved = leg.rod_flow * weight(law, leg.rod_pressure, modulus)
    loss = leg.flow * (at - node) + leg.rod_flow * (rod_at - leg.rod_pressure)
    carried = moved * enthalpy(law, node, modulus)
    leg.work += loss + carried + rod_moved * enthalpy(law, leg.rod_pressure, modulus)
    if opening != 0.0:
        leg.drawn = moved if opening > 0.0 else rod_moved
    if shared:
        leg.work -= leg.drawn * supply
    slope[leg.rod] = rod_moved / leg.rod_scale
    if leg.line >= 0:
        slope[leg.line] = moved / leg.line_scale
    else:
        slope[leg.state] += moved / leg.scale
    integrate(legs, n, LET_IN, moved + rod_moved, slope)
    integrate(legs, n, VALVE_LOSS, loss, slope)
    leg.loss += loss


@compiled
def pass_line(legs: Records, n: int, supply: float, slope: Series, gaps: Series) -> None:
    """Flow of the line, and of a check valve behind it, into the piston side, and what they take."""
    leg = legs[n]
    law, modulus, p, node = leg.law, leg.modulus, leg.pressure, leg.line_pressure
    if leg.check != 0:
        gaps[CHECK] = node - p - leg.cracking
    pilot = leg.tank if leg.opening > -CLOSED else supply
    ahead, share = checked(legs, n, node - p, pilot)
    flow = share * ahead / leg.line_resistance
    moved = through(law, modulus, flow, node, p)
    lost = moved * (enthalpy(law, node, modulus) - enthalpy(law, p, modulus))
    slope[leg.line] -= moved / leg.line_scale
    slope[leg.state] += moved / leg.scale
    integrate(legs, n, LINE_LOSS, lost, slope)
    leg.loss += lost
    leg.flow = flow


@inlined
def relief(
    jumps: int, opened: float, pressure: float, opens: float, closes: float, per_pressure: float
) -> float:
    """Flow [m^3/s] of a relief valve without a poppet, see `YieldValve`."""
    if jumps == 0:
        return per_pressure * max(0.0, pressure - opens)
    return per_pressure * max(0.0, pressure - closes) if opened != 0.0 else 0.0


@inlined
def to_tank(
    legs: Records, n: int, flow: float, pressure: float, state: int, scale: float, what: int, slope: Series
) -> float:
    """Let a flow [m^3/s] out of a chamber to the tank; the power that its valve takes [W].

    Arguments:
        legs, n: records, and which leg. pressure: of the chamber [Pa].
        state, scale: place of its oil, and its unit [m^3/Pa]. what: integral of that oil.
        slope: rates of the states, which are written.
    """
    leg = legs[n]
    moved, taken = flow * weight(leg.law, pressure, leg.modulus), flow * (pressure - leg.tank)
    leg.work += taken - moved * enthalpy(leg.law, pressure, leg.modulus)
    slope[state] -= moved / scale
    integrate(legs, n, what, moved, slope)
    return float(taken)


@compiled
def let_out(legs: Records, n: int, y: Series, slope: Series, gaps: Series) -> None:
    """Flows through the relief valves of both sides to the tank, and what they take; the poppet's motion."""
    leg = legs[n]
    lost = 0.0
    leg.yield_flow = leg.relief_flow = 0.0
    if leg.slope > 0.0:
        p = leg.pressure
        gaps[YIELD] = p - (leg.closes if leg.open != 0.0 else leg.opens)
        if leg.poppet >= 0:
            lift, rate = y[leg.poppet], y[leg.poppet + 1]
            gaps[YIELD] = lift  # its seat gives a jolt; nothing happens where the spring gives way
            pressed = (p - leg.tank) / (DRAINED * leg.opens)
            flow = leg.slope * max(0.0, lift) * min(1.0, max(0.0, pressed))
            k, d = leg.poppet_rate * leg.poppet_rate, leg.poppet_decay
            if lift < 0.0:
                lift, d = SEAT * lift, 2.0 * math.sqrt(SEAT) * leg.poppet_rate
            slope[leg.poppet], slope[leg.poppet + 1] = rate, k * (p - leg.opens - lift) - d * rate
        else:
            flow = relief(leg.jumps, leg.open, p, leg.opens, leg.closes, leg.slope)
        leg.yield_flow = flow
        lost = to_tank(legs, n, flow, p, leg.state, leg.scale, YIELDED, slope)
    if leg.rod_slope > 0.0:
        p = leg.rod_pressure
        gaps[RELIEF] = p - (leg.rod_closes if leg.rod_open != 0.0 else leg.rod_opens)
        flow = relief(leg.rod_jumps, leg.rod_open, p, leg.rod_opens, leg.rod_closes, leg.rod_slope)
        leg.relief_flow = flow
        lost += to_tank(legs, n, flow, p, leg.rod, leg.rod_scale, RELIEVED, slope)
    integrate(legs, n, YIELD_LOSS, lost, slope)
    leg.loss += lost
