"""A cylindrical pin pressed into its bore along a line: half contact angle, peak pressure, depth.

Pin and bore are elastic, their contact has no friction, and nothing varies along the axis. Everything follows
from one number, the load per length p over 2 E* dR, with E* of `materials.effective_modulus` and the radial
clearance dR. With b = tan(half angle / 2)

    2 E* dR / p = (2 - ln(1 + b^2) - 2 b^4) / (pi b^2 (1 + b^2))

Source: Persson, On the Stress Distribution of Cylindrical Elastic Bodies in Contact, Chalmers (1964), for equal
materials; pressure as in Ciavarella and Decuzzi, Int. J. Solids Struct. 38 (2001) 4507-4523. For small angles
this is Hertz's line contact. The rule that says which applies: up to `LINE_CONTACT` the two differ in load by
less than 2 % and the contact is called a line contact; beyond it is conformal, and only Persson's form holds.

The depth is how far the middles of the two bodies approach. It is the integral of Persson's pressure over the
radial displacements of a disc and of a hole in a plane, which for equal materials add up to

    4 R p_n / E1 n / (n^2 - 1)    for the pressure p_n cos(n phi), n > 1,    E1 = 2 E*

The part n = 1 depends on where the bodies are held, and adds a depth in proportion to the load: it is taken so
that small angles give Johnson's depth, which is held in the middle of each body.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from user_forces.journal import JournalBearing
from user_forces.roots import bracketed_root
from user_forces.values.value import InputError

LINE_CONTACT = math.radians(10.0)  # half angle up to which Hertz's form is within 2 % of Persson's
WIDEST = math.radians(84.0)  # half angle; at 84.8 degrees the load has no bound
SMALLEST = 1e-9  # half angle [rad] of the lightest load that is told from none
NODES, WEIGHTS = np.polynomial.legendre.leggauss(60)

Array = npt.NDArray[np.float64]


class LineContact(NamedTuple):
    """What a force makes of a pin in its bore.

    half_angle: of the contact, seen from the pin's middle [rad]. peak_pressure: [Pa]. depth: by which pin and
    bore are pressed into each other, without what pin and link give besides [m]. stiffness: slope of the force
    over that depth [N/m]. conformal: whether Hertz's form has ceased to hold.
    """

    half_angle: float
    peak_pressure: float
    depth: float
    stiffness: float
    conformal: bool


def line_contact(bearing: JournalBearing, length: float, modulus: float, force: float) -> LineContact:
    """The contact of a pin in its bore under a force [N] >= 0.

    Arguments:
        bearing: radii and clearance.
        length: of the contact, along the axis [m], > 0.
        modulus: E* [Pa], see `user_forces.effective_modulus`.
        force: that presses the pin into the bore [N], >= 0.

    Raises InputError for a force that no half angle of up to 84 degrees carries.
    """
    if force == 0.0:
        return LineContact(0.0, 0.0, 0.0, 0.0, False)
    unit = 2.0 * modulus * bearing.clearance
    load = force / length / unit
    most = float(relative_load(np.array(WIDEST)))
    if not 0.0 < load <= most:
        raise InputError(
            f"force = {force:.6g} N on a pin of {length:.6g} m: allowed: from 0 to {most * unit * length:.6g} N"
        )
    low = float(relative_load(np.array(SMALLEST)))
    if load <= low:  # a pin that carries nothing but rounding
        return LineContact(0.0, 0.0, 0.0, 0.0, False)

    def excess(angle: float) -> float:
        return math.log(float(relative_load(np.array(angle))) / load)

    angle = bracketed_root(excess, SMALLEST, WIDEST, xtol=1e-15)
    radius = math.sqrt(bearing.journal_radius * bearing.bore_radius)  # with which Hertz's is exact
    step = 1e-4 * angle
    near = np.array([angle - step, angle, angle + step])
    loads = relative_load(near)
    depths = loads * relative_depth(near)
    return LineContact(
        half_angle=angle,
        peak_pressure=force / length / radius * float(relative_pressure(np.array(angle))),
        depth=float(depths[1]) * bearing.clearance,
        stiffness=float((loads[2] - loads[0]) / (depths[2] - depths[0])) * 2.0 * modulus * length,
        conformal=angle > LINE_CONTACT,
    )


def relative_load(half_angle: Array) -> Array:
    """p / (2 E* dR) for half contact angles [rad] from 0 to 84 degrees, of any shape."""
    square = np.tan(0.5 * half_angle) ** 2
    return np.asarray(np.pi * square * (1.0 + square) / (2.0 - np.log1p(square) - 2.0 * square * square))


def relative_pressure(half_angle: Array) -> Array:
    """Peak pressure times R / p, R the middle radius, p the load per length; Hertz's is 2 / (pi half angle)."""
    b = np.tan(0.5 * half_angle)
    return _pressure(b, b, np.zeros_like(b))


def relative_depth(half_angle: Array) -> Array:
    """Depth times 2 E* / p for half angles [rad], shape (n,); Johnson's is (2 ln(4 / angle) - 1) 2 / pi."""
    b = np.tan(0.5 * half_angle)[:, None]
    share = 0.5 * (NODES + 1.0)
    turn = 0.5 * np.pi * share**3  # dense where the logarithm has its pole
    weight = 0.25 * np.pi * WEIGHTS * 3.0 * share**2
    along = b * np.sin(turn)
    angle = 2.0 * np.arctan(along)
    pressure = _pressure(b, b * np.cos(turn), along) * 2.0 * b * np.cos(turn) / (1.0 + along * along) * weight
    kernel = -np.cos(angle) * np.log(2.0 * np.sin(0.5 * angle)) - 0.25
    held = 4.0 / np.pi * (math.log(2.0) - 1.0) + 1.0 / np.pi
    return np.asarray(8.0 / np.pi * (pressure * kernel).sum(axis=1) + held)


def _pressure(b: Array, root: Array, along: Array) -> Array:
    """Persson's pressure times R / p at y = tan(phi / 2) = `along`; root: of b^2 - y^2."""
    outer = np.sqrt(1.0 + b * b)
    elliptic = 2.0 / (np.pi * outer) * root / (1.0 + along * along)
    return np.asarray(elliptic + np.arctanh(root / outer) / (np.pi * b * b * (1.0 + b * b)))
