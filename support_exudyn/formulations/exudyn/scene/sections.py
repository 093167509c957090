"""A journal of finite length in its bore: sections along the axis, each with its share of the contact.

The law gives the force of the whole length at one depth. Where the journal is tilted the depth is different
from place to place, and the force is the mean along the axis,

    F = 1/L integral of law(depth(s)) ds,   s from -L/2 to L/2

taken by Gauss and Lobatto's rule, whose outermost points are the edges: a tilted journal makes contact there
first.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal, NamedTuple

import numpy as np

from support_exudyn.mechanics.body_motion import SpatialMotion, cross
from support_exudyn.mechanics.constraints import frame_of
from support_exudyn.mechanics.contact_places import RelativeMotion, journal_arm, series
from support_exudyn.mechanics.trajectory import ContactSeries, Series
from support_exudyn.model.linkage import GROUND
from support_exudyn.model.spatial_linkage import Bearing, BearingEnd
from user_forces.connector.item import Attachment, attachment
from user_forces.contact import JournalContact
from user_forces.contact_state import PinMemory
from user_forces.friction.laws import Frictionless
from user_forces.normal.part import PartOf
from user_forces.values.value import Vector3


class Section(NamedTuple):
    """Place of a section from the bearing's middle [m], and its share of the pin's force."""

    place: float
    share: float


def sections(bearing: Bearing, number: int) -> list[Section]:
    """So many sections of a bearing, at least two; one in the middle if it has no length."""
    if bearing.length == 0.0:
        return [Section(0.0, bearing.share)]
    places, weights = lobatto(number)
    return [
        Section(0.5 * bearing.length * place, bearing.share * weight)
        for place, weight in zip(places.tolist(), weights.tolist(), strict=True)
    ]


def lobatto(number: int) -> tuple[Series, Series]:
    """Points from -1 to 1, both included, and weights that add up to 1, of the rule of so many points >= 2."""
    polynomial = np.polynomial.Legendre.basis(number - 1)
    inside = np.real(polynomial.deriv().roots()) if number > 2 else np.array([])
    places = np.concatenate([[-1.0], np.sort(inside), [1.0]])
    places = 0.5 * (places - places[::-1])  # exactly symmetric
    weights = 1.0 / polynomial(places) ** 2
    return places, weights / weights.sum()


def ends(bearing: Bearing, bore: Literal["first", "second"]) -> tuple[BearingEnd, BearingEnd]:
    """Bore and journal."""
    first = BearingEnd(bearing.first, bearing.first_point, bearing.first_axis)
    second = BearingEnd(bearing.second, bearing.second_point, bearing.second_axis)
    return (first, second) if bore == "first" else (second, first)


@dataclass(frozen=True)
class SectionPlace:
    """A section of a clearance bearing as a place of contact, see `ContactPlace`.

    contact: with the section's share of the force. bore_end, journal_end: of the bearing. section: which it is.
    slides: the journal may shift along the bore.
    """

    contact: JournalContact
    bore_end: BearingEnd
    journal_end: BearingEnd
    section: Section
    slides: bool

    @property
    def bore(self) -> str:
        """The body that encloses."""
        return self.bore_end.body

    @property
    def journal(self) -> str:
        """The body that is enclosed."""
        return self.journal_end.body

    @property
    def bore_point(self) -> Vector3:
        """Centre of the bore's section, start posture [m]."""
        return self.bore_end.centre(self.section.place)

    @property
    def journal_point(self) -> Vector3:
        """Centre of the journal's section, start posture [m]."""
        return self.journal_end.centre(self.section.place)

    def motion(self, motion: SpatialMotion) -> SectionMotion:
        """How the section moves, see `section_motion`."""
        at = attachment(self.contact, self.bore == GROUND, self.journal == GROUND)
        return section_motion(motion, self.bore_end, self.journal_end, self.section.place, at, self.slides)

    def series(self, motion: SpatialMotion, memories: Series | Sequence[PinMemory]) -> ContactSeries:
        """The section at every record, in the axes in which its force is given."""
        return series(self.contact, RelativeMotion(*self.motion(motion)[:6]), memories)

    def push(self, motion: SpatialMotion, contact: ContactSeries) -> tuple[Series, Series]:
        """Force of the bore on the journal [N], and the point at which it acts [m], ground's axes (n, 3)."""
        moving = self.motion(motion)
        away = np.linalg.norm(moving.displacement, axis=1)
        outward = moving.displacement / np.where(away > 0.0, away, 1.0)[:, None]
        if isinstance(self.contact.friction, Frictionless):
            force = -contact.normal_force[:, None] * outward
        else:
            plane = np.column_stack([contact.force_x, contact.force_y, np.zeros(motion.count)])
            force = np.einsum("nij,nj->ni", moving.axes, plane)
        return force, moving.centre + journal_arm(self.contact, contact.depth)[:, None] * outward


