"""A pin with clearance over a run: what it remembers, when it touches, and its force on the engine."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import exudyn

from support_exudyn.connector import PinConnector, displacement_scale, recalled
from support_exudyn.impact_steps import ImpactSteps
from support_exudyn.onset import Action, Mobility, Onset, PinMemory, Verdict, judge
from support_exudyn.symbolic_force import SymbolicForce
from user_forces.contact import AT_REST, ContactForce, JournalContact, SlipHistory
from user_forces.friction.frictionless import Frictionless
from user_forces.normal.law import Touch
from user_forces.values import Vector2

REPEAT_ERROR = 1e6  # above any tolerance of the engine's discontinuous iteration: the step is repeated
SPIN_ERROR = 1e-13  # of slip [m/s] by a bore's spin that had to be guessed, above which a step is repeated
SPIN_REPEATS = 4


class LoosePin:
    """One clearance pin of a scene. Its memory lives in a data node of the engine, which puts it back
    when a step is rejected; what is kept here is a copy of it for the step being tried.

    Arguments:
        mbs: the engine's system.
        contact: bearing and laws.
        bore, journal: the engine's body and the centre on it, in the body's axes [m].
        turn: of the journal's body relative to the bore's [rad].
        bore_node: node of the bore's body if both bodies move, else None.
        bore_on_ground: the bore's body is the ground.
        symbolic: let the engine evaluate the force.
        impact_steps: number of steps in an impact, see SolverSettings.
    """

    def __init__(
        self,
        mbs: Any,
        contact: JournalContact,
        *,
        bore: tuple[Any, Vector2],
        journal: tuple[Any, Vector2],
        turn: float,
        bore_node: Any,
        bore_on_ground: bool,
        symbolic: bool,
        impact_steps: int,
    ) -> None:
        self.mbs = mbs
        self.contact = contact
        self.bore_on_ground = bore_on_ground
        self.bore_node = bore_node
        self.needs_spin = bore_node is not None and not isinstance(contact.friction, Frictionless)
        self.impact = ImpactSteps(contact.normal, impact_steps)
        self.connector = PinConnector(mbs, bore, journal, turn, self._after_newton)
        self.symbolic = (
            SymbolicForce(mbs, contact, bore_node is None and not bore_on_ground) if symbolic else None
        )
        self.connector.set_force(self.symbolic.function if self.symbolic else self._connector_force)
        # set when the scene is whole
        self.mobility: Callable[[], Mobility] = lambda: Mobility(math.nan, math.nan, math.nan)  # as it is now
        self.step_size: Callable[[], float] = lambda: math.nan  # of the step being tried [s]
        # at the last accepted step
        self._turn, self._turn_rate = 0.0, 0.0  # between the marker frames [rad], [rad/s]
        self._spin, self._spin_rate = 0.0, 0.0  # of the bore [rad/s], [rad/s^2]
        # the step being tried
        self.memory = PinMemory(False, 0.0, 0.0, 0.0)  # with which its force is computed
        self._mobility = self.memory.mobility
        self._history = AT_REST
        self.reached = self.memory  # at its end
        self.force: ContactForce = contact.force(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, None)
        self.onset: Onset | None = None
        self.wants_cut = False
        self.landing = math.inf  # where steps are to end, seen in one that was then cut [s]
        self._step = 0.0
        self._eccentricity = (0.0, 0.0)  # at its end [m]
        self._tried_turn = (0.0, 0.0)
        self._tried_spin = 0.0
        self._guessed_spin = 0.0  # of the bore at its end [rad/s]
        self._guessed_turn = 0.0  # between the marker frames at its end [rad]
        self._spin_repeats = 0
        # over the run
        self.onsets: list[Onset] = []
        self.calls = 0
        self.clamped_steps = 0
        self.largest_force = 0.0

    @property
    def slots(self) -> slice:
        """Where the pin's memory stands in the engine's vector of data coordinates, once assembled."""
        return self.connector.slots

    # --- called by the solver ---

    def start(self, turn: float) -> None:
        """Before the first step: how far the journal's body has turned against the bore's [rad] by settling."""
        self._turn = turn

    def begin_try(self, data: list[float], step: float) -> None:
        """Before a step is tried: take the memory from the engine, line up the frames.

        Arguments:
            data: the pin's data coordinates, as the engine has them.
            step: length of the step [s].
        """
        self.onset = None
        self.wants_cut = False
        self._step = step
        self._spin_repeats = 0
        self._guessed_spin = self._spin + self._spin_rate * step
        self._guessed_turn = self._turn + self._turn_rate * step
        if self.connector.line_up(self._guessed_turn):
            self._turn -= self._guessed_turn
            self._guessed_turn = 0.0
        self._recall(recalled(data))

    def accept(self) -> None:
        """After a step has been accepted: keep what happened in it."""
        self._turn, self._turn_rate = self._tried_turn
        if self._step > 0.0:
            self._spin_rate = (self._tried_spin - self._spin) / self._step
        self._spin = self._tried_spin
        state = self.reached.depth, self.reached.rate, self._mass
        if self.onset is None:
            self.impact.follow(*state)
        else:
            self.impact.touch(*state)
            self.onsets.append(self.onset)
            self.onset = None
        self.clamped_steps += bool(self.force.clamped)
        self.largest_force = max(
            self.largest_force, math.hypot(self.force.normal_force, self.force.friction_force)
        )

    def begin_impact(self) -> None:
        """The drive's speed has jumped: the depth of a closed pin swings from now on."""
        if self.reached.depth > 0.0:
            self.impact.begin(self.reached.depth, self.reached.rate, self._mass)

    @property
    def _mass(self) -> float:
        """Mass [kg] that moves as the depth does at the end of the last step."""
        return self.reached.mobility.mass(*self._eccentricity)

    # --- called by the engine ---

    def _connector_force(
        self,
        mbs: Any,
        t: float,
        item: int,
        displacement: list[float],
        rotation: list[float],
        velocity: list[float],
        angular_velocity: list[float],
        *unused: Any,
    ) -> list[float]:
        """Force and moment of the connector, which act on the bore and, reversed, on the journal."""
        self.calls += 1
        x, y = _offset(displacement, rotation)
        force = self._contact_force(x, y, velocity, angular_velocity)
        # the engine moves the force to the middle between both centres, eccentricity/2 from the journal's
        arm = force.journal_arm + 0.5 * math.hypot(x, y)
        return [-force.force_x, -force.force_y, 0.0, 0.0, 0.0, -arm * force.friction_force]

    def _after_newton(
        self,
        mbs: Any,
        t: float,
        item: int,
        data: list[float],
        displacement: list[float],
        rotation: list[float],
        velocity: list[float],
        angular_velocity: list[float],
        *unused: Any,
    ) -> list[float]:
        """[error, recommended step, new memory]: accept the step, repeat it, or ask for a shorter one."""
        start = recalled(data)
        x, y = _offset(displacement, rotation)
        self.force = self._contact_force(x, y, velocity, angular_velocity)
        self._eccentricity = (x, y)
        self._tried_turn = (rotation[2], angular_velocity[2])
        if self._spin_was_wrong(math.hypot(x, y)):
            return [REPEAT_ERROR, -1.0, *data]
        verdict = judge(
            start,
            self.force.depth,
            self.force.rate,
            t,
            self.step_size(),
            lambda speed: self.impact.length(speed, self.mobility().mass(x, y)),
            self.contact.normal.forgets,
        )
        if verdict.action is Action.CUT:
            self.wants_cut = True
            self.landing = verdict.landing
            return [REPEAT_ERROR, verdict.step, *data]
        memory = self._completed(verdict, start)
        if verdict.onset is not None:
            self.onset = verdict.onset
        if verdict.action is Action.REPEAT:
            self._recall(memory)
            return [REPEAT_ERROR, -1.0, *memory]
        self.reached = memory
        return [0.0, -1.0, *memory]

    def _completed(self, verdict: Verdict, start: PinMemory) -> PinMemory:
        """The verdict's memory with what the laws need besides."""
        memory = verdict.memory
        if verdict.action is Action.REPEAT:
            return memory.with_mobility(self.mobility())._replace(deflection=0.0)
        if verdict.onset is not None or verdict.anew:
            memory = memory.with_mobility(self.mobility())
        sticks = memory.in_contact and verdict.onset is None
        return memory._replace(slip=self.force.slip, deflection=self.force.deflection if sticks else 0.0)

    def _contact_force(
        self, x: float, y: float, velocity: list[float], angular_velocity: list[float]
    ) -> ContactForce:
        memory = self.memory
        # as memory.touch says, which the engine asks for too often to make the mobility anew
        touch = Touch(memory.approach_speed, self._mobility.mass(x, y)) if memory.in_contact else None
        bore_spin, journal_spin = self._spins(angular_velocity[2])
        return self.contact.force(
            x,
            y,
            velocity[0],
            velocity[1],
            bore_spin,
            journal_spin,
            touch,
            self._history,
        )

    def _spins(self, turning: float) -> tuple[float, float]:
        """Angular velocities of bore and journal [rad/s] from that of the journal against the bore."""
        if self.needs_spin:
            output = exudyn.OutputVariableType.Coordinates_t
            self._tried_spin = float(self.mbs.GetNodeOutput(self.bore_node, output)[2])
            return self._tried_spin, self._tried_spin + turning
        return (0.0, turning) if self.bore_on_ground else (-turning, 0.0)

    def _spin_was_wrong(self, eccentricity: float) -> bool:
        """Whether the engine's expression used another spin of the bore than came out; then set the right one.

        It is told the bore's own spin before a step, since the connector knows only that of both bodies
        against each other. The slip depends on it by spin times eccentricity.
        """
        if self.symbolic is None or not self.needs_spin or self._spin_repeats >= SPIN_REPEATS:
            return False
        if abs(self._tried_spin - self._guessed_spin) * eccentricity < SPIN_ERROR:
            return False
        self._spin_repeats += 1
        self._guessed_spin = self._tried_spin
        self._recall(self.memory)
        return True

    def _recall(self, memory: PinMemory) -> None:
        self.memory = memory
        self._mobility = memory.mobility
        self._history = SlipHistory(memory.deflection, memory.slip, self._step)
        if self.symbolic is not None:
            self.symbolic.load(memory, self._step, self._guessed_spin, self._guessed_turn)

    # --- static equilibrium ---

    @contextmanager
    def settling(self, stiffness: Callable[[], float]) -> Iterator[None]:
        """Replace the contact by its elastic part and a spring that pulls a free journal to the middle.

        Arguments:
            stiffness: of the spring [N/m], asked at every evaluation.
        """

        def force(
            mbs: Any,
            t: float,
            item: int,
            displacement: list[float],
            rotation: list[float],
            *unused: Any,
        ) -> list[float]:
            x, y = _offset(displacement, rotation)
            eccentricity = math.hypot(x, y)
            pull = stiffness()
            depth = self.contact.bearing.depth(eccentricity)
            if depth > 0.0:
                pull += self.contact.normal.elastic_force(depth) / eccentricity
            return [pull * x, pull * y, 0.0, 0.0, 0.0, 0.0]

        def after_newton(mbs: Any, t: float, item: int, data: list[float], *unused: Any) -> list[float]:
            return [0.0, -1.0, *data]

        connector = self.connector
        connector.set_force(force)
        connector.set_after_newton(after_newton)
        try:
            yield
        finally:
            connector.set_force(self.symbolic.function if self.symbolic else self._connector_force)
            connector.set_after_newton(self._after_newton)


def _offset(displacement: list[float], rotation: list[float]) -> Vector2:
    """Journal's centre minus bore's centre [m] from what the engine hands to its user functions."""
    scale = displacement_scale(rotation[2])
    return scale * displacement[0], scale * displacement[1]
