"""Where clearance pins let the support go, in closed form: no run, no engine, no integration.

The support with ideal pins is statically determinate: ten components of pin forces and two column forces stand
against four bodies. Its constraints' matrix C, 12 by 12, gives both ways between them:

    C^T L = W - M a        forces L of pins and columns under weights W, loads and inertia
    C dq = o               motion dq of the bodies when pins are opened by o, columns keeping their length

Under a load L a journal lies against its bore along L, at a distance of clearance and depth. With friction it
climbs, against the turning, by the angle whose tangent is the coefficient. What it moves any point by is the
work that the pin force of a unit force at that point does along the way (virtual work, by which C and C^T
belong together). First order: the way is small against the links.
"""

import math
from collections.abc import Mapping, Sequence
from functools import cache
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from studies.common.numbers import Number
from studies.common.rise import DEGREES, END, START
from support_exudyn import (
    ClearancePin,
    CubicStep,
    Drive,
    HydraulicSupport,
    Scenario,
    Steady,
    reference_support,
)
from support_exudyn.machines.four_bar_shield import PINS
from support_exudyn.mechanics.kinetics import Kinetics, kinetics_of
from support_exudyn.model.linkage import GROUND
from user_forces.values.value import Vector2

Matrix = npt.NDArray[np.float64]
Press = tuple[str, Vector2, Vector2]  # a force on a body, its point in the start posture [m]; forward, up [N]

GRAVITY = (0.0, -9.81)  # [m/s^2]
BESIDE = 5e-3  # [s] between the postures by which speeds and accelerations are taken
NEWTON = 8  # steps from a posture to the next; their errors are squared by each
ROUNDS = 20  # of pin forces and the friction that follows from them; each leaves a tenth of the last change
TIP_X, TIP_Y, TILT = range(3)  # of a shift [m], [m], [rad]


class Stand(NamedTuple):
    """The ideal support at an instant of a stroke.

    kinetics: its matrices. position, speed, acceleration: of all coordinates since the start [m], [rad], and
    their rates, shape (12,). constraints: C, shape (12, 12): two rows a pin, second body against the first,
    then one a column.
    """

    kinetics: Kinetics
    position: Matrix
    speed: Matrix
    acceleration: Matrix
    constraints: Matrix

    def rows(self, name: str) -> slice:
        """The rows of a pin."""
        first = 2 * list(self.kinetics.linkage.pins).index(name)
        return slice(first, first + 2)

    def friction_angle(self, name: str, pin: ClearancePin, size: float) -> float:
        """Angle of friction [rad], against the turning, under a load [N]; for laws without a state."""
        place = self.kinetics.linkage.pins[name]
        first, second = (self.kinetics.turning(self.speed.size, body) for body in (place.first, place.second))
        slip = float((second - first) @ self.speed) * pin.contact.bearing.bore_radius
        return math.atan(pin.contact.friction(slip, size) / size)


def stands(support: HydraulicSupport, drive: Drive, times: Sequence[float]) -> list[Stand]:
    """The support along a stroke, with the inertia that goes with it; both columns follow the drive."""
    closed = kinetics_of(support.linkage())
    position = np.zeros(3 * len(closed.linkage.bodies))
    wanted = closed.values(position)  # of pins, and lengths of columns
    columns = np.array(["column" in name for _, name in closed.owners()])

    def close(position: Matrix, t: float) -> Matrix:
        for _ in range(NEWTON):
            off = wanted + columns * drive.extension(t) - closed.values(position)
            position = position + np.linalg.solve(closed.rows(position), off)
        return position

    along = []
    for t in times:
        before, position, after = (close(position, t + beside) for beside in (-BESIDE, 0.0, BESIDE))
        speed, change = (after - before) / (2.0 * BESIDE), after - 2.0 * position + before
        along.append(Stand(closed, position, speed, change / BESIDE**2, closed.rows(position)))
    return along


def forces(stand: Stand, rubbing: Mapping[str, ClearancePin], presses: Sequence[Press] = ()) -> Matrix:
    """L: forces of pins on their first bodies, thrusts of columns reversed [N], shape (12,).

    rubbing: pins whose friction counts, by name; it turns the bodies with a moment of the journal's radius.
    """
    kinetics = stand.kinetics
    load = kinetics.weight(GRAVITY) - kinetics.mass() * stand.acceleration
    for body, point, force in presses:
        load = load + np.array(force) @ kinetics.point(stand.position, body, point)[1]
    carried, moments = np.zeros_like(load), np.zeros_like(load)
    for _ in range(ROUNDS if rubbing else 1):
        carried[:] = np.linalg.solve(stand.constraints.T, load + moments)
        moments[:] = 0.0
        for name, pin in rubbing.items():
            size = float(np.hypot(*carried[stand.rows(name)]))
            angle = stand.friction_angle(name, pin, size)
            moment = pin.contact.bearing.bore_radius * size * math.sin(angle)
            place = kinetics.linkage.pins[name]
            for body, sign in ((place.second, 1.0), (place.first, -1.0)):
                if body != GROUND:
                    moments[kinetics.first(body) + 2] += sign * moment
    return carried


