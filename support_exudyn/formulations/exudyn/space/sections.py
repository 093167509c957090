"""A journal of finite length in its bore: sections along the axis, each with its share of the contact.

The law gives the force of the whole length at one depth. Where the journal is tilted the depth is different
from place to place, and the force is the mean along the axis,

    F = 1/L integral of law(depth(s)) ds,   s from -L/2 to L/2

taken by Gauss and Lobatto's rule, whose outermost points are the edges: a tilted journal makes contact there
first.
"""

from typing import Literal, NamedTuple

import numpy as np

from support_exudyn.mechanics.body_motion import SpatialMotion, cross
from support_exudyn.mechanics.constraints import frame_of
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.spatial_linkage import Bearing, BearingEnd
from user_forces.connector.attachment import Attachment
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


def marker_frame(end: BearingEnd, place: float, centre: Vector3) -> list[list[float]]:
    """Frame of a section on its body, in the body's axes (4 x 4), its z along the bearing."""
    frame = np.eye(4)
    frame[:3, :3] = frame_of(end.axis)
    frame[:3, 3] = np.array(end.centre(place)) - np.array(centre)
    found: list[list[float]] = frame.tolist()
    return found
