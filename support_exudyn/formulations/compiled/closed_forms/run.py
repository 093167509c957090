"""The run in closed forms: scenario in, outcome out."""

import numpy as np

from support_exudyn.formulations.compilation import on_arrays
from support_exudyn.formulations.compiled.closed_forms import layout
from support_exudyn.formulations.compiled.closed_forms.contact import accelerations
from support_exudyn.formulations.compiled.closed_forms.equations import law_at
from support_exudyn.formulations.compiled.closed_forms.ideal import run_ideal
from support_exudyn.formulations.compiled.closed_forms.integrate import (
    ACCEPTED,
    AT,
    CLAMPED,
    CUTS,
    DEAD_CENTRE,
    EVALUATIONS,
    FINISHED,
    GOING,
    IMPACTS,
    JUMPS,
    LARGEST,
    LARGEST_AT,
    LAST_STEP,
    NEXT_STEP,
    NOT_A_NUMBER,
    PAUSED,
    STEPS,
    STOPPED_AT,
    STUCK,
    TOO_MANY_IMPACTS,
    TOO_MANY_STEPS,
    integrate,
)
from support_exudyn.formulations.compiled.closed_forms.layout import DriveValues, Matrix, Vector
from support_exudyn.formulations.compiled.closed_forms.machine_model import MachineModel
from support_exudyn.formulations.compiled.closed_forms.setup import MOST_IMPACTS, RunArrays, outline
from support_exudyn.formulations.contract import Failure, Progress, SimulationError
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.channels import DataNeeds
from support_exudyn.mechanics.contact_history import RelativeMotion, acting, journal_arm, series
from support_exudyn.mechanics.contact_state import Onset, PinMemory
from support_exudyn.mechanics.joint_forces import JointForces, PinForce, open_joint_forces
from support_exudyn.mechanics.trajectory import ContactSeries, Counts, Impulse, Outcome, Trajectory
from support_exudyn.model.pins import ClearancePin
from support_exudyn.scenario.recorded_channels import needs
from support_exudyn.scenario.scenario import Scenario
from user_forces.expressions.scalar import maximum
from user_forces.lawful import UNLAWFUL, LawError, look
from user_forces.normal.law import Impact, LoadError

_law_at, _accelerations = on_arrays(law_at), on_arrays(accelerations)


def trajectory(scenario: Scenario, model: MachineModel, p: list[float], rows: Matrix) -> Trajectory:
    """The run at its records; forces of joints only if a channel needs them.

    Arguments:
        p: parameters.
        rows: of the records, see `layout`.
    """
    linkage = scenario.linkage
    pin = scenario.clearance_pins.get(model.PIN)
    contact = free = None
    if pin is not None:
        contact, free = _contact(p, pin, rows)
    bodies = model.bodies(scenario.machine, linkage, p, rows, free)
    # turns are from the machine's own start posture, in which no journal is out of the middle
    own = scenario.machine.linkage().bodies
    turned = [body.angle - own[name].angle for name, body in linkage.bodies.items()]
    if any(turned):
        bodies.position[:, 2::3] -= turned
    motion = BodyMotion(linkage, bodies.position, bodies.velocity, bodies.acceleration)
    joints = JointForces()
    if DataNeeds.JOINTS in needs(scenario):
        if pin is not None and contact is not None:
            known = acting(motion, linkage.pins[model.PIN], pin, contact)
        else:
            assert bodies.pin_force is not None
            known = PinForce(np.column_stack(bodies.pin_force), _place(motion, model.PIN))
        joints = open_joint_forces(motion, scenario.gravity, bodies.actuators, {model.PIN: known})
    losses = rows[layout.STATE_ROW + layout.DAMPING_LOSS : layout.STATE_ROW + layout.WORK]
    return Trajectory(
        time=rows[layout.TIME],
        position=motion.position,
        velocity=motion.velocity,
        acceleration=motion.acceleration,
        ideal_pins={name: force for name, force in joints.pins.items() if name not in scenario.clearance_pins},
        contacts={model.PIN: contact} if contact else {},
        actuators=bodies.actuators,
        cranks=joints.cranks,
        slides=joints.slides,
        oil_energy=np.zeros(rows.shape[1]),
        work=rows[layout.STATE_ROW + layout.WORK],
        damping_loss=losses[0],
        friction_loss=losses[1],
    )


