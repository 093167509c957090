"""The run: steps of chosen length, cut at impacts and separations and where the drive has its breaks."""

import math
from collections.abc import Callable
from typing import Any

import exudyn

from support_exudyn.formulations.contract import Failure, Progress, SimulationError, explained
from support_exudyn.formulations.engine_settings import quiet_engine
from support_exudyn.formulations.tree.drive_pieces import Piece
from support_exudyn.formulations.tree.engine import SMALLEST_STEP, Engine, TreeHistory, settings
from support_exudyn.formulations.tree.events import EventKind, event
from support_exudyn.formulations.tree.forces import Forces, TreeClearanceJoint
from support_exudyn.mechanics.contact_state import InverseMass, Onset
from support_exudyn.mechanics.pressed_pins import EffectiveMasses
from user_forces.lawful import UNLAWFUL, LawError
from user_forces.normal.law import Impact, LoadError

FIRST_STEP = 1e-5  # [s]
LONGEST_STEP = 0.02  # [s]
SAFETY, LARGEST_GROWTH, SMALLEST_ERROR = 0.9, 5.0, 1e-9
STEADY = 0.08  # weight of the last error in the choice of a step (Gustafsson): a fifth as many are refused
STEPS_OF_AN_IMPACT = 12  # the first step of an impact is this part of its undamped duration
SHORTEN = 0.25  # factor for a step in which too much happens
SLIVER = 0.01  # share of a step by which it may be stretched to end at a stop
REPEAT_ERROR = 1e6  # above any tolerance of the engine's discontinuous iteration: the step is repeated
ACCEPTED, REFUSED = [0.0, -1.0], [REPEAT_ERROR, -1.0]  # an error, and that no step is recommended
LANDINGS = 12  # attempts
SHORTEST_LANDING = 4.0 * SMALLEST_STEP
TURNED = 1e-2  # share of the rate at the start of a step that may be left where the depth turns
STEPS_OF_PROGRESS = 200
FEWER_STEPS = "Allow a larger tolerance, a shorter duration, or more steps (`solver.most_steps`)."
ADVICE = "Allow a larger tolerance, or look whether a contact is far stiffer than the masses beside it allow."


def growth(error: float, before: float) -> float:
    """Factor from a step to the next by its error and that of the step before it, in units of the tolerance."""
    kept, last = max(error, SMALLEST_ERROR), max(before, 1e-4)
    return min(LARGEST_GROWTH, SAFETY * math.pow(kept, 0.75 * STEADY - 0.2) * math.pow(last, STEADY))


