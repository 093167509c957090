"""Static equilibrium with clearance joints, so that a run can start settled.

Places q and multipliers L at which elastic contacts without friction, oil, loads and the weight, f, balance:

    f(q) - C(q)^T L = 0,    g(q) = 0

by Newton's method. A journal in the middle of its bore has no stiffness: springs centre all of them at first,
stiff enough to hold the weight of the machine within the clearance, and are then taken away; contacts give way
meanwhile. That is how the Exudyn formulation settles, too.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from support_exudyn.mechanics.acting_loads import forces_at_rest
from support_exudyn.mechanics.kinetics import kinetics_of
from support_exudyn.mechanics.resting import resting
from support_exudyn.scene.arrays import Matrix, SceneArrays, Vector
from support_exudyn.scene.compilation import call_law, compiled, entry
from support_exudyn.scene.contract import Failure, SimulationError
from support_exudyn.scene.forces import (
    observe,
    press_bushings,
    press_cylinders,
    press_loads,
    press_oil,
    push_contact,
)
from support_exudyn.scene.legs import press_resting_legs
from support_exudyn.scene.limits import CENTRING
from support_exudyn.scene.motion import hold, place
from support_exudyn.scene.setup import Model
from user_forces.normal.law import LoadError, NormalLaw

ITERATIONS = 60
SHIFT = 1e-9  # [m] over which it is looked how forces change, and [rad] of a body of a metre
CLOSE = 1e-12  # [m], [rad] of the last change; rounding of coordinates on top:
ROUNDINGS = 64.0
LONGEST = 0.2  # [m], [rad] of a change
HANGS_BY = 0.01  # [m] that the spring by which a block hangs would give under the weight of all bodies
LEAST = 1.0  # [N], stands for that weight where there is none
VALID = 1.0 - 1e-9  # share of the depth up to which a law is valid, beyond which it goes on in proportion
UNSETTLED = (
    "Is every body held by pins and actuators, and does gravity press the clearance pins? Otherwise start "
    "concentric."
)


class Centring(NamedTuple):
    """How contacts are held while an equilibrium is looked for, shape (contacts,) each.

    pull: of the springs [N/m]; slack: depth at which they carry nothing [m]. soft: share of the law's force.
    deepest: depth up to which it is valid [m].
    """

    pull: Vector
    slack: Vector
    soft: Vector
    deepest: Vector


@compiled
def balance(
    scene: SceneArrays, centring: Centring, volumes: Matrix, y: Vector, x: Vector, left: Vector
) -> None:
    """Write what is left of forces and joints at places and multipliers x; pressures in y follow from them."""
    count = 3 * scene.bodies.size
    for i in range(count):
        y[i] = x[i]
    place(scene, y)
    hold(scene, y)
    for n in range(scene.bodies.size):
        body = scene.bodies[n]
        body.fx, body.fy, body.m = body.weight_x, body.weight_y, 0.0
    for n in range(scene.contacts.size):
        centre(scene, centring, n, y)
    for n in range(scene.cylinders.size):
        one = scene.cylinders[n]
        foot, head = scene.points[one.foot], scene.points[one.head]
        extension = math.hypot(head.x - foot.x, head.y - foot.y) - one.length0
        piston = one.bore * (one.oil_length + extension) + one.hose
        rod = one.rod_side * (one.rod_length - extension) + one.rod_hose
        y[one.state] = volumes[n, 0] + one.modulus * math.log(volumes[n, 2] / piston)
        y[one.state + 1] = volumes[n, 1] + one.modulus * math.log(volumes[n, 3] / rod)
    press_oil(scene)
    press_cylinders(scene, y, left)
    press_resting_legs(scene, scene.legs, y, left)
    press_loads(scene, 0.0, y)
    press_bushings(scene, y)
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
        left[count + n] = -row.off


@compiled
def centre(scene: SceneArrays, centring: Centring, n: int, y: Vector) -> None:
    """Let the elastic force of a contact act, and that of a spring to its middle."""
    contact = scene.contacts[n]
    observe(scene, n, y)
    force = centring.pull[n] * (contact.depth - centring.slack[n])
    if contact.depth > 0.0:
        depth = min(contact.depth, centring.deepest[n])
        constants = scene.constants[contact.constants :]
        call_law(contact.law, depth, 0.0, 0.0, 1.0, 0.0, constants, scene.out)
        force += centring.soft[n] * scene.out[1] * contact.depth / depth
    contact.fx, contact.fy = -force * contact.nx, -force * contact.ny
    contact.closed = 1.0
    push_contact(scene, n)
    contact.closed = 0.0


@entry
def linearised(
    scene: SceneArrays,
    centring: Centring,
    volumes: Matrix,
    y: Vector,
    x: Vector,
    left: Vector,
    other: Vector,
    slope: Matrix,
) -> None:
    """Write what is left of the balance, and how it changes with x, by differences; `other` is scratch."""
    count = 3 * scene.bodies.size
    for i in range(count):
        before = x[i]
        x[i] = before + SHIFT
        balance(scene, centring, volumes, y, x, left)
        x[i] = before - SHIFT
        balance(scene, centring, volumes, y, x, other)
        x[i] = before
        for k in range(x.size):
            slope[k, i] = (left[k] - other[k]) / (2.0 * SHIFT)
    balance(scene, centring, volumes, y, x, left)
    for n in range(scene.rows.size):
        row = scene.rows[n]
        for i in range(count):
            slope[i, count + n] = 0.0
        for i in range(scene.rows.size):
            slope[count + i, count + n] = 0.0
        if row.body >= 0:
            i = 3 * row.body
            slope[i, count + n], slope[i + 1, count + n], slope[i + 2, count + n] = -row.x, -row.y, -row.t
        if row.other >= 0:
            i = 3 * row.other
            slope[i, count + n], slope[i + 1, count + n], slope[i + 2, count + n] = -row.ox, -row.oy, -row.ot
        if row.carrier >= 0:
            slope[3 * row.carrier + 2, count + n] = -row.carrier_t


class _Search:
    """The search for the equilibrium of a model."""

    def __init__(self, model: Model, y: Vector) -> None:
        self.model, self.scene, self.y = model, model.scene, y
        scenario = model.scenario
        self.count = 3 * len(scenario.linkage.bodies)
        size = self.count + self.scene.rows.size
        room = max(size, y.size)  # rates of pressures are written at their places in the state
        self.x, self.left, self.other = np.zeros(size), np.zeros(room), np.zeros(room)
        self.slope = np.zeros((size, size))
        self.weight = sum(body.mass for body in scenario.linkage.bodies.values()) * math.hypot(
            *scenario.gravity
        )
        self.volumes = np.array(
            [[*one.start_pressures, *one.model.volumes(0.0)] for one in model.cylinders.values()]
        ).reshape(-1, 4)
        self.close = max(CLOSE, ROUNDINGS * math.ulp(scenario.linkage.farthest))

    def centring(self, share: float) -> Centring:
        """Springs that hold so much of the weight at the wall, and contacts that give way by so much of it."""
        found = []
        blocks = self.model.scenario.blocks
        for name, where in self.model.scenario.contact_places.items():
            law, clearance = where.contact.normal, where.contact.bearing.clearance
            pull, slack = share * self.weight / clearance, -clearance
            if name in blocks:  # it hangs, whatever the share
                pull, slack = max(self.weight, LEAST) / HANGS_BY, blocks[name].start_depth
            found.append((pull, slack, self._softness(law, share * clearance), VALID * law.largest_depth))
        return Centring(*np.array(found).reshape(-1, 4).T.copy())

    def _softness(self, law: NormalLaw, allowed: float) -> float:
        return min(1.0, self.weight / law.force_in_search(allowed)) if allowed > 0.0 else 1.0

    def newton(self, centring: Centring) -> bool:
        """Find the balance from where the search is; whether it has been found."""
        for _ in range(ITERATIONS):
            left, x = self.left[: self.x.size], self.x
            linearised(self.scene, centring, self.volumes, self.y, x, self.left, self.other, self.slope)
            try:
                change = self._change(left)
            except np.linalg.LinAlgError:
                return False
            largest = float(np.abs(change[: self.count]).max(initial=0.0))
            if not largest < math.inf:
                return False
            self.x = x + change * min(1.0, LONGEST / max(largest, LONGEST))
            if largest <= self.close:
                return True
        return False

    def _change(self, left: Vector) -> Vector:
        """The step of Newton's method; of multipliers whose rows repeat others the least."""
        repeats = len(self.scene.repeats)
        if not repeats:
            return np.asarray(np.linalg.solve(self.slope, -left))
        size, count = self.x.size, self.count
        again = np.linalg.svd(self.slope[count:size, :count])[0][:, -repeats:]
        bordered = np.zeros((size + repeats, size + repeats))
        bordered[:size, :size] = self.slope
        bordered[count:size, size:], bordered[size:, count:size] = again, again.T
        return np.asarray(np.linalg.solve(bordered, -np.concatenate([left, again.T @ self.x[count:]]))[:size])


