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
from dataclasses import dataclass
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
    Held,
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

GRAVITY = (0.0, -9.81)  # [m/s^2]
BESIDE = 5e-3  # [s] between the postures by which speeds and accelerations are taken
NEWTON = 8  # steps from a posture to the next; their errors are squared by each
ROUNDS = 20  # of pin forces and the friction that follows from them; each leaves a tenth of the last change
TIP_X, TIP_Y, TILT = range(3)  # of a shift [m], [m], [rad]


class Press(NamedTuple):
    """A force that presses on the support besides its weight.

    body, point: where, in the start posture [m]. force: forward and up [N].
    """

    body: str
    point: Vector2
    force: Vector2


@dataclass(frozen=True)
class Stand:
    """The ideal support at an instant of a stroke.

    kinetics: its matrices. position, speed, acceleration: of all coordinates since the start [m], [rad], and
    their rates, shape (12,).
    """

    kinetics: Kinetics
    position: Matrix
    speed: Matrix
    acceleration: Matrix

    def constraints(self) -> Matrix:
        """C, shape (12, 12): two rows a pin, second body against the first, then one a column."""
        return self.kinetics.rows(self.position)

    def load(self, presses: Sequence[Press]) -> Matrix:
        """W - M a and what presses besides [N], [N m], shape (12,)."""
        force = self.kinetics.weight(GRAVITY) - self.kinetics.mass() * self.acceleration
        for press in presses:
            force = force + np.array(press.force) @ self.kinetics.point(self.position, *press[:2])[1]
        return force


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

    found = []
    for t in times:
        before, position, after = (close(position, t + beside) for beside in (-BESIDE, 0.0, BESIDE))
        speed = (after - before) / (2.0 * BESIDE)
        found.append(Stand(closed, position, speed, (after - 2.0 * position + before) / BESIDE**2))
    return found


def standing(support: HydraulicSupport) -> Stand:
    """The support at rest in its start posture."""
    return stands(support, Held(), [0.0])[0]


def forces(stand: Stand, rubbing: Mapping[str, ClearancePin], presses: Sequence[Press] = ()) -> Matrix:
    """L: forces of pins on their first bodies, thrusts of columns reversed [N], shape (12,).

    rubbing: pins whose friction counts, by name; it turns the bodies with a moment of the journal's radius.
    """
    constraints, load = stand.constraints(), stand.load(presses)
    found, moments = np.zeros_like(load), np.zeros_like(load)
    for _ in range(ROUNDS if rubbing else 1):
        found[:] = np.linalg.solve(constraints.T, load + moments)
        moments[:] = 0.0
        for name, pin in rubbing.items():
            size = float(np.hypot(*found[_rows(stand, name)]))
            angle = _friction_angle(stand, name, pin, size)
            _turn(stand, name, pin.contact.bearing.bore_radius * size * math.sin(angle), moments)
    return found


def openings(
    stand: Stand, pins: Mapping[str, ClearancePin], presses: Sequence[Press] = ()
) -> dict[str, Matrix]:
    """For each clearance pin where its journal lies from the bore's centre [m], shape (2,); bore on the first
    body.

    Its distance is clearance and the depth at which the law holds the load at rest.
    """
    carried = forces(stand, pins, presses)
    found: dict[str, Matrix] = {}
    for name, pin in pins.items():
        along = carried[_rows(stand, name)]
        size = float(np.hypot(*along))
        climbed = _friction_angle(stand, name, pin, size)
        c, s = math.cos(climbed), math.sin(climbed)
        normal = np.array([[c, -s], [s, c]]) @ along / size
        depth = pin.contact.normal.resting_depth(size * math.cos(climbed))
        found[name] = (pin.contact.bearing.clearance + depth) * normal
    return found


def influence(stand: Stand, name: str) -> Matrix:
    """How tip and tilt of the canopy follow the opening of a pin, shape (3, 2) [1], [1], [rad/m]."""
    ways = np.linalg.solve(stand.constraints(), np.eye(stand.position.size)[:, _rows(stand, name)])
    tip = stand.kinetics.linkage.points["tip"].point
    at_tip = stand.kinetics.point(stand.position, "canopy", tip)[1] @ ways
    return np.vstack([at_tip, ways[stand.kinetics.first("canopy") + 2]])


def shifts(stand: Stand, pins: Mapping[str, ClearancePin], presses: Sequence[Press] = ()) -> dict[str, Matrix]:
    """What each clearance pin moves the tip forward and up [m] and tilts the canopy [rad] by, (3,) each."""
    return {name: influence(stand, name) @ opening for name, opening in openings(stand, pins, presses).items()}


