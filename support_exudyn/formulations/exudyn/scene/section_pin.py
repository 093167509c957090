"""One section of a bearing with clearance over a run: a clearance joint like those of the plane."""

from __future__ import annotations

import math

from user_forces.connector.contact_connector import ContactConnector, FindMass
from user_forces.connector.item import INITIAL, Attachment, JointItem
from user_forces.contact import Contact
from user_forces.contact_state import InverseMass, Onset, PinMemory
from user_forces.impact_steps import ImpactSteps
from user_forces.roots import NEAR_PEAK, has_a_top, peak
from user_forces.values.value import Vector2


class SectionJournal:
    """What the sections of one clearance bearing share: where its middle is and how it answers impulses.

    Both are needed by every section in every step of an impact, and computed once.

    Arguments:
        find_inverse_mass: computes how its middle answers impulses, in the axes of its bore.
        slides: the journal may shift along the bore.
    """

    def __init__(self, find_inverse_mass: FindMass, *, slides: bool) -> None:
        self._find_inverse_mass, self.slides = find_inverse_mass, slides
        self._inverse_mass: InverseMass | None = None
        self.sections: list[SectionPin] = []
        self.onsets: list[Onset] = []  # of the journal, all sections of which were separated
        self.largest_force = 0.0  # [N], at any time
        self.largest_force_time = 0.0  # end of the step that has it [s]
        self._bound = 0.0  # of the force at the end of the last step [N]
        self._places: list[Vector2] = []  # of the sections in the bore at its end, bore's axes [m]

    def moved(self) -> None:
        """The bodies are elsewhere now."""
        self._inverse_mass = None

    def inverse_mass(self) -> InverseMass:
        """How the middle of the journal answers impulses, in the axes of its bore."""
        if self._inverse_mass is None:
            self._inverse_mass = self._find_inverse_mass()
        return self._inverse_mass

    @property
    def place(self) -> Vector2:
        """The place of the journal's middle in its bore [m]: midway between the outermost sections."""
        (x, y), (other_x, other_y) = self.sections[0].place, self.sections[-1].place
        return 0.5 * (x + other_x), 0.5 * (y + other_y)

    def accepted(self, t: float) -> None:
        """All sections have kept a step to t [s]."""
        impacts = [pin.struck for pin in self.sections if pin.struck is not None]
        # a journal makes contact when all that was in contact before has separated
        if impacts and all(pin.struck is not None for pin in self.sections if pin.was_in_contact):
            self.onsets.append(min(impacts))
        separated = [-pin.kept.rate for pin in self.sections if pin.was_in_contact]
        if self.onsets and separated and not any(pin.kept.in_contact for pin in self.sections):
            self.onsets[-1] = self.onsets[-1].separated(t, max(separated))  # the last sections have separated
        before, bound = self._bound, 0.0
        for pin in self.sections:
            force = pin.force
            bound += force.normal_force + abs(force.friction_force)
        self._bound = bound
        near = max(before, self._bound) > NEAR_PEAK * self.largest_force
        has = near and has_a_top(self._bound_within, before, self._bound)
        if has or self._bound > self.largest_force:
            self._places = [pin.place for pin in self.sections]
            was_largest = self.largest_force
            self.largest_force = max(self.largest_force, self._resultant(1.0))
            if has:
                self.largest_force = peak(self._resultant, self.largest_force)
            if self.largest_force > was_largest:
                self.largest_force_time = t

    def _bound_within(self, fraction: float) -> float:
        """What the force is at most [N] at a fraction of the step just accepted."""
        forces = [pin.force_within(fraction) for pin in self.sections]
        return sum(force.normal_force + abs(force.friction_force) for force in forces)

    def _resultant(self, fraction: float) -> float:
        """Magnitude of the force of all sections together [N] at a fraction of the step just accepted."""
        total_x = total_y = 0.0
        for pin, (x, y) in zip(self.sections, self._places, strict=True):
            away = math.hypot(x, y) or 1.0
            force = pin.force_within(fraction)
            normal, friction = force.normal_force, force.friction_force
            total_x += (-normal * x - friction * y) / away
            total_y += (-normal * y + friction * x) / away
        return math.hypot(total_x, total_y)


class SectionPin(ContactConnector):
    """One section of a clearance bearing.

    Where the journal may shift along the bore, the markers move along before every step, so that sections of
    bore and journal act on each other that are abreast.

    Arguments:
        contact: of the whole pin, by which steps are chosen.
        item: markers and connector.
        whole: what it shares with the other sections.
        share: of the contact.
        impact_steps: number of steps in an undamped impact.
    """

    def __init__(
        self, contact: Contact, item: JointItem, whole: SectionJournal, share: float, impact_steps: int
    ) -> None:
        super().__init__(item, whole.inverse_mass, impact_steps, share=share)
        self.impact_steps = ImpactSteps(contact.normal, impact_steps)
        self.whole, self.slides = whole, whole.slides
        whole.sections.append(self)
        self._is_first = whole.sections[0] is self
        # whether it was in contact before the last accepted step, and its impact in that
        self.was_in_contact = False
        self.struck: Onset | None = None
        self._shift = self._shift_rate = 0.0  # of the journal along the bore at the last step's end [m], [m/s]
        self._shifted = 0.0  # by which the markers have been moved [m]

    def start(self, inverse_mass: InverseMass, state: object = INITIAL) -> None:
        """See `ContactConnector`."""
        if self.slides:
            self._move_markers(0.0)
            motion = self.item.relative(state)
            self._shift, self._shift_rate = motion.displacement[2], motion.velocity[2]
            self._move_markers(self._shift)
        super().start(inverse_mass, state)

    def _move_markers(self, shift: float) -> None:
        """Let the sections act on each other that are so far from each other along the axis [m].

        Those of the bore move, or half and half where the force acts in the middle: in either case what the
        force follows, the displacement across its axis, is not changed by it.
        """
        if shift != self._shifted:
            self._shifted = shift
            both = (0.5 * shift, -0.5 * shift) if self.item.at is Attachment.MIDDLE else (shift, 0.0)
            self.item.slide(*both)

    def begin_try(self, step: float) -> None:
        """See `ContactConnector`."""
        if self.slides:
            self._move_markers(self._shift + step * self._shift_rate)
        super().begin_try(step)

    def after_newton(self, t: float) -> float | None:
        """See `ContactConnector`."""
        if self._is_first:
            self.whole.moved()
        return super().after_newton(t)

    def jumped(self, memory: PinMemory) -> None:
        """See `ContactConnector`."""
        if self._is_first:
            self.whole.moved()
        super().jumped(memory)
        if self.slides:
            self._shift_rate = self.item.relative().velocity[2]

    def accept(self, t: float) -> None:
        """See `ContactConnector`."""
        self.was_in_contact, self.struck = self.kept.in_contact, self.onset
        super().accept(t)
        if self.slides:
            motion = self.item.relative() if self.item.on_line else None
            along = self.item.along if motion is None else (motion.displacement[2], motion.velocity[2])
            self._shift, self._shift_rate = self._shifted + along[0], along[1]
        if self.whole.sections[-1] is self:
            self.whole.accepted(t)

    def _look_for_largest(self, t: float) -> None:
        # those in the middle are not reported, see `run`
        if self._is_first or self.whole.sections[-1] is self:
            super()._look_for_largest(t)
        elif self.force.clamped:
            self.clamped_steps += 1

    def mass_place(self) -> Vector2:
        """See `ContactConnector`."""
        return self.whole.place
