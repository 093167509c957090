"""How a run begins, and how velocities jump where the speed of a drive does."""

from support_exudyn.formulations.compiled.recording import write_record
from support_exudyn.formulations.compiled.step import evaluate
from support_exudyn.scene.arrays import JUMP_ENERGY, WORK, Matrix, SceneArrays, Scratch, Vector
from support_exudyn.scene.compilation import compiled, once
from support_exudyn.scene.legs import begin_legs
from support_exudyn.scene.motion import SINGULAR, solve
from user_forces.roots import STILL


@once
def begin_run(scene: SceneArrays, room: Scratch, y: Vector, rows: Matrix) -> bool:
    """Write the first record at 0 s, with the contacts that are closed then; whether the linkage moves."""
    least = evaluate(scene, 0.0, y, room.slope, room.right)
    for n in range(scene.contacts.size):
        contact = scene.contacts[n]
        if contact.depth > (STILL if contact.rate > 0.0 else 0.0):  # else it meets just now
            contact.closed, contact.impact_velocity = 1.0, max(0.0, contact.rate)
    evaluate(scene, 0.0, y, room.slope, room.right)
    write_record(scene, 0.0, y, room.slope, rows[0])
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
def jump(scene: SceneArrays, room: Scratch, t: float, y: Vector, jumps: Vector, report: Vector) -> None:
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
    report[JUMP_ENERGY] = kinetic_energy(scene, y) - before
    y[WORK] += report[JUMP_ENERGY]
