"""What acts on the bodies: contacts, loads; their powers, and those of hydraulic legs."""

import math

from support_exudyn.scene.arrays import (
    DAMPING_LOSS,
    FRICTION_LOSS,
    MOMENT,
    ONE_SIDED,
    STRETCH,
    WORK,
    SceneArrays,
    Vector,
)
from support_exudyn.scene.compilation import call_law, compiled, inlined, once
from support_exudyn.scene.hydraulics.leg import powers_of
from support_exudyn.scene.hydraulics.records import LegArrays
from support_exudyn.scene.motion import push, push_point, spin_of, turn_of
from user_forces.contact import SHALLOWEST
from user_forces.journal import corner_in_slot, journal_in_bore, point_on_face
from user_forces.lawful import ROUNDING


@inlined
def observe(scene: SceneArrays, n: int, y: Vector) -> None:
    """Write how a journal stands in its bore and moves there, from directions and places of its bodies."""
    contact = scene.contacts[n]
    bore, journal = scene.points[contact.first], scene.points[contact.second]
    bore_spin, journal_spin = spin_of(scene, y, bore.body), spin_of(scene, y, journal.body)
    x, y_ = journal.x - bore.x, journal.y - bore.y
    vx, vy = journal.vx - bore.vx, journal.vy - bore.vy
    if contact.slot == 0:
        contact.depth, contact.rate, contact.slip, nx, ny, contact.arm = journal_in_bore(
            x, y_, vx, vy, bore_spin, journal_spin, contact.radius, contact.clearance
        )
    else:
        c, s = math.cos(contact.angle), math.sin(contact.angle)
        if bore.body >= 0:
            body = scene.bodies[bore.body]
            c, s = c * body.c - s * body.s, s * body.c + c * body.s
        along, across = c * x + s * y_, c * y_ - s * x
        # the plain rate across, less what the slot's turning moves the walls there
        speed, rise = c * vx + s * vy, c * vy - s * vx - bore_spin * along
        motion = 0.0, across, speed, rise, bore_spin, journal_spin, contact.radius, contact.clearance
        if contact.slot == ONE_SIDED:
            contact.depth, contact.rate, contact.slip, _, side, contact.arm = point_on_face(*motion)
        else:
            contact.depth, contact.rate, contact.slip, _, side, contact.arm = corner_in_slot(*motion)
        nx, ny = -s * side, c * side
        x, y_ = -s * across, c * across
        vx, vy = c * speed - s * rise, s * speed + c * rise
    contact.x, contact.y, contact.vx, contact.vy, contact.nx, contact.ny = x, y_, vx, vy, nx, ny


@inlined
def press(scene: SceneArrays, n: int, y: Vector, slope: Vector) -> None:
    """Write the force of a contact that has been observed, and the rate of its friction law's state.

    Before the surfaces have separated the law goes on as at SHALLOWEST, so that one with a dashpot does not
    jump. What cannot be the force of a law is no number, which the integrator looks for.
    """
    contact = scene.contacts[n]
    contact.normal = contact.friction = contact.damping = contact.fx = contact.fy = 0.0
    contact.push = 1.0
    if contact.state >= 0:
        slope[contact.state] = 0.0
    if contact.closed == 0.0:
        return
    out = scene.out
    depth, rate, slip = max(contact.depth, SHALLOWEST), contact.rate, contact.slip
    deflection = y[contact.state] if contact.state >= 0 else 0.0
    asked = call_law(
        contact.law,
        depth,
        rate,
        slip,
        contact.impact_velocity,
        deflection,
        scene.constants[contact.constants :],
        out,
    )
    friction, elastic = out[0], out[1]
    normal = asked if asked > 0.0 or asked != asked else 0.0
    lost = (normal - elastic) * rate
    lawful = elastic >= 0.0 and abs(normal) < math.inf and abs(friction) < math.inf
    lawful = lawful and (contact.state >= 0 or friction * slip <= 0.0)
    if not lawful or (elastic > 0.0 and lost < -ROUNDING * (normal + elastic) * abs(rate)):
        normal = math.nan
        if math.isfinite(depth + rate + slip):  # else this is what comes of an unlawful force
            contact.asked_depth, contact.asked_rate, contact.asked_slip = depth, rate, slip
            contact.asked_deflection = deflection
    size = elastic + abs(asked - elastic)
    contact.push = asked / size if size > 0.0 else 1.0
    contact.normal, contact.friction, contact.damping = normal, friction, lost
    contact.fx = -normal * contact.nx - friction * contact.ny
    contact.fy = -normal * contact.ny + friction * contact.nx
    if contact.state >= 0:
        slope[contact.state] = out[2]


