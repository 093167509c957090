"""A hydraulic leg at an instant: from length, rate and states to its force, flows, rates of states and powers.

One function for all columns, cylinders and legs, in both formulations, for all chambers, and for all valves. A
flow between two chambers moves as much oil as it takes, and what the oil carries along, B (1 - exp(-p/B)) per
volume W, so that no resistance takes less than nothing, and energies add up. Where oil comes from or goes to a
source of pressure p_s, the resistance takes Q (p_s - p), and the source gives the rest.
"""

import math

from support_exudyn.scene.compilation import call_law, compiled, entry, inlined, once
from support_exudyn.scene.hydraulics.oil import fill_chamber, liquid_pressure, stored_in
from support_exudyn.scene.hydraulics.records import (
    CONSTANT,
    MEMORY,
    STATES,
    STOPS,
    LegArrays,
    Vector,
)

CLOSED = 1e-12  # opening of an inlet, of either sign, that is rounding


@inlined
def integrate(place: int, rate: float, slope: Vector) -> None:
    """Add to the rate of an integral over time, if there is that integral."""
    if place >= 0:
        slope[place] += rate


@once
def fill_chambers(legs: LegArrays, n: int, y: Vector) -> None:
    """Write pressures and cavities of all chambers of a leg, their gaps to boiling, and a drive's work."""
    leg = legs.records[n]
    extension = leg.length - leg.length0
    leg.travel, leg.travel_rate = extension, leg.rate
    if leg.stage >= 0:
        leg.travel, leg.travel_rate = y[leg.stage], y[leg.stage + 1]
    for c in range(leg.chamber, leg.chamber + leg.chambers):
        chamber = legs.chambers[c]
        if chamber.law == CONSTANT:
            continue
        chamber.oil = chamber.oil0 + chamber.fed * leg.inflow
        if chamber.state >= 0:
            chamber.oil += chamber.scale * y[chamber.state]
        chamber.volume = chamber.room + chamber.by_travel * leg.travel + chamber.by_length * extension
        chamber.span = chamber.reference + chamber.grown * leg.inflow
        p = fill_chamber(legs.chambers, c)
        if chamber.vapour > -math.inf:
            legs.gaps[c].now = p - chamber.vapour
        if leg.inflow_rate != 0.0:
            p = chamber.pressure
            leg.work += p * chamber.fed * leg.inflow_rate
            leg.work -= 0.5 * p * p / chamber.modulus * chamber.grown * leg.inflow_rate


@compiled
def flow_through(legs: LegArrays, n: int, k: int, y: Vector) -> float:
    """Flow [m^3/s] of valve k of a leg by its action, which writes into `out` too, see `records`."""
    leg, valve = legs.records[n], legs.valves[k]
    before = legs.chambers[valve.before if leg.opening >= 0.0 else valve.back].pressure
    legs.numbers[MEMORY] = valve.memory
    for i in range(valve.states):
        legs.numbers[STATES + i] = y[valve.state + i]
    after, constants = legs.chambers[valve.after].pressure, legs.numbers[valve.constants :]
    flow = call_law(valve.law, before, after, leg.pilot, leg.opening, leg.travel, constants, legs.numbers)
    return float(flow)


@once
def pass_valve(legs: LegArrays, n: int, k: int, y: Vector, slope: Vector) -> None:
    """Flow of valve k of a leg, the oil that it moves, and what it takes."""
    leg, valve = legs.records[n], legs.valves[k]
    flow = valve.flow = flow_through(legs, n, k, y)
    legs.gaps[legs.chambers.size + k].now = legs.numbers[MEMORY]
    for i in range(valve.states):
        slope[valve.state + i] = legs.numbers[STATES + i]
    if flow == 0.0:
        return
    first, second = (
        legs.chambers[valve.before if leg.opening >= 0.0 else valve.back],
        legs.chambers[valve.after],
    )
    upstream = (flow > 0.0 and first.source == 0) or second.source != 0
    moved = flow * (first.weight if upstream else second.weight)
    carried = moved * (second.enthalpy - first.enthalpy)
    lost = -carried
    if first.source + second.source > 0:
        lost = flow * (first.pressure - second.pressure)
        leg.work += lost + carried
    if first.state >= 0:
        slope[first.state] -= moved / first.scale
        if first.source != 0:  # the pump's line counts its oil, too: what is drawn brings its pressure's work
            leg.work -= moved * first.pressure
    if second.state >= 0:
        slope[second.state] += moved / second.scale
        if second.source != 0:
            leg.work += moved * second.pressure
    integrate(valve.passed, moved, slope)
    integrate(valve.loss, lost, slope)
    leg.loss += lost


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
def push_stage(legs: LegArrays, n: int, stage: int, extension: float, rate: float, slope: Vector) -> float:
    """Force [N] of stops, seals and damping that pushes the ends of a stage apart, and what they take.

    Arguments:
        legs, n: records, and which leg. stage: 0: the outer one, or all of the leg; 1: the inner one.
        extension, rate: of the stage [m], [m/s]. slope: rates of states, of which integrals are written.
    """
    leg = legs.records[n]
    force = 0.0
    if leg.stop[stage] > 0.0:
        stiffness, damping = leg.stop[stage], leg.stop_damping[stage]
        low, high = leg.lowest[stage] - extension, extension - leg.highest[stage]
        place = legs.chambers.size + legs.valves.size + STOPS * n + 2 * stage
        legs.gaps[place].now, legs.gaps[place + 1].now = low, high
        force = stop_force(low, -rate, stiffness, damping) - stop_force(high, rate, stiffness, damping)
        deepest = max(0.0, low) - max(0.0, high)
        held = -(force - stiffness * deepest) * rate
        leg.stopped += 0.5 * stiffness * deepest * deepest
        integrate(leg.stop_loss, held, slope)
        leg.loss += held
    rubbed = seals(leg.coulomb, leg.static, leg.stribeck, leg.transition, rate)
    leg.friction += rubbed * rate
    viscous = leg.damping * rate * rate
    integrate(leg.seal_loss, rubbed * rate, slope)
    integrate(leg.viscous_loss, viscous, slope)
    leg.loss += viscous
    return float(force - rubbed - leg.damping * rate)


