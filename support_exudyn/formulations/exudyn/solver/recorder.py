"""What is kept of a run: states at the records, and integrals over all steps."""

from array import array
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from support_exudyn.formulations.exudyn.scene.engine_scene import EngineScene
from support_exudyn.formulations.exudyn.solver.within_steps import RunningIntegrals, StepEnd, between
from support_exudyn.formulations.statistics.collected import RunStatistics
from support_exudyn.formulations.statistics.ends import beside_jumps
from support_exudyn.mechanics.channels import EVERYTHING, DataNeeds
from support_exudyn.mechanics.observed_run import Trajectory
from support_exudyn.mechanics.time_statistics import TimeStatistics
from support_exudyn.mechanics.trajectory import Series
from user_forces.contact_state import PinMemory

# of a StepEnd after its time
STATE = (DataNeeds.POSITION, DataNeeds.VELOCITY, DataNeeds.CONTACTS)
Numbers = Sequence[float] | Series
AT_ONCE = 250  # ends of steps: then they become statistics


@dataclass(frozen=True)
class History:
    """Raw states at the records, one row each; see `channels` for what they mean.

    time (n,); position, velocity (n, coordinates); memory (n, clearance pins, fields of PinMemory);
    legs (n, states): of hydraulic legs; deflection (n, ideal joints with friction), states of their laws; work,
    damping_loss, friction_loss (n,) [J].
    What was not to be kept has rows without columns; integrals that were not are zero.
    """

    time: np.ndarray
    position: np.ndarray
    velocity: np.ndarray
    memory: np.ndarray
    legs: np.ndarray
    deflection: np.ndarray
    work: np.ndarray
    damping_loss: np.ndarray
    friction_loss: np.ndarray


class _StateRows:
    """States one behind the other: with an object for each part of a row they take three times as much."""

    def __init__(self) -> None:
        self._numbers = array("d")
        self._widths: tuple[int, ...] = ()
        self._count = 0

    def keep(self, *parts: Numbers) -> None:
        """Add a row: time, and what a `History` has."""
        for part in parts:
            if isinstance(part, np.ndarray):
                self._numbers.frombytes(part.tobytes())
            else:
                self._numbers.extend(part)
        self._widths = tuple(map(len, parts))
        self._count += 1

    def history(self) -> History:
        """What has been kept so far."""
        table = np.array(self._numbers).reshape(self._count, -1)
        edges = np.cumsum(self._widths)[:-1]
        time, *parts, totals = (np.ascontiguousarray(part) for part in np.split(table, edges, axis=1))
        position, velocity, memory, legs, deflection = parts
        memory = memory.reshape(self._count, -1, len(PinMemory._fields))
        return History(time[:, 0], position, velocity, memory, legs, deflection, *totals.T)

    def keep_ends(self) -> None:
        """Forget all but the first and the last row."""
        width = sum(self._widths)
        self._numbers[:] = self._numbers[:width] + self._numbers[-width:]
        self._count = 2


