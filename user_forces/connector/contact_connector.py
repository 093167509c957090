"""A contact in the engine over a run: its memory, its impacts, its largest force, and how long steps may be.

A solver calls `begin_try` before it tries a step, `after_newton` when the step is solved, and `accept` when it
stands. The stock solver does without them, see `ClearanceJoint`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from user_forces.connector.friction_line import FrictionLine, can_be_line, with_line
from user_forces.connector.item import INITIAL, JointItem, connector_kernel
from user_forces.contact import ContactForce
from user_forces.contact_events import Action, goes_on, judge, judge_at_ends
from user_forces.contact_state import InverseMass, Onset, PinMemory
from user_forces.impact_steps import ImpactSteps
from user_forces.lawful import PROBED, look
from user_forces.roots import NEAR_PEAK, STILL, DepthPath, depth_at, has_a_top, peak, rate_at

SHALLOW = 1e-9  # depth [m] at which a law is probed that has only just been in contact
FIRST, LAST = 4, 14  # where `ContactForce` stands in what the kernel gives; the place x, y follows
FindMass = Callable[[], InverseMass]  # how a journal answers impulses now, in the axes of its bore
NOT_KNOWN = InverseMass(math.nan, math.nan, math.nan)


class ContactConnector:
    """A contact of two bodies in the engine.

    Arguments:
        item: markers and connector.
        find_inverse_mass: computes how the journal answers impulses, by which steps are chosen.
        impact_steps: number of steps in an undamped impact.
        locates: whether steps end at impacts and separations.
        share: of the contact that the inverse effective mass is of.

    `onsets` are the impacts so far, `largest_force` [N] the largest contact force, also between the ends of
    steps, and `largest_force_time` [s] the end of the step that has it.
    """

    def __init__(
        self,
        item: JointItem,
        find_inverse_mass: FindMass,
        impact_steps: int,
        locates: bool = True,
        share: float = 1.0,
    ) -> None:
        self.item, self.contact, self.find_inverse_mass = item, item.contact, find_inverse_mass
        self.locates, self.share = locates, share
        self.impact_steps = ImpactSteps(self.contact.normal, impact_steps)
        self.elastic_force = self.contact.normal.elastic_force
        self._force = self.contact.force_kernel
        self._has_state = self.contact.friction.has_state
        self._line: FrictionLine | None = None  # that stands for steep friction
        # at the last accepted step
        self.kept = PinMemory(False, 0.0, 0.0, 0.0)
        self._turn = self._turn_rate = 0.0  # between the marker frames [rad], [rad/s]
        self._swing_step = math.inf  # see `longest_step`
        self._inverse_mass, self._lightest = NOT_KNOWN, math.nan  # at the last impact; least mass [kg]
        # the step being tried
        self.memory = self.kept  # with which its force is computed
        self.reached = self.memory  # at its end
        self.force = self.contact.force(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, None)
        self._place: tuple[float, float] | None = 0.0, 0.0  # see `place`
        self.onset: Onset | None = None
        self.wants_cut = False
        self.landing = math.inf  # where steps are to end, seen in a step that was then cut [s]
        self._step = 0.0  # its length [s]
        # over the run
        self.onsets: list[Onset] = []
        self.clamped_steps = 0
        self.largest_force = self.largest_force_time = 0.0
        self._size = 0.0  # of the force at the end of the last step [N]
        self._went_on_from: PinMemory | None = None  # of a step just accepted in which the contact lasted

    @property
    def longest_step(self) -> float:
        """The longest step [s] in the present impact, or for what friction holds at the end of the last."""
        return min(self.impact_steps.step, self._swing_step) if self._has_state else self.impact_steps.step

    @property
    def place(self) -> tuple[float, float]:
        """Where the journal is in its bore at the end of the step being tried, in the bore's axes [m]."""
        if self._place is None:
            x, y, _ = self.item.relative().displacement
            self._place = x, y
        return self._place

    def mass_place(self) -> tuple[float, float]:
        """The place [m] in the bore whose direction effective masses are of."""
        return self.place

    def observe(self, state: Any) -> ContactForce:
        """Kinematics of the contact in a state of the engine, as if the surfaces were separated."""
        motion, contact = self.item.relative(state), self.contact
        in_axes = connector_kernel(contact.force_kernel, self.item.at, contact.bearing.is_slot)
        spins = motion.turn, motion.turning, motion.bore_spin
        memory = False, 0.0, 0.0, 0.0, 0.0
        result = in_axes(*motion.displacement, *motion.velocity, *spins, *memory, contact.constants)
        self._place = result[LAST], result[LAST + 1]
        self._turn, self._turn_rate = motion.turn, motion.turning
        return ContactForce(*result[FIRST:LAST])

    # --- called by the solver ---

    def start(self, inverse_mass: InverseMass, state: Any = INITIAL) -> None:
        """Begin the run in a state of the engine: a journal that is pressed makes contact just now.

        inverse_mass: of the journal in that state.

        Surfaces that touch within rounding are separated if they approach, so that their impact is located, and
        closed otherwise: a journal that is put on its bore at rest has no impact.
        """
        depth, rate, slip, *_ = self.observe(state)
        closed = depth > (STILL if rate > 0.0 else -STILL)
        speed = max(0.0, rate) if closed else 0.0
        self.kept = self.reached = PinMemory(closed, speed, depth, rate, slip)
        self._swing_step, self._size, self._went_on_from = math.inf, 0.0, None
        self._inverse_mass, self._lightest = inverse_mass, inverse_mass.lightest

    def jumped(self, memory: PinMemory) -> None:
        """Velocities have jumped after the last step; the memory since then."""
        self.kept = self.reached = memory

    def begin_try(self, step: float) -> None:
        """Begin to try a step of this length [s] from the last accepted state: line up the marker frames."""
        self.onset, self.wants_cut, self._step = None, False, step
        if self._line is not None:
            self._line.begin()
        expected = self._turn + self._turn_rate * step
        if self.item.line_up(expected):
            self._turn -= expected
        self._recall(self.kept)

    def _recall(self, memory: PinMemory) -> None:
        """Let the force of the step being tried follow from a memory, and from the line if there is any."""
        self.memory, item = memory, self.item
        item.closed, item.speed = memory.in_contact, memory.impact_velocity
        if self._has_state:
            item.deflection, item.slip, item.step = memory.deflection, memory.slip, self._step
        if self._line is not None:
            item.constants[-2:] = self._line.offset, self._line.slope

    def after_newton(self, t: float) -> float | None:
        """Decide on a solved step that would end at t [s]: None if it may stand.

        Else with which length [s] it is to be repeated; infinite: with the same, for the force has changed.
        """
        # the residual that satisfied Newton's method was evaluated at this same state
        result, start, line = self.item.last, self.memory, self._line
        self.force = force = tuple.__new__(ContactForce, result[FIRST:LAST])
        self._place = None if self.item.on_line else (result[LAST], result[LAST + 1])
        depth, rate, slip, normal, friction, *_, deflection = force
        if not -math.inf < normal + friction < math.inf:
            look(self.contact, depth, rate, slip, normal, friction)
        if line is not None and start.in_contact:
            softness = normal * self._step / self._lightest
            if not line.meets(slip, normal, softness):
                self._recall(start)
                return 0.5 * self._step if line.exhausted else math.inf
        if goes_on(start, depth, rate, self._step):
            self.reached = start.at(depth, rate, slip, deflection)
            return None
        step = start, depth, rate, t, self._step
        action, memory, onset, shorter, landing = (
            judge(*step, self._impact_step) if self.locates else judge_at_ends(*step)
        )
        if action is Action.CUT:
            self.wants_cut, self.landing = True, landing
            return shorter
        if onset is not None:
            self.onset = onset
            self._inverse_mass = self.find_inverse_mass()
            self._lightest = self._inverse_mass.lightest
        if action is Action.REPEAT:
            self._recall(memory._replace(deflection=0.0))
            return math.inf
        self.reached = memory.slid(slip, deflection if memory.in_contact and onset is None else 0.0)
        return None

    def _impact_step(self, speed: float) -> float:
        """Length of the steps [s] in an impact of this speed [m/s] that begins where the journal is."""
        return self.impact_steps.length(speed, self.find_inverse_mass().mass(*self.mass_place()))

    def accept(self, t: float) -> None:
        """Keep what happened in a step that ends at t [s] and stands."""
        start, onset = self.kept, self.onset
        self._went_on_from = start if self.memory.in_contact and onset is None else None
        self.kept = reached = self.reached
        self._turn, self._turn_rate = self.item.turn
        if not reached.in_contact:
            if self._line is not None:
                self._line = None
                self.item.use()
            if start.in_contact and self.onsets:
                self.onsets[-1] = self.onsets[-1].separated(t, -reached.rate)
        if self.locates:
            steps, depth, rate = self.impact_steps, reached.depth, reached.rate
            if onset is not None:
                steps.impact(depth, rate, self._mass())
            else:
                steps.follow(depth, rate, self._lightest, self._mass)
            if self._has_state:
                self._swing_step = steps.swing_step(self._swing_time())
        if onset is not None:
            self.onsets.append(onset)
            self.onset = None
        self._look_for_largest(t)

    def _mass(self) -> float:
        """Mass [kg] that moves at least as the depth does, where the journal is now."""
        return self._inverse_mass.mass(*self.mass_place())

    def _swing_time(self) -> float:
        """The time of the swing of what friction holds, with the least mass that moves along the surface [s].

        It is that of the journal's centre. Its turning adds little: pins are thin against what they join.
        """
        force = self.force.normal_force
        if force == 0.0:
            return math.inf
        x, y = self.mass_place()
        return self.contact.friction.swing_time(self._inverse_mass.mass(-y, x), force / self.share)

    def begin_impact(self) -> None:
        """Let the depth of a closed joint oscillate from now on: at the start, or after a jump of speed."""
        if self.locates and self.kept.depth > 0.0:
            self.impact_steps.begin(self.kept.depth, self.kept.rate, self._mass())

    # --- where a run could not go on ---

    def straighten(self) -> bool:
        """Newton's method has failed: let a straight line stand for friction; whether that is new."""
        if self._line is not None or not self.kept.in_contact or not can_be_line(self.contact.friction):
            return False
        self._line = FrictionLine(self.contact.friction)
        self._line.lay(self.kept.slip, self.force.normal_force)
        kernel, constants = with_line(self.contact)
        in_axes = connector_kernel(kernel, self.item.at, self.contact.bearing.is_slot)
        self.item.use(in_axes, np.array(constants))
        return True

    def rounding(self, step: float, size: float) -> float:
        """The scatter of friction in a step [N], see `FrictionLine.rounding`."""
        return 0.0 if self._line is None else self._line.rounding(self.force.normal_force, size, step)

    def check(self, elastic: float, name: str) -> None:
        """Raise LawError if the force at the end of the last step, elastic to this part [N], cannot exist."""
        depth, rate, slip, normal, friction, *_ = self.force
        look(self.contact, depth, rate, slip, normal, friction, elastic, name)

    def probe(self, name: str) -> None:
        """Raise LawError if a law is no number where the last step began, or a little deeper and faster."""
        memory, contact = self.memory, self.contact
        for more in PROBED:
            depth, slip = more * max(memory.depth, SHALLOW), more * memory.slip
            if depth > contact.normal.largest_depth:  # of which the law has its own message
                return
            normal = contact.normal(depth, memory.rate, memory.impact_velocity)
            friction = contact.friction(slip, max(0.0, normal), memory.deflection)
            look(contact, depth, memory.rate, slip, normal, friction, pin=name)

    # --- the largest force ---

    def _look_for_largest(self, t: float) -> None:
        """Update the largest force by the step to t [s], at its end and within it."""
        force, before, was_largest = self.force, self._size, self.largest_force
        if force.clamped:
            self.clamped_steps += 1
        self._size = size = math.hypot(force.normal_force, force.friction_force)
        near = self._went_on_from is not None and max(before, size) > NEAR_PEAK * max(was_largest, size)
        self.largest_force = max(was_largest, size)
        if near and has_a_top(self._size_within, before, size):
            self.largest_force = peak(self._size_within, self.largest_force)
        if self.largest_force > was_largest:
            self.largest_force_time = t

    def force_within(self, x: float) -> ContactForce:
        """The force at a fraction of the step just accepted; at its end, if the contact did not last in it.

        The depth is the cubic through both ends, and the slip changes evenly.
        """
        start, end = self._went_on_from, self.force
        if start is None:
            return end
        path = DepthPath(start.depth, start.rate, end.depth, end.rate, self._step)
        slip = start.slip + x * (end.slip - start.slip)
        motion = self.contact.bearing.placed(depth_at(path, x), rate_at(path, x), slip)
        memory = self.memory.impact_velocity, self.memory.deflection, self.memory.slip, x * self._step
        return ContactForce(*self._force(*motion, True, *memory, self.contact.constants))

    def _size_within(self, x: float) -> float:
        force = self.force_within(x)
        return math.hypot(force.normal_force, force.friction_force)
