"""The support as anyone with scipy would do it: equations of motion by hand, LSODA and its events.

Coordinates are the displacements and turns of the four links, which pins and columns hold by ten conditions
g(q, t) = 0. M q'' + G^T l = f and G q'' = c - 2 a g' - a^2 g (Baumgarte) give the accelerations. Between
impacts and separations, which `solve_ivp` locates, the equations are smooth and the initial impact velocity
is a constant.
"""

import itertools
import math
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from studies.benchmarking.peers.plain_support import (
    COLUMN_LINK,
    JOURNAL_LINK,
    PeerRun,
    PlainSupport,
    Series,
    plain_support,
    undisturbed,
)
from support_exudyn.model.drives.drive import Held
from support_exudyn.scenario.scenario import Scenario

DRAWN_BACK = 50.0  # rate at which the drift of the conditions decays [1/s]
MOST_PIECES = 2000  # of a run, each ends with an impact or separation
NOTED = np.array([0.25, 0.5, 0.75, 1.0])  # parts of its long steps that are looked at


def run_lsoda(scenario: Scenario, tolerance: float) -> PeerRun:
    """Integrate a scenario.

    Arguments:
        scenario: see `plain_support`; its own step and solver are not used.
        tolerance: of LSODA, relative, and absolute for places [m], turns [rad] and their rates alike.

    Raises InputError if the scenario is not covered, RuntimeError if LSODA gives up.
    """
    support = plain_support(scenario)
    equations = PeerEquations(support)
    breaks = [t for t in scenario.drive.breaks if 0.0 < t < scenario.duration]
    t, state, speed, closed = 0.0, np.zeros(24), 0.0, False
    pieces: list[tuple[float, Any]] = []  # initial impact velocity and what `solve_ivp` gave
    with undisturbed():
        while t < scenario.duration:
            if len(pieces) > MOST_PIECES:
                raise RuntimeError(
                    f"more than {MOST_PIECES} impacts and separations by {t} s: the tolerance is too loose"
                )
            end = next((one for one in breaks if one > t + 1e-12), scenario.duration)
            found = _smooth(equations, t, end, state, speed, closed, tolerance)
            if not found.success:
                raise RuntimeError(f"LSODA gave up at {t} s: {found.message}")
            pieces.append((speed, found))
            t, state = float(found.t[-1]), found.y[:, -1]
            if found.status == 1:
                t, state = float(found.t_events[0][0]), found.y_events[0][0]
                closed = not closed
                place, velocity, _ = equations.journal(state)
                speed = max(0.0, float(place @ velocity) / support.clearance) if closed else 0.0
    times, forces = [], []
    for speed, found in pieces:
        within = np.concatenate([h + (k - h) * NOTED for h, k in itertools.pairwise(found.t)])
        for at, each in zip(within.tolist(), found.sol(within).T, strict=True):
            (x, y), (vx, vy), spin = equations.journal(each)
            fx, fy, _ = support.force(x, y, vx, vy, spin, speed)
            times.append(at)
            forces.append(math.hypot(fx, fy))
    return PeerRun(np.array(times), np.array(forces))


def _smooth(
    equations: "PeerEquations",
    begin: float,
    end: float,
    state: Series,
    speed: float,
    closed: bool,
    tolerance: float,
) -> Any:
    """The motion up to the next impact or separation, or to the end [s], as `solve_ivp` gives it."""
    side = -1.0 if closed else 1.0

    # just after a change the depth is zero but for rounding: it must not be seen as the next change
    def change(t: float, y: Series) -> float:
        if t == begin and begin > 0.0:
            return -side
        place, _, _ = equations.journal(y)
        return math.hypot(*place.tolist()) - equations.support.clearance

    change.terminal = True  # type: ignore[attr-defined]
    change.direction = side  # type: ignore[attr-defined]
    return solve_ivp(
        lambda t, y: equations.rates(t, y, speed if closed else None),
        (begin, end),
        state,
        method="LSODA",
        events=change,
        dense_output=True,
        rtol=tolerance,
        atol=tolerance,
    )