@inlined
def push_contact(scene: SceneArrays, n: int) -> None:
    """Let a contact's force act at one point of space on both bodies."""
    contact = scene.contacts[n]
    if contact.closed == 0.0:
        return
    bore, journal = scene.points[contact.first], scene.points[contact.second]
    arm = contact.radius
    if contact.slot == 0:
        arm -= contact.clearance + 0.5 * contact.depth
    x, y = arm * contact.nx, arm * contact.ny  # from the journal's centre
    fx, fy = contact.fx, contact.fy
    push(scene, journal.body, fx, fy, (journal.rx + x) * fy - (journal.ry + y) * fx)
    x, y = x + journal.x - bore.x, y + journal.y - bore.y
    push(scene, bore.body, -fx, -fy, (bore.ry + y) * fx - (bore.rx + x) * fy)


@inlined
def lengthening(scene: SceneArrays, foot: int, head: int) -> tuple[float, float, float, float]:
    """Length between two points [m], its rate [m/s], and the direction."""
    one, two = scene.points[foot], scene.points[head]
    dx, dy = two.x - one.x, two.y - one.y
    length = math.sqrt(dx * dx + dy * dy)
    ux, uy = dx / length, dy / length
    return length, ux * (two.vx - one.vx) + uy * (two.vy - one.vy), ux, uy


@inlined
def push_apart(scene: SceneArrays, foot: int, head: int, fx: float, fy: float) -> None:
    """Add a force on the second point and its opposite on the first."""
    push_point(scene, head, fx, fy)
    push_point(scene, foot, -fx, -fy)


@compiled
def press_loads(scene: SceneArrays, t: float, y: Vector) -> None:
    """Forces, moments and powers of loads."""
    for n in range(scene.loads.size):
        one = scene.loads[n]
        point, origin = scene.points[one.point], scene.points[one.origin]
        constants = scene.constants[one.constants :]
        scene.out[0] = scene.out[1] = 0.0  # in the plane nothing is to the right
        for k in range(one.courses):
            scene.out[one.first + k] = scene.courses[one.course + k].value
        if one.kind == MOMENT:
            turn = turn_of(y, point.body) - turn_of(y, origin.body)
            spin = spin_of(scene, y, point.body) - spin_of(scene, y, origin.body)
            one.fx = call_law(one.law, t, turn, spin, 0.0, 0.0, constants, scene.out)
            push(scene, point.body, 0.0, 0.0, one.fx)
            push(scene, origin.body, 0.0, 0.0, -one.fx)
        elif one.kind == STRETCH:
            first, second = point.y - one.point_y, origin.y - one.origin_y
            one.fx = call_law(one.law, t, first, second, point.vy, origin.vy, constants, scene.out)
            one.fy = scene.out[0]
            push_point(scene, one.point, 0.0, one.fx)
            push_point(scene, one.origin, 0.0, one.fy)
        else:
            x, y_ = point.x - origin.x, point.y - origin.y
            vx, vy = point.vx - origin.vx, point.vy - origin.vy
            one.fx = call_law(one.law, t, x, y_, vx, vy, constants, scene.out)
            one.fy = scene.out[0]
            push_apart(scene, one.origin, one.point, one.fx, one.fy)
        one.work, one.loss = scene.out[one.powers], scene.out[one.powers + 1]


@compiled
def with_legs(
    legs: LegArrays | None, damping: float, friction: float, work: float
) -> tuple[float, float, float]:
    """Losses by damping and friction, and the power of what drives [W], with those of legs and their pump."""
    if legs is None:
        return damping, friction, work
    works, losses, frictions = powers_of(legs)
    return damping + losses, friction + frictions, work + works


@once
def powers(scene: SceneArrays, y: Vector, slope: Vector) -> None:
    """Write the rates of losses and work into `slope`."""
    damping = friction = work = 0.0
    for n in range(scene.contacts.size):
        contact = scene.contacts[n]
        damping += contact.damping
        friction -= contact.friction * contact.slip
    damping, friction, work = with_legs(scene.legs, damping, friction, work)
    for n in range(scene.loads.size):
        work, damping = work + scene.loads[n].work, damping + scene.loads[n].loss
    for n in range(scene.rubbing.size):
        one = scene.rubbing[n]
        friction -= one.force * one.slip
    for n in range(scene.joints.size):
        joint = scene.joints[n]
        if joint.course >= 0:
            work -= scene.courses[joint.course].rate * scene.rows[joint.row].held
    slope[DAMPING_LOSS], slope[FRICTION_LOSS], slope[WORK] = damping, friction, work
