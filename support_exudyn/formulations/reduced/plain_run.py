"""The run in plain Python: scipy's DOP853 with located touches and partings, any law.

The functions of this package are taken as they are written, not compiled, and work on lists of floats; the
force of the contact is that of the scenario's own law objects.
"""

from __future__ import annotations

import math
from copy import copy
from typing import Any

import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import brentq

from support_exudyn.formulations.compiled import plain
from support_exudyn.formulations.contract import Failure, SimulationError
from support_exudyn.formulations.progress import Progress
from support_exudyn.formulations.reduced import events, layout
from support_exudyn.formulations.reduced.drive import Vector, driven
from support_exudyn.formulations.reduced.equations import (
    approach,
    evaluate,
    freeze_mobility,
    move_with_the_drive,
    observe,
    pin_at,
)
from support_exudyn.formulations.reduced.integrate import (
    ACCEPTED,
    CLAMPED,
    CUTS,
    DEAD_CENTRE,
    EVALUATIONS,
    FINISHED,
    JUMPS,
    LARGEST,
    LAST_STEP,
    NOT_A_NUMBER,
    SHARE_OF_WAY,
    SHORTEN,
    SMALLEST_SINE,
    SMALLEST_STEP,
    STEPS,
    STOPPED_AT,
    STUCK,
    TOO_MANY_STEPS,
    TOO_MANY_TOUCHES,
    happen,
)
from support_exudyn.formulations.reduced.jump import jump
from support_exudyn.formulations.reduced.law_contact import LawContact
from support_exudyn.formulations.reduced.outline import Outline
from support_exudyn.formulations.reduced.plain_records import PlainRecords
from support_exudyn.formulations.reduced.records import peak, size
from user_forces.lawful import UNLAWFUL, LawError
from user_forces.normal.law import LoadError

FIRST_STEP = 1e-4  # [s]
WORTH_A_LOOK = 0.3  # share of the largest force so far from which a step may hold a larger one
PARTS = 4  # of such a step
PARTS_CLOSED = 8  # of a step in contact, when it is looked for what happens in it
SHARE_OF_IMPACT = 0.1  # of an impact's duration is the first step after a touch
SHORT = 1e-9  # [s]: a step that goes too far and is no longer has only itself to blame
RELATIVE_TOLERANCE = 1e-13  # of the state; what counts is the absolute one
State = list[float]
Method: Any = DOP853  # its stubs ask for arrays where lists are faster
# in plain Python, on lists instead of arrays
_jump, _happen, _size, _pin_at = plain(jump), plain(happen), plain(size), plain(pin_at)
_driven, _approach, _freeze_mobility = plain(driven), plain(approach), plain(freeze_mobility)
_move_with_the_drive = plain(move_with_the_drive)


class Path:
    """The state within a step that DOP853 has just made, or within its beginning."""

    def __init__(self, solver: Any) -> None:
        self._solver = solver
        self._dense: Any = None
        self.begin, self.end = float(solver.t_old), float(solver.t)

    def states(self, times: Vector) -> Vector:
        """States at times [s] within the step, shape (n, STATES)."""
        if self._dense is None:
            self._dense = self._solver.dense_output()  # three evaluations
        return self._dense(times).T  # type: ignore[no-any-return]

    def part(self, begin: float, end: float) -> Path:
        """A part of the step, between two times [s]."""
        part = copy(self)
        part.begin, part.end = begin, end
        return part

    def at(self, t: float) -> State:
        """State at t [s]."""
        return self.states(np.array([t]))[0].tolist()  # type: ignore[no-any-return]


def _within(path: Path, x: float, out: State) -> None:
    """The state at a fraction of a step, in place of `runge_kutta.within`."""
    out[:] = path.at(path.begin + x * (path.end - path.begin))


