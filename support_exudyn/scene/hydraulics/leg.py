"""A hydraulic leg at an instant: from length, rate and states to its force, flows, rates of states and powers.

One function for both formulations. Every flow between two chambers moves as much oil as it takes, and what it
carries along: B (1 - exp(-p/B)) per volume W, so that what a resistance takes is never negative, and energies
add up. Where oil comes from or goes to a tank or a pump of constant pressure p_s, the resistance takes
Q (p_s - p), and the source gives what is left.
"""

import math

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.scene.compilation import compiled, entry, inlined
from support_exudyn.scene.hydraulics.oil import (
    air_volume,
    enthalpy,
    liquid_volume,
    pressure_of,
    stored_in,
    weight,
)
from support_exudyn.scene.hydraulics.records import (
    CAVITY,
    CAVITY_2,
    CHECK,
    HIGH,
    HIGH_2,
    LET_IN,
    LINE_CAVITY,
    LINE_LOSS,
    LOW,
    LOW_2,
    RELIEF,
    RELIEVED,
    ROD_CAVITY,
    SEAL_LOSS,
    STAGE_LOSS,
    STOP_LOSS,
    VALVE_LOSS,
    VISCOUS_LOSS,
    YIELD,
    YIELD_LOSS,
    YIELDED,
    Matrix,
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
def seals(coulomb: float, static: float, stribeck: float, transition: float, rate: float) -> float:
    """Friction [N] that resists a rate [m/s], see `SealFriction`."""
    if static == 0.0:
        return 0.0
    ratio = rate / stribeck
    return (coulomb + (static - coulomb) * math.exp(-ratio * ratio)) * math.tanh(rate / transition)


@inlined
def stop_force(depth: float, rate: float, stiffness: float, damping: float) -> float:
    """Force [N] of a stop at a depth [m] that grows by a rate [m/s], see `EndStops`."""
    return stiffness * depth * max(0.0, 1.0 + damping * rate) if depth > 0.0 else 0.0


@compiled
def fill_chambers(legs: Records, n: int, length: float, inflow: float, y: Series, gaps: Series) -> None:
    """Write pressures and cavities of all chambers of a leg, and how far they are from boiling."""
    leg = legs[n]
    law, modulus, lowest = leg.law, leg.modulus, leg.vapour
    extension = length - leg.length0
    s = y[leg.stage + 1] if leg.stage >= 0 else extension
    leg.oil = leg.oil0 + leg.scale * y[leg.state]
    if leg.driven != 0 and leg.line < 0:
        leg.oil += leg.bore * inflow
    leg.volume = leg.bore * (leg.oil_length + s) + leg.hose
    leg.reference = leg.bore * (leg.oil_length + inflow)
    p = pressure_of(law, leg.oil, leg.volume, leg.reference, modulus, leg.air, leg.air_exponent)
    if not (leg.volume > 0.0 and leg.oil > 0.0):  # no room or no oil is left: `empty_legs` says so
        p = math.nan
    gaps[CAVITY] = p - lowest
    leg.pressure, leg.cavity = lowest if p < lowest else p, 0.0
    if p < lowest:
        filled = liquid_volume(law, leg.oil, lowest, leg.reference, modulus)
        leg.cavity = leg.volume - filled - air_volume(leg.air, leg.air_exponent, lowest)
    leg.rod_pressure = leg.tank
    if leg.rod >= 0:
        leg.rod_oil = leg.rod_oil0 + leg.rod_scale * y[leg.rod]
        leg.rod_volume = leg.rod_area * (leg.rod_length - s) + leg.rod_hose
        if leg.stage >= 0:
            leg.rod_volume += leg.rod_area2 * (leg.rod_length2 - extension + s)
        p = pressure_of(law, leg.rod_oil, leg.rod_volume, leg.rod_volume, modulus, 0.0, 1.0)
        gaps[ROD_CAVITY] = p - lowest
        leg.rod_pressure, leg.rod_cavity = lowest if p < lowest else p, 0.0
        if p < lowest:
            leg.rod_cavity = leg.rod_volume - liquid_volume(law, leg.rod_oil, lowest, 0.0, modulus)
    if leg.stage >= 0:
        leg.oil2 = leg.oil02 + leg.scale2 * y[leg.stage]
        leg.volume2 = leg.bore2 * (leg.oil_length2 + extension - s)
        reference = leg.bore2 * leg.oil_length2
        p = pressure_of(law, leg.oil2, leg.volume2, reference, modulus, 0.0, 1.0)
        if not (leg.volume2 > 0.0 and leg.oil2 > 0.0):
            p = math.nan
        gaps[CAVITY_2] = p - lowest
        leg.pressure2, leg.cavity2 = lowest if p < lowest else p, 0.0
        if p < lowest:
            leg.cavity2 = leg.volume2 - liquid_volume(law, leg.oil2, lowest, reference, modulus)
    leg.line_pressure = leg.pressure
    if leg.line >= 0:
        leg.line_oil = leg.line_oil0 + leg.line_scale * y[leg.line]
        if leg.driven != 0:
            leg.line_oil += leg.bore * inflow
        room = leg.line_volume
        p = pressure_of(law, leg.line_oil, room, room, modulus, 0.0, 1.0) if leg.line_oil > 0.0 else math.nan
        gaps[LINE_CAVITY] = p - lowest
        leg.line_pressure, leg.line_cavity = lowest if p < lowest else p, 0.0
        if p < lowest:
            leg.line_cavity = room - liquid_volume(law, leg.line_oil, lowest, room, modulus)


@inlined
def released(legs: Records, n: int, pilot: float) -> float:
    """Share of the flow that a check valve lets out at a pilot pressure [Pa]."""
    leg = legs[n]
    if leg.check == 0:
        return 1.0
    return float(min(1.0, max(0.0, (leg.pilot_ratio * pilot - leg.pressure) / leg.pilot_range)))


@inlined
def through(law: int, modulus: float, flow: float, before: float, after: float) -> float:
    """Oil that a flow [m^3/s] moves between two chambers, as volume without pressure [m^3/s]."""
    return flow * weight(law, before if flow > 0.0 else after, modulus)


@compiled
def let_in(
    legs: Records, n: int, opening: float, supply: float, shared: bool, slope: Series, gaps: Series
) -> None:
    """Flows through the inlet, the check valve and the line, and what they take.

    supply: the pump's pressure [Pa]. shared: the pump's line counts its oil, too, so that what is drawn from it
    brings its pressure's work.
    """
    leg = legs[n]
    law, modulus, p = leg.law, leg.modulus, leg.pressure
    if abs(opening) < CLOSED:
        opening = 0.0
    at, rod_at = (supply, leg.tank) if opening >= 0.0 else (leg.tank, supply)
    node = leg.line_pressure
    flow = loss = 0.0
    if leg.driven == 0:
        wide = leg.flow_factor * abs(opening)
        ahead = at - node
        if leg.check != 0 and leg.line < 0:
            gaps[CHECK] = at - p - leg.cracking if opening > 0.0 else OPEN
            if at - p > leg.cracking:
                ahead = at - p - leg.cracking
            else:
                wide *= released(legs, n, rod_at)
                ahead = min(0.0, at - p)
        flow = wide * orifice(ahead, leg.smooth)
        moved = flow * weight(law, node, modulus)
        loss = flow * (at - node)
        leg.work += loss + moved * enthalpy(law, node, modulus)
        leg.drawn = moved if opening > 0.0 else 0.0
        rod_flow = wide * orifice(rod_at - leg.rod_pressure, leg.smooth)
        if leg.check != 0 and leg.line < 0:  # the check valve is in the piston side's way alone
            rod_flow = leg.flow_factor * abs(opening) * orifice(rod_at - leg.rod_pressure, leg.smooth)
        rod_moved = rod_flow * weight(law, leg.rod_pressure, modulus)
        rod_loss = rod_flow * (rod_at - leg.rod_pressure)
        leg.work += rod_loss + rod_moved * enthalpy(law, leg.rod_pressure, modulus)
        if opening < 0.0:
            leg.drawn = rod_moved
        if shared:
            leg.work -= leg.drawn * supply
        loss += rod_loss
        slope[leg.rod] = rod_moved / leg.rod_scale
        leg.flow, leg.rod_flow = flow, rod_flow
        if leg.line >= 0:
            slope[leg.line] = moved / leg.line_scale
        else:
            slope[leg.state] += moved / leg.scale
        slope[leg.booked + LET_IN] = moved + rod_moved
    slope[leg.booked + VALVE_LOSS] = loss
    leg.loss += loss
    if leg.line < 0:
        return
    ahead = node - p
    if leg.check != 0:
        gaps[CHECK] = node - p - leg.cracking
        if ahead > leg.cracking:
            ahead -= leg.cracking
        else:
            ahead = released(legs, n, rod_at) * min(0.0, ahead)
    flow = ahead / leg.line_resistance
    moved = through(law, modulus, flow, node, p)
    lost = moved * (enthalpy(law, node, modulus) - enthalpy(law, p, modulus))
    slope[leg.line] -= moved / leg.line_scale
    slope[leg.state] += moved / leg.scale
    slope[leg.booked + LINE_LOSS] = lost
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


@compiled
def let_out(legs: Records, n: int, y: Series, slope: Series, gaps: Series) -> None:
    """Flows through the relief valves of both sides to the tank, and what they take; the poppet's motion."""
    leg = legs[n]
    law, modulus, lost = leg.law, leg.modulus, 0.0
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
        moved, taken = flow * weight(law, p, modulus), flow * (p - leg.tank)
        leg.work += taken - moved * enthalpy(law, p, modulus)
        slope[leg.state] -= moved / leg.scale
        slope[leg.booked + YIELDED] = moved
        leg.yield_flow, lost = flow, taken
    if leg.rod_slope > 0.0:
        p = leg.rod_pressure
        gaps[RELIEF] = p - (leg.rod_closes if leg.rod_open != 0.0 else leg.rod_opens)
        flow = relief(leg.rod_jumps, leg.rod_open, p, leg.rod_opens, leg.rod_closes, leg.rod_slope)
        moved, taken = flow * weight(law, p, modulus), flow * (p - leg.tank)
        leg.work += taken - moved * enthalpy(law, p, modulus)
        slope[leg.rod] -= moved / leg.rod_scale
        slope[leg.booked + RELIEVED] = moved
        leg.relief_flow = flow
        lost += taken
    slope[leg.booked + YIELD_LOSS] = lost
    leg.loss += lost


@compiled
def push_ends(
    legs: Records, n: int, length: float, rate: float, y: Series, slope: Series, gaps: Series
) -> None:
    """The force that pushes the ends apart, of oil, seals and stops; the tube's motion; what they take."""
    leg = legs[n]
    extension = length - leg.length0
    s, v = extension, rate
    if leg.stage >= 0:
        s, v = y[leg.stage + 1], y[leg.stage + 2]
    low, high = leg.lowest - s, s - leg.highest
    stop = 0.0
    stopped = held = 0.0
    if leg.stop > 0.0:
        gaps[LOW], gaps[HIGH] = low, high
        stop = stop_force(low, -v, leg.stop, leg.stop_damping) - stop_force(high, v, leg.stop, leg.stop_damping)
        deepest = max(0.0, low) - max(0.0, high)
        held = -(stop - leg.stop * deepest) * v
        stopped = 0.5 * leg.stop * deepest * deepest
    rubbed = seals(leg.coulomb, leg.static, leg.stribeck, leg.transition, v)
    force = leg.bore * leg.pressure - leg.rod_area * leg.rod_pressure - rubbed + stop
    seal = rubbed * v
    viscous, lost = leg.damping * v * v, 0.0
    if leg.stage < 0:
        leg.force = force - leg.damping * v
        leg.kinetic = 0.0
    else:
        law, modulus = leg.law, leg.modulus
        v2, drop = rate - v, leg.pressure - leg.pressure2
        low, high = leg.lowest2 - (extension - s), extension - s - leg.highest2
        gaps[LOW_2], gaps[HIGH_2] = low, high
        stop = stop_force(low, -v2, leg.stop2, leg.stop_damping2)
        stop -= stop_force(high, v2, leg.stop2, leg.stop_damping2)
        deepest = max(0.0, low) - max(0.0, high)
        held -= (stop - leg.stop2 * deepest) * v2
        stopped += 0.5 * leg.stop2 * deepest * deepest
        other = seals(leg.coulomb, leg.static, leg.stribeck, leg.transition, v2)
        seal += other * v2
        leg.force = leg.bore2 * leg.pressure2 - leg.rod_area2 * leg.rod_pressure - other + stop
        leg.force -= leg.damping * v2
        viscous += leg.damping * v2 * v2
        share = 1.0
        if drop < 0.0:  # out of the tube only where it stands on its bottom
            share = min(1.0, max(0.0, (leg.lowest + leg.release - s) / leg.release))
        flow = share * leg.foot_factor * orifice(drop, leg.foot_smooth)
        moved = through(law, modulus, flow, leg.pressure, leg.pressure2)
        lost = moved * (enthalpy(law, leg.pressure, modulus) - enthalpy(law, leg.pressure2, modulus))
        slope[leg.state] -= moved / leg.scale
        slope[leg.stage] = moved / leg.scale2
        lost += leg.tube_damping * v * v
        slope[leg.stage + 1] = v
        slope[leg.stage + 2] = (force - (leg.damping + leg.tube_damping) * v - leg.force) / leg.tube_mass
        leg.kinetic = 0.5 * leg.tube_mass * v * v
    leg.stopped, leg.seal = stopped, seal
    slope[leg.booked + SEAL_LOSS], slope[leg.booked + STOP_LOSS] = seal, held
    slope[leg.booked + STAGE_LOSS], slope[leg.booked + VISCOUS_LOSS] = lost, viscous
    leg.loss += viscous + held + lost
    leg.friction = seal


@compiled
def press_leg(
    legs: Records, n: int, supply: float, shared: bool, y: Series, slope: Series, gaps: Series
) -> None:
    """All of a leg at an instant: force, powers and flows into its record, rates of its states into `slope`.

    Arguments:
        legs, n: records, which say how long the leg is, and which one.
        supply: pressure of the pump [Pa]. shared: it is that of a `PumpStation`.
        y: states, of which its own are read. slope: their rates, of which its own are written.
        gaps: of this leg; what passes zero where something happens.
    """
    leg = legs[n]
    fill_chambers(legs, n, leg.length, leg.inflow, y, gaps)
    leg.work = leg.loss = leg.friction = leg.drawn = leg.flow = leg.rod_flow = 0.0
    slope[leg.state] = 0.0
    if leg.line >= 0:
        slope[leg.line] = 0.0
    let_in(legs, n, leg.opening, supply, shared, slope, gaps)
    let_out(legs, n, y, slope, gaps)
    push_ends(legs, n, leg.length, leg.rate, y, slope, gaps)
    if leg.driven != 0:
        into = leg.line_pressure if leg.line >= 0 else leg.pressure
        leg.work += into * leg.bore * leg.inflow_rate
        leg.work -= 0.5 * leg.pressure * leg.pressure / leg.modulus * leg.bore * leg.inflow_rate
        leg.flow = leg.flow if leg.line >= 0 else leg.bore * leg.inflow_rate


@compiled
def press_all(legs: Records, pumps: Records, gaps: Matrix, y: Series, slope: Series) -> None:
    """All legs of a machine at an instant, and its pump.

    Their records say length, rate, inflow, inflow_rate and opening. Arguments: see `press_leg`; gaps of all
    legs, shape (legs, GAPS).
    """
    shared, drawn, supply = pumps.size > 0, 0.0, 0.0
    if shared:
        pump = pumps[0]
        pump.now = pump.modulus * (pump.oil0 + pump.scale * y[pump.state] - pump.volume) / pump.volume
        supply = pump.now
    for n in range(legs.size):
        press_leg(legs, n, supply if shared else legs[n].supply, shared, y, slope, gaps[n])
        drawn += legs[n].drawn
    if shared:
        pump = pumps[0]
        share = min(1.0, max(0.0, (pump.pressure - pump.now) / pump.range))
        pump.given = share * pump.flow
        pump.work = pump.given * pump.now
        slope[pump.state] = (pump.given - drawn) / pump.scale
        slope[pump.state + 1] = pump.given


@compiled
def stored_by(legs: Records, n: int) -> float:
    """Energy [J] stored in a leg as it stands in its record: oil, air, cavities, stops, its tube's motion."""
    leg = legs[n]
    law, modulus = leg.law, leg.modulus
    total = leg.stopped + leg.kinetic
    total += stored_in(
        law, leg.oil, leg.pressure, leg.reference, modulus, leg.air, leg.air_exponent, leg.cavity
    )
    if leg.rod >= 0:
        total += stored_in(law, leg.rod_oil, leg.rod_pressure, 0.0, modulus, 0.0, 1.0, leg.rod_cavity)
    if leg.stage >= 0:
        reference = leg.bore2 * leg.oil_length2
        total += stored_in(law, leg.oil2, leg.pressure2, reference, modulus, 0.0, 1.0, leg.cavity2)
    if leg.line >= 0:
        room = leg.line_volume
        total += stored_in(law, leg.line_oil, leg.line_pressure, room, modulus, 0.0, 1.0, leg.line_cavity)
    return float(total)


@compiled
def stored_by_pump(pumps: Records) -> float:
    """Energy [J] stored in the pump's line: p^2 V/2B."""
    if pumps.size == 0:
        return 0.0
    pump = pumps[0]
    return float(0.5 * pump.now * pump.now * pump.volume / pump.modulus)


@entry
def evaluate_legs(legs: Records, pumps: Records, gaps: Matrix, y: Series, slope: Series) -> float:
    """Evaluate all legs as `press_all` does, from Python; energy stored in them and in the pump's line [J]."""
    press_all(legs, pumps, gaps, y, slope)
    total = stored_by_pump(pumps)
    for n in range(legs.size):
        total += stored_by(legs, n)
    return total
