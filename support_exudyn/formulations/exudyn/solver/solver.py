"""The generalised-alpha solver with impacts located in time.

Steps lie on the grid of a StepPlan. A step in which a clearance pin makes contact is cut so that it ends at
the impact, and the remainder of the grid step follows. The engine's own step control is left out of it:
the size of every step is set here before it is tried.

Two traps of Exudyn 1.13.6 that this avoids: a rejected step loses the algorithmic accelerations of
generalised alpha if `discontinuous.maxIterations` is 1 or used up; and its recovery of step sizes would
leave the grid.
"""

import math
from typing import Any

import exudyn
import numpy as np

from support_exudyn.formulations.engine_settings import SMALLEST_STEP, engine_settings, quiet_engine
from support_exudyn.formulations.exudyn.scene.engine_scene import EngineScene, slide
from support_exudyn.formulations.exudyn.solver.newton_method import NewtonMethod
from support_exudyn.formulations.exudyn.solver.recorder import Recorder
from support_exudyn.formulations.exudyn.solver.refusals import (
    ADVICE,
    FEWER_STEPS,
    STEEP,
    singular,
    state_of,
    unlawful,
    why,
)
from support_exudyn.formulations.exudyn.solver.step_growth import StepGrowth, step_growth
from support_exudyn.mechanics.trajectory import Counts, Impulse, Series
from support_exudyn.scene.contract import Failure, Progress, SimulationError
from support_exudyn.scene.limits import DEEPEST, SOFT, rounding_of_positions, too_deep
from support_exudyn.scene.time_grid import StepPlan
from user_forces import Frictionless
from user_forces.contact_events import SHARE
from user_forces.lawful import LawError

REPEAT_ERROR = 1e6  # above any tolerance of the engine's discontinuous iteration: the step is repeated
SMALLEST_IMPACT_STEP = 1e-11  # [s], well above the rounding of times
# The joint forces overshoot in the first steps after a jump of the actuators' acceleration, by a factor that
# falls with the spectral radius from step to step. The grid step that follows is divided so often, so that
# nothing of it is left at the next record.
BREAK_REFINEMENT = 32
CALM = 10.0  # times the largest velocity before Newton's method failed: up to that coordinates are believed
# Before steps that are so many times shorter than the last, velocities are aligned, see `Scene.align`.
MUCH_SHORTER = 8.0


