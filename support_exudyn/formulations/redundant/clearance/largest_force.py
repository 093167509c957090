"""The largest force of a clearance pin over a run, which may be reached between the ends of two steps."""

import math

from support_exudyn.formulations.contact_events import DepthPath
from support_exudyn.formulations.peak_force import NEAR_PEAK, has_a_top, peak
from support_exudyn.formulations.redundant.clearance.connector import PinConnector
from support_exudyn.formulations.redundant.clearance.connector_force import Relative
from support_exudyn.formulations.redundant.clearance.pin_motion import Course
from support_exudyn.mechanics.contact_state import PinMemory
from user_forces.compilation.flat import FlatForce
from user_forces.contact import Contact, ContactForce


class LargestForce:
    """What a clearance pin keeps of its force from step to step.

    contact, connector: of the pin. memory: with which the force of the step is computed. force: at its end.
    """

    contact: Contact
    connector: PinConnector
    memory: PinMemory
    force: ContactForce
    _motion: Relative
    _step: float
    _force: FlatForce

    def __init__(self) -> None:
        self._size = 0.0  # of the force [N]
        # of a step just accepted over which the contact went on: its memory at the start, its course if asked
        self._went_on_from: PinMemory | None = None
        self._course: Course | None = None
        # over the run
        self.clamped_steps = 0
        self.largest_force = 0.0
        self.largest_force_time = 0.0  # end of the step that has it [s]

    def _look_for_largest(self, t: float) -> None:
        """See whether the force was the largest so far at the end of the step to t [s], or within it."""
        force, before, was_largest = self.force, self._size, self.largest_force
        if force.clamped:
            self.clamped_steps += 1
        self._size = size = math.hypot(force.normal_force, force.friction_force)
        near = self._went_on_from is not None and max(before, size) > NEAR_PEAK * max(was_largest, size)
        if size > was_largest:
            self.largest_force = size
        if near and has_a_top(self._size_within, before, size):
            self.largest_force = peak(self._size_within, self.largest_force)
        if self.largest_force > was_largest:
            self.largest_force_time = t

    def _find_course(self, start: PinMemory) -> Course:
        """The course of the step just accepted, over which the contact went on from a memory."""
        end = self.force
        path = DepthPath(start.depth, start.rate, end.depth, end.rate, self._step)
        return Course(path, start.slip, self._motion, end.slip, self.contact.bearing.clearance)

    def force_within(self, x: float) -> ContactForce:
        """The force at a fraction of the step just accepted; at its end, if the contact did not go on in it."""
        if self._went_on_from is None:
            return self.force
        if self._course is None:
            self._course = self._find_course(self._went_on_from)
        motion, memory = self._course.at(x), self.memory
        impact = memory.in_contact, memory.impact_velocity, memory.deflection, memory.slip
        return self._force(*motion[:4], *motion.spins(self.connector.at), *impact, x * self._step)

    def _size_within(self, x: float) -> float:
        force = self.force_within(x)
        return math.hypot(force[3], force[4])
