"""The generalised-alpha solver with impacts located in time.

Steps lie on the grid of a StepPlan. A step in which a clearance pin touches is cut so that it ends at
the touch, and the remainder of the grid step follows. The engine's own step control is left out of it:
the size of every step is set here before it is tried.

Two traps of Exudyn 1.13.6 that this avoids: a rejected step loses the algorithmic accelerations of
generalised alpha if `discontinuous.maxIterations` is 1 or used up; and its recovery of step sizes would
leave the grid.
"""

from __future__ import annotations

import gc
import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import exudyn

from support_exudyn.errors import Failure, SimulationError
from support_exudyn.impulse import Impulse, jump_velocities
from support_exudyn.onset import SHARE
from support_exudyn.recorder import Recorder
from support_exudyn.scenario import SolverSettings
from support_exudyn.scene import Scene
from support_exudyn.steps import StepPlan
from user_forces.normal.law import LoadError

SMALLEST_STEP = 1e-13  # [s]
SMALLEST_IMPACT_STEP = 1e-11  # [s], well above the rounding of times
# The joint forces overshoot in the first steps after a jump of the columns' acceleration, by a factor that
# falls with the spectral radius from step to step. The grid step that follows is divided so often, so that
# nothing of it is left at the next record.
BREAK_REFINEMENT = 32
ADVICE = (
    "Try a smaller step; if that does not help, look whether the posture is near a dead centre "
    "or a contact is far stiffer than the masses beside it allow."
)
Progress = Callable[[float], None]  # is told the share that is done, 0 to 1


@dataclass(frozen=True)
class Counts:
    """What a run took.

    steps: accepted; cut_steps: repeated shorter to land on an impact; newton_iterations, jacobians: of
    the solver; user_function_calls: force evaluations in Python; failed_newton: steps repeated because
    Newton's method did not converge; clamped_steps: steps at whose end a law asked for tension.
    """

    steps: int
    cut_steps: int
    newton_iterations: int
    jacobians: int
    user_function_calls: int
    failed_newton: int
    clamped_steps: int


