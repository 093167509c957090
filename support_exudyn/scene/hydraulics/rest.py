"""Legs at rest, for a static equilibrium: oil stays inside, and tubes, lines and poppets come to rest."""

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.scene.compilation import compiled, entry
from support_exudyn.scene.hydraulics.flows import SEAT
from support_exudyn.scene.hydraulics.gaps import MET_PRESSURE
from support_exudyn.scene.hydraulics.leg import press_all
from support_exudyn.scene.hydraulics.records import Matrix, Records

ROUNDS = 40  # of Newton's method
SHIFT = 1e-9  # [m] over which it is looked how the force on a tube changes
FOUND = 1e-14  # [m] of its last change
SHARE = 1e-6  # of the oil in a line, over which it is looked how pressures change
ROUNDINGS = 8.0  # of pressures


@compiled
def rest_line(legs: Records, n: int, pumps: Records, gaps: Matrix, y: Series, slope: Series) -> None:
    """Evaluate all legs with the pressure of a leg's line that of the leg, unless a check valve is between."""
    leg = legs[n]
    press_all(legs, pumps, gaps, y, slope)
    if leg.line < 0 or leg.check != 0:
        return
    shift = SHARE * leg.line_scale * leg.modulus
    for _ in range(ROUNDS):
        drop = leg.line_pressure - leg.pressure
        if not abs(drop) > ROUNDINGS * 2.2e-16 * (leg.modulus + abs(leg.pressure)):
            break
        before, line_before = y[leg.state], y[leg.line]
        y[leg.state], y[leg.line] = before + shift / leg.scale, line_before - shift / leg.line_scale
        press_all(legs, pumps, gaps, y, slope)
        fall = drop - (leg.line_pressure - leg.pressure)
        moved = shift * drop / fall if fall > 0.0 else 0.0
        y[leg.state], y[leg.line] = before + moved / leg.scale, line_before - moved / leg.line_scale
        press_all(legs, pumps, gaps, y, slope)
        if not fall > 0.0:
            break


@compiled
def rest_tube(legs: Records, n: int, pumps: Records, gaps: Matrix, y: Series, slope: Series) -> None:
    """Evaluate all legs with the tube of a leg of two stages where nothing pushes it, by Newton's method."""
    place = legs[n].stage + 1
    y[place + 1] = 0.0
    for _ in range(ROUNDS):
        rest_line(legs, n, pumps, gaps, y, slope)
        pushed = slope[place + 1]
        y[place] += SHIFT
        rest_line(legs, n, pumps, gaps, y, slope)
        rise = (slope[place + 1] - pushed) / SHIFT
        y[place] -= SHIFT
        step = -pushed / rise if rise < 0.0 else 0.0
        y[place] += step
        rest_line(legs, n, pumps, gaps, y, slope)
        if not abs(step) > FOUND:
            break


@entry
def rest_legs(legs: Records, pumps: Records, gaps: Matrix, y: Series, slope: Series) -> None:
    """Let all legs rest at the lengths that their records tell, and evaluate them there, see `press_all`."""
    for n in range(legs.size):
        leg = legs[n]
        leg.rate = 0.0
        if leg.stage >= 0:
            rest_tube(legs, n, pumps, gaps, y, slope)
        else:
            rest_line(legs, n, pumps, gaps, y, slope)
        leg.open = 1.0 if leg.pressure > leg.opens + MET_PRESSURE else 0.0
        leg.rod_open = 1.0 if leg.rod_pressure > leg.rod_opens + MET_PRESSURE else 0.0
        if leg.poppet >= 0:
            above = leg.pressure - leg.opens
            y[leg.poppet], y[leg.poppet + 1] = above if above > 0.0 else above / SEAT, 0.0
    press_all(legs, pumps, gaps, y, slope)
