"""Dynamic solution of a user's own Exudyn model in steps that end at the impacts of its clearance joints.

The stock solver cuts the step in which an impact lies, and lengthens steps again by its own rules. Here steps
lie on a grid, so that records on the grid are not disturbed: a step with an impact ends there, and the rest of
the grid step follows. Steps in an impact follow from law, speed and mass, and steps may grow where the motion
is smooth. A second run with half the steps estimates the error.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import exudyn

from user_forces.connector.clearance_joint import JOINTS, REPEAT, SHORTEST, EngineContact
from user_forces.contact_state import Onset
from user_forces.values.value import InputError

NEVER_LONGER = 2**30  # steps after which the engine would lengthen a step by itself
ROUNDING = 1e-9  # of a grid step, by which its end may be missed
GROWTH_AFTER = 4  # grid steps in a row without contact, before steps grow twofold
# largest change of accelerations over a step, as a share of the largest so far, for steps to grow
SMOOTH = 0.02
CALLED = ("PreStep", "PostNewton", "PostStep")  # user functions of the model
CONTROL = {
    "adaptiveStep": True,  # else the engine computes times from a fixed step
    "adaptiveStepRecoverySteps": NEVER_LONGER,
    "minimumStepSize": 0.1 * SHORTEST,
    "numberOfSteps": 1,
}


@dataclass(frozen=True)
class JointRun:
    """A clearance joint over a run.

    impacts: in order. largest_force: [N]. error: of the largest force [N], by halving all steps; NaN without
    an estimate. time_error: of the impact times [s], of as many impacts as both runs have in common.
    """

    impacts: tuple[Onset, ...]
    largest_force: float
    error: float = math.nan
    time_error: float = math.nan


@dataclass(frozen=True)
class LocatedRun:
    """Result of `solve_located`: joints in the order in which they were added, and the number of steps."""

    joints: tuple[JointRun, ...]
    steps: int
    cut_steps: int


@dataclass
class _Steps:
    """Steps of one run, as the engine's user functions see them."""

    mbs: Any
    solver: Any
    joints: Sequence[EngineContact]
    grid: float  # its step [s]
    start: float
    end: float
    growth: int
    time: float = 0.0  # end of the last accepted step [s]
    steps: int = 0
    cut_steps: int = 0
    trying: bool = False
    calm: int = 0  # grid steps in a row
    size: int = 1  # of the next step in grid steps
    last: Any = None  # accelerations at the end of the last step
    largest: float = 0.0  # of their norms
    own: dict[str, Any] = field(default_factory=dict)  # user functions that the model had before

    def before_try(self, mbs: Any, t: float) -> bool:
        """Prepare every attempt at a step that would end at t [s]."""
        if self.trying and any(joint.wants_cut for joint in self.joints):
            self.cut_steps += 1
        self.trying = True
        step = float(self.solver.it.currentStepSize)
        for joint in self.joints:
            joint.begin_try(step)
        return bool(self.own["PreStep"](mbs, t)) if self.own.get("PreStep") else True

    def after_newton(self, mbs: Any, t: float) -> list[float]:
        """Decide on a solved step that would end at t [s]: error and recommended step."""
        wanted = [step for joint in self.joints if (step := joint.after_newton(t)) is not None]
        if wanted:
            shortest = min(wanted)
            return [REPEAT, -1.0 if shortest == math.inf else max(shortest, SHORTEST)]
        return list(self.own["PostNewton"](mbs, t)) if self.own.get("PostNewton") else [0.0, -1.0]

    def after_step(self, mbs: Any, t: float) -> bool:
        """Keep an accepted step to t [s] and choose the next; the engine calls it at the start, too."""
        if self.trying:
            self.trying = False
            self.steps += 1
            for joint in self.joints:
                joint.accept(t)
            self._follow(t - self.time)
        goes_on = bool(self.own["PostStep"](mbs, t)) if self.own.get("PostStep") else True
        self.time = t
        self.solver.it.currentStepSize = max(SHORTEST, self._goal(t) - t)
        return goes_on

    def _goal(self, t: float) -> float:
        """Where the step that starts at t [s] is to end: on the grid, or at an impact that was located [s]."""
        longest = min(joint.longest_step for joint in self.joints)
        number = math.floor((t - self.start) / self.grid + ROUNDING)
        number += self.size if longest == math.inf else 1
        goal = min(self.start + number * self.grid, self.end)
        if longest < goal - t:
            goal = t + (goal - t) / math.ceil((goal - t) / longest)
        return min([goal, *(joint.landing for joint in self.joints if t < joint.landing)])

    def _follow(self, taken: float) -> None:
        """Let steps grow twofold while nothing is in contact and accelerations change little over a step."""
        if self.growth == 1:
            return
        now = self.mbs.systemData.GetODE2Coordinates_tt()
        size = float((now @ now) ** 0.5)
        change = math.inf if self.last is None else float(((now - self.last) @ (now - self.last)) ** 0.5)
        self.last, self.largest = now, max(self.largest, size)
        free = all(not joint.kept.in_contact for joint in self.joints)
        if not free or change > SMOOTH * self.largest:
            self.calm, self.size = 0, 1
            return
        self.calm += taken >= (1.0 - ROUNDING) * self.size * self.grid
        if self.calm >= GROWTH_AFTER:
            self.calm, self.size = 0, min(2 * self.size, self.growth)


