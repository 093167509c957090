"""The run of the reduced formulation: scenario in, outcome out."""

from __future__ import annotations

from itertools import count

import numpy as np

from support_exudyn.formulations.contract import Failure, SimulationError
from support_exudyn.formulations.progress import Progress
from support_exudyn.formulations.reduced import layout
from support_exudyn.formulations.reduced.ideal import run_ideal
from support_exudyn.formulations.reduced.integrate import (
    ACCEPTED,
    AT,
    CLAMPED,
    CUTS,
    DEAD_CENTRE,
    EVALUATIONS,
    FINISHED,
    GOING,
    JUMPS,
    LARGEST,
    LAST_STEP,
    NEXT_STEP,
    NOT_A_NUMBER,
    PAUSED,
    STEPS,
    STOPPED_AT,
    STUCK,
    TOO_MANY_STEPS,
    TOO_MANY_TOUCHES,
    TOUCHES,
    integrate,
)
from support_exudyn.formulations.reduced.outline import MOST_TOUCHES, Outline, outline
from support_exudyn.formulations.reduced.trajectory import trajectory
from support_exudyn.mechanics.contact_state import Onset
from support_exudyn.mechanics.trajectory import Counts, Impulse, Outcome
from support_exudyn.scenario.scenario import Scenario
from user_forces.expressions.scalar import maximum
from user_forces.lawful import UNLAWFUL, LawError, look
from user_forces.normal.law import LoadError, Touch

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


def _integrated(made: Outline, most_steps: int, progress: Progress) -> int:
    going = np.zeros(GOING)
    going[NEXT_STEP] = FIRST_STEP
    for pause in count(AT_ONCE, AT_ONCE):
        code = integrate(
            made.p,
            made.segments,
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
        if code != PAUSED:
            break
        progress(float(going[AT] / made.times[-1]))
    return code


def _outcome(scenario: Scenario, made: Outline) -> Outcome:
    report, name = made.report, made.model.PIN
    touches = made.onsets[: int(report[TOUCHES])].tolist()
    loose = made.pin is not None
    return Outcome(
        trajectory=trajectory(scenario, made.model, made.p.tolist(), made.rows),
        onsets={name: tuple(Onset(*touch) for touch in touches)} if loose else {},
        largest_force={name: float(report[LARGEST])} if loose else {},
        impulses=tuple(_impulse(row) for row in made.jumps[: int(report[JUMPS])].tolist()),
        counts=Counts(
            steps=int(report[ACCEPTED if loose else STEPS]),
            cut_steps=int(report[CUTS]),
            evaluations=int(report[EVALUATIONS]),
            user_function_calls=0,
            clamped_steps=int(report[CLAMPED]),
        ),
    )


def _impulse(row: list[float]) -> Impulse:
    columns = {"front_column": row[layout.FRONT_IMPULSE], "rear_column": row[layout.REAR_IMPULSE]}
    return Impulse(row[layout.JUMP_TIME], columns, row[layout.JUMP_ENERGY])


def _failure(code: int, made: Outline, most_steps: int) -> Failure:
    """Why a run stopped."""
    report, y = made.report, made.y
    state = {
        "step": float(report[LAST_STEP]),
        "first_coordinate": float(y[layout.FIRST]),
        "second_coordinate": float(y[layout.SECOND]),
        "first_rate": float(y[layout.FIRST_RATE]),
        "second_rate": float(y[layout.SECOND_RATE]),
        "touches": float(report[TOUCHES]),
    }
    if code == TOO_MANY_STEPS:
        reason, advice = f"more than {most_steps} steps", FEWER_STEPS
    elif code == TOO_MANY_TOUCHES:
        reason, advice = f"more than {MOST_TOUCHES} touches", "Look at the contact law: nothing comes to rest."
    elif code == DEAD_CENTRE:
        reason, advice = "the linkage is at a dead centre", CLOSES
    elif made.memory[layout.ASKED_DEPTH] and (broken := _broken_law(made)):
        reason, advice = broken
    elif report[NOT_A_NUMBER] or made.pin is None:
        reason, advice = "the linkage cannot close, or a value is no longer a finite number", CLOSES
    else:
        reason, advice = "the step became too short", "Allow a larger tolerance."
    return Failure(reason, advice, float(report[STOPPED_AT]), state)


def _broken_law(made: Outline) -> tuple[str, str] | None:
    """What the laws of the pin say, asked in Python, where the run could not go on by what they give."""
    assert made.pin is not None
    contact, memory = made.pin.contact, made.memory
    depth, rate, slip, mass = memory[layout.ASKED_DEPTH : layout.ALL_MEMORY].tolist()
    try:
        asked = contact.normal(depth, rate, Touch(float(memory[layout.TOUCH_SPEED]), mass))
        normal, elastic = maximum(asked, 0.0), contact.normal.elastic_force(depth)
        look(contact, depth, rate, slip, normal, contact.friction(slip, normal), elastic, made.model.PIN)
    except LoadError as error:
        return "a contact is overloaded", str(error)
    except LawError as error:
        return str(error), UNLAWFUL
    except ArithmeticError:
        pass
    return None
