"""One section of a bearing with clearance over a run: a clearance pin like those of the plane."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from support_exudyn.formulations.impact_steps import ImpactSteps
from support_exudyn.formulations.peak_force import NEAR_PEAK, has_a_top, peak
from support_exudyn.formulations.redundant.clearance.clearance_pin import ClearanceJoint
from support_exudyn.formulations.redundant.clearance.connector import PinConnector
from support_exudyn.formulations.redundant.clearance.connector_force import Attachment
from support_exudyn.formulations.redundant.clearance.pin_motion import Motion, in_plane
from support_exudyn.formulations.redundant.space.sections import ON_LINE, Section
from support_exudyn.mechanics.contact_state import Onset, PinMemory
from support_exudyn.mechanics.pressed_pins import EffectiveMasses
from support_exudyn.mechanics.space.constraints import BearingEnd, frame_of
from support_exudyn.scenario.solver_settings import SolverSettings
from user_forces.contact import JournalContact
from user_forces.normal.part import PartOf
from user_forces.values.value import Vector2, Vector3

Vector = tuple[float, float, float]
Axes = tuple[Vector, Vector, Vector]


class BodyState(NamedTuple):
    """A body at an instant, from the engine's coordinates: rows of its rotation, centre, velocity, spin."""

    rows: tuple[Vector, Vector, Vector]
    centre: Vector
    velocity: Vector
    spin: Vector

    @staticmethod
    def of(centre: Vector3, q: list[float], v: list[float]) -> BodyState:
        """The state that follows from the start [m] of the centre, and the body's coordinates and rates (7)."""
        a, b, c, d = 1.0 + q[3], q[4], q[5], q[6]
        ta, tb, tc, td = v[3:7]
        rows = (
            (a * a + b * b - c * c - d * d, 2.0 * (b * c - a * d), 2.0 * (b * d + a * c)),
            (2.0 * (b * c + a * d), a * a - b * b + c * c - d * d, 2.0 * (c * d - a * b)),
            (2.0 * (b * d - a * c), 2.0 * (c * d + a * b), a * a - b * b - c * c + d * d),
        )
        spin = (
            2.0 * (-b * ta + a * tb - d * tc + c * td),
            2.0 * (-c * ta + d * tb + a * tc - b * td),
            2.0 * (-d * ta - c * tb + b * tc + a * td),
        )
        return BodyState(rows, (centre[0] + q[0], centre[1] + q[1], centre[2] + q[2]), (v[0], v[1], v[2]), spin)

    def turned(self, vector: Vector3) -> Vector:
        """A vector of the body's axes, in the ground's."""
        x, y, z = vector
        (a, b, c), (d, e, f), (g, h, i) = self.rows
        return a * x + b * y + c * z, d * x + e * y + f * z, g * x + h * y + i * z

    def point(self, arm: Vector3) -> tuple[Vector, Vector]:
        """Position and velocity of a point, its arm in the body's axes."""
        ax, ay, az = self.turned(arm)
        (x, y, z), (vx, vy, vz), (wx, wy, wz) = self.centre, self.velocity, self.spin
        return (x + ax, y + ay, z + az), (
            vx + wy * az - wz * ay,
            vy + wz * ax - wx * az,
            vz + wx * ay - wy * ax,
        )


GROUND_STATE = BodyState(
    ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)), (0.0,) * 3, (0.0,) * 3, (0.0,) * 3
)


class SectionEnd(NamedTuple):
    """Centre of a section on a body.

    first: the body's first coordinate in the vector of all; None: the ground. centre: of the body at the start
    [m]. arm: of the section from there [m]. across, along: axes of the bearing, in those of the body.
    """

    first: int | None
    centre: Vector3
    arm: Vector3
    across: tuple[Vector3, Vector3]
    along: Vector3

    def beside(self, shift: float) -> Vector:
        """The section's arm if it is so far beside its place along the axis [m]."""
        (x, y, z), (ax, ay, az) = self.arm, self.along
        return x + shift * ax, y + shift * ay, z + shift * az

    def state(self, position: list[float], velocity: list[float]) -> BodyState:
        """The state of its body."""
        if self.first is None:
            return GROUND_STATE
        which = slice(self.first, self.first + 7)
        return BodyState.of(self.centre, position[which], velocity[which])