class Integration:
    """One integration from 0 to the duration.

    Arguments:
        engine: the system.
        forces: on the coordinates, with the clearance pins in their state at the start.
        find_mobilities: of a clearance pin's journal at the stage evaluated last, by name.
        pieces: of the drive.
        error: root mean square error of a step [rad], [rad/s].
        most_steps: after which a run is given up.
        progress: is told how far it is.
    """

    def __init__(
        self,
        engine: Engine,
        forces: Forces,
        find_inverse_masses: Callable[[str], EffectiveMasses],
        pieces: list[Piece],
        error: float,
        most_steps: int,
        progress: Progress,
    ) -> None:
        self.engine, self.forces, self.find_inverse_masses = engine, forces, find_inverse_masses
        self.pins = forces.pins
        self.pieces = pieces
        self.most_steps = most_steps
        self.progress = progress
        self.duration = pieces[-1].end
        self.settings = settings(self.duration, error, FIRST_STEP)
        self.it = engine.solver.it
        self.time = 0.0  # end of the last accepted step
        self.piece = 0
        self.steps = self.cut_steps = 0
        self.history = TreeHistory([0.0], [forces.position], [forces.velocity])
        # of the attempt at a step
        self._trying = False
        self._step: float | None = FIRST_STEP  # to be tried next; None: as the engine's error control says
        self._tried = FIRST_STEP
        self._last_error = 0.0  # of the last accepted step
        self._wanted = 0.0  # length that a step would have had, had it not been cut
        self._landings = 0  # attempts to end it where something happens
        self._turning: str | None = None  # pin at whose turning point it is to end
        self._happened: dict[str, EventKind] = {}  # to clearance pins at its end
        self._trouble: Exception | None = None  # for which a step has been refused

    def go(self) -> None:
        """Integrate. Raises SimulationError if the run cannot be finished."""
        mbs = self.engine.mbs
        mbs.SetPreStepUserFunction(self._before_try)
        mbs.SetPostNewtonUserFunction(self._judge)
        mbs.SetPostStepUserFunction(self._after_step)
        self._remember()
        try:
            with quiet_engine():
                finished = self.engine.solver.SolveSystem(mbs, self.settings)
        except exudyn.ExudynError as error:
            cause = error.__cause__  # set if a function of ours raised
            if cause is None:
                raise SimulationError(self._failure(explained(error))) from error
            raise cause from None
        finally:
            self.engine.release()
        if not finished or self.time < self.duration * (1.0 - 1e-9):
            raise SimulationError(self._failure("the engine gave up"))

    # --- called by the engine ---

    def _before_try(self, mbs: Any, t: float) -> bool:
        """Before every attempt at a step: choose its length."""
        it = self.it
        step = it.currentStepSize if self._step is None else self._step
        if not step > 2.0 * SMALLEST_STEP:  # or not a number
            self._give_up()
        stop = self.pieces[self.piece].end
        end = self.time + step
        if end + SLIVER * step >= stop:
            self._wanted = max(self._wanted, step)
            step, end = stop - self.time, stop
        it.currentStepSize, it.currentTime = step, end
        self._tried, self._step, self._trying = step, None, True
        self.forces.trouble = None
        return True

    def _judge(self, mbs: Any, t: float) -> list[float]:
        """After a step that meets the tolerance: an error to have it repeated, and no recommended step."""
        if self.forces.trouble is not None or not math.isfinite(self.it.automaticStepSizeError):
            self._trouble = self.forces.trouble or ArithmeticError("a force is no longer a finite number")
            return self._repeat(SHORTEN)
        self._happened.clear()
        first, where = 1.0, None
        for name, pin in self.pins.items():
            pin.end = pin.place()
            found = event(pin.memory.in_contact, pin.renews, pin.start, pin.end, self._tried, pin.clearance)
            if found is not None and found.kind is EventKind.UNCLEAR:
                return self._repeat(SHORTEN)
            if found is not None and found.fraction >= 1.0:
                self._happened[name] = found.kind
            elif found is not None and found.fraction < first:
                first, where = found.fraction, (name, found.kind)
        if where is not None and self._can_land():
            # what happens at the very start is met a little later, not at the end of the step
            return self._land(max(first, SHORTEST_LANDING / self._tried), *where)
        if where is not None:  # as near to it as can be
            self._happened[where[0]] = where[1]
        elif self._turning is not None and self._turns(self.pins[self._turning]):
            self._happened.setdefault(self._turning, EventKind.RETURN)
        return ACCEPTED

    def _after_step(self, mbs: Any, t: float) -> bool:
        """After every accepted step, and once at the start."""
        if not self._trying:
            return True
        self._trying = False
        self.steps += 1
        self.time = t
        self.history.add(t, self.forces.position, self.forces.velocity, self.piece)
        clamped = False
        for pin in self.pins.values():
            pin.start = pin.end
            pin.clamped_steps += pin.clamped
            clamped = clamped or pin.clamped
        error = self.it.automaticStepSizeError
        following = max(self._tried * growth(error, self._last_error), self._wanted)
        self._last_error = error
        if clamped:  # without a force steps would grow past the point where it sets in again
            following = min(following, max(self._tried, self._wanted))
        self._wanted, self._landings, self._turning, self._trouble = 0.0, 0, None, None
        if self._happened:
            following = min(following, self._change_memory())
        if t >= self.pieces[self.piece].end and self.piece + 1 < len(self.pieces):
            self.piece += 1
            self.forces.cubic[:] = self.pieces[self.piece].cubic
        self._step = min(following, LONGEST_STEP)
        if self.steps % STEPS_OF_PROGRESS == 0:
            self.progress(t / self.duration)
        if self.steps + self.cut_steps > self.most_steps:
            raise SimulationError(self._failure(f"more than {self.most_steps} steps", FEWER_STEPS))
        return True

    # --- events ---

    def _turns(self, pin: TreeClearanceJoint) -> bool:
        """Whether the step that was to end where the depth turns does so; it may have been cut again."""
        return pin.end.depth > 0.0 and pin.end.rate > TURNED * pin.start.rate

    def _can_land(self) -> bool:
        return self._landings < LANDINGS and self._tried > 2.0 * SHORTEST_LANDING

    def _land(self, fraction: float, name: str, kind: EventKind) -> list[float]:
        """Repeat the step so that it ends where something happens to a pin."""
        self._landings += 1
        self.cut_steps += 1
        self._wanted = max(self._wanted, self._tried)
        self._turning = name if kind is EventKind.RETURN else None
        return self._repeat(fraction)

    def _repeat(self, share: float) -> list[float]:
        self._step = share * self._tried
        return REFUSED

    def _change_memory(self) -> float:
        """Let pins remember what happened to them at the end of the step; longest next step [s]."""
        largest = math.inf
        for name, kind in self._happened.items():
            pin = self.pins[name]
            memory = pin.memory
            if kind is not EventKind.RETURN or pin.forgets:
                memory = memory._replace(impact_velocity=0.0)
            if kind is EventKind.SEPARATION:
                pin.remember(memory._replace(in_contact=False))
                if pin.onsets:
                    pin.onsets[-1] = pin.onsets[-1].separated(self.time, -pin.start.rate)
                continue
            inverse_masses = self.find_inverse_masses(name)
            pin.remember(memory._replace(in_contact=True).with_inverse_mass(inverse_masses.held))
            if kind is EventKind.IMPACT:
                largest = min(largest, self._impact(pin, inverse_masses.alone))
            else:
                pin.start = pin.start._replace(rate=max(0.0, pin.start.rate))  # whatever rounding says
        self._remember()
        return largest

    def _impact(self, pin: TreeClearanceJoint, inverse_mass: InverseMass) -> float:
        """Begin a contact; length of the first step in it [s]."""
        place = pin.start
        speed = max(0.0, place.rate)
        pin.remember(pin.memory._replace(impact_velocity=speed))
        pin.onsets.append(Onset(self.time - place.depth / speed if speed > 0.0 else self.time, speed))
        impact = Impact(speed, pin.mass(inverse_mass, place.x, place.y))
        return pin.contact.normal.impact_time(impact) / STEPS_OF_AN_IMPACT

    def _remember(self) -> None:
        self.history.memories.append(tuple(pin.memory for pin in self.pins.values()))
        self.forces.watch()

    # --- failures ---

    def _give_up(self) -> None:
        trouble = self._trouble
        if isinstance(trouble, LoadError):
            raise SimulationError(self._failure("a contact is overloaded", str(trouble)))
        if isinstance(trouble, LawError):
            raise SimulationError(self._failure(str(trouble), UNLAWFUL))
        raise SimulationError(self._failure(str(trouble) if trouble else "the step became too short"))

    def _failure(self, reason: str, advice: str = ADVICE) -> Failure:
        state = {"step": self._tried}
        for link, spin in zip(
            self.forces.tree.links, self.forces.tree.carried @ self.history.velocity[-1], strict=True
        ):
            state[f"{link.name}.angular_velocity"] = float(spin)
        for name, pin in self.pins.items():
            state[f"pin.{name}.depth"] = pin.start.depth
            state[f"pin.{name}.rate"] = pin.start.rate
            state[f"pin.{name}.impact_velocity"] = pin.memory.impact_velocity
        return Failure(reason, advice, self.time, state)