@once
def push_ends(legs: LegArrays, n: int, slope: Vector) -> None:
    """The force that pushes the ends apart, by the work of pressures on travel and length; a tube's motion."""
    leg = legs.records[n]
    by_travel = by_length = 0.0
    for c in range(leg.chamber, leg.chamber + leg.chambers):
        chamber = legs.chambers[c]
        by_travel += chamber.pressure * chamber.by_travel
        by_length += chamber.pressure * chamber.by_length
    s, v = leg.travel, leg.travel_rate
    outer = by_travel + push_stage(legs, n, 0, s, v, slope)
    if leg.stage < 0:
        leg.force = outer + by_length
        return
    inner = push_stage(legs, n, 1, leg.length - leg.length0 - s, leg.rate - v, slope)
    leg.force = by_length + inner
    slope[leg.stage] = v
    slope[leg.stage + 1] = (outer - inner - leg.tube_damping * v) / leg.tube_mass
    lost = leg.tube_damping * v * v
    leg.kinetic = 0.5 * leg.tube_mass * v * v
    integrate(leg.stage_loss, lost, slope)
    leg.loss += lost


@compiled
def press_leg(legs: LegArrays, n: int, y: Vector, slope: Vector) -> None:
    """All of a leg at an instant: force, powers and flows into its records, rates of its states into `slope`.

    Arguments:
        legs, n: records, which say how long the leg is, and which one. y: states, of which its own are read.
        slope: their rates, of which its own are written.
    """
    leg = legs.records[n]
    if abs(leg.opening) < CLOSED:
        leg.opening = 0.0
    for i in range(leg.first, leg.first + leg.states):
        slope[i] = 0.0
    leg.work = leg.loss = leg.friction = leg.stopped = 0.0
    fill_chambers(legs, n, y)
    if leg.valves > 0:
        leg.pilot = legs.chambers[leg.tank if leg.opening >= 0.0 else leg.supply].pressure
        for k in range(leg.valve, leg.valve + leg.valves):
            pass_valve(legs, n, k, y, slope)
    push_ends(legs, n, slope)


@compiled
def press_all(legs: LegArrays, y: Vector, slope: Vector) -> None:
    """All legs of a machine at an instant, and its pump.

    Their records say length, rate, inflow, inflow_rate and opening. Arguments: see `press_leg`.
    """
    for n in range(legs.pumps.size):
        line = legs.chambers[legs.pumps[n].chamber]
        line.oil = line.oil0 + line.scale * y[line.state]
        line.pressure = liquid_pressure(line.law, line.oil, line.volume, line.span, line.modulus)
        slope[line.state] = 0.0
    for n in range(legs.records.size):
        press_leg(legs, n, y, slope)
    for n in range(legs.pumps.size):
        pump = legs.pumps[n]
        line = legs.chambers[pump.chamber]
        pump.now = min(1.0, max(0.0, (pump.pressure - line.pressure) / pump.range)) * pump.flow
        pump.work = pump.now * line.pressure
        slope[line.state] += pump.now / line.scale
        slope[pump.given] = pump.now


@compiled
def powers_of(legs: LegArrays) -> tuple[float, float, float]:
    """Powers [W] as evaluated last: of what gives oil, taken by flows and dampers, and taken by seals."""
    work = loss = friction = 0.0
    for n in range(legs.records.size):
        leg = legs.records[n]
        work, loss, friction = work + leg.work, loss + leg.loss, friction + leg.friction
    for n in range(legs.pumps.size):
        work += legs.pumps[n].work
    return work, loss, friction


@compiled
def stored_by(legs: LegArrays, n: int) -> float:
    """Energy [J] stored in a leg as it stands in its records: oil, air, cavities, stops, its tube's motion."""
    leg = legs.records[n]
    total = leg.stopped + leg.kinetic
    for c in range(leg.chamber, leg.chamber + leg.chambers):
        if legs.chambers[c].law != CONSTANT:
            total += stored_in(legs.chambers, c)
    return float(total)


@entry
def evaluate_legs(legs: LegArrays, y: Vector, slope: Vector) -> None:
    """Evaluate all legs as `press_all` does, from Python."""
    press_all(legs, y, slope)
