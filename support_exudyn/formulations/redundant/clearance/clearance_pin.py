"""A pin with clearance over a run: what it remembers, when it touches, and its force on the engine."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import exudyn

from support_exudyn.formulations.contact_events import Action, DepthPath, Verdict, goes_on, judge, judge_at_ends
from support_exudyn.formulations.impact_steps import ImpactSteps
from support_exudyn.formulations.redundant.clearance.attachment import (
    Attachment,
    Relative,
    attachment,
    in_plane,
)
from support_exudyn.formulations.redundant.clearance.connector import Frame, PinConnector, displacement_scale
from support_exudyn.formulations.redundant.clearance.force_in_step import NEAR_PEAK, Course, has_a_top, peak
from support_exudyn.formulations.redundant.clearance.pin_motion import Motion, Moving, PinMotion
from support_exudyn.formulations.redundant.clearance.python_force import PythonForce
from support_exudyn.formulations.redundant.clearance.steep_friction import EngineForce, SteepFriction
from support_exudyn.formulations.redundant.clearance.symbolic_force import SymbolicForce
from support_exudyn.mechanics.contact_state import Mobility, Onset, PinMemory
from support_exudyn.mechanics.pressed_pins import NOT_KNOWN, Mobilities
from user_forces.compilation.flat import flat_force
from user_forces.contact import ContactForce, JournalContact
from user_forces.normal.law import Touch
from user_forces.values.value import Vector2

SPIN_ERROR = 1e-13  # of slip [m/s] by a bore's spin that had to be guessed, above which a step is repeated
SPIN_REPEATS = 4


class LoosePin:
    """One clearance pin of a scene.

    Arguments:
        mbs: the engine's system.
        contact: bearing and laws.
        bore, journal: the engine's body and the frame on it, see `PinConnector`.
        turn: of the journal's frame relative to the bore's [rad].
        bore_node, journal_node: node of the body, None: it is the ground.
        in_space: the bodies move in space.
        symbolic: let the engine evaluate the force.
        impact_steps: number of steps in an impact, see SolverSettings.
    """

    def __init__(
        self,
        mbs: Any,
        contact: JournalContact,
        *,
        bore: tuple[Any, Frame],
        journal: tuple[Any, Frame],
        turn: float,
        bore_node: Any,
        journal_node: Any,
        in_space: bool = False,
        symbolic: bool,
        impact_steps: int,
    ) -> None:
        self.mbs = mbs
        self.contact = contact
        self.bore_node = bore_node
        self.at = at = attachment(contact, bore_node is None, journal_node is None, in_space)
        self._on_line = at is Attachment.LINE
        self.turns = at is Attachment.CENTRAL and bore_node is not None  # the bore, in the connector's axes
        self.impact = ImpactSteps(contact.normal, impact_steps)
        self.connector = PinConnector(mbs, bore, journal, turn, at, contact.bearing.clearance)

        def engine_force(straight: bool) -> EngineForce:
            if symbolic:
                return SymbolicForce(mbs, contact, at, straight)
            return PythonForce(contact, at, self._bore_spin, straight)

        self._friction = SteepFriction(contact.friction, engine_force)
        self.connector.set_force(self.engine_force.function)
        self._force = flat_force(contact)
        # whether the force depends on more than the touch from step to step
        self._changes = contact.friction.has_state or at is Attachment.MIDDLE or self.turns
        self._touch: tuple[object, ...] = ()
        # set when the scene is whole
        self.find_mobilities: Callable[[], Mobilities] = lambda: NOT_KNOWN  # as they are now
        self.motion: PinMotion | None = None
        self.step_size: Callable[[], float] = lambda: math.nan  # of the step being tried [s]
        self.locates = True  # touches and partings, see SolverSettings
        self.share = 1.0  # of the contact that mobilities are told for
        # at the last accepted step
        self.kept = PinMemory(False, 0.0, 0.0, 0.0)
        self._alone = NOT_KNOWN.alone  # the journal's mobility by itself, when the memory's was found
        self._turn, self._turn_rate = 0.0, 0.0  # between the marker frames [rad], [rad/s]
        self._spin, self._spin_rate = 0.0, 0.0  # of the bore [rad/s], [rad/s^2]
        self._bore = (0.0, 0.0)  # angle and spin of a bore that turns in the connector's axes [rad], [rad/s]
        # the step being tried
        self.memory = self.kept  # with which its force is computed
        # in the axes of the connector's displacement: the memory's mobility, and that of the journal by itself
        self._here = self._alone_here = self.memory.mobility
        self._bore_angle = 0.0  # of the bore's axes in those of the connector, expected at its end [rad]
        self.reached = self.memory  # at its end
        self.force: ContactForce = contact.force(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, None)
        self.onset: Onset | None = None
        self.wants_cut = False
        self.landing = math.inf  # where steps are to end, seen in one that was then cut [s]
        self._step = 0.0
        self._motion = Relative(0.0, 0.0, 0.0, 0.0)  # at its end
        self._mass = 1.0  # that moves as the depth does at its end, while in contact [kg]
        self._swing_step = math.inf  # see `longest_step`
        self._least_mass = 1.0  # the same if no other loose pin holds anything, which steps follow [kg]
        self._tried_turn = (0.0, 0.0)
        self._tried_spin = 0.0
        self._tried_bore = self._bore
        self._seen: tuple[Motion, Motion] | None = None  # of bore and journal at its end, if asked
        self._guessed_spin = 0.0  # of the bore at its end [rad/s]
        self._guessed_turn = 0.0  # between the marker frames at its end [rad]
        self._spin_repeats = 0
        # at the end of the last accepted step
        self._angle: float | None = None  # of the journal's place in the bore [rad]
        self._size = 0.0  # of the force [N]
        self.course: Course | None = None  # of a step just accepted over which the contact went on
        # over the run
        self.onsets: list[Onset] = []
        self.clamped_steps = 0
        self.largest_force = 0.0

    @property
    def engine_force(self) -> EngineForce:
        """What the engine asks for the force."""
        return self._friction.acting

    @property
    def calls(self) -> int:
        """Evaluations of the force in Python."""
        return self._friction.calls

    @property
    def longest_step(self) -> float:
        """For the impact going on, or for what friction holds at the end of the last step [s]."""
        return min(self.impact.step, self._swing_step)

    # --- called by the solver ---

    def start(self, memory: PinMemory, mobilities: Mobilities, turn: float, bore: tuple[float, float]) -> None:
        """Before the first step.

        Arguments:
            memory: of the pin.
            mobilities: of its journal.
            turn: of the journal against the bore since the start posture [rad].
            bore: angle and spin of the bore [rad], [rad/s].
        """
        self.kept = self._renewed(memory, mobilities)
        self._turn = turn
        self._bore = bore

    def plainly(self, touch_speed: float) -> None:
        """Let the force act whenever there is depth, as for a touch with this speed [m/s].

        For recipes that do without `begin_try`, `after_newton` and `accept`.
        """
        self._recall(self.kept._replace(in_contact=True, approach_speed=touch_speed))

    def jumped(self, memory: PinMemory) -> None:
        """Velocities have jumped after the last step; the memory since then."""
        self.kept = self.reached = memory
        self._seen = None
        if self.turns:
            self._bore = self.moving.now()[0][4:]

    def begin_try(self, step: float) -> None:
        """Before a step of this length [s] is tried: go back to the last accepted one, line up the frames."""
        self.onset = None
        self.wants_cut = False
        self._step = step
        self._friction.begin()
        if self.at is Attachment.MIDDLE:
            self._guess(step)
        elif self.turns:
            self._bore_angle = self._bore[0] + step * self._bore[1]
        self._recall(self.kept)

    def _guess(self, step: float) -> None:
        """What the connector does not know of the step's end."""
        self._spin_repeats = 0
        self._guessed_spin = self._spin + self._spin_rate * step
        self._guessed_turn = self._turn + self._turn_rate * step
        if self.connector.line_up(self._guessed_turn):
            self._turn -= self._guessed_turn
            self._guessed_turn = 0.0

    def accept(self, t: float) -> None:
        """After a step that ends at t [s] has been accepted: keep what happened in it."""
        was_in_contact = self.kept.in_contact
        self.course = self._course() if self.memory.in_contact and self.onset is None else None
        self.kept = reached = self.reached
        if not reached.in_contact and self._friction.part():
            self._let_act()
        if was_in_contact and not reached.in_contact and self.onsets:
            self.onsets[-1] = self.onsets[-1].parted(t, -reached.rate)
        if self.at is Attachment.MIDDLE:
            self._turn, self._turn_rate = self._tried_turn
            if self._step > 0.0:
                self._spin_rate = (self._tried_spin - self._spin) / self._step
            self._spin = self._tried_spin
        self._bore = self._tried_bore
        if self.locates:
            after = self.impact.follow if self.onset is None else self.impact.touch
            unknown = self._on_line and (self.onset is not None or not self.impact.calm(reached.depth))
            after(reached.depth, reached.rate, self._find_least_mass() if unknown else self._least_mass)
            self._swing_step = self.impact.swing_step(self._swing_time())
        if self.onset is not None:
            self.onsets.append(self.onset)
            self.onset = None
        force = self.force
        if force.clamped:
            self.clamped_steps += 1
        before, self._size = self._size, math.hypot(force.normal_force, force.friction_force)
        self._angle = self._place_angle()
        self.largest_force = max(self.largest_force, self._size)
        near = self.course is not None and max(before, self._size) > NEAR_PEAK * self.largest_force
        if near and has_a_top(self._size_within, before, self._size):
            self.largest_force = peak(self._size_within, self.largest_force)

    def _course(self) -> Course:
        """Of the step that has been tried, from the last accepted one to its end."""
        start, end, angle = self.kept, self.force, self._place_angle()
        path = DepthPath(start.depth, start.rate, end.depth, end.rate, self._step)
        before = angle if self._angle is None else self._angle
        return Course(path, start.slip, before, self._motion, end.slip, angle, self.contact.bearing.clearance)

    def _place_angle(self) -> float:
        """Direction of the journal's place at the end of the step, in the axes of mobilities [rad]."""
        x, y = self._motion[:2]
        return math.atan2(y, x) - self._bores_axes

    def force_within(self, x: float) -> ContactForce:
        """The force at a fraction of the step just accepted; at its end, if the contact did not go on in it."""
        if self.course is None:
            return self.force
        motion, memory, mass = self.course.at(x), self.memory, self._mass
        if not self._on_line:
            mass = self._turned(memory.mobility).mass(motion.x, motion.y)
        touch = memory.in_contact, memory.approach_speed, mass, memory.deflection, memory.slip
        return self._force(*motion[:4], *motion.spins(self.at), *touch, x * self._step)

    def _size_within(self, x: float) -> float:
        force = self.force_within(x)
        return math.hypot(force[3], force[4])

    @property
    def touch(self) -> Touch:
        """What laws are told of the contact in the step that has been tried."""
        return Touch(self.memory.approach_speed, self._mass)

    def _swing_time(self) -> float:
        """Of what friction holds, with the least mass that moves along the surface [s].

        It is that of the journal's centre. Its turning adds little: pins are thin beside what they join.
        """
        friction, force = self.contact.friction, self.force.normal_force
        if not friction.has_state or force == 0.0:
            return math.inf
        x, y = self._motion[:2]
        return friction.swing_time(self._alone_here.mass(-y, x), force / self.share)

    def begin_impact(self) -> None:
        """At the start, or when the drive's speed has jumped: the depth of a closed pin swings from now on."""
        if self.locates and self.kept.depth > 0.0:
            self.impact.begin(self.kept.depth, self.kept.rate, self._find_least_mass())

    def _find_least_mass(self) -> float:
        """Mass [kg] that moves at least as the depth does, where the journal is now."""
        return self._alone.mass(*self._place())

    def _place(self) -> Vector2:
        """Where the journal is now in its bore, in the bore's axes [m]."""
        (bx, by, _, _, angle, _), (x, y, *_) = self._seen or self.moving.now()
        x, y = x - bx, y - by
        if self.bore_node is None:
            return x, y
        c, s = math.cos(angle), math.sin(angle)
        return c * x + s * y, c * y - s * x

    def after_newton(self, t: float) -> float | None:
        """A step that would end at t [s] has been solved: None if it may stand.

        Else with which length [s] it is to be repeated; infinite: with the same, for the force has changed.
        """
        start = self.memory
        relative = self._relative()
        self.force = force = self._contact_force(relative)
        if self._spin_was_wrong():
            return math.inf
        if (
            start.in_contact
            and (again := self._friction.after_newton(force, self._step, self._mass)) is not None
        ):
            self._touch = ()  # another line is laid
            self._recall(start)
            return again
        depth, rate, slip = force[:3]
        if goes_on(start, depth, rate, self._step):
            self.reached = start.at(depth, rate, slip, force.deflection)
            return None
        return self._decided(start, self._verdict(start, t))

    def straighten(self) -> bool:
        """Newton's method has failed: let a straight line stand for friction; whether that is new."""
        if not self.kept.in_contact or not self._friction.straighten(self.kept.slip, self.force.normal_force):
            return False
        self._let_act()
        return True

    def rounding(self, step: float, size: float) -> float:
        """By how much friction scatters in a step [N], see `FrictionLine.rounding`."""
        return self._friction.rounding(self.force.normal_force, size, step)

    def _let_act(self) -> None:
        """Another force acts from now on, which has been told nothing yet."""
        self.connector.set_force(self.engine_force.function)
        self._touch = ()

    def _decided(self, start: PinMemory, verdict: Verdict) -> float | None:
        """The answer to the engine that follows from a verdict."""
        if verdict.action is Action.CUT:
            self.wants_cut = True
            self.landing = verdict.landing
            return verdict.step
        memory = self._completed(verdict)
        if verdict.onset is not None:
            self.onset = verdict.onset
        if verdict.action is Action.REPEAT:
            self._recall(memory)
            return math.inf
        self.reached = memory
        if not self._on_line:
            self._least_mass = self._find_least_mass()
        return None

    def _verdict(self, start: PinMemory, end_time: float) -> Verdict:
        """Whether the step that has been tried may stand."""
        step = (start, self.force.depth, self.force.rate, end_time, self.step_size())
        if self.locates:
            return judge(*step, self._impact_step, self.contact.normal.forgets)
        return judge_at_ends(*step, self.contact.normal.forgets)

    def _impact_step(self, speed: float) -> float:
        """Length of the steps [s] in an impact of this speed [m/s] that begins where the journal is."""
        return self.impact.length(speed, self.find_mobilities().alone.mass(*self._place()))

    def _completed(self, verdict: Verdict) -> PinMemory:
        """The verdict's memory with what the laws need besides."""
        memory = verdict.memory
        if verdict.action is Action.REPEAT:
            return self._renewed(memory, self.find_mobilities())._replace(deflection=0.0)
        if verdict.onset is not None or verdict.anew:
            memory = self._renewed(memory, self.find_mobilities())
        sticks = memory.in_contact and verdict.onset is None
        return memory.slid(self.force.slip, self.force.deflection if sticks else 0.0)

    def _renewed(self, memory: PinMemory, mobilities: Mobilities) -> PinMemory:
        """A memory with the mobility that laws go by from now on; steps go by that of the journal by itself."""
        self._alone = mobilities.alone
        return memory.with_mobility(mobilities.held)

    def _recall(self, memory: PinMemory) -> None:
        self.memory = memory
        touch = memory[:2] + memory[6:]  # all but its motion
        if touch != self._touch or self._changes:
            self._touch = touch
            self._here, self._alone_here = self._turned(memory.mobility), self._turned(self._alone)
            self._friction.lay()
            self.engine_force.load(memory, self._here, self._step, self._guessed_spin, self._guessed_turn)

    def _turned(self, mobility: Mobility) -> Mobility:
        """A mobility in the bore's axes, in those of the connector's displacement."""
        angle = self._bores_axes
        return mobility.turned(angle) if angle else mobility

    @property
    def _bores_axes(self) -> float:
        """Angle of the bore's axes in those of the connector's displacement, at the end of the step [rad].

        Where it acts between both bodies its axes are in the middle between both marker frames. These are lined
        up within 1e-4 rad, which counts where the mass that moves hangs on the direction.
        """
        if self.at is Attachment.MIDDLE:
            return -0.5 * self._guessed_turn
        return self._bore_angle if self.turns else 0.0

    # --- the motion at the end of the step that is being tried ---

    def _relative(self) -> Relative:
        """The journal in its bore in the axes of the connector's displacement."""
        if isinstance(self.engine_force, SymbolicForce):
            return self._from_coordinates()
        # the residual that satisfied Newton's method was evaluated at this same state
        if self._on_line:
            depth, rate = self.engine_force.last
            return Relative(depth + self.contact.bearing.clearance, 0.0, rate, 0.0)
        displacement, velocity, *turning = self.engine_force.last
        if self.at is Attachment.SPACE:
            return Relative(*in_plane(displacement, velocity))
        x, y, vx, vy = displacement[0], displacement[1], velocity[0], velocity[1]
        if not turning:
            if self.turns:
                self._tried_bore = self.moving.now()[0][4:]
            return Relative(x, y, vx, vy)
        (_, _, turn), (_, _, spin) = turning
        if self.at is not Attachment.MIDDLE:
            return Relative(x, y, vx, vy, spin)
        self._tried_turn = turn, spin
        self._tried_spin = self._bore_spin()
        scale = displacement_scale(turn)
        return Relative(scale * x, scale * y, vx, vy, spin, self._tried_spin)

    def _from_coordinates(self) -> Relative:
        self._seen = self.moving.now()
        (bx, by, bvx, bvy, bore_angle, bore_spin), journal = self._seen
        x, y, vx, vy, journal_angle, spin = journal
        x, y, vx, vy, turning = x - bx, y - by, vx - bvx, vy - bvy, spin - bore_spin
        if self.bore_node is None:
            return Relative(x, y, vx, vy, turning)
        self._tried_bore = bore_angle, bore_spin
        if self._on_line or self.turns:
            return Relative(x, y, vx, vy, turning)
        if self.at is Attachment.MIDDLE:
            turn = math.remainder(journal_angle + self.connector.frame_turn - bore_angle, 2.0 * math.pi)
            self._tried_turn, self._tried_spin = (turn, turning), bore_spin
            bore_angle += 0.5 * turn  # the connector's axes are in the middle between both marker frames
        c, s = math.cos(bore_angle), math.sin(bore_angle)
        return Relative(c * x + s * y, c * y - s * x, c * vx + s * vy, c * vy - s * vx, turning, bore_spin)

    @property
    def moving(self) -> Moving:
        """How bore and journal move."""
        if self.motion is None:
            raise RuntimeError("LoosePin.motion: is set by the scene")
        return self.motion

    def _contact_force(self, motion: Relative) -> ContactForce:
        x, y, vx, vy, _, _ = motion
        self._motion = motion
        in_contact, approach_speed, _, _, slip, deflection, *_ = self.memory
        if in_contact and not self._on_line:
            self._mass, self._least_mass = self._here.mass(x, y), self._alone_here.mass(x, y)
        spins = motion.spins(self.at)
        return self._force(
            x, y, vx, vy, *spins, in_contact, approach_speed, self._mass, deflection, slip, self._step
        )

    def _bore_spin(self) -> float:
        return float(self.mbs.GetNodeOutput(self.bore_node, exudyn.OutputVariableType.Coordinates_t)[2])

    def _spin_was_wrong(self) -> bool:
        """Whether the engine's expression used another spin of the bore than came out; then set the right one.

        It is told the bore's own spin before a step, since the connector knows only that of both bodies
        against each other. The slip depends on it by spin times eccentricity.
        """
        if self.at is not Attachment.MIDDLE or isinstance(self.engine_force, PythonForce):
            return False
        if self._spin_repeats >= SPIN_REPEATS:
            return False
        if abs(self._tried_spin - self._guessed_spin) * math.hypot(*self._motion[:2]) < SPIN_ERROR:
            return False
        self._spin_repeats += 1
        self._guessed_spin = self._tried_spin
        self._recall(self.memory)
        return True
