"""Legs at the start of a run: on which side of zero their gaps are, and where they rest in an equilibrium."""

import math

from support_exudyn.scene.compilation import compiled, entry
from support_exudyn.scene.hydraulics.fill import MET_PRESSURE
from support_exudyn.scene.hydraulics.leg import flow_through, press_all
from support_exudyn.scene.hydraulics.records import MEMORY, STATES, LegArrays, Records, Vector

ROUNDS = 40  # of Newton's method
SHIFT = 1e-9  # [m] over which it is looked how the force on a tube changes
FOUND = 1e-14  # [m] of its last change
SHARE = 1e-6  # of the oil in a line, over which it is looked how pressures change
ROUNDINGS = 8.0  # of pressures


@entry
def begin_sides(gaps: Records, valves: Records) -> None:
    """Write the side of zero on which each gap is, 0 for those that are not there.

    A gap that is met just at the start is on the side on which nothing happens yet: valves closed, chambers
    filled, stops free. Records then show what happens from there on. A valve with hysteresis keeps its state.
    """
    for k in range(gaps.size):
        gap = gaps[k]
        gap.side = 1.0 if gap.now > 0.0 else -1.0
        if math.isnan(gap.now):
            gap.side = 0.0
        elif gap.valve >= 0 and valves[gap.valve].jumps != 0:
            gap.side = 1.0 if valves[gap.valve].memory != 0.0 else -1.0
        elif abs(gap.now) <= gap.near:
            gap.side = gap.rest


@compiled
def join_rooms(legs: LegArrays, n: int, y: Vector, slope: Vector) -> None:
    """Evaluate all legs with the same pressure before and behind those valves of a leg that join rooms."""
    press_all(legs, y, slope)
    leg = legs.records[n]
    for _ in range(ROUNDS):
        moves = False
        for k in range(leg.valve, leg.valve + leg.valves):
            valve = legs.valves[k]
            if valve.joins != 0:
                moves = join(legs, k, y, slope) or moves
        if not moves:
            break


@compiled
def join(legs: LegArrays, k: int, y: Vector, slope: Vector) -> bool:
    """Let oil through a valve that joins two rooms, by a step of Newton's method; whether oil has moved."""
    first, second = legs.chambers[legs.valves[k].before], legs.chambers[legs.valves[k].after]
    drop = first.pressure - second.pressure
    if not abs(drop) > ROUNDINGS * 2.2e-16 * (second.modulus + abs(second.pressure)):
        return False
    shift = SHARE * min(first.scale, second.scale) * first.modulus
    before, after = y[first.state], y[second.state]
    y[first.state], y[second.state] = before - shift / first.scale, after + shift / second.scale
    press_all(legs, y, slope)
    fall = drop - (first.pressure - second.pressure)
    moved = shift * drop / fall if fall > 0.0 else 0.0
    y[first.state], y[second.state] = before - moved / first.scale, after + moved / second.scale
    press_all(legs, y, slope)
    return bool(fall > 0.0)


@compiled
def rest_tube(legs: LegArrays, n: int, y: Vector, slope: Vector) -> None:
    """Evaluate all legs with the tube of a leg of two stages where nothing pushes it, by Newton's method."""
    place = legs.records[n].stage
    y[place + 1] = 0.0
    for _ in range(ROUNDS):
        join_rooms(legs, n, y, slope)
        pushed = slope[place + 1]
        y[place] += SHIFT
        join_rooms(legs, n, y, slope)
        rise = (slope[place + 1] - pushed) / SHIFT
        y[place] -= SHIFT
        step = -pushed / rise if rise < 0.0 else 0.0
        y[place] += step
        join_rooms(legs, n, y, slope)
        if not abs(step) > FOUND:
            break


@entry
def rest_legs(legs: LegArrays, y: Vector, slope: Vector) -> None:
    """Let all legs rest at the lengths that their records tell, and evaluate them there, see `press_all`."""
    for n in range(legs.records.size):
        leg = legs.records[n]
        leg.rate = 0.0
        if leg.stage >= 0:
            rest_tube(legs, n, y, slope)
        else:
            join_rooms(legs, n, y, slope)
        for k in range(leg.valve, leg.valve + leg.valves):
            valve = legs.valves[k]
            valve.memory = 0.0
            flow_through(legs, n, k, y)
            if valve.jumps != 0 and legs.numbers[MEMORY] > MET_PRESSURE:
                valve.memory = 1.0
            for i in range(valve.states):
                y[valve.state + i] = legs.numbers[STATES + valve.states + i]
    press_all(legs, y, slope)
