"""How a run begins: its state, how large its errors may be, its first record, and jumps of drives."""

import math

import numpy as np

from support_exudyn.formulations.compiled.recording import write_record
from support_exudyn.formulations.compiled.step import evaluate
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.kinetics import kinetics_of
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scene.arrays import LOSSES, WORK, SceneArrays, Scratch, Vector
from support_exudyn.scene.compilation import compiled, once
from support_exudyn.scene.equilibrium import settle
from support_exudyn.scene.hydraulics.fill import weigh_states
from support_exudyn.scene.legs import begin_legs
from support_exudyn.scene.motion import SINGULAR, solve
from support_exudyn.scene.setup import Model
from user_forces.roots import STILL

PLAY = 1e-3  # [m], stands for that of a machine without any
SLOWEST = 1e-3  # [m/s], of what journals may do in their bores, for scenes in which nothing falls
SHORTEST_ARM = 1e-3  # [m], of bodies whose points all lie at their centre
SMALL = 1e-9  # normal and friction forces by which the deflection of a friction law is scaled [m]


def first_state(model: Model) -> Vector:
    """The state at the start. Raises SimulationError if a static equilibrium is asked for and not found."""
    scenario, y = model.scenario, np.zeros(model.states)
    count = 3 * len(scenario.linkage.bodies)
    y[model.legs.first : model.legs.first + model.legs.states] = model.legs.start
    if scenario.start == "settled":
        settle(model, y)
    else:
        y[count : 2 * count] = _velocities(scenario)
        _start_sliding(model, y)
    return y


def _start_sliding(model: Model, y: Vector) -> None:
    """Write the states of friction laws of ideal joints that slide at the start."""
    scenario, count = model.scenario, 3 * model.scene.bodies.size
    still, rates = np.zeros((1, count)), y[count : 2 * count].reshape(1, -1)
    motion = BodyMotion(scenario.linkage, still, rates)
    for record, joint in zip(model.scene.rubbing, scenario.friction_joints.values(), strict=True):
        if record["state"] >= 0:
            y[record["state"]] = joint.law.steady_deflection(float(joint.slips(motion)[0]))


def _velocities(scenario: Scenario) -> Vector:
    """Velocities of all bodies at the start: the machine's, with the drive's, all pins ideal."""
    linkage = scenario.linkage
    velocity = np.array([part for body in linkage.bodies.values() for part in (*body.velocity, body.spin)])
    if all(drive.initial_speed == 0.0 for drive in scenario.drives_in_use):
        return velocity
    closed = kinetics_of(linkage)
    still = np.zeros_like(velocity)
    missing = closed.rates(lambda name: scenario.drive_of(name).initial_speed) - closed.rows(still) @ velocity
    return np.asarray(velocity + closed.respond(still, still, missing)[0])


