"""A clearance pin, or a corner in a slot, over a run: its memory, when it makes contact, and its force."""

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from support_exudyn.formulations.contact_events import Action, Verdict, goes_on, judge, judge_at_ends
from support_exudyn.formulations.impact_steps import ImpactSteps
from support_exudyn.formulations.redundant.clearance.connector import PinConnector
from support_exudyn.formulations.redundant.clearance.connector_force import Attachment, Relative
from support_exudyn.formulations.redundant.clearance.largest_force import LargestForce
from support_exudyn.formulations.redundant.clearance.pin_frames import PinFrames
from support_exudyn.formulations.redundant.clearance.pin_motion import Moving
from support_exudyn.formulations.redundant.clearance.python_force import PythonForce
from support_exudyn.formulations.redundant.clearance.slot_frames import SlotFrames
from support_exudyn.formulations.redundant.clearance.steep_friction import EngineForce, SteepFriction
from support_exudyn.formulations.redundant.clearance.symbolic_force import SymbolicForce
from support_exudyn.mechanics.contact_state import InverseMass, Onset, PinMemory
from support_exudyn.scenario.solver_settings import SolverSettings
from user_forces.compilation.flat import flat_force, flat_function
from user_forces.contact import Contact, ContactForce
from user_forces.lawful import PROBED, look
from user_forces.values.value import Vector2

SHALLOW = 1e-9  # depth [m] at which a law is probed that has only just been been in contact


FindMass = Callable[[], InverseMass]  # how a journal answers impulses now, in the axes of its bore
NOT_KNOWN = InverseMass(math.nan, math.nan, math.nan)


