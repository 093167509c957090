"""What is kept of a step: the largest force, and the records within it."""

import math

from support_exudyn.formulations.compiled.events import copy_contacts, look
from support_exudyn.formulations.compiled.stabilised import square_of
from support_exudyn.formulations.compiled.step import WEIGHTS, close_joints, combine, evaluate, within
from support_exudyn.formulations.statistics.steps import INNER, OF_STEP
from support_exudyn.scene.arrays import CONTACT_NUMBERS, STAGES, Matrix, SceneArrays, Scratch, Vector
from support_exudyn.scene.compilation import compiled, once
from support_exudyn.scene.forces import observe, press
from support_exudyn.scene.motion import follow_courses, place
from user_forces.roots import NEAR_PEAK, NEAR_TOP, PEAK_LOOKS, PEAK_SAMPLES, StepPeak, peak_place, peak_with

LOBATTO_END, LOBATTO_INNER = 1 / 12, 5 / 12  # weights of Lobatto's rule with four nodes


@compiled
def size(scene: SceneArrays, n: int) -> float:
    """Magnitude of a contact's force [N] as it stands in the scene."""
    return math.hypot(scene.contacts[n].normal, scene.contacts[n].friction)


@once
def peak_of(scene: SceneArrays, n: int, path: Matrix, y: Vector, slope: Vector) -> StepPeak:
    """The largest force of a contact in a step; next to the largest so far it is sought between the samples."""
    peak = StepPeak(-math.inf, 0.0, 0.0, 1.0)
    for k in range(PEAK_LOOKS):
        x = peak_place(peak, k)
        look(scene, n, x, path, y, slope, True)
        peak = peak_with(peak, k, x, size(scene, n))
        if k == PEAK_SAMPLES and peak.top <= NEAR_TOP * scene.contacts[n].largest:
            break
    return peak


@compiled
def write_record(scene: SceneArrays, t: float, y: Vector, slope: Vector, row: Vector) -> None:
    """Write a record of what has been evaluated at t [s].

    That is the state, accelerations, multipliers, what contacts remember, courses, friction of joints.
    """
    row[0] = t
    i, count = 1, 3 * scene.bodies.size
    for k in range(y.size):
        row[i + k] = y[k]
    i += y.size
    for k in range(count):
        row[i + k] = slope[count + k]
    i += count
    for k in range(scene.rows.size):
        row[i + k] = scene.rows[k].held
    i += scene.rows.size
    for k in range(scene.contacts.size):
        one = scene.contacts[k]
        pressed = one.closed != 0.0 and one.depth > 0.0
        row[i], row[i + 1] = (one.fx, one.fy) if pressed else (0.0, 0.0)
        row[i + 2], row[i + 3] = (one.normal, one.friction) if pressed else (0.0, 0.0)
        row[i + 4], row[i + 5], row[i + 6] = one.depth, one.slip, one.impact_velocity
        row[i + 7], row[i + 8] = one.x, one.y
        i += CONTACT_NUMBERS
    for k in range(scene.courses.size):
        row[i], row[i + 1] = scene.courses[k].value, scene.courses[k].rate
        i += 2
    for k in range(scene.rubbing.size):
        row[i] = scene.rubbing[k].force
        i += 1


@compiled
def evaluate_record(scene: SceneArrays, room: Scratch, t: float, forced: bool) -> None:
    """Let the scene stand as in `room.probe`, within the last step at t [s]; forced: with all forces."""
    copy_contacts(room.then, scene.contacts)
    if forced:
        evaluate(scene, t, room.probe, room.slope, room.right)
        return
    follow_courses(scene, t)
    if scene.contacts.size > 0:
        place(scene, room.probe)
    for n in range(scene.contacts.size):
        observe(scene, n, room.probe)
        press(scene, n, room.probe, room.slope)


@compiled
def begin_nodes(scene: SceneArrays, room: Scratch, t: float, y: Vector) -> None:
    """Write the node at t [s] that the next step begins with, as it has been evaluated."""
    if room.nodes.size > 0:
        write_record(scene, t, y, room.rates[0], room.nodes[OF_STEP * int(room.report[0].nodes)])


@once
def write_nodes(scene: SceneArrays, room: Scratch, t: float, h: float) -> float:
    """Write the other nodes of a step of h [s] from t, whose end stands in the scene.

    Returns by how much an explicit step is away from Lobatto's integral of its own rates at the nodes, in units
    of what is allowed; 0 of a stabilised step. Where a force has a corner within the step, that is half of the
    true error in the median of all places; the embedded pair shows 5 %. Of smooth rates it is of order 6.
    """
    nodes, rates, explicit = room.nodes, room.rates, room.going[0].decay == 0.0
    if nodes.size == 0 and not explicit:
        return 0.0
    first = OF_STEP * int(room.report[0].nodes)
    if nodes.size > 0:
        write_record(scene, t + h, room.end, rates[STAGES - 1], nodes[first + 3])
    off = rates[1]  # which the interpolation has no weight for
    if explicit:
        combine(WEIGHTS[STAGES - 1], rates, STAGES - 1, off.size, room.probe)
        for i in range(off.size):
            off[i] = room.probe[i] - LOBATTO_END * (rates[0, i] + rates[STAGES - 1, i])
    for n in range(1, 3):
        x = INNER if n == 1 else 1.0 - INNER
        within(room.path, x, 0, room.probe.size, room.probe)
        evaluate_record(scene, room, t + x * h, explicit or room.forces)
        if nodes.size > 0:
            write_record(scene, t + x * h, room.probe, room.slope, nodes[first + n])
        for i in range(off.size):
            off[i] -= LOBATTO_INNER * room.slope[i]
    copy_contacts(room.then, scene.contacts)
    return h * math.sqrt(square_of(off, room.weights) / off.size) if explicit else 0.0


@once
def end_nodes(room: Scratch) -> None:
    """Keep the nodes of a step that stands, and begin the next with its last."""
    nodes = room.nodes
    if nodes.size > 0:
        first = OF_STEP * int(room.report[0].nodes)
        for i in range(nodes.shape[1]):
            nodes[first + OF_STEP, i] = nodes[first + 3, i]
        room.report[0].nodes += 1


@once
def note_peaks(scene: SceneArrays, room: Scratch, t: float, h: float) -> None:
    """Keep the largest forces of a step of h [s] from t, whose ends are `room.now` and `room.then`."""
    now, then = room.now, room.then
    for m in range(then.size):
        if then[m].closed != 0.0:
            first, final = math.hypot(now[m].normal, now[m].friction), size(scene, m)
            if max(first, final) > NEAR_PEAK * then[m].largest:
                peak = peak_of(scene, m, room.path, room.probe, room.slope)
                if max(peak.top, final) > then[m].largest:
                    then[m].largest = max(peak.top, final)
                    then[m].largest_at = t + h * (peak.at if peak.top > final else 1.0)
        room.report[0].clamped += then[m].push < 0.0


@once
def write_records(scene: SceneArrays, room: Scratch, t: float, h: float, until: float) -> None:
    """Write the records within a step of h [s] from t, up to `until` [s]."""
    n, times = int(room.report[0].records), room.times
    while n < times.size and times[n] <= until:
        within(room.path, min(1.0, (times[n] - t) / h), 0, room.probe.size, room.probe)
        close_joints(scene, times[n], room.probe, room.right)
        evaluate_record(scene, room, times[n], room.forces)
        write_record(scene, times[n], room.probe, room.slope, room.rows[n])
        n += 1
    room.report[0].records = n
