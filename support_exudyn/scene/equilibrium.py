"""Static equilibrium, so that a run can start settled: one Newton's method for both formulations.

Coordinates q and multipliers L at which elastic contacts without friction, oil, loads and the weight, f,
balance:

    f(q) - C(q)^T L = 0,    g(q) = 0

A `Balance` computes what is left of both: `ArrayBalance` from the arrays of a scene, `EngineBalance` of the
Exudyn formulation from the engine's model. A journal in the middle of its bore has no stiffness: springs centre
all journals at first, stiff enough to hold the weight of the machine within the clearance, and are then taken
away; contacts give way meanwhile.
"""

from __future__ import annotations

import math
from typing import NamedTuple, Protocol

import numpy as np

from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scene.arrays import Matrix, SceneArrays, Vector
from support_exudyn.scene.compilation import call_law, compiled, entry
from support_exudyn.scene.contract import Failure, SimulationError
from support_exudyn.scene.forces import (
    observe,
    press_loads,
    push_contact,
)
from support_exudyn.scene.legs import press_resting_legs
from support_exudyn.scene.motion import hold, place
from support_exudyn.scene.setup import Model
from user_forces.contact import Contact
from user_forces.normal.law import LoadError

# Shares of the weight that a centring spring holds at the wall, and of the clearance by which the weight may
# press a contact, one after the other.
CENTRING = (1.0, 0.3, 0.1, 0.03, 0.01, 1e-3, 1e-4, 1e-6, 0.0)
ITERATIONS = 80
CLOSE = 1e-12  # [m], [rad] of the last change; rounding of coordinates on top:
ROUNDINGS = 64.0
LONGEST = 0.2  # [m], [rad] of a change
SHIFT = 1e-9  # [m] over which a change of forces is measured, and [rad] of a body of a metre
SMOOTH_SHIFT = 1e-6  # the same of rows of constraints, and of forces where nothing makes contact
WEAK = 1e-9  # share of the largest stiffness below which nothing restores, where nothing makes contact
HELD = 1e-9  # share of the largest singular value of constraints below which a direction is free
HANGS_BY = 0.01  # [m] that the spring by which a block hangs would give under the weight of all bodies
LEAST = 1.0  # [N], stands for that weight where there is none
VALID = 1.0 - 1e-9  # share of the depth up to which a law is valid, beyond which it goes on in proportion
UNSETTLED = (
    "Is every body held by pins and actuators, and does gravity press the clearance pins? Otherwise start "
    "concentric."
)


class Balance(Protocol):
    """Forces and joints of a scene as functions of its coordinates q (n,) and of multipliers (joints,).

    joints: number of the rows of constraints.
    """

    joints: int

    def centre(self, share: float) -> None:
        """Let centring springs hold a share of the weight, and contacts give way by it; see `CENTRING`."""
        ...

    def linear(self, q: Vector, multipliers: Vector) -> tuple[Vector, Matrix]:
        """What is left of forces, f - C^T L [N], [N m], and of joints, g [m], [rad]; (n + joints,).

        Second its derivatives with respect to q (n + joints, n).
        """
        ...


def find_equilibrium(balance: Balance, q: Vector, scenario: Scenario) -> Vector:
    """Coordinates (n,) of the stable equilibrium to which springs that are taken away lead from a start q (n,).

    Raises SimulationError if there is no equilibrium or it is not found.
    """
    contacts = len(scenario.contact_places) > 0
    close = max(CLOSE, ROUNDINGS * math.ulp(scenario.linkage.farthest))
    try:
        for share in CENTRING if contacts else (0.0,):
            balance.centre(share)
            q = _newton(balance, q, close, 0.0 if contacts else WEAK)
    except (LoadError, ArithmeticError, np.linalg.LinAlgError):
        raise SimulationError(Failure("no static equilibrium was found", UNSETTLED, 0.0)) from None
    return q