@dataclass
class SectionMover:
    """The motion of a section's journal in its bore, in the axes in which its force is given.

    data: the engine's. at: what the force acts on; see `section_motion`. shifts: of the sections of bore and
    journal from their places along both [m].
    """

    data: Any
    bore: SectionEnd
    journal: SectionEnd
    at: Attachment
    shifts: tuple[float, float] = (0.0, 0.0)

    def now(self) -> tuple[Motion, Motion]:
        """The present motions of bore and journal, the bore's centre and axes being those of the plane."""
        return self.when(*self.coordinates())

    def coordinates(self) -> tuple[list[float], list[float]]:
        """The engine's, and their rates, as they are now."""
        return self.data.GetODE2Coordinates().tolist(), self.data.GetODE2Coordinates_t().tolist()

    def when(self, position: list[float], velocity: list[float]) -> tuple[Motion, Motion]:
        """The motions of bore and journal at these coordinates and rates."""
        bore, journal = self.bore.state(position, velocity), self.journal.state(position, velocity)
        apart, rates = self._apart(bore, journal)
        along = bore.turned(self.bore.along)
        axes = self._axes(bore, journal)
        local, moving = [dot(a, apart) for a in axes], [dot(a, rates) for a in axes]
        x, y, vx, vy = in_plane(local, moving) if self.at in ON_LINE else (*local[:2], *moving[:2])
        own = journal.turned(self.journal.across[0])
        turn = math.atan2(dot(own, axes[1]), dot(own, axes[0]))
        spin = dot(bore.spin, along)
        turning = dot(journal.spin, axes[2]) - dot(bore.spin, axes[2])
        return (0.0, 0.0, 0.0, 0.0, 0.0, spin), (x, y, vx, vy, turn, spin + turning)

    def _apart(self, bore: BodyState, journal: BodyState) -> tuple[Vector, Vector]:
        """The vector from the bore's section to the journal's, and its rate, ground's axes."""
        (bx, by, bz), (bvx, bvy, bvz) = bore.point(self.bore.beside(self.shifts[0]))
        (jx, jy, jz), (jvx, jvy, jvz) = journal.point(self.journal.beside(self.shifts[1]))
        return (jx - bx, jy - by, jz - bz), (jvx - bvx, jvy - bvy, jvz - bvz)

    def _axes(self, bore: BodyState, journal: BodyState) -> Axes:
        axes = bore.turned(self.bore.across[0]), bore.turned(self.bore.across[1]), bore.turned(self.bore.along)
        if self.at is Attachment.MIDDLE:
            return half_way(axes, journal.turned(self.journal.along))
        return axes

    def beside(self, position: list[float], velocity: list[float]) -> tuple[float, float]:
        """How far the sections are apart along the axis in their own places [m], and the rate."""
        bore, journal = self.bore.state(position, velocity), self.journal.state(position, velocity)
        apart, rates = self._apart(bore, journal)
        along = self._axes(bore, journal)[2]
        return self.shifts[0] - self.shifts[1] + dot(along, apart), dot(along, rates)

    def meet(self, apart: float) -> None:
        """Shift the sections so that they meet that are so far apart in their own places [m].

        Those of the bore, or half and half where the force acts in the middle: in either case what the force
        goes by, the displacement across its axis, is not changed by it.
        """
        self.shifts = (0.5 * apart, -0.5 * apart) if self.at is Attachment.MIDDLE else (apart, 0.0)