def _contact(p: list[float], pin: ClearancePin, rows: Matrix) -> tuple[ContactSeries, Matrix]:
    """The contact, and accelerations of the free coordinates with the force of the bore on the journal."""
    state = rows[layout.STATE_ROW : layout.STATE_ROW + layout.STATES]
    drive = DriveValues(*rows[layout.EXTENSION : layout.ACCELERATION + 1])
    at, law = _law_at(p, drive, state, 1.0)
    count = rows.shape[1]
    moving = RelativeMotion(*(np.broadcast_to(getattr(at, name), (count,)) for name in RelativeMotion._fields))
    found = series(pin.contact, moving, _memories(rows))
    contact = np.zeros((layout.CONTACT, count))
    contact[layout.FORCE_X], contact[layout.FORCE_Y] = found.force_x, found.force_y
    contact[layout.FRICTION] = found.friction_force
    contact[layout.JOURNAL_ARM] = journal_arm(pin.contact, found.depth)
    contact[layout.OFFSET_X], contact[layout.OFFSET_Y] = moving.x, moving.y
    first, second = _accelerations(at, law, contact)
    return found, np.array([first, second, found.force_x, found.force_y])


def _memories(rows: Matrix) -> Vector:
    """The pin's memory as PinMemory's fields, shape (n, 9)."""
    memory = rows[layout.MEMORY_ROW : layout.MEMORY_ROW + layout.MEMORY]
    still = np.zeros(rows.shape[1])
    named = {
        "in_contact": memory[layout.CLOSED],
        "impact_velocity": memory[layout.IMPACT_VELOCITY],
        "inverse_mass_xx": memory[layout.INVERSE_MASS_XX],
        "inverse_mass_xy": memory[layout.INVERSE_MASS_XY],
        "inverse_mass_yy": memory[layout.INVERSE_MASS_YY],
    }
    return np.column_stack([named.get(name, still) for name in PinMemory._fields])


def _place(motion: BodyMotion, name: str) -> Vector:
    """Where an ideal pin is."""
    place = motion.linkage.pins[name]
    return motion.point(place.second, place.second_point).position


FIRST_STEP = 1e-5  # [s]
FEWER_STEPS = "Allow a larger tolerance, a shorter duration, or more steps (`solver.most_steps`)."
AT_ONCE = 100_000  # compiled steps, some 0.5 s: until then it cannot be interrupted, and tells no progress
CLOSES = "Look whether the posture is near a dead centre, or the pin is pressed far out of its place."


def run(scenario: Scenario, progress: Progress) -> Outcome:
    """Run a scenario. Raises SimulationError if it cannot be finished."""
    made = outline(scenario)
    if made.pin is None:
        code = run_ideal(
            made.p, made.segments, made.times, made.y, made.memory, made.rows, made.jumps, made.report
        )
    else:
        code = _integrated(made, scenario.solver.most_steps, progress)
    if 0.0 in scenario.breaks:  # a record at a break holds what is just before it
        made.rows[layout.ACCELERATION, 0] = 0.0
    if code == FINISHED and not np.isfinite(made.rows.sum()):
        code, made.report[NOT_A_NUMBER] = STUCK, 1.0
    if code != FINISHED:
        raise SimulationError(_failure(code, made, scenario.solver.most_steps))
    # the first record is of the state before the drive's speed jumps, as those of later jumps are
    made.rows[layout.SPEED, 0] -= made.segments[0, layout.JUMP]
    progress(1.0)
    return _outcome(scenario, made)


def _integrated(made: RunArrays, most_steps: int, progress: Progress) -> int:
    going = np.zeros(GOING)
    going[NEXT_STEP] = FIRST_STEP
    pause, code = AT_ONCE, FINISHED
    for segment in made.segments:
        while (code := _go_on(made, segment, going, most_steps, pause)) == PAUSED:
            pause += AT_ONCE
            progress(float(going[AT] / made.times[-1]))
        if code != FINISHED:
            break
    return code