class Run:
    """One integration of a scene from 0 to its duration."""

    def __init__(self, scene: Scene, recorder: Recorder, progress: Progress) -> None:
        scenario = scene.scenario
        self.scene = scene
        self.pins = tuple(scene.loose_pins.values())
        self.data = scene.mbs.systemData
        self.recorder = recorder
        self.progress = progress
        self.plan = StepPlan(scenario.duration, scenario.record_period, scenario.step, scenario.drive.breaks)
        self.solver: Any = exudyn.MainSolverImplicitSecondOrder()  # its stubs lack self
        self.impulses: list[Impulse] = []
        self.settings = _settings(scenario.solver, scenario.duration)
        self.time = 0.0  # end of the last accepted step
        self.steps = self.cut_steps = self.failed_newton = 0
        self.trying = False  # a step has been tried and not accepted yet
        self.driven = (0.0, scenario.drive.initial_speed)  # extension and speed that the engine has [m], [m/s]

    def go(self) -> Counts:
        """Integrate. Raises SimulationError if the run cannot be finished."""
        mbs, it = self.scene.mbs, self.solver.it
        data = mbs.systemData.GetDataCoordinates(exudyn.ConfigurationType.Initial).tolist()
        for pin in self.pins:
            pin.step_size = lambda: float(it.currentStepSize)
            pin.begin_try(data[pin.slots], 0.0)
        mbs.SetPreStepUserFunction(self._before_try)
        mbs.SetPostStepUserFunction(self._after_step)
        try:
            with quiet_engine(), paused_collector():
                finished = self.solver.SolveSystem(mbs, self.settings)
        except exudyn.ExudynError as error:
            cause = error.__cause__  # set if a function of ours raised
            if isinstance(cause, LoadError):
                raise SimulationError(self._failure("a contact is overloaded", str(cause))) from error
            if cause is not None and not isinstance(cause, ArithmeticError):
                raise cause from None
            raise SimulationError(self._failure(_first_line(cause or error))) from error
        if not finished or self.time < self.plan.duration * (1.0 - 1e-9):
            raise SimulationError(self._failure("the solver gave up"))
        return Counts(
            steps=self.steps,
            cut_steps=self.cut_steps,
            newton_iterations=int(it.newtonStepsCount),
            jacobians=int(it.newtonJacobiCount),
            user_function_calls=sum(pin.calls for pin in self.pins),
            failed_newton=self.failed_newton,
            clamped_steps=sum(pin.clamped_steps for pin in self.pins),
        )

    # --- called by the engine ---

    def _before_try(self, mbs: Any, t: float) -> bool:
        """Before every attempt at a step that would end at t."""
        if self.trying:
            if any(pin.wants_cut for pin in self.pins):
                self.cut_steps += 1
            else:
                self.failed_newton += 1
        self.trying = True
        drive = self.scene.scenario.drive
        driven = drive.extension(t), drive.speed(t)
        if driven != self.driven:
            self.scene.drive_to(*driven)
            self.driven = driven
        if self.pins:
            data = self.data.GetDataCoordinates().tolist()
            step = float(self.solver.it.currentStepSize)
            for pin in self.pins:
                pin.begin_try(data[pin.slots], step)
        return True

    def _after_step(self, mbs: Any, t: float) -> bool:
        """After every accepted step, and once at the start."""
        breaking = self.plan.break_at(t)
        kink = breaking is not None
        if self.trying:
            self.trying = False
            self.steps += 1
            for pin in self.pins:
                kink = kink or pin.onset is not None
                pin.accept()
        self.time = t
        self.recorder.after_step(t, kink)
        if self.plan.is_record(t):
            self.recorder.record(t)
            self._check_finite()
            self.progress(t / self.plan.duration)
        if breaking is not None:
            self._jump(breaking)
        self.solver.it.currentStepSize = max(SMALLEST_STEP, self._next_time(t) - t)
        return True

    def _jump(self, t: float) -> None:
        """Velocities after a break, if the columns' speed jumps there."""
        speed_jump = self.scene.scenario.drive.speed_jump(t)
        if speed_jump:
            impulse = jump_velocities(self.scene, t, speed_jump)
            if impulse.columns or impulse.cranks:  # where all columns give, nothing is struck
                self.impulses.append(impulse)
            self.recorder.jump(t, impulse.energy)
            self.scene.refresh_memory()
            for pin in self.pins:
                pin.begin_impact()

    def _next_time(self, t: float) -> float:
        """Where the step that starts at t is to end: on the grid, or at an impact seen coming [s]."""
        largest = min((pin.impact.step for pin in self.pins), default=math.inf)
        if self.plan.follows_break(t):
            largest = min(largest, self.plan.step / BREAK_REFINEMENT)
        goal = self.plan.next_time(t, max(largest, SMALLEST_IMPACT_STEP))
        for pin in self.pins:
            if t + SHARE * (goal - t) < pin.landing < goal:
                goal = pin.landing
        return goal

    def _check_finite(self) -> None:
        total = float(self.data.GetODE2Coordinates_t().sum())
        if not math.isfinite(total):
            raise ArithmeticError("a velocity is no longer a finite number")

    def _failure(self, reason: str, advice: str = ADVICE) -> Failure:
        state: dict[str, float] = {"step": float(self.solver.it.currentStepSize)}
        velocity = self.data.GetODE2Coordinates_t()
        for name, item in self.scene.bodies.items():
            state[f"{name}.angular_velocity"] = float(velocity[item.first + 2])
        for name, pin in self.scene.loose_pins.items():
            state[f"pin.{name}.depth"] = pin.memory.depth
            state[f"pin.{name}.rate"] = pin.memory.rate
            state[f"pin.{name}.approach_speed"] = pin.memory.approach_speed
        return Failure(
            reason,
            advice,
            self.time,
            state,
        )


def _settings(chosen: SolverSettings, duration: float) -> Any:
    settings = exudyn.SimulationSettings()
    integration = settings.timeIntegration
    integration.endTime = duration
    integration.numberOfSteps = 1  # sizes are set before every step
    integration.adaptiveStep = True  # else the engine computes times from a fixed step
    integration.adaptiveStepRecoverySteps = 2**30  # the engine never lengthens a step by itself
    integration.minimumStepSize = SMALLEST_STEP
    integration.verboseMode = 0
    integration.discontinuous.maxIterations = 8
    integration.discontinuous.ignoreMaxIterations = False
    integration.generalizedAlpha.spectralRadius = chosen.spectral_radius
    integration.newton.relativeTolerance = chosen.newton_tolerance
    integration.newton.modifiedNewtonContractivity = 0.1  # renew the Jacobian early: a fifth faster here
    settings.solution.file.write = False
    return settings


@contextmanager
def quiet_engine() -> Iterator[None]:
    """Keep the engine from writing to the console; what it has to say comes as an exception."""
    before = exudyn.config.printToConsole
    exudyn.config.printToConsole = False
    try:
        yield
    finally:
        exudyn.config.printToConsole = before


@contextmanager
def paused_collector() -> Iterator[None]:
    """Pause Python's search for reference cycles: a step makes none, and the search costs a fifth."""
    before = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if before:
            gc.enable()


def _first_line(error: BaseException) -> str:
    lines = [line.strip() for line in str(error).splitlines() if line.strip(" =*-")]
    return lines[0] if lines else type(error).__name__