def error_weights(model: Model, y: Vector, tolerance: float) -> Vector:
    """One over the largest error of a step, for each component of the state.

    `tolerance` times: the smallest play, for places; the speed of a fall through half of it, for velocities;
    the energy of all bodies at that speed, for losses and work; the pressure of the pump, or that which carries
    their weight, for pressures.

    Arguments:
        y: the state at the start, of whose velocities turning makes accelerations besides gravity's.
    """
    scenario = model.scenario
    velocity = y[3 * model.scene.bodies.size : 6 * model.scene.bodies.size].reshape(-1, 3)
    acceleration = float(np.abs(velocity[:, 2]).max() * np.hypot(*velocity[:, :2].T).max())
    bodies = scenario.linkage.bodies.values()
    play = min((place.play for place in scenario.contact_places.values()), default=PLAY)
    pull = math.hypot(*scenario.gravity) + acceleration
    speed = max(math.sqrt(pull * play), SLOWEST)
    arms = np.full(len(bodies), SHORTEST_ARM)
    for point in model.scene.points:
        if point["body"] >= 0:
            arms[point["body"]] = max(arms[point["body"]], math.hypot(point["arm_x"], point["arm_y"]))
    reach = np.column_stack([np.ones(len(bodies)), np.ones(len(bodies)), arms]).ravel()
    mass = sum(body.mass for body in bodies)
    found = np.zeros(model.states)
    found[: reach.size] = reach / play
    found[reach.size : 2 * reach.size] = reach / speed
    if model.legs.names:
        carries = mass * pull / float(model.legs.records["bore"].max())
        weigh_states(model.legs, found, carries, mass * speed**2, play)
    for record, place in zip(model.scene.contacts, scenario.contact_places.values(), strict=True):
        if record["state"] >= 0:
            found[record["state"]] = abs(place.contact.friction(0.0, 1.0, SMALL)) / SMALL
    for record, law in zip(model.scene.rubbing, scenario.friction_laws.values(), strict=True):
        if record["state"] >= 0:
            found[record["state"]] = abs(law(0.0, 1.0, SMALL)) / SMALL
    found[-LOSSES:] = 1.0 / (mass * speed**2)
    return np.asarray(found / tolerance)


# --- compiled ---


@once
def begin_run(scene: SceneArrays, room: Scratch, y: Vector) -> bool:
    """Write the first record at 0 s, with the contacts that are closed then; whether the linkage moves.

    Surfaces that touch within rounding are separated if they approach, so that their impact is located, and
    closed otherwise: a journal that is put on its bore at rest has no impact.
    """
    least = evaluate(scene, 0.0, y, room.slope, room.right)
    for n in range(scene.contacts.size):
        contact = scene.contacts[n]
        if contact.depth > (STILL if contact.rate > 0.0 else -STILL):
            contact.closed, contact.impact_velocity = 1.0, max(0.0, contact.rate)
    evaluate(scene, 0.0, y, room.slope, room.right)
    write_record(scene, 0.0, y, room.slope, room.rows[0])
    begin_legs(scene.legs)
    for n in range(scene.courses.size):
        scene.courses[n].still = 0
    return least > SINGULAR


@compiled
def kinetic_energy(scene: SceneArrays, y: Vector) -> float:
    """Kinetic energy of all bodies [J]."""
    count, total = scene.bodies.size, 0.0
    for n in range(count):
        body, i = scene.bodies[n], 3 * (count + n)
        inertia = 1.0 / body.light_turn - body.stand_in
        total += 0.5 * ((y[i] ** 2 + y[i + 1] ** 2) / body.light + y[i + 2] ** 2 * inertia)
    return total


@once
def jump(scene: SceneArrays, room: Scratch, t: float, y: Vector, jumps: Vector) -> None:
    """Change velocities as speeds of drives jump at t [s], jumps by course."""
    jumped = False
    for n in range(jumps.size):
        jumped = jumped or jumps[n] != 0.0
    if not jumped:
        return
    evaluate(scene, t, y, room.slope, room.right)
    for n in range(scene.bodies.size):
        body = scene.bodies[n]
        body.fx = body.fy = body.m = 0.0
    for n in range(scene.rows.size):
        scene.rows[n].wanted = 0.0
    for n in range(scene.joints.size):
        joint = scene.joints[n]
        if joint.course >= 0:
            scene.rows[joint.row].wanted = jumps[joint.course]
    solve(scene, room.right)  # impulses and changes of velocities in place of forces and accelerations
    before = kinetic_energy(scene, y)
    for n in range(scene.bodies.size):
        body, i = scene.bodies[n], 3 * (scene.bodies.size + n)
        y[i], y[i + 1], y[i + 2] = y[i] + body.ax, y[i + 1] + body.ay, y[i + 2] + body.a
    for n in range(scene.rows.size):
        room.impulses[n] = scene.rows[n].held
    room.report[0].jump_energy = kinetic_energy(scene, y) - before
    y[WORK] += room.report[0].jump_energy