def _go_on(made: RunArrays, segment: Vector, going: Vector, most_steps: int, pause: int) -> int:
    code: int = integrate(
        made.p,
        segment,
        made.times,
        made.weights,
        going,
        most_steps,
        pause,
        made.y,
        made.memory,
        made.rows,
        made.onsets,
        made.jumps,
        made.report,
    )
    return code


def _outcome(scenario: Scenario, made: RunArrays) -> Outcome:
    report, name = made.report, made.model.PIN
    impacts = made.onsets[: int(report[IMPACTS])].tolist()
    with_clearance = made.pin is not None
    return Outcome(
        trajectory=trajectory(scenario, made.model, made.p.tolist(), made.rows),
        onsets={name: tuple(Onset(*impact) for impact in impacts)} if with_clearance else {},
        largest_force={name: float(report[LARGEST])} if with_clearance else {},
        largest_force_time={name: float(report[LARGEST_AT])} if with_clearance else {},
        impulses=tuple(_impulse(row) for row in made.jumps[: int(report[JUMPS])].tolist()),
        counts=Counts(
            steps=int(report[ACCEPTED if with_clearance else STEPS]),
            cut_steps=int(report[CUTS]),
            evaluations=int(report[EVALUATIONS]),
            user_function_calls=0,
            clamped_steps=int(report[CLAMPED]),
        ),
    )


def _impulse(row: list[float]) -> Impulse:
    actuators = {"front_column": row[layout.FRONT_IMPULSE], "rear_column": row[layout.REAR_IMPULSE]}
    return Impulse(row[layout.JUMP_TIME], actuators, row[layout.JUMP_ENERGY])


def _failure(code: int, made: RunArrays, most_steps: int) -> Failure:
    """Why a run stopped."""
    report, y = made.report, made.y
    state = {
        "step": float(report[LAST_STEP]),
        "first_coordinate": float(y[layout.FIRST]),
        "second_coordinate": float(y[layout.SECOND]),
        "first_rate": float(y[layout.FIRST_RATE]),
        "second_rate": float(y[layout.SECOND_RATE]),
        "impacts": float(report[IMPACTS]),
    }
    if code == TOO_MANY_STEPS:
        reason, advice = f"more than {most_steps} steps", FEWER_STEPS
    elif code == TOO_MANY_IMPACTS:
        reason, advice = f"more than {MOST_IMPACTS} impacts", "Look at the contact law: nothing comes to rest."
    elif code == DEAD_CENTRE:
        reason, advice = "the linkage is at a dead centre", CLOSES
    elif made.memory[layout.ASKED_DEPTH] and (broken := _broken_law(made)):
        reason, advice = broken
    elif report[NOT_A_NUMBER] or made.pin is None:
        reason, advice = "the linkage cannot close, or a value is no longer a finite number", CLOSES
    else:
        reason, advice = "the step became too short", "Allow a larger tolerance."
    return Failure(reason, advice, float(report[STOPPED_AT]), state)


def _broken_law(made: RunArrays) -> tuple[str, str] | None:
    """What the laws of the pin say, asked in Python, where the run could not go on by what they give."""
    assert made.pin is not None
    contact, memory = made.pin.contact, made.memory
    depth, rate, slip, mass = memory[layout.ASKED_DEPTH : layout.ALL_MEMORY].tolist()
    try:
        asked = contact.normal(depth, rate, Impact(float(memory[layout.IMPACT_VELOCITY]), mass))
        normal, elastic = maximum(asked, 0.0), contact.normal.elastic_force(depth)
        look(contact, depth, rate, slip, normal, contact.friction(slip, normal), elastic, made.model.PIN)
    except LoadError as error:
        return "a contact is overloaded", str(error)
    except LawError as error:
        return str(error), UNLAWFUL
    except ArithmeticError:
        pass
    return None