def dot(a: Vector, b: Vector) -> float:
    """Inner product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def half_way(axes: Axes, along: Vector) -> Axes:
    """Axes tilted half of the way that turns their third into another vector; see `sections.half_way`."""
    first, second, own = axes
    x, y, z = own[0] + along[0], own[1] + along[1], own[2] + along[2]
    size = math.sqrt(x * x + y * y + z * z)
    middle = x / size, y / size, z / size
    both = own[0] + middle[0], own[1] + middle[1], own[2] + middle[2]

    def turned(vector: Vector) -> Vector:
        share = dot(middle, vector) / (1.0 + dot(own, middle))
        return vector[0] - share * both[0], vector[1] - share * both[1], vector[2] - share * both[2]

    return turned(first), turned(second), middle


class SectionJournal:
    """What the sections of one clearance bearing share: where its middle is and how it answers impulses.

    Both are asked for by every section in every step of an impact, and found once.

    Arguments:
        moving: how its middle moves.
        find_mobilities: tells how its middle answers impulses now, in the axes of its bore.
    """

    def __init__(self, moving: SectionMover, find_inverse_masses: Callable[[], EffectiveMasses]) -> None:
        self.moving = moving
        self._find_mobilities = find_inverse_masses
        self._inverse_masses: EffectiveMasses | None = None
        self._place: Vector2 | None = None
        self.sections: list[SectionPin] = []
        self.onsets: list[Onset] = []  # of the journal, which was all apart
        self.largest_force = 0.0  # [N], at any time
        self.largest_force_time = 0.0  # end of the step that has it [s]
        self._bound = 0.0  # of the force at the end of the last step [N]
        self._places: list[Vector2] = []  # of the sections in the bore at its end, bore's axes [m]
        # of each section: whether it was in contact before the step, and its impact in it
        self._before: list[tuple[bool, Onset | None]] = []

    def moved(self) -> None:
        """The bodies are elsewhere now."""
        self._inverse_masses = self._place = None

    def inverse_masses(self) -> EffectiveMasses:
        """How the middle of the journal answers impulses, in the axes of its bore."""
        if self._inverse_masses is None:
            self._inverse_masses = self._find_mobilities()
        return self._inverse_masses

    def place(self) -> Vector2:
        """The place of the journal's middle in its bore, in the bore's axes [m]."""
        if self._place is None:
            _, (x, y, *_) = self.moving.now()
            self._place = x, y
        return self._place

    def accepted(self, was_in_contact: bool, onset: Onset | None, t: float) -> None:
        """A section has kept a step to t [s]: was it in contact before, and the impact in it, if any."""
        self._before.append((was_in_contact, onset))
        if len(self._before) < len(self.sections):
            return
        impacts = [impact for _, impact in self._before if impact is not None]
        # a journal makes contact when all that was in contact before has separated
        if impacts and all(impact is not None for was, impact in self._before if was):
            self.onsets.append(min(impacts))
        self._look_for_separation(t)
        self._before.clear()
        forces = [pin.force for pin in self.sections]
        before, self._bound = self._bound, sum(f.normal_force + abs(f.friction_force) for f in forces)
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
        if not self.onsets or any(pin.kept.in_contact for pin in self.sections):
            return
        separated = [-pin.kept.rate for pin, (was, _) in zip(self.sections, self._before, strict=True) if was]
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
        connector, moving, bore_spin, settings: as of ClearanceJoint.
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
        bore_spin: Callable[[], float],
        whole: SectionJournal,
        section: Section,
        ends: tuple[BearingEnd, BearingEnd],
        *,
        slides: bool,
        settings: SolverSettings,
    ) -> None:
        part = part_of(contact, section)
        super().__init__(part, connector, moving, bore_spin, whole.inverse_masses, settings, section.share)
        self.impact_steps = ImpactSteps(contact.normal, settings.impact_steps)  # steps of the whole
        self.section, self.whole, self.moving, self.ends, self.slides = section, whole, moving, ends, slides
        whole.sections.append(self)
        self._beside = 0.0, 0.0  # where the journal is along the bore at the last accepted step [m], [m/s]

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
        if self is self.whole.sections[0]:
            self.whole.moved()
        return super().after_newton(t)

    def jumped(self, memory: PinMemory) -> None:
        """See `ClearanceJoint`."""
        if self is self.whole.sections[0]:
            self.whole.moved()
        super().jumped(memory)
        self.look_beside(*self.moving.coordinates())

    def accept(self, t: float) -> None:
        """See `ClearanceJoint`."""
        before = self.kept.in_contact, self.onset
        super().accept(t)
        if self.slides:
            self._beside = self.moving.beside(*self.moving.coordinates())
        self.whole.accepted(*before, t)

    def _place(self) -> Vector2:
        return self.whole.place()


def part_of(contact: JournalContact, section: Section) -> JournalContact:
    """The contact of a section, which has its share of the force."""
    return replace(contact, normal=PartOf(law=contact.normal, share=section.share))


def marker_frame(end: BearingEnd, place: float, centre: Vector3) -> list[list[float]]:
    """Frame of a section on its body, in the body's axes (4 x 4), its z along the bearing."""
    frame = np.eye(4)
    frame[:3, :3] = frame_of(end.axis)
    frame[:3, 3] = np.array(end.centre(place)) - np.array(centre)
    found: list[list[float]] = frame.tolist()
    return found
