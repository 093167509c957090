"""One section of a bearing with clearance over a run: a clearance pin like those of the plane."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import cast

from support_exudyn.formulations.impact_steps import ImpactSteps
from support_exudyn.formulations.peak_force import NEAR_PEAK, has_a_top, peak
from support_exudyn.formulations.redundant.clearance.clearance_pin import ClearanceJoint, FindMass
from support_exudyn.formulations.redundant.clearance.connector import PinConnector
from support_exudyn.formulations.redundant.clearance.pin_frames import PinFrames
from support_exudyn.formulations.redundant.clearance.pin_motion import Moving
from support_exudyn.formulations.redundant.clearance.steep_friction import EngineForce
from support_exudyn.formulations.redundant.space.bearing_connector import (
    SectionConnector,
    SectionForce,
    SectionFrames,
)
from support_exudyn.formulations.redundant.space.section_motion import SectionMover
from support_exudyn.formulations.redundant.space.sections import Section
from support_exudyn.mechanics.contact_state import InverseMass, Onset, PinMemory
from support_exudyn.mechanics.space.constraints import BearingEnd
from support_exudyn.scenario.solver_settings import SolverSettings
from user_forces.contact import JournalContact
from user_forces.normal.part import PartOf
from user_forces.values.value import Vector2


class SectionJournal:
    """What the sections of one clearance bearing share: where its middle is and how it answers impulses.

    Both are asked for by every section in every step of an impact, and found once.

    Arguments:
        moving: how its middle moves.
        find_inverse_mass: tells how its middle answers impulses, in the axes of its bore.
    """

    def __init__(self, moving: SectionMover, find_inverse_mass: FindMass) -> None:
        self.moving = moving
        self._find_inverse_mass = find_inverse_mass
        self._inverse_mass: InverseMass | None = None
        self._place: Vector2 | None = None
        self.sections: list[SectionPin] = []
        self.onsets: list[Onset] = []  # of the journal, which was all apart
        self.largest_force = 0.0  # [N], at any time
        self.largest_force_time = 0.0  # end of the step that has it [s]
        self._bound = 0.0  # of the force at the end of the last step [N]
        self._places: list[Vector2] = []  # of the sections in the bore at its end, bore's axes [m]

    def moved(self, place: Vector2 | None = None) -> None:
        """The bodies are elsewhere now; place: of the middle, if it is known [m]."""
        self._inverse_mass, self._place = None, place

    def inverse_mass(self) -> InverseMass:
        """How the middle of the journal answers impulses, in the axes of its bore."""
        if self._inverse_mass is None:
            self._inverse_mass = self._find_inverse_mass()
        return self._inverse_mass

    def place(self) -> Vector2:
        """The place of the journal's middle in its bore, in the bore's axes [m]."""
        if self._place is None:
            _, (x, y, *_) = self.moving.now()
            self._place = x, y
        return self._place

    def accepted(self, t: float) -> None:
        """All sections have kept a step to t [s]."""
        impacts = [pin.struck for pin in self.sections if pin.struck is not None]
        # a journal makes contact when all that was in contact before has separated
        if impacts and all(pin.struck is not None for pin in self.sections if pin.was_in_contact):
            self.onsets.append(min(impacts))
        self._look_for_separation(t)
        before, bound = self._bound, 0.0
        for pin in self.sections:
            force = pin.force
            bound += force.normal_force + abs(force.friction_force)
        self._bound = bound
        near = max(before, self._bound) > NEAR_PEAK * self.largest_force
        has = near and has_a_top(self._bound_within, before, self._bound)
        if has or self._bound > self.largest_force:
            self._places = [pin.moving.now()[1][:2] for pin in self.sections]
            was_largest = self.largest_force
            self.largest_force = max(self.largest_force, self._resultant(1.0))
            if has:
                self.largest_force = peak(self._resultant, self.largest_force)
            if self.largest_force > was_largest:
                self.largest_force_time = t

    def _look_for_separation(self, t: float) -> None:
        """If in the step to t [s] the last sections have separated: note when, and their highest speed."""
        if not self.onsets:
            return
        for pin in self.sections:
            if pin.kept.in_contact:
                return
        separated = [-pin.kept.rate for pin in self.sections if pin.was_in_contact]
        if separated:
            self.onsets[-1] = self.onsets[-1].separated(t, max(separated))

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


class SectionPin(ClearanceJoint):
    """One section of a clearance bearing.

    Arguments:
        contact: of the whole pin.
        connector, moving, settings: as of ClearanceJoint.
        whole: what it shares with the other sections.
        section: its place and share.
        ends: bore and journal.
        slides: whether the journal may shift along the bore. The markers then move along before every step,
            so that sections of both meet that are abreast of each other.
    """

    def __init__(
        self,
        contact: JournalContact,
        connector: PinConnector,
        moving: SectionMover,
        whole: SectionJournal,
        section: Section,
        ends: tuple[BearingEnd, BearingEnd],
        *,
        slides: bool,
        settings: SolverSettings,
    ) -> None:
        part = part_of(contact, section)
        super().__init__(
            part,
            connector,
            moving,
            lambda: moving.now()[0][5],
            whole.inverse_mass,
            settings,
            section.share,
        )
        self.impact_steps = ImpactSteps(contact.normal, settings.impact_steps)  # steps of the whole
        self.section, self.whole, self.moving, self.ends, self.slides = section, whole, moving, ends, slides
        whole.sections.append(self)
        self._is_first = whole.sections[0] is self
        # whether it was in contact before the last accepted step, and its impact in that
        self.was_in_contact, self.struck = False, cast(Onset | None, None)
        self._beside = 0.0, 0.0  # where the journal is along the bore at the last accepted step [m], [m/s]

    def _make_frames(self, moving: Moving, bore_spin: Callable[[], float]) -> PinFrames:
        if isinstance(self.connector, SectionConnector):
            return SectionFrames(self.connector, moving, bore_spin)
        return super()._make_frames(moving, bore_spin)

    def _make_force(self, backend: str, bore_spin: Callable[[], float], straight: bool) -> EngineForce:
        if isinstance(self.connector, SectionConnector):
            return SectionForce(self.connector, straight)
        return super()._make_force(backend, bore_spin, straight)

    def look_beside(self, position: list[float], velocity: list[float]) -> None:
        """See where the journal is along the bore at the engine's coordinates and their rates."""
        if self.slides:
            self._beside = self.moving.beside(position, velocity)
            self._meet(self._beside[0])

    def _meet(self, apart: float) -> None:
        self.moving.meet(apart)
        self.connector.slide(*self.moving.shifts)

    def begin_try(self, step: float) -> None:
        """See `ClearanceJoint`."""
        if self.slides:
            self._meet(self._beside[0] + step * self._beside[1])
        super().begin_try(step)

    def after_newton(self, t: float) -> float | None:
        """See `ClearanceJoint`."""
        if self._is_first:
            connector = self.connector
            self.whole.moved(connector.whole.middle if isinstance(connector, SectionConnector) else None)
        return super().after_newton(t)

    def jumped(self, memory: PinMemory) -> None:
        """See `ClearanceJoint`."""
        if self._is_first:
            self.whole.moved()
        super().jumped(memory)
        self.look_beside(*self.moving.coordinates())

    def accept(self, t: float) -> None:
        """See `ClearanceJoint`."""
        self.was_in_contact, self.struck = self.kept.in_contact, self.onset
        super().accept(t)
        if self.slides:
            self._beside = self.moving.beside(*self.moving.coordinates())
        if self.whole.sections[-1] is self:
            self.whole.accepted(t)

    def _look_for_largest(self, t: float) -> None:
        # of those in the middle nobody asks for it, see `run`
        if self._is_first or self.whole.sections[-1] is self:
            super()._look_for_largest(t)
        elif self.force.clamped:
            self.clamped_steps += 1

    def _place(self) -> Vector2:
        return self.whole.place()


def part_of(contact: JournalContact, section: Section) -> JournalContact:
    """The contact of a section, which has its share of the force."""
    return replace(contact, normal=PartOf(law=contact.normal, share=section.share))