class SolverRun:
    """One integration of a scene from 0 to its duration."""

    def __init__(self, scene: EngineScene, recorder: Recorder, progress: Progress) -> None:
        scenario = scene.scenario
        self.scene = scene
        self.pins = tuple(scene.clearance_joints.values())
        self.frictions = tuple(scene.frictions.values())
        self.data = scene.mbs.systemData
        self.recorder = recorder
        self.progress = progress
        self.plan = StepPlan(
            scenario.duration,
            scenario.recorded_every,
            scenario.step,
            scenario.breaks,
            rounding_of_positions(scenario),
        )
        self.solver: Any = exudyn.MainSolverImplicitSecondOrder()  # its stubs lack self
        self.impulses: list[Impulse] = []
        self.legs = scene.legs
        unknowns = int(self.data.ODE2Size() + self.data.ODE1Size() + self.data.AEsize())
        self.settings = engine_settings(
            scenario.solver,
            scenario.duration,
            unknowns,
            sum(load.rounding for load in scene.loads.values()) + scene.legs.rounding,
            scene.repeats,
        )
        self.impact_steps = scenario.solver.impact_steps
        # what a load does need not show in accelerations, and long steps would pass over where it begins
        # and states of legs and friction are not interpolated at records that a step passes over
        states = scene.legs.solves or any(one.law.has_state for one in self.frictions)
        grows = scenario.solver.growth > 1.0 and not (scenario.acting_loads or states)
        self.smooth = step_growth(scene) if grows else None
        self.time = 0.0  # end of the last accepted step
        self.steps = self.cut_steps = self.failed_newton = 0
        self.most_steps, self.looks = scenario.solver.most_steps, scenario.solver.result_checks
        self.trying = False  # a step has been tried and not accepted yet
        self.repeated = False  # that step is tried again, shorter
        self.calm: Series | None = None  # coordinates before velocities grew as Newton's method failed,
        self.calm_speed = 0.0  # and the largest velocity that is none of it
        newton = self.settings.timeIntegration.newton
        self.newton = NewtonMethod(self.solver, newton, scenario, self.pins, unknowns)
        self.named_pins = tuple(scene.clearance_joints.items())
        # names, pins and depths [m] beyond which a run is given up
        self.limits = [(name, pin, DEEPEST * pin.contact.bearing.size) for name, pin in self.named_pins]

    def go(self) -> Counts:
        """Integrate. Raises SimulationError if the run cannot be finished."""
        mbs, it = self.scene.mbs, self.solver.it
        for pin in self.pins:
            pin.begin_try(0.0)
            if self.scene.scenario.start != "settled":
                pin.begin_impact()
        self.connect()
        try:
            # iterates of Newton's method that diverge may overflow; what is accepted is checked to be finite
            with quiet_engine(), np.errstate(over="ignore", invalid="ignore"):
                finished = self.solver.SolveSystem(mbs, self.settings)
        except exudyn.ExudynError as error:
            raise SimulationError(self._failure(*why(error, self.scene, self._ahead, self.calm))) from error
        if not finished or self.time < self.plan.duration * (1.0 - 1e-9):
            rough = any(not isinstance(pin.contact.friction, Frictionless) for pin in self.pins)
            has_friction = rough or bool(self.frictions)
            advice = f"{ADVICE} {STEEP}" if self.newton.failures and has_friction else ADVICE
            scene, ahead = self.scene, self._ahead
            told = unlawful(scene, ahead) or singular(scene, self.calm) or ("the solver gave up", advice)
            raise SimulationError(self._failure(*told))
        return Counts(
            steps=self.steps,
            cut_steps=self.cut_steps,
            newton_iterations=int(it.newtonStepsCount),
            jacobians=int(it.newtonJacobiCount),
            user_function_calls=sum(pin.item.calls for pin in self.pins)
            + sum(friction.calls for friction in self.frictions),
            failed_newton=self.failed_newton,
            clamped_steps=sum(pin.clamped_steps for pin in self.pins),
        )

    def connect(self) -> None:
        """Have the engine call what has to see every step."""
        mbs = self.scene.mbs
        mbs.SetPreStepUserFunction(self._before_try)
        if self.pins or self.legs.solves:
            mbs.SetPostNewtonUserFunction(self._after_newton)
        mbs.SetPostStepUserFunction(self._after_step)

    # --- called by the engine ---

    def _before_try(self, mbs: Any, t: float) -> bool:
        """Prepare every attempt at a step that would end at t."""
        again = self.trying
        if again:
            self.repeated = True
            if self.legs.happenings.wants_cut or any(pin.wants_cut for pin in self.pins):
                self.cut_steps += 1
            else:
                self._keep_calm()
                self.failed_newton += 1
                self.newton.failed()
        self.trying = True
        self.scene.drive_to(t)
        step = float(self.solver.it.currentStepSize)
        self.legs.begin_try(step)
        for friction in self.frictions:
            friction.begin_try(step, again)
        if self.pins:
            for pin in self.pins:
                pin.begin_try(step)
            self.newton.begin(step)
        return True

    def _after_newton(self, mbs: Any, t: float) -> list[float]:
        """Tell whether a solved step that would end at t may stand: [error, recommended step]."""
        again, shortest = False, math.inf
        name = ""
        try:
            for name, pin in self.named_pins:  # noqa: B007 - is told if one fails
                step = pin.after_newton(t)
                if step is not None:
                    again, shortest = True, min(shortest, step)
        except LawError as error:
            raise error.at(name) from None
        if (step := self.legs.after_newton(t)) is not None:
            again, shortest = True, min(shortest, step)
        if not again:
            return [0.0, -1.0]
        if shortest == math.inf:
            return [REPEAT_ERROR, -1.0]
        # to a time that has no rounding: else drives, which are asked for that time, would move on by another
        # one than the step, and late in a long run forces would show it
        exact = (self.time + shortest) - self.time
        return [REPEAT_ERROR, exact if exact > SMALLEST_IMPACT_STEP else shortest]

    def _after_step(self, mbs: Any, t: float) -> bool:
        """Keep what happened in an accepted step, and choose the next; called once at the start, too."""
        taken = t - self.time
        breaks = self.plan.breaks_at(t)
        kink, met = bool(breaks), False
        remembered = [pin.kept for pin in self.pins]
        if self.trying:
            self.trying = False
            self.steps += 1
            self._look_for_limits()
            self.newton.solved(taken)
            for name, pin in self.named_pins:
                met = met or pin.onset is not None
                try:
                    pin.accept(t)
                except LawError as error:  # inside the step
                    raise error.at(name) from None
            kink = self.legs.accept(t) or kink or met
        self.recorder.after_step(t, kink)
        for friction in self.frictions:
            friction.accept()
        if self.smooth is not None:
            self._look_for_smoothness(t, self.smooth)
        self.recorder.end(t, remembered if met else None)
        if (later := self._arrived(t)) != t:
            t, breaks = later, self.plan.breaks_at(later)
        goal = self._next_time(t)
        if not breaks and self._is_to_be_cut(taken, goal - t):
            self.recorder.energies.totals[0] += self.scene.align(t)
            self.scene.refresh_memory()
            self.legs.refresh()
        if self.smooth is not None and self.plan.passes_record(t, goal):
            self.recorder.begin_step(t)
        self.solver.it.currentStepSize = max(SMALLEST_STEP, goal - t)
        return True

    def _arrived(self, t: float) -> float:
        """From when the run goes on [s] after a step to t [s]: stops may follow that are not worth one."""
        self._at_stop(t)
        while self.plan.rest(t) and (stop := self.plan.rest(t, self._longest_step(t))):
            slide(self.scene, stop - t)
            self.data.SetTime(stop)
            self.solver.it.currentTime = t = stop
            self.recorder.after_step(t, True)
            self.recorder.end(t)
            self._at_stop(t)
        return t

    def _at_stop(self, t: float) -> None:
        """The run is at t: it may be a record, or a break of the drive."""
        self.time = t
        if (asked := self.plan.record_at(t)) is not None:
            self.recorder.record(asked)
            velocity = self.data.GetODE2Coordinates_t()
            if not math.isfinite(velocity @ velocity):
                raise ArithmeticError("a velocity is no longer a finite number")
            self.progress(t / self.plan.duration)
        if breaks := self.plan.breaks_at(t):
            self._jump(t, breaks)
            self.recorder.begin(t)

    @property
    def _ahead(self) -> float:
        """A time that was to be reached [s]."""
        return self.time + self.plan.step

    def _keep_calm(self) -> None:
        """Keep the coordinates before a step that has failed, while velocities are not far above the usual.

        Beside a change point they grow beyond any limit, and positions with them.
        """
        start = exudyn.ConfigurationType.StartOfStep
        speed = float(np.abs(self.data.GetODE2Coordinates_t(start)).max())
        if not self.newton.more:
            self.calm_speed = CALM * speed
        if speed <= self.calm_speed:
            self.calm = self.data.GetODE2Coordinates(start)

    def _is_to_be_cut(self, taken: float, following: float) -> bool:
        """Whether far shorter steps follow on one of this length [s], or the next will be cut.

        It will if a clearance pin begins or ends a contact in it.
        """
        if not (self.pins or self.legs.solves):
            return False
        if following < taken / MUCH_SHORTER:
            return True
        for pin in self.pins:
            if pin.impact_steps.step == math.inf:
                depth = pin.reached.depth
                if depth * (depth + 2.0 * following * pin.reached.rate) < 0.0:
                    return True
        return False

    def _look_for_limits(self) -> None:
        """Raise SimulationError if a journal is too deep, or there were too many steps, or too many failed."""
        if self.steps + self.cut_steps + self.failed_newton > self.most_steps:
            raise SimulationError(self._failure(f"more than {self.most_steps} steps", FEWER_STEPS))
        if self.newton.too_many:
            reason = f"Newton's method has failed {self.failed_newton} times, and needs next to no step"
            raise SimulationError(self._failure(reason, STEEP))
        for name, pin, deepest in self.limits if self.looks else ():
            if (depth := pin.reached.depth) > deepest:
                raise SimulationError(self._failure(too_deep(name, depth, pin.contact.bearing), SOFT))

    def _look_for_smoothness(self, t: float, smooth: StepGrowth) -> None:
        """See whether steps after t may be longer, and keep the records that the last has passed over."""
        if self.recorder.passes_records:
            for passed in self.plan.records_between(self.time, t):
                self.recorder.record_between(passed, t)
            self.recorder.end_step()
        at_rest = all(pin.impact_steps.step == math.inf and pin.reached.depth > 0.0 for pin in self.pins)
        if at_rest and not self.repeated and not self.plan.follows_break(t):
            smooth.follow(t - self.time, self.data.GetODE2Coordinates_tt())
        else:
            smooth.restart()
        self.repeated = False

    def _jump(self, t: float, breaks: list[float]) -> None:
        """Velocities after the breaks that t [s] is, if the speed of a drive jumps there, and valves."""
        drives = self.scene.scenario.drives_in_use
        jumps = [b for b in breaks if any(drive.speed_jump(b) for drive in drives)]
        for b in jumps:
            impulse = self.scene.jump(b)
            if impulse is not None:
                self.impulses.append(impulse)
            self.recorder.jump(t, 0.0 if impulse is None else impulse.energy)
        if jumps:
            self.scene.refresh_memory()
            for pin in self.pins:
                pin.begin_impact()
        for b in breaks:
            self.legs.switch(b)
        self.legs.refresh()
        if self.legs.solves and not jumps:
            self.recorder.switch(t)

    def _longest_step(self, t: float) -> float:
        """How long a step from t [s] on may be [s]; infinite: as the plan says."""
        largest = self.newton.length
        for pin in self.pins:
            if (longest := pin.longest_step) < largest:
                largest = longest
        if self.plan.follows_break(t):
            largest = min(largest, self.plan.step / BREAK_REFINEMENT)
        return largest

    def _next_time(self, t: float) -> float:
        """Where the step that starts at t is to end: on the grid, or at an impact seen coming [s]."""
        largest = self._longest_step(t)
        if self.smooth is not None and largest == math.inf:
            goal = self.plan.far_time(t, self.smooth.size)
        else:
            goal = self.plan.next_time(t, max(largest, SMALLEST_IMPACT_STEP))
        for landing in (*(pin.landing for pin in self.pins), self.legs.happenings.landing):
            if landing < goal and t + SHARE * (goal - t) < landing:
                goal = landing
        return goal

    def _failure(self, reason: str, advice: str = ADVICE) -> Failure:
        state = {"step": float(self.solver.it.currentStepSize)} | state_of(self.scene)
        return Failure(reason, advice, self.time, state, finer=advice is not FEWER_STEPS)