def _rows(stand: Stand, name: str) -> slice:
    first = 2 * list(stand.kinetics.linkage.pins).index(name)
    return slice(first, first + 2)


def _friction_angle(stand: Stand, name: str, pin: ClearancePin, size: float) -> float:
    """Angle of friction [rad], against the turning, under a load [N]; for laws without a state."""
    slip = _spin(stand, name) * pin.contact.bearing.bore_radius
    return math.atan(pin.contact.friction(slip, size) / size)


def _spin(stand: Stand, name: str) -> float:
    """Angular velocity of a pin's second body against its first [rad/s]."""
    place = stand.kinetics.linkage.pins[name]
    first, second = (stand.kinetics.turning(stand.speed.size, body) for body in (place.first, place.second))
    return float((second - first) @ stand.speed)


def _turn(stand: Stand, name: str, moment: float, moments: Matrix) -> None:
    """Add a moment [N m] on a pin's second body, and its opposite on the first."""
    place = stand.kinetics.linkage.pins[name]
    for body, sign in ((place.second, 1.0), (place.first, -1.0)):
        if body != GROUND:
            moments[stand.kinetics.first(body) + 2] += sign * moment


INSTANTS = 41  # of the rise; twice as many change its means by 1e-5
PLACES = 11  # of the stroke
STROKE = 0.5  # [m]
CREEP = 1e-3  # [m/s]: so slow that nothing has inertia


@cache
def _rise() -> tuple[Stand, ...]:
    return tuple(stands(reference_support(), CubicStep(), np.linspace(START, END, INSTANTS).tolist()))


def mean_shift(pins: Mapping[str, ClearancePin]) -> Matrix:
    """Mean shift over the rise, of clearance pins together:

    tip forward and up [m], canopy's tilt [rad], (3,).
    """
    found = np.array([sum(shifts(stand, pins).values()) for stand in _rise()])
    inner = found[1:-1].sum(axis=0) + 0.5 * (found[0] + found[-1])  # the rule of trapezoids
    mean: Matrix = inner / (INSTANTS - 1)
    return mean


def posture_numbers(case: str, scenario: Scenario) -> list[Number]:
    """The closed form's numbers for a case that was run."""
    along, up, tilt = mean_shift(scenario.clearance_pins).tolist()
    return [
        Number("closed_form_tip_shift_forward", case, 1e3 * along, "mm", 0.0),
        Number("closed_form_tip_shift_up", case, 1e3 * up, "mm", 0.0),
        Number("closed_form_canopy_tilt", case, DEGREES * tilt, "deg", 0.0),
    ]


@dataclass(frozen=True)
class UnderLoad:
    """What each pin moves the tip by under a load, along the stroke.

    extension: of the columns [m], (n,). shift: by pin, forward [m], (n,). thrust: least of both columns on the
    way [N]; negative: one is pulled.
    """

    extension: Matrix
    shift: Mapping[str, Matrix]
    thrust: float

    def mean(self, name: str) -> float:
        """Mean along the stroke [m]."""
        return float(self.shift[name].mean())


def loads(pin: ClearancePin) -> dict[str, UnderLoad]:
    """A pin without friction in all five places, under several loads, at rest."""
    support = reference_support()
    start = support.start()
    middle = tuple(
        0.5 * (a + b) for a, b in zip(start.ends["front_head"], start.ends["rear_head"], strict=True)
    )
    over = {"columns": (middle[0], middle[1]), "hinge": start.hinge, "tip": start.tip}
    presses = {
        "weight alone": (),
        "1 MN down over the columns": (Press("canopy", over["columns"], (0.0, -1e6)),),
        "100 kN down over the hinge": (Press("canopy", over["hinge"], (0.0, -1e5)),),
        "100 kN down on the tip": (Press("canopy", over["tip"], (0.0, -1e5)),),
        "100 kN to the rear": (Press("canopy", over["columns"], (-1e5, 0.0)),),
        "100 kN forward": (Press("canopy", over["columns"], (1e5, 0.0)),),
    }
    extension = np.linspace(0.0, STROKE, PLACES)
    along = stands(support, Steady(rate=CREEP), (extension / CREEP).tolist())
    pins, found = dict.fromkeys(PINS, pin), {}
    for load, press in presses.items():
        moved = [shifts(stand, pins, press) for stand in along]
        thrust = min(-float(forces(stand, {}, press)[2 * len(PINS) :].max()) for stand in along)
        shift = {name: np.array([one[name][TIP_X] for one in moved]) for name in PINS}
        found[load] = UnderLoad(extension, shift, thrust)
    return found
