"""A journal of finite length in its bore: sections along the axis, each with its share of the contact.

The law gives the force of the whole length at one depth. Where the journal is tilted the depth is different
from place to place, and the force is the mean along the axis,

    F = 1/L integral of law(depth(s)) ds,   s from -L/2 to L/2

taken by Gauss and Lobatto's rule, whose outermost points are the edges: a tilted journal touches there first.
"""

from __future__ import annotations

from typing import Literal, NamedTuple

import numpy as np

from support_exudyn.machine import GROUND
from support_exudyn.spatial.constraints import frame_of
from support_exudyn.spatial.layout import Bearing
from support_exudyn.spatial.motion import SpatialMotion
from support_exudyn.trajectory import Series
from user_forces.values import Vector3


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


class End(NamedTuple):
    """Bore or journal of a bearing: its body, its middle and its axis, start posture."""

    body: str
    point: Vector3
    axis: Vector3

    def centre(self, place: float) -> Vector3:
        """Centre of a section [m]."""
        x, y, z = np.array(self.point) + place * np.array(self.axis)
        return float(x), float(y), float(z)


def ends(bearing: Bearing, bore: Literal["first", "second"]) -> tuple[End, End]:
    """Bore and journal."""
    first = End(bearing.first, bearing.first_point, bearing.first_axis)
    second = End(bearing.second, bearing.second_point, bearing.second_axis)
    return (first, second) if bore == "first" else (second, first)


class SectionMotion(NamedTuple):
    """A section of a journal in its bore over time, (n,) each, in the bore's axes; see `attachment.in_plane`.

    axes: the bore's, in columns (n, 3, 3). turning: of the journal about the axis against the bore.
    """

    x: Series
    y: Series
    vx: Series
    vy: Series
    bore_spin: Series
    journal_spin: Series
    axes: Series
    displacement: Series


def section_motion(motion: SpatialMotion, bore: End, journal: End, place: float) -> SectionMotion:
    """How a section moves: displacement of its centres and its rate, the plain difference of velocities."""
    start = frame_of(bore.axis)
    axes = np.stack([motion.carried(bore.body, start[:, k]) for k in range(3)], axis=-1)
    b = motion.point(bore.body, bore.centre(place))
    j = motion.point(journal.body, journal.centre(place))
    displacement = j.position - b.position
    x, y, z = np.einsum("nji,nj->in", axes, displacement)
    vx, vy, vz = np.einsum("nji,nj->in", axes, j.velocity - b.velocity)
    across = np.hypot(x, y)
    away = across > 0.0
    safe = np.where(away, across, 1.0)
    distance = np.hypot(across, z)
    rate = (x * vx + y * vy + z * vz) / np.where(away, distance, 1.0) - (x * vx + y * vy) / safe
    stretch = np.where(away, distance / safe, 1.0)
    rate = np.where(away, rate, 0.0)
    along = axes[:, :, 2]
    return SectionMotion(
        stretch * x,
        stretch * y,
        vx + rate * x / safe,
        vy + rate * y / safe,
        np.einsum("ni,ni->n", motion.spin_of(bore.body), along),
        np.einsum("ni,ni->n", motion.spin_of(journal.body), along),
        axes,
        displacement,
    )


def is_fixed(end: End) -> bool:
    """Whether it is on the ground."""
    return end.body == GROUND