def _newton(balance: Balance, q: Vector, close: float, weak: float) -> Vector:
    """Coordinates (n,) at which forces balance, by Newton's method from q (n,), in the directions left free.

    Of multipliers whose rows repeat others the least are taken.

    Arguments:
        close: largest last change of a coordinate [m], [rad].
        weak: see `_downhill`.

    Raises LinAlgError if no stable equilibrium is found.
    """
    size = q.size
    multipliers: Vector = np.zeros(balance.joints)
    left, slope = balance.linear(q, multipliers)
    multipliers = np.asarray(np.linalg.lstsq(slope[size:].T, left[:size], rcond=HELD)[0])
    for _ in range(ITERATIONS):
        left, slope = balance.linear(q, multipliers)
        rows, forces = slope[size:], slope[:size]
        base, values, directions = np.linalg.svd(rows)
        rank = int((values > HELD * values.max(initial=0.0)).sum())
        change = -directions[:rank].T @ (base[:, :rank].T @ left[size:] / values[:rank])
        free = directions[rank:].T
        step, stable = _downhill(-free.T @ forces @ free, free.T @ (left[:size] + forces @ change), weak)
        change += free @ step
        largest = float(np.abs(change).max(initial=0.0))
        if not largest < math.inf:
            break
        change *= min(1.0, LONGEST / max(largest, LONGEST))
        more = np.linalg.lstsq(rows.T, left[:size] + forces @ change, rcond=HELD)[0]
        multipliers = np.asarray(multipliers + more)
        q = np.asarray(q + change)
        if largest <= close:
            if stable:
                return q
            break
    raise np.linalg.LinAlgError


def _downhill(stiffness: Matrix, pull: Vector, weak: float) -> tuple[Vector, bool]:
    """The step (k,) of Newton's method under a pull (k,), and whether the stiffness (k, k) restores everywhere.

    Against a stiffness that pushes away the step goes along the pull.

    weak: share of the largest stiffness below which a direction has none; LinAlgError is raised then.
    """
    if not pull.size:
        return pull, True
    sizes, ways = np.linalg.eigh(0.5 * (stiffness + stiffness.T))
    if not np.abs(sizes).min() > weak * np.abs(sizes).max():
        raise np.linalg.LinAlgError
    if sizes[0] > 0.0:
        return np.asarray(np.linalg.solve(stiffness, pull)), True
    return np.asarray(ways @ (ways.T @ pull / np.abs(sizes))), False


class CentringSpring(NamedTuple):
    """How a contact is held while an equilibrium is sought.

    pull: of the spring to its middle [N/m]. slack: depth at which that carries nothing [m]. soft: share of the
    law's elastic force that acts. deepest: depth up to which the law is valid [m].
    """

    pull: float
    slack: float
    soft: float
    deepest: float

    def force(self, depth: float, elastic: float) -> float:
        """Force out of the wall [N] at a depth [m], with the law's elastic force [N] at `valid_depth`."""
        force = self.pull * (depth - self.slack)
        if depth > 0.0:
            force += self.soft * elastic * depth / min(depth, self.deepest)
        return force


def centring_spring(scenario: Scenario, name: str, contact: Contact, share: float) -> CentringSpring:
    """How a contact of this name is held with a share of `CENTRING`; blocks hang, whatever the share."""
    weight = sum(body.mass for body in scenario.linkage.bodies.values()) * math.hypot(*scenario.gravity)
    law, clearance = contact.normal, contact.bearing.clearance
    pull, slack = share * weight / clearance if clearance else 0.0, -clearance
    if name in scenario.blocks:
        pull, slack = max(weight, LEAST) / HANGS_BY, scenario.blocks[name].start_depth
    deepest, allowed = VALID * law.largest_depth, share * clearance
    soft = 1.0
    if allowed > 0.0:
        valid = min(allowed, deepest)
        soft = min(1.0, weight * valid / (law.elastic_force(valid) * allowed))
    return CentringSpring(pull, slack, soft, deepest)


@compiled
def balance(scene: SceneArrays, springs: Matrix, y: Vector, x: Vector, left: Vector) -> None:
    """Write what is left of forces and joints at places and multipliers x; states of legs in y follow."""
    count = 3 * scene.bodies.size
    for i in range(count):
        y[i] = x[i]
    place(scene, y)
    hold(scene, y)
    for n in range(scene.bodies.size):
        body = scene.bodies[n]
        body.fx, body.fy, body.m = body.weight_x, body.weight_y, 0.0
    for n in range(scene.contacts.size):
        hold_contact(scene, springs[n], n, y)
    press_resting_legs(scene, scene.legs, y, left)
    press_loads(scene, 0.0, y)
    for n in range(scene.bodies.size):
        body = scene.bodies[n]
        left[3 * n], left[3 * n + 1], left[3 * n + 2] = body.fx, body.fy, body.m
    for n in range(scene.rows.size):
        row, size = scene.rows[n], x[count + n]
        if row.body >= 0:
            i = 3 * row.body
            left[i] -= row.x * size
            left[i + 1] -= row.y * size
            left[i + 2] -= row.t * size
        if row.other >= 0:
            i = 3 * row.other
            left[i] -= row.ox * size
            left[i + 1] -= row.oy * size
            left[i + 2] -= row.ot * size
        if row.carrier >= 0:
            left[3 * row.carrier + 2] -= row.carrier_t * size
        left[count + n] = row.off