def settle(model: Model, y: Vector) -> None:
    """Bring the state to static equilibrium under gravity, at rest: elastic contacts, no friction.

    Blocks that are to fall hang over their points meanwhile, and start from there as they were to start.

    Raises SimulationError if there is no equilibrium or it is not found.
    """
    scenario, scene = model.scenario, model.scene
    scene.courses["value"] = scene.courses["rate"] = scene.courses["bend"] = 0.0
    of_loads = [course(0.0) for load in scenario.acting_loads.values() for course in load.courses]
    scene.courses["value"][len(scene.courses) - len(of_loads) :] = of_loads  # which come last
    weights = {what: scene.bodies[what].copy() for what in ("weight_x", "weight_y")}
    search = _Search(model, y)
    falling = [list(scenario.linkage.bodies).index(name) for name in scenario.blocks]
    for what in weights:
        scene.bodies[what][falling] = 0.0
    try:
        held = _held_by_loads(model)
        if held is not None:
            search.x[: search.count] = held
        elif not all(search.newton(search.centring(share)) for share in _shares(model)):
            raise SimulationError(Failure("no static equilibrium was found", UNSETTLED, 0.0))
    except LoadError:
        raise SimulationError(Failure("no static equilibrium was found", UNSETTLED, 0.0)) from None
    finally:
        for what, pull in weights.items():
            scene.bodies[what] = pull
    y[: search.count] = search.x[: search.count]
    for n, name in enumerate(scenario.linkage.bodies):
        if name in scenario.blocks:
            moving, i = scenario.linkage.bodies[name], search.count + 3 * n
            y[i : i + 3] = *moving.velocity, moving.spin


def _shares(model: Model) -> tuple[float, ...]:
    """How springs are taken away, one share of the weight after another; with no contact there are none."""
    return CENTRING if model.contacts else (0.0,)


def _held_by_loads(model: Model) -> Vector | None:
    """Places at which a linkage rests that nothing but loads holds, such as springs; None if it is none."""
    scenario = model.scenario
    compliant = model.oil or model.cylinders or model.legs.names or model.scene.bushings.size
    if not scenario.acting_loads or model.contacts or compliant:
        return None
    closed, acting = kinetics_of(scenario.linkage), scenario.acting_loads
    weight = closed.weight(scenario.gravity)

    def forces(position: Matrix) -> Matrix:
        return weight + forces_at_rest(closed, acting, position, 0.0)

    return resting(closed, forces, np.zeros(weight.size))