def section_places(
    bearing: Bearing, contact: JournalContact, bore: Literal["first", "second"], number: int
) -> list[SectionPlace]:
    """The middle of a clearance bearing with all of its pin's contact, then so many sections."""
    slides, both = "along" not in bearing.holds, ends(bearing, bore)
    found = [SectionPlace(contact, *both, Section(0.0, bearing.share), slides)]
    for section in sections(bearing, number):
        part = replace(contact, normal=PartOf(law=contact.normal, share=section.share))
        found.append(SectionPlace(part, *both, section, slides))
    return found


class SectionMotion(NamedTuple):
    """A section of a journal in its bore over time, (n,) each, in the axes in which its force is given.

    axes: these, in columns (n, 3, 3). displacement: (n, 3), ground's axes; to centre, of the journal's section
    (n, 3). See `section_motion`.
    """

    x: Series
    y: Series
    vx: Series
    vy: Series
    bore_spin: Series
    journal_spin: Series
    axes: Series
    displacement: Series
    centre: Series


def section_motion(
    motion: SpatialMotion, bore: BearingEnd, journal: BearingEnd, place: float, at: Attachment, slides: bool
) -> SectionMotion:
    """How a section moves: displacement of its centres and its rate, the plain difference of velocities.

    Arguments:
        motion: of all bodies.
        bore, journal: where it is.
        place: of the section [m].
        at: what its force acts on; in the middle between both bodies the axes, too, are half-way.
        slides: the journal may shift along the bore; see `SectionPin`.
    """
    start = frame_of(bore.axis)
    axes = np.stack([motion.carried(bore.body, start[:, k]) for k in range(3)], axis=-1)
    b = motion.point(bore.body, bore.centre(place))
    j = motion.point(journal.body, journal.centre(place))
    displacement, velocity = j.position - b.position, j.velocity - b.velocity
    bore_spin, journal_spin = motion.spin(bore.body), motion.spin(journal.body)
    along, own = axes[:, :, 2], motion.carried(journal.body, journal.axis)
    spin = np.einsum("ni,ni->n", bore_spin, along)
    if at is Attachment.MIDDLE:
        axes = half_way(axes, own)
    centre = j.position
    if slides:
        apart = np.einsum("ni,ni->n", displacement, axes[:, :, 2])[:, None]
        share = 0.5 if at is Attachment.MIDDLE else 0.0
        bore_shift, journal_shift = (1.0 - share) * apart * along, -share * apart * own
        centre = centre + journal_shift
        displacement = displacement + journal_shift - bore_shift
        velocity = velocity + cross(journal_spin, journal_shift) - cross(bore_spin, bore_shift)
    spins = spin, spin + np.einsum("ni,ni->n", journal_spin - bore_spin, axes[:, :, 2])
    x, y, z = np.einsum("nji,nj->in", axes, displacement)
    vx, vy, vz = np.einsum("nji,nj->in", axes, velocity)
    if at is not Attachment.CENTRES:
        return SectionMotion(x, y, vx, vy, *spins, axes, displacement, centre)
    across = np.hypot(x, y)
    away = across > 0.0
    safe = np.where(away, across, 1.0)
    distance = np.hypot(across, z)
    rate = (x * vx + y * vy + z * vz) / np.where(away, distance, 1.0) - (x * vx + y * vy) / safe
    run_of_steps = np.where(away, distance / safe, 1.0)
    rate = np.where(away, rate, 0.0)
    return SectionMotion(
        run_of_steps * x,
        run_of_steps * y,
        vx + rate * x / safe,
        vy + rate * y / safe,
        *spins,
        axes,
        displacement,
        centre,
    )


def half_way(axes: Series, along: Series) -> Series:
    """Axes in columns (n, 3, 3), tilted half of the way that turns their third into another vector (n, 3)."""
    own = axes[:, :, 2]
    middle = own + along
    middle /= np.linalg.norm(middle, axis=1)[:, None]
    share = (
        np.einsum("ni,nik->nk", middle, axes[:, :, :2]) / (1.0 + np.einsum("ni,ni->n", own, middle))[:, None]
    )
    across = axes[:, :, :2] - np.einsum("ni,nk->nik", own + middle, share)
    return np.concatenate([across, middle[:, :, None]], axis=2)