class Recorder:
    """Collects a History while a run goes on, and statistics from the ends of all steps.

    Arguments:
        scene: that is run.
        needs: what is to be kept, see `channel_definitions`.
        observe: what is to be said of states, from which channels are computed; None: no statistics.
    """

    def __init__(
        self,
        scene: EngineScene,
        needs: DataNeeds = EVERYTHING,
        observe: Callable[[History], Trajectory] | None = None,
    ) -> None:
        duration = scene.scenario.duration
        # rigid actuators that are held and ideal pins neither work nor lose anything
        works = any(part.drive.span(duration) != (0.0, 0.0) for part in scene.driven)
        self.integrates = DataNeeds.INTEGRALS in needs and bool(
            works or scene.clearance_joints or scene.frictions or scene.loads or scene.legs.names
        )
        self._kept = tuple(part in needs for part in STATE)
        self.energies = RunningIntegrals(3)  # work of the drive, losses by damping and by friction
        self._data = scene.mbs.systemData
        self._pins = tuple(scene.clearance_joints.items())
        self._looks = scene.scenario.solver.result_checks  # whether what is lost is
        self._driven = tuple(scene.driven)
        self._frictions = tuple(scene.frictions.items())
        self._loads = tuple(scene.loads.values())
        self._legs = scene.legs
        self._keeps_legs = scene.legs.states_count > 0 and DataNeeds.OIL in needs
        self._records, self._ends = _StateRows(), _StateRows()
        self._begins: list[bool] = []  # whether a piece begins with an end of a step, behind the first
        self._observe = observe
        self.statistics = RunStatistics(scene.scenario)
        self.follows = observe is not None and bool(self.statistics.wanted)  # whether ends of steps are kept
        self._powers_now = (0.0, 0.0, 0.0)  # [W]
        self._start: StepEnd | None = None  # of the step going on

    def after_step(self, t: float, kink: bool) -> None:
        """Add a step that has been accepted; `kink`: an impact or a break of the drive lies at its end."""
        if not self.integrates:
            return
        self._powers_now = self._powers(t)
        self.energies.add(t, self._powers_now)
        if kink:
            self.energies.restart()

    def jump(self, t: float, energy: float) -> None:
        """The actuators' speed has jumped at t [s], which gave the bodies this energy [J]."""
        self.energies.totals[0] += energy
        self.energies.jump(t)

    def switch(self, t: float) -> None:
        """Valves have opened or closed at t [s], the end of the last step."""
        if self.integrates:
            self.energies.add(t, self._powers(t))

    def begin_step(self, t: float) -> None:
        """Begin a step at t [s] that may pass over records."""
        self._start = self._state(t)

    @property
    def passes_records(self) -> bool:
        """Whether the step going on was begun as one that may pass over records."""
        return self._start is not None

    def end_step(self) -> None:
        """The records that the step has passed over are kept."""
        self._start = None

    def record_between(self, t: float, end: float) -> None:
        """Keep the state at time t [s] inside the step that has just ended at another [s]."""
        if self._start is None:
            raise RuntimeError("begin_step: was not called before the step")
        position, velocity, memory, totals = between(self._start, self._state(end), t)
        # in contact or not, with which impact: as over all of the step
        memory[:, :2] = self._start.memory[:, :2]
        kept = (position, velocity, memory.ravel())
        self._keep(self._records, t, kept, totals.tolist())
        if self.follows:
            self._keep(self._ends, t, kept, totals.tolist())
            self._begins.append(False)

    def _state(self, t: float) -> StepEnd:
        data = self._data
        return StepEnd(
            t,
            data.GetODE2Coordinates(),
            data.GetODE2Coordinates_t(),
            data.GetODE2Coordinates_tt(),
            _memories([pin.kept for _, pin in self._pins]),
            np.array(self.energies.totals),
            np.array(self._powers_now),
        )

    def record(self, t: float) -> None:
        """Keep the state at time t [s]."""
        self._keep_now(self._records, t, None)

    def end(self, t: float, before: Sequence[PinMemory] | None = None) -> None:
        """Keep the state at the end of a step, t [s], for the statistics.

        before: what pins remembered in the step, where impacts have made something else of it; else None.
        """
        if before is None:
            self._keep_end(t, not self._begins, None)
        else:
            self._keep_end(t, False, before)
            self.begin(t)

    def begin(self, t: float) -> None:
        """Keep the state at t [s], where something has jumped since the end of the last step."""
        self._keep_end(t, True, None)

    def _keep_end(self, t: float, begins: bool, remembered: Sequence[PinMemory] | None) -> None:
        if not self.follows:
            return
        if not self._begins:  # the state by which energies are told
            self._keep_now(self._ends, t, remembered)
        self._keep_now(self._ends, t, remembered)
        self._begins.append(begins)
        if len(self._begins) >= AT_ONCE:
            self._take_ends()

    def _take_ends(self) -> None:
        """Take the ends of the steps since the last time into the statistics."""
        assert self._observe is not None
        history, begins = self._ends.history(), np.array(self._begins)
        time = history.time[1:].copy()
        history.time[1:] = beside_jumps(time, begins)
        self.statistics.add_ends(time, begins, self._observe(history))
        self._ends.keep_ends()
        self._begins = [True]

    def _keep_now(self, rows: _StateRows, t: float, remembered: Sequence[PinMemory] | None) -> None:
        data = self._data
        pins = [pin.kept for _, pin in self._pins] if remembered is None else remembered
        position, velocity, memory = self._kept
        state = (
            data.GetODE2Coordinates() if position else (),
            data.GetODE2Coordinates_t() if velocity else (),
            _memories(pins).ravel() if memory else (),
        )
        self._keep(rows, t, state, self.energies.totals)

    def _keep(self, rows: _StateRows, t: float, state: Sequence[Numbers], totals: Sequence[float]) -> None:
        """Add a row; parts of the state that are not to be kept are left out."""
        rows.keep(
            (t,),
            *(part if keep else () for part, keep in zip(state, self._kept, strict=True)),
            self._legs.states() if self._keeps_legs else (),
            [friction.deflection for _, friction in self._frictions],
            totals,
        )

    def history(self) -> History:
        """What has been recorded so far."""
        return self._records.history()

    def finished(self) -> TimeStatistics | None:
        """The statistics of the run; None if nobody asks for any."""
        if not self.follows:
            return None
        self._take_ends()
        return self.statistics.finished()

    def _powers(self, t: float) -> tuple[float, float, float]:
        """Power [W] of the drive, of damping and of friction at the end of a step."""
        driving = damping = friction = 0.0
        for part in self._driven:
            if (speed := part.speed(t)) != 0.0:
                # the multiplier of a distance is the tension, that of a crank's angle the moment against it
                driving -= speed * float(self._data.GetAECoordinates()[part.multiplier])
        for load in self._loads:
            work, loss = load.powers()
            if self._looks and not loss >= 0.0:
                load.look()
            driving += work
            damping += loss
        if self._legs.names:
            work, loss, rubbed = self._legs.powers()
            driving, damping, friction = driving + work, damping + loss, friction + rubbed
        for name, rubbing in self._frictions:
            lost = rubbing.power()
            if self._looks and not lost >= 0.0:
                rubbing.look(name)
            friction += lost
        for name, pin in self._pins:
            force = pin.force
            if force.depth > 0.0:
                elastic = pin.elastic_force(force.depth) if pin.memory.in_contact else 0.0
                lost = (force.normal_force - elastic) * force.rate
                rubbed = force.friction_force * force.slip
                if self._looks and not (lost >= 0.0 >= rubbed and elastic >= 0.0):
                    pin.check(elastic, name)
                damping += lost
                friction -= rubbed
        return driving, damping, friction


def _memories(pins: Series | Sequence[PinMemory]) -> Series:
    """Memory of all clearance pins, shape (clearance pins, fields of PinMemory)."""
    return np.asarray(pins, dtype=np.float64).reshape(-1, len(PinMemory._fields))