def influence(stand: Stand, name: str) -> Matrix:
    """How tip and tilt of the canopy follow the opening of a pin, shape (3, 2) [1], [1], [rad/m]."""
    ways = np.linalg.solve(stand.constraints, np.eye(stand.position.size)[:, stand.rows(name)])
    tip = stand.kinetics.linkage.points["tip"].point
    at_tip = stand.kinetics.point(stand.position, "canopy", tip)[1] @ ways
    return np.vstack([at_tip, ways[stand.kinetics.first("canopy") + 2]])


def shifts(stand: Stand, pins: Mapping[str, ClearancePin], presses: Sequence[Press] = ()) -> dict[str, Matrix]:
    """What each clearance pin moves the tip forward and up [m] and tilts the canopy [rad] by, (3,) each.

    A journal lies from the bore's centre by clearance and the depth at which the law holds the load at rest;
    bore on the first body.
    """
    carried = forces(stand, pins, presses)
    moved = {}
    for name, pin in pins.items():
        along = carried[stand.rows(name)]
        size = float(np.hypot(*along))
        climbed = stand.friction_angle(name, pin, size)
        c, s = math.cos(climbed), math.sin(climbed)
        normal = np.array([[c, -s], [s, c]]) @ along / size
        depth = pin.contact.normal.resting_depth(size * math.cos(climbed))
        moved[name] = influence(stand, name) @ ((pin.contact.bearing.clearance + depth) * normal)
    return moved


# --- the rise, and other loads ---

INSTANTS = 41  # of the rise; twice as many change its means by 1e-5
PLACES = 11  # of the stroke
STROKE = 0.5  # [m]
CREEP = 1e-3  # [m/s]: so slow that nothing has inertia


@cache
def _rise() -> tuple[Stand, ...]:
    return tuple(stands(reference_support(), CubicStep(), np.linspace(START, END, INSTANTS).tolist()))


def mean_shift(pins: Mapping[str, ClearancePin]) -> Matrix:
    """Mean shift over the rise of all these pins: tip forward and up [m], canopy's tilt [rad], (3,)."""
    each = np.array([sum(shifts(stand, pins).values()) for stand in _rise()])
    mean: Matrix = np.trapezoid(each, axis=0) / (INSTANTS - 1)
    return mean


def posture_numbers(case: str, scenario: Scenario) -> list[Number]:
    """The closed form's numbers for a case that was run."""
    along, up, tilt = mean_shift(scenario.clearance_pins).tolist()
    return [
        Number("closed_form_tip_shift_forward", case, 1e3 * along, "mm", 0.0),
        Number("closed_form_tip_shift_up", case, 1e3 * up, "mm", 0.0),
        Number("closed_form_canopy_tilt", case, DEGREES * tilt, "deg", 0.0),
    ]


class UnderLoad(NamedTuple):
    """What each pin moves the tip by under a load, along the stroke.

    extension: of the columns [m], (n,). shift: by pin, forward [m], (n,). thrust: least of both columns on the
    way [N]; negative: one is pulled.
    """

    extension: Matrix
    shift: Mapping[str, Matrix]
    thrust: float

    def means(self) -> dict[str, float]:
        """Mean along the stroke [m], by pin."""
        return {name: float(shift.mean()) for name, shift in self.shift.items()}


def loads(pin: ClearancePin) -> dict[str, UnderLoad]:
    """A pin without friction in all five places, under several loads, at rest."""
    support = reference_support()
    start = support.start()
    (ax, ay), (bx, by) = start.ends["front_head"], start.ends["rear_head"]
    columns = 0.5 * (ax + bx), 0.5 * (ay + by)
    presses: dict[str, tuple[Press, ...]] = {
        "weight alone": (),
        "1 MN down over the columns": (("canopy", columns, (0.0, -1e6)),),
        "100 kN down over the hinge": (("canopy", start.hinge, (0.0, -1e5)),),
        "100 kN down on the tip": (("canopy", start.tip, (0.0, -1e5)),),
        "100 kN to the rear": (("canopy", columns, (-1e5, 0.0)),),
        "100 kN forward": (("canopy", columns, (1e5, 0.0)),),
    }
    extension = np.linspace(0.0, STROKE, PLACES)
    along = stands(support, Steady(rate=CREEP), (extension / CREEP).tolist())
    pins, under = dict.fromkeys(PINS, pin), {}
    for load, press in presses.items():
        moved = [shifts(stand, pins, press) for stand in along]
        thrust = min(-float(forces(stand, {}, press)[2 * len(PINS) :].max()) for stand in along)
        shift = {name: np.array([one[name][TIP_X] for one in moved]) for name in PINS}
        under[load] = UnderLoad(extension, shift, thrust)
    return under