class PlainRun:
    """One run; what `integrate` does compiled."""

    def __init__(self, made: Outline, most_steps: int, progress: Progress) -> None:
        assert made.pin is not None
        self.made, self.report = made, made.report
        self.most_steps = most_steps
        self.progress = progress
        self.force = LawContact(made.pin.contact)
        self.p: State = made.p.tolist()
        self.memory: State = made.memory.tolist()
        self.segment: State = made.segments[0].tolist()
        self.records = PlainRecords(made)
        with np.errstate(divide="ignore"):
            self.allowed = 1.0 / made.weights  # error of a step
        self.allowed[layout.WORK] = math.inf  # is integrated afterwards
        self.first_step = FIRST_STEP
        self.code = FINISHED
        self.is_a_number = True  # the last rate of the state
        self.met = events.NOTHING  # at the end of the last step that was accepted
        # the law itself is asked, and here this says: something happens where a contact is pressed on again
        self.p[layout.BY_DEPTH] = float(self.force.contact.normal.forgets or self.force.asks_for_mass)
        self.evaluate = plain(
            evaluate, contact_force=self.force, support_power=_no_power, slider_crank_power=_no_power
        )
        self.observe = plain(observe, contact_force=self.force)
        instead = {"contact_force": self.force, "within": _within}
        # steps of DOP853 are so long that a contact swings in them, and PUSH is a sign only
        self.event = plain(events.event, **instead, PARTS_CLOSED=PARTS_CLOSED, CUT_SAMPLES=1)
        self.peak = plain(peak, **instead)

    def go(self) -> int:
        """Run from 0 to the end; FINISHED, or why not."""
        y: State = self.made.y.tolist()
        if self.segment[layout.JUMP] == 0.0:
            _move_with_the_drive(self.p, self.segment, 0.0, y)
        _freeze_mobility(self.p, self.segment, self.memory, 0.0, y)
        self.records.first(y, self.segment, self.memory)
        for row in self.made.segments:
            self.segment = row.tolist()
            if self.segment[layout.JUMP] != 0.0:
                _jump(self.p, self.segment, y, False, self.made.jumps, int(self.report[JUMPS]))
                self.records.jump(float(self.made.jumps[int(self.report[JUMPS]), layout.JUMP_ENERGY]))
                self.report[JUMPS] += 1
            t = self.segment[layout.BEGIN]
            while t < self.segment[layout.END] and self.code == FINISHED:
                t, y = self._until_event(t, y)
            if self.code != FINISHED:
                self.made.y[:] = y
                return self.code
        self.records.write(self.p)
        return FINISHED

    def _contact(self, t: float, y: State) -> State:
        """State of the contact, see `layout`."""
        found = [0.0] * layout.CONTACT
        self.observe(self.p, self.segment, self.memory, t, y, found)
        return found

    def _rate(self, t: float, y: Vector) -> State:
        slope = [0.0] * layout.STATES
        # numbers of numpy would slow down all that is computed from them
        self.evaluate(self.p, self.segment, self.memory, float(t), y.tolist(), slope, [0.0] * layout.CONTACT)
        self.is_a_number = math.isfinite(slope[layout.FIRST_RATE] + slope[layout.SECOND_RATE])
        return slope

    def _until_event(self, t: float, y: State) -> tuple[float, State]:
        """Make steps until something happens to the contact, or one must be made again; time and state then."""
        stop = self.segment[layout.END]
        first = min(self.first_step, stop - t)
        solver = Method(self._rate, t, y, stop, rtol=RELATIVE_TOLERANCE, atol=self.allowed, first_step=first)
        start, counted = self._contact(t, y), 0
        # whatever rounding says
        if self.met == events.CUT:
            start[layout.PUSH] = 0.0  # on neither side
        elif self.met == events.RETURN:
            start[layout.RATE] = max(0.0, start[layout.RATE])
        while solver.status == "running":
            if not self._step(solver):
                return solver.t, y
            self.report[EVALUATIONS] += solver.nfev - counted
            counted = solver.nfev
            path, end = Path(solver), solver.y.tolist()
            found = self._contact(path.end, end)
            h = path.end - path.begin
            swiftness = self._swiftness(path.end, end)
            scratch = [0.0] * layout.STATES, [0.0] * layout.CONTACT
            what, low, high = self.event(
                self.p, self.segment, self.memory, path.begin, h, start, found, path, *scratch
            )
            if what == events.TOO_LONG or h * swiftness > SHARE_OF_WAY:
                self.first_step = SHORTEN * h
                return path.begin, y
            if what != events.NOTHING:
                return self._meet(what, path, low, high, start)
            self._accept(path, start, found)
            y, start, self.first_step = end, found, solver.h_abs
        return stop, y

    def _step(self, solver: Any) -> bool:
        """Let DOP853 make a step; whether it did."""
        report = self.report
        report[STEPS] += 1
        report[STOPPED_AT], report[LAST_STEP] = solver.t, solver.h_abs
        if report[STEPS] > self.most_steps:
            self.code = TOO_MANY_STEPS
            return False
        try:
            solver.step()
        except (ValueError, ArithmeticError) as error:  # overloaded, or it does not close
            self.first_step = SHORTEN * solver.h_abs  # perhaps only the step that was tried went too far
            if self.first_step < SHORT:
                if isinstance(error, (LoadError, LawError)):
                    raise
                report[NOT_A_NUMBER] = 1.0
                self.code = STUCK
            return False
        if solver.status == "failed" or solver.h_abs < SMALLEST_STEP:
            report[NOT_A_NUMBER] = float(not self.is_a_number)
            self.code = STUCK
        return self.code == FINISHED

    def _swiftness(self, t: float, y: State) -> float:
        """How fast a dead centre comes nearer [1/s]; notes one that is reached."""
        near = [0.0] * layout.NEARNESS
        _approach(self.p, self.segment, t, y, near)
        if near[layout.SINE] < SMALLEST_SINE:
            self.code = DEAD_CENTRE
        return near[layout.SWIFTNESS]

    def _meet(self, what: int, path: Path, low: float, high: float, start: State) -> tuple[float, State]:
        """End the step where something happens, and change the memory as it does; time and state then."""
        h = path.end - path.begin
        path.end = self._place(what, path, path.begin + low * h, path.begin + high * h)
        y = path.at(path.end)
        found = self._contact(path.end, y)
        self._accept(path, start, found)
        self.report[CUTS] += what != events.RETURN
        self.met = what
        speed = self.memory[layout.TOUCH_SPEED]
        if not _happen(what, path.end, found[layout.RATE], self.memory, self.made.onsets, self.report):
            self.code = TOO_MANY_TOUCHES
        if what == events.RETURN and not self.force.contact.normal.forgets:
            self.memory[layout.TOUCH_SPEED] = speed
        if what in (events.TOUCH, events.RETURN):
            _freeze_mobility(self.p, self.segment, self.memory, path.end, y)
        self.first_step = FIRST_STEP
        if what == events.TOUCH:
            pin = _pin_at(self.p, _driven(self.segment, path.end), y)
            self.first_step = min(FIRST_STEP, SHARE_OF_IMPACT * self.force.duration(self.memory, pin))
        return path.end, y

    def _place(self, what: int, path: Path, low: float, high: float) -> float:
        """When it happens [s], between two times."""
        item = {events.CUT: layout.PUSH, events.RETURN: layout.RATE}.get(what, layout.DEPTH)

        def value(t: float) -> float:
            return self._contact(t, path.at(t))[item]

        if what == events.RETURN:  # where the cubic of its part turns
            part = (path.end - path.begin) / PARTS_CLOSED
            low = path.begin + part * min(int((high - path.begin) / part), PARTS_CLOSED - 1)
            if not value(low) < 0.0 < value(low + part):
                return high
            high = low + part
        if low >= high:
            return high
        beyond = value(high) > 0.0
        if (value(low) > 0.0) == beyond:  # the cubic by which it has been looked for is off in a long step
            low = path.begin
        if (value(low) > 0.0) == beyond:  # it has happened at the very start, say where tension was cut
            return min(high, path.begin + SHORT)
        return float(brentq(value, low, high, xtol=1e-16, rtol=1e-15))

    def _accept(self, path: Path, start: State, end: State) -> None:
        """Keep what there is to keep of a step."""
        report = self.report
        report[ACCEPTED] += 1
        self.met = events.NOTHING
        report[CLAMPED] += end[layout.PUSH] < 0.0
        if self.memory[layout.TOUCHING] and max(_size(start), _size(end)) > WORTH_A_LOOK * report[LARGEST]:
            self._look_for_a_peak(path, start, end)
        if self.records.step(path, self.segment, self.memory):
            self.progress(path.end / self.made.times[-1])

    def _look_for_a_peak(self, path: Path, start: State, end: State) -> None:
        """Note the largest force of a step; those of DOP853 are so long that its parts are looked at."""
        edges = np.linspace(path.begin, path.end, PARTS + 1)
        inner = [
            self._contact(t, y)
            for t, y in zip(edges[1:-1].tolist(), path.states(edges[1:-1]).tolist(), strict=True)
        ]
        forces = [_size(contact) for contact in (start, *inner, end)]
        scratch = [0.0] * layout.STATES, [0.0] * layout.CONTACT
        largest = self.report[LARGEST]
        for n in range(PARTS):
            part = path.part(float(edges[n]), float(edges[n + 1]))
            h = part.end - part.begin
            around = self.p, self.segment, self.memory, part.begin, h, part
            largest = self.peak(*around, largest, forces[n], forces[n + 1], *scratch)
        self.report[LARGEST] = largest


def _no_power(*unused: object) -> float:
    return 0.0


def run_plain(made: Outline, most_steps: int, progress: Progress) -> tuple[int, int]:
    """Run; FINISHED or why not, and how often the law was asked."""
    run = PlainRun(made, most_steps, progress)
    try:
        return run.go(), run.force.calls
    except LoadError as error:
        failure = Failure("a contact is overloaded", str(error), float(made.report[STOPPED_AT]))
        raise SimulationError(failure) from error
    except LawError as error:
        said = str(error.at(made.model.PIN))
        raise SimulationError(Failure(said, UNLAWFUL, float(made.report[STOPPED_AT]))) from error