force_of_spring = compiled(CentringSpring.force)


@compiled
def hold_contact(scene: SceneArrays, spring: Vector, n: int, y: Vector) -> None:
    """Let the elastic force of a contact act, and that of a spring to its middle, see `CentringSpring`."""
    contact, elastic = scene.contacts[n], 0.0
    observe(scene, n, y)
    if contact.depth > 0.0:
        constants = scene.constants[contact.constants :]
        call_law(contact.law, min(contact.depth, spring[3]), 0.0, 0.0, 1.0, 0.0, constants, scene.out)
        elastic = scene.out[1]
    force = force_of_spring(CentringSpring(spring[0], spring[1], spring[2], spring[3]), contact.depth, elastic)
    contact.fx, contact.fy = -force * contact.nx, -force * contact.ny
    contact.closed = 1.0
    push_contact(scene, n)
    contact.closed = 0.0


@entry
def linearise(
    scene: SceneArrays,
    springs: Matrix,
    y: Vector,
    x: Vector,
    shift: float,
    left: Vector,
    other: Vector,
    slope: Matrix,
) -> None:
    """Write what is left of the balance, and how it changes with places, by differences; `other` is scratch."""
    for i in range(slope.shape[1]):
        before = x[i]
        x[i] = before + shift
        balance(scene, springs, y, x, left)
        x[i] = before - shift
        balance(scene, springs, y, x, other)
        x[i] = before
        for k in range(x.size):
            slope[k, i] = (left[k] - other[k]) / (2.0 * shift)
    balance(scene, springs, y, x, left)


class ArrayBalance:
    """The balance of a model's arrays, see `Balance`; y: its state, whose pressures follow from the places."""

    def __init__(self, model: Model, y: Vector) -> None:
        self.scenario, self.scene, self.y = model.scenario, model.scene, y
        self.joints, self._count = self.scene.rows.size, 3 * self.scene.bodies.size
        size = self._count + self.joints
        room = max(size, y.size)  # rates of pressures are written at their places in the state
        self._left, self._other = np.zeros(room), np.zeros(room)
        self._slope = np.zeros((size, self._count))

    def centre(self, share: float) -> None:
        """See `Balance`."""
        places = self.scenario.contact_places.items()
        springs = [centring_spring(self.scenario, name, place.contact, share) for name, place in places]
        self._springs = np.array(springs).reshape(-1, 4)

    def linear(self, q: Vector, multipliers: Vector) -> tuple[Vector, Matrix]:
        """See `Balance`."""
        x = np.concatenate([q, multipliers])
        shift = SHIFT if self.scene.contacts.size else SMOOTH_SHIFT
        linearise(self.scene, self._springs, self.y, x, shift, self._left, self._other, self._slope)
        return self._left[: x.size], self._slope


def settle(model: Model, y: Vector) -> None:
    """Bring the state to static equilibrium under gravity, at rest: elastic contacts, no friction.

    Blocks that are to fall hang over their points meanwhile, and start from there as they were to start.

    Raises SimulationError if there is no equilibrium or it is not found.
    """
    scenario, scene = model.scenario, model.scene
    scene.courses["value"] = scene.courses["rate"] = scene.courses["bend"] = 0.0
    of_loads = [course(0.0) for load in scenario.elements.values() for course in load.courses]
    scene.courses["value"][len(scene.courses) - len(of_loads) :] = of_loads  # which come last
    weights = {what: scene.bodies[what].copy() for what in ("weight_x", "weight_y")}
    falling = [list(scenario.linkage.bodies).index(name) for name in scenario.blocks]
    count = 3 * scene.bodies.size
    for what in weights:
        scene.bodies[what][falling] = 0.0
    try:
        y[:count] = find_equilibrium(ArrayBalance(model, y), np.zeros(count), scenario)
    finally:
        for what, pull in weights.items():
            scene.bodies[what] = pull
    for n, name in zip(falling, scenario.blocks, strict=True):
        moving, i = scenario.linkage.bodies[name], count + 3 * n
        y[i : i + 3] = *moving.velocity, moving.spin