class PeerEquations:
    """Equations of motion; a state has displacements [m] and turns [rad] of the links, then their rates, (24,).

    Points of links are the pins at the links' own ends, the same pins on their parents, the heads of the
    columns and the journal. The Jacobian of all points changes by the turns alone.
    """

    def __init__(self, support: PlainSupport) -> None:
        self.support = support
        links, columns = support.links, support.columns
        carried = [n for n, one in enumerate(links) if one.parent >= 0]
        points = [
            *((n, one.pin) for n, one in enumerate(links)),
            *((links[n].parent, links[n].pin) for n in carried),
            *((COLUMN_LINK, one.head_point) for one in columns),
            (JOURNAL_LINK, support.bore),
        ]
        self.link = np.array([n for n, _ in points])
        self.start = np.array([point for _, point in points])
        self.arm = self.start - np.array([links[n].centre for n in self.link])
        self.feet = np.array([one.foot_point for one in columns])
        self.lengths = np.array([one.start_length for one in columns])
        self.heads = slice(len(points) - 1 - len(columns), len(points) - 1)
        self.pins = np.eye(2 * len(links), 2 * len(points))  # from places of points to distances in pins
        for k, n in enumerate(carried):
            for axis in range(2):
                self.pins[2 * n + axis, 2 * (len(links) + k) + axis] = -1.0
        self.mobility = 1.0 / np.array([x for one in links for x in (one.mass, one.mass, one.inertia)])
        self.weight = np.array([x for one in links for x in (*np.multiply(support.gravity, one.mass), 0.0)])
        self.jacobian = np.zeros((len(points), 2, 3 * len(links)))
        self.row = np.arange(len(points))
        for axis in range(2):
            self.jacobian[self.row, axis, 3 * self.link + axis] = 1.0

    def arms(self, turns: Series) -> Series:
        """Vectors from the links' centres to all points [m]."""
        c, s = np.cos(turns[self.link]), np.sin(turns[self.link])
        return np.stack(
            [c * self.arm[:, 0] - s * self.arm[:, 1], s * self.arm[:, 0] + c * self.arm[:, 1]], axis=1
        )

    def journal(self, state: Series) -> tuple[Series, Series, float]:
        """Place [m] and velocity [m/s] of the journal in its bore, and its spin [rad/s]."""
        at, rate = (
            state[3 * JOURNAL_LINK : 3 * JOURNAL_LINK + 3],
            state[12 + 3 * JOURNAL_LINK : 15 + 3 * JOURNAL_LINK],
        )
        c, s, (x, y) = math.cos(at[2]), math.sin(at[2]), self.arm[-1]
        arm = np.array([c * x - s * y, s * x + c * y])
        return at[:2] + arm - self.arm[-1], rate[:2] + rate[2] * np.array([-arm[1], arm[0]]), float(rate[2])

    def motion(self, t: float) -> tuple[float, float, float]:
        """Extension [m] of both columns, its rate [m/s] and second derivative [m/s^2] at a time [s]."""
        drive = self.support.drive
        second = 0.0
        if not isinstance(drive, Held) and drive.start < t < drive.end:
            width = drive.end - drive.start
            second = drive.stroke * (6.0 - 12.0 * (t - drive.start) / width) / width**2
        return drive.extension(t), drive.speed(t), second

    def rates(self, t: float, state: Series, speed: float | None) -> Series:
        """The rate of a state at a time [s]; speed: initial impact velocity [m/s], None in free flight."""
        at, rate = state[:12].reshape(4, 3), state[12:]
        arm, spin = self.arms(at[:, 2]), rate[2::3][self.link]
        jacobian = self.jacobian
        jacobian[self.row, 0, 3 * self.link + 2] = -arm[:, 1]
        jacobian[self.row, 1, 3 * self.link + 2] = arm[:, 0]
        moved = at[self.link, :2] + arm - self.arm
        velocity, bias = jacobian @ rate, -(spin**2)[:, None] * arm
        force = self.weight.copy()
        if speed is not None:
            (x, y), (vx, vy), turning = moved[-1].tolist(), velocity[-1].tolist(), float(spin[-1])
            fx, fy, moment = self.support.force(x, y, vx, vy, turning, speed)
            force += fx * jacobian[-1, 0] + fy * jacobian[-1, 1]
            force[3 * JOURNAL_LINK + 2] += moment

        extension, lengthening, second = self.motion(t)
        places = self.start[self.heads] + moved[self.heads] - self.feet
        length = np.hypot(*places.T)
        unit, along = places / length[:, None], velocity[self.heads]
        change = (unit * along).sum(axis=1)
        across = ((along**2).sum(axis=1) - change**2) / length + (unit * bias[self.heads]).sum(axis=1)

        rows = np.concatenate(
            [self.pins @ jacobian.reshape(-1, 12), np.einsum("ki,kij->kj", unit, jacobian[self.heads])]
        )
        off = np.concatenate([self.pins @ moved.reshape(-1), length - self.lengths - extension])
        drift = np.concatenate([self.pins @ velocity.reshape(-1), change - lengthening])
        wanted = np.concatenate([-self.pins @ bias.reshape(-1), second - across])
        wanted -= 2.0 * DRAWN_BACK * drift + DRAWN_BACK**2 * off
        moving = rows * self.mobility
        hold = np.linalg.solve(moving @ rows.T, wanted - moving @ force)
        return np.concatenate([rate, self.mobility * (force + rows.T @ hold)])
