"""A hydraulic leg at an instant: from length, rate and states to its force, flows, rates of states and powers.

One function for all columns, cylinders and legs, in both formulations. What a leg does not have is passed over:
a plain column of oil costs its pressure and its force.
"""

import math

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.scene.compilation import compiled, entry, inlined
from support_exudyn.scene.hydraulics.flows import integrate, let_in, let_out, orifice, pass_line, through
from support_exudyn.scene.hydraulics.oil import enthalpy, fill_chamber, stored_in
from support_exudyn.scene.hydraulics.records import (
    CAVITY,
    CAVITY_2,
    HIGH,
    HIGH_2,
    LINE_CAVITY,
    LOW,
    LOW_2,
    ROD_CAVITY,
    SEAL_LOSS,
    STAGE_LOSS,
    STOP_LOSS,
    VISCOUS_LOSS,
    Matrix,
    Records,
)


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


@inlined
def stop_ends(
    low: float, high: float, rate: float, stiffness: float, damping: float
) -> tuple[float, float, float]:
    """Force of both stops of a stage [N], the power that they take [W] and the energy stored in them [J].

    Arguments:
        low, high: depths in both [m]. rate: of the stage's extension [m/s].
        stiffness [N/m], damping [s/m]: see `EndStops`.
    """
    force = stop_force(low, -rate, stiffness, damping) - stop_force(high, rate, stiffness, damping)
    deepest = max(0.0, low) - max(0.0, high)
    return force, -(force - stiffness * deepest) * rate, 0.5 * stiffness * deepest * deepest


@compiled
def fill_chambers(legs: Records, n: int, y: Series, gaps: Series) -> None:
    """Write pressures and cavities of all chambers of a leg, and how far they are from boiling."""
    leg = legs[n]
    law, modulus, lowest = leg.law, leg.modulus, leg.vapour
    boils = lowest > -math.inf
    extension = leg.length - leg.length0
    s = y[leg.stage + 1] if leg.stage >= 0 else extension
    leg.oil = leg.oil0
    if leg.state >= 0:
        leg.oil += leg.scale * y[leg.state]
    if leg.driven != 0 and leg.line < 0:
        leg.oil += leg.bore * leg.inflow
    leg.volume = leg.bore * (leg.oil_length + s) + leg.hose
    leg.reference = leg.bore * (leg.oil_length + leg.inflow)
    p, leg.pressure, leg.cavity = fill_chamber(
        law, leg.oil, leg.volume, leg.reference, modulus, leg.air, leg.air_exponent, lowest
    )
    if boils:
        gaps[CAVITY] = p - lowest
    leg.rod_pressure = leg.tank
    if leg.rod >= 0:
        leg.rod_oil = leg.rod_oil0 + leg.rod_scale * y[leg.rod]
        room = leg.rod_area * (leg.rod_length - s) + leg.rod_hose
        if leg.stage >= 0:
            room += leg.rod_area2 * (leg.rod_length2 - extension + s)
        leg.rod_volume = room
        p, leg.rod_pressure, leg.rod_cavity = fill_chamber(
            law, leg.rod_oil, room, room, modulus, 0.0, 1.0, lowest
        )
        if boils:
            gaps[ROD_CAVITY] = p - lowest
    if leg.stage >= 0:
        leg.oil2 = leg.oil02 + leg.scale2 * y[leg.stage]
        leg.volume2 = leg.bore2 * (leg.oil_length2 + extension - s)
        reference = leg.bore2 * leg.oil_length2
        p, leg.pressure2, leg.cavity2 = fill_chamber(
            law, leg.oil2, leg.volume2, reference, modulus, 0.0, 1.0, lowest
        )
        if boils:
            gaps[CAVITY_2] = p - lowest
    leg.line_pressure = leg.pressure
    if leg.line >= 0:
        leg.line_oil = leg.line_oil0 + leg.line_scale * y[leg.line]
        if leg.driven != 0:
            leg.line_oil += leg.bore * leg.inflow
        room = leg.line_volume
        p, leg.line_pressure, leg.line_cavity = fill_chamber(
            law, leg.line_oil, room, room, modulus, 0.0, 1.0, lowest
        )
        if boils:
            gaps[LINE_CAVITY] = p - lowest