def solve_located(mbs: Any, settings: Any, *, growth: int = 1, estimates_error: bool = True) -> LocatedRun:
    """Solve the dynamics of a model in steps that end at impacts; the model then is in its final state.

    Arguments:
        mbs: the Exudyn system, assembled, with clearance joints.
        settings: `exudyn.SimulationSettings`: end time and number of steps (the grid), generalised alpha,
            Newton's method and what is written, as for `mbs.SolveDynamic`. Step control is set and put back.
        growth: so many grid steps at most make a step where nothing is in contact and the motion is smooth.
        estimates_error: whether a second run with half of all steps estimates the error, which takes twice the
            time in addition. The finer run is the result.

    Returns:
        Impacts and largest force of each joint, with errors.

    Raises InputError if the model has no clearance joint, and exudyn.SolverError if a step cannot be solved.
    """
    joints: list[EngineContact] = mbs.variables.get(JOINTS, [])
    if not joints:
        raise InputError(
            "mbs: has no clearance joint; allowed: a model with `ClearanceJoint` or `ClearanceGuide`"
        )
    coarse = _run(mbs, settings, joints, 1, growth)
    if not estimates_error:
        return coarse
    fine = _run(mbs, settings, joints, 2, growth)
    runs = []
    for one, other in zip(coarse.joints, fine.joints, strict=True):
        both = zip(one.impacts, other.impacts, strict=False)
        off = max((abs(first.time - second.time) for first, second in both), default=0.0)
        force = abs(one.largest_force - other.largest_force)  # covers a method of at least first order
        runs.append(JointRun(other.impacts, other.largest_force, force, off))
    return LocatedRun(tuple(runs), fine.steps, fine.cut_steps)


def _run(mbs: Any, settings: Any, joints: Sequence[EngineContact], finer: int, growth: int) -> LocatedRun:
    """One run with steps so many times finer, on the grid and in impacts."""
    integration = settings.timeIntegration
    duration = integration.endTime - integration.startTime
    grid = duration / (integration.numberOfSteps * finer)
    solver: Any = exudyn.MainSolverImplicitSecondOrder()
    steps = _Steps(mbs, solver, joints, grid, integration.startTime, integration.endTime, growth)
    steps.time = integration.startTime
    kept = {name: getattr(integration, name) for name in CONTROL}
    numbers = [joint.impact_steps.number for joint in joints]
    steps.own = {name: getattr(mbs, f"Get{name}UserFunction")() for name in CALLED}
    try:
        for name, setting in CONTROL.items():
            setattr(integration, name, setting)
        for joint, number in zip(joints, numbers, strict=True):
            joint.is_driven, joint.impact_steps.number = True, finer * number
            joint.reset()
            joint.begin_try(0.0)
            joint.begin_impact()
        mbs.SetPreStepUserFunction(steps.before_try)
        mbs.SetPostNewtonUserFunction(steps.after_newton)
        mbs.SetPostStepUserFunction(steps.after_step)
        if not solver.SolveSystem(mbs, settings):
            raise exudyn.SolverError("solve_located: a step could not be solved")
    finally:
        for name, setting in kept.items():
            setattr(integration, name, setting)
        for name, function in steps.own.items():
            getattr(mbs, f"Set{name}UserFunction")(function or 0)
        for joint, number in zip(joints, numbers, strict=True):
            joint.is_driven, joint.impact_steps.number = False, number
    results = tuple(JointRun(tuple(joint.onsets), joint.largest_force) for joint in joints)
    return LocatedRun(results, steps.steps, steps.cut_steps)