class ClearanceJoint(LargestForce):
    """One clearance pin of a scene, or one corner between walls, which is a journal that slides freely along.

    Arguments:
        contact: bearing and laws.
        connector: in the engine, which is assembled.
        moving: how bore and journal move.
        bore_spin: tells the angular velocity of the bore's body now [rad/s].
        find_inverse_mass: tells how the journal answers impulses, by which steps go.
        settings: of the solver: what evaluates the force, how many steps are in an impact, whether impacts and
            separations are located.
        share: of the contact that the inverse effective mass is of.
    """

    def __init__(
        self,
        contact: Contact,
        connector: PinConnector,
        moving: Moving,
        bore_spin: Callable[[], float],
        find_inverse_mass: FindMass,
        settings: SolverSettings,
        share: float = 1.0,
    ) -> None:
        super().__init__()
        self.contact, self.connector, self.find_inverse_mass = contact, connector, find_inverse_mass
        self.locates, self.share = settings.locate, share
        self.frames = self._make_frames(moving, bore_spin)
        self._follows = self.frames.follows
        self._on_line = connector.at is Attachment.LINE
        self.impact_steps = ImpactSteps(contact.normal, settings.impact_steps)

        def engine_force(straight: bool) -> EngineForce:
            return self._make_force(settings.backend, bore_spin, straight)

        self._friction = SteepFriction(contact.friction, engine_force)
        self.engine_force = self._friction.acting  # what the engine asks for the force
        self.is_straight = False  # whether a line stands for friction
        self._is_symbolic = isinstance(self.engine_force, SymbolicForce)
        self.connector.set_force(self.engine_force.function)
        self._force, self.elastic_force = flat_force(contact), flat_function(contact.normal.elastic_force)
        self._has_state = contact.friction.has_state
        # whether the force depends on more than the impact from step to step
        self._changes = self._has_state or self._follows
        self._impact: tuple[object, ...] = ()  # that it has been told
        self._is_told = self._goes_on = False  # the impact of `kept`, of what the step being tried has reached
        # at the last accepted step
        self.kept = PinMemory(False, 0.0, 0.0, 0.0)
        # the journal's inverse effective mass at the last impact, and its least mass [kg]
        self._inverse_mass, self._lightest = NOT_KNOWN, NOT_KNOWN.lightest
        # the step being tried
        self.memory = self.kept  # with which its force is computed
        self.reached = self.memory  # at its end
        self.force: ContactForce = contact.force(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, None)
        self.onset: Onset | None = None
        self.wants_cut = False
        self.landing = math.inf  # where steps are to end, seen in one that was then cut [s]
        self._step = 0.0  # its length [s]
        self._motion = Relative(0.0, 0.0, 0.0, 0.0)  # at its end
        # at the end of the last accepted step
        self._swing_step = math.inf  # see `longest_step`
        # over the run
        self.onsets: list[Onset] = []

    def _make_frames(self, moving: Moving, bore_spin: Callable[[], float]) -> PinFrames:
        frames = SlotFrames if self.contact.bearing.is_slot else PinFrames
        return frames(self.connector, moving, bore_spin)

    def _make_force(self, backend: str, bore_spin: Callable[[], float], straight: bool) -> EngineForce:
        connector = self.connector
        if backend == "symbolic":
            return SymbolicForce(connector.mbs, self.contact, connector.at, straight)
        return PythonForce(self.contact, connector.at, bore_spin, straight)

    @property
    def calls(self) -> int:
        """Evaluations of the force in Python."""
        return self._friction.calls

    @property
    def longest_step(self) -> float:
        """The longest step [s] for the impact going on, or for what friction holds at the end of the last."""
        return min(self.impact_steps.step, self._swing_step) if self._has_state else self.impact_steps.step

    # --- called by the solver ---

    def start(self, memory: PinMemory, inverse_mass: InverseMass, turn: float) -> None:
        """Begin the run.

        Arguments:
            memory: of the pin.
            inverse_mass: of its journal.
            turn: of the journal against the bore since the start posture [rad].
        """
        self.kept, self._is_told = memory, False
        self._weigh(inverse_mass)
        self.frames.start(turn)

    @contextmanager
    def settling(self, load: float, share: Callable[[], float]) -> Iterator[None]:
        """Replace the contact by its elastic part and a spring that pulls a free journal to the middle.

        load: that is to be held [N].
        share: of the clearance by which the load may press the contact, and of the load that the spring holds
            at the wall; asked at every evaluation.
        """
        self.connector.settle(load, share)
        try:
            yield
        finally:
            self.connector.set_force(self.engine_force.function)

    def plainly(self, impact_velocity: float) -> None:
        """Let the force act whenever there is depth, as for an impact with this speed [m/s].

        For recipes that do without `begin_try`, `after_newton` and `accept`.
        """
        self._recall(self.kept._replace(in_contact=True, impact_velocity=impact_velocity))

    def jumped(self, memory: PinMemory) -> None:
        """Velocities have jumped after the last step; the memory since then."""
        self.kept = self.reached = memory
        self._is_told = False
        self.frames.jumped()

    def begin_try(self, step: float) -> None:
        """Begin to try a step of this length [s]: go back to the last accepted one, line up the frames."""
        self.onset = None
        self.wants_cut = False
        self._step = step
        if self.is_straight:
            self._friction.begin()
        if self._follows:
            self.frames.begin(step)
        if self._is_told and not self._changes:  # nearly always
            self.memory = self.kept
        else:
            self._recall(self.kept)

    def accept(self, t: float) -> None:
        """Keep what happened in a step that ends at t [s] and stands."""
        start, onset = self.kept, self.onset
        self._went_on_from = start if self.memory.in_contact and onset is None else None
        self._course = None
        self.kept = reached = self.reached
        self._is_told = self._goes_on
        if not reached.in_contact:
            self._separated(start, t)
        if self._follows:
            self.frames.accept()
        if self.locates:
            steps, depth, rate = self.impact_steps, reached.depth, reached.rate
            if onset is not None:
                steps.impact(depth, rate, self._find_least_mass())
            else:
                steps.follow(depth, rate, self._lightest, self._find_least_mass)
            if self._has_state:
                self._swing_step = steps.swing_step(self._swing_time())
        if onset is not None:
            self.onsets.append(onset)
            self.onset = None
        self._look_for_largest(t)

    def _separated(self, start: PinMemory, t: float) -> None:
        """The surfaces are apart at t [s], the end of a step from a memory."""
        if self.is_straight and self._friction.part():
            self._let_act()
        if start.in_contact and self.onsets:
            self.onsets[-1] = self.onsets[-1].separated(t, -self.kept.rate)

    def look(self, elastic: float, name: str) -> None:
        """Raise LawError if the force at the end of the last step, elastic to this part [N], cannot be one."""
        depth, rate, slip, normal, friction, *_ = self.force
        look(self.contact, depth, rate, slip, normal, friction, elastic, name)

    def probe(self, name: str) -> None:
        """Raise LawError if a law is no number where the last step began, or a little deeper and faster."""
        memory, contact = self.memory, self.contact
        for more in PROBED:
            depth, slip = more * max(memory.depth, SHALLOW), more * memory.slip
            if depth > contact.normal.largest_depth:  # of which the law has its own words
                return
            normal = contact.normal(depth, memory.rate, memory.impact_velocity)
            friction = contact.friction(slip, max(0.0, normal), memory.deflection)
            look(contact, depth, memory.rate, slip, normal, friction, pin=name)

    def _swing_time(self) -> float:
        """The time of the swing of what friction holds, with the least mass that moves along the surface [s].

        It is that of the journal's centre. Its turning adds little: pins are thin beside what they join.
        """
        friction, force = self.contact.friction, self.force.normal_force
        if not friction.has_state or force == 0.0:
            return math.inf
        x, y = self._place()
        return friction.swing_time(self._inverse_mass.mass(-y, x), force / self.share)

    def begin_impact(self) -> None:
        """Let the depth of a closed pin swing from now on: at the start, or after a jump of speed."""
        if self.locates and self.kept.depth > 0.0:
            self.impact_steps.begin(self.kept.depth, self.kept.rate, self._find_least_mass())

    def _find_least_mass(self) -> float:
        """Mass [kg] that moves at least as the depth does, where the journal is now."""
        return self._inverse_mass.mass(*self._place())

    def _place(self) -> Vector2:
        """Where the journal is now in its bore, in the bore's axes [m]."""
        return self.frames.place()

    def after_newton(self, t: float) -> float | None:
        """Decide on a solved step that would end at t [s]: None if it may stand.

        Else with which length [s] it is to be repeated; infinite: with the same, for the force has changed.
        """
        start = self.memory
        self._goes_on = True
        self._motion = motion = self.frames.relative(self.engine_force)
        self.force = force = self._contact_force(motion)
        if self._is_symbolic and self.frames.spin_was_wrong(motion):
            self._recall(start)
            return math.inf
        if (
            self.is_straight
            and start.in_contact
            and (again := self._friction.after_newton(force, self._step, self._lightest)) is not None
        ):
            self._impact, self._is_told = (), False  # another line is laid
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
        """The scatter of friction in a step [N], see `FrictionLine.rounding`."""
        return self._friction.rounding(self.force.normal_force, size, step)

    def _let_act(self) -> None:
        """Another force acts from now on, which has been told nothing yet."""
        self.engine_force = self._friction.acting
        self.is_straight = self._friction.is_straight
        self.connector.set_force(self.engine_force.function)
        self._impact, self._is_told = (), False

    def _decided(self, start: PinMemory, verdict: Verdict) -> float | None:
        """The answer to the engine that follows from a verdict."""
        self._goes_on = False
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
        return None

    def _verdict(self, start: PinMemory, end_time: float) -> Verdict:
        """Whether the step that has been tried may stand."""
        step = (start, self.force.depth, self.force.rate, end_time, self._step)
        if self.locates:
            return judge(*step, self._impact_step)
        return judge_at_ends(*step)

    def _impact_step(self, speed: float) -> float:
        """Length of the steps [s] in an impact of this speed [m/s] that begins where the journal is."""
        return self.impact_steps.length(speed, self.find_inverse_mass().mass(*self._place()))

    def _completed(self, verdict: Verdict) -> PinMemory:
        """The verdict's memory with what the laws need besides."""
        memory = verdict.memory
        if verdict.onset is not None:
            self._weigh(self.find_inverse_mass())
        if verdict.action is Action.REPEAT:
            return memory._replace(deflection=0.0)
        sticks = memory.in_contact and verdict.onset is None
        return memory.slid(self.force.slip, self.force.deflection if sticks else 0.0)

    def _weigh(self, inverse_mass: InverseMass) -> None:
        """Let steps go by an inverse effective mass from now on."""
        self._inverse_mass, self._lightest = inverse_mass, inverse_mass.lightest

    def _recall(self, memory: PinMemory) -> None:
        self.memory = memory
        self._is_told = memory is self.kept
        impact = memory[:2]
        if impact != self._impact or self._changes:
            self._impact = impact
            self._friction.lay()
            self.engine_force.load(memory, self._step, self.frames.guessed_spin, self.frames.guessed_turn)

    def _contact_force(self, motion: Relative) -> ContactForce:
        x, y, vx, vy, turning, bore_spin = motion
        in_contact, speed, _, _, slip, deflection = self.memory
        spin, at = turning, self.connector.at
        if at is Attachment.MIDDLE or at is Attachment.BORE:
            bore_spin, spin = motion.spins(at)
        else:
            bore_spin = 0.0
        return self._force(x, y, vx, vy, bore_spin, spin, in_contact, speed, deflection, slip, self._step)