@compiled
def move_tube(
    legs: Records, n: int, extension: float, rate: float, outer: float, y: Series, slope: Series, gaps: Series
) -> tuple[float, float]:
    """Force of the inner stage and motion of the tube; power of stops, and of viscous damping [W].

    Arguments:
        legs, n: records, and which leg, whose force is written. extension, rate: of the leg [m], [m/s].
        outer: force with which the outer stage pushes the tube, without its damping [N].
        y: states. slope: their rates, which are written. gaps: of this leg.
    """
    leg = legs[n]
    law, modulus = leg.law, leg.modulus
    s, v = y[leg.stage + 1], y[leg.stage + 2]
    v2, drop = rate - v, leg.pressure - leg.pressure2
    low, high = leg.lowest2 - (extension - s), extension - s - leg.highest2
    gaps[LOW_2], gaps[HIGH_2] = low, high
    stop, held, stopped = stop_ends(low, high, v2, leg.stop2, leg.stop_damping2)
    leg.stopped += stopped
    rubbed = seals(leg.coulomb, leg.static, leg.stribeck, leg.transition, v2)
    leg.friction += rubbed * v2
    leg.force = leg.bore2 * leg.pressure2 - leg.rod_area2 * leg.rod_pressure - rubbed + stop
    leg.force -= leg.damping * v2
    share = 1.0
    if drop < 0.0:  # out of the tube only where it stands on its bottom
        share = min(1.0, max(0.0, (leg.lowest + leg.release - s) / leg.release))
    flow = share * leg.foot_factor * orifice(drop, leg.foot_smooth)
    moved = through(law, modulus, flow, leg.pressure, leg.pressure2)
    lost = moved * (enthalpy(law, leg.pressure, modulus) - enthalpy(law, leg.pressure2, modulus))
    lost += leg.tube_damping * v * v
    slope[leg.state] -= moved / leg.scale
    slope[leg.stage] = moved / leg.scale2
    slope[leg.stage + 1] = v
    slope[leg.stage + 2] = (outer - (leg.damping + leg.tube_damping) * v - leg.force) / leg.tube_mass
    leg.kinetic = 0.5 * leg.tube_mass * v * v
    integrate(legs, n, STAGE_LOSS, lost, slope)
    leg.loss += lost
    return held, leg.damping * v2 * v2


@compiled
def push_ends(legs: Records, n: int, y: Series, slope: Series, gaps: Series) -> None:
    """The force that pushes the ends apart, of oil, seals and stops; the tube's motion; what they take."""
    leg = legs[n]
    extension = leg.length - leg.length0
    s, v = extension, leg.rate
    if leg.stage >= 0:
        s, v = y[leg.stage + 1], y[leg.stage + 2]
    force = leg.bore * leg.pressure - leg.rod_area * leg.rod_pressure
    held = 0.0
    if leg.static > 0.0:
        rubbed = seals(leg.coulomb, leg.static, leg.stribeck, leg.transition, v)
        force -= rubbed
        leg.friction = rubbed * v
    if leg.stop > 0.0:
        low, high = leg.lowest - s, s - leg.highest
        gaps[LOW], gaps[HIGH] = low, high
        stop, held, leg.stopped = stop_ends(low, high, v, leg.stop, leg.stop_damping)
        force += stop
    viscous = leg.damping * v * v
    leg.force = force - leg.damping * v
    if leg.stage >= 0:
        taken, slid = move_tube(legs, n, extension, leg.rate, force, y, slope, gaps)
        held, viscous = held + taken, viscous + slid
    integrate(legs, n, SEAL_LOSS, leg.friction, slope)
    integrate(legs, n, STOP_LOSS, held, slope)
    integrate(legs, n, VISCOUS_LOSS, viscous, slope)
    leg.loss += viscous + held


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
    fill_chambers(legs, n, y, gaps)
    leg.work = leg.loss = leg.friction = leg.drawn = leg.stopped = 0.0
    if leg.state >= 0:
        slope[leg.state] = 0.0
    if leg.line >= 0:
        slope[leg.line] = 0.0
    if leg.driven == 0:
        let_in(legs, n, supply, shared, slope, gaps)
    else:
        into = leg.line_pressure if leg.line >= 0 else leg.pressure
        leg.flow = leg.bore * leg.inflow_rate
        leg.work += into * leg.flow
        leg.work -= 0.5 * leg.pressure * leg.pressure / leg.modulus * leg.flow
    if leg.line >= 0:
        pass_line(legs, n, supply, slope, gaps)
    if leg.slope > 0.0 or leg.rod_slope > 0.0:
        let_out(legs, n, y, slope, gaps)
    push_ends(legs, n, y, slope, gaps)


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
