"""Degrees of freedom of a linkage with ideal pins: counted, and as the rank of its constraints."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from support_exudyn.mechanics.kinetics import Kinetics, kinetics_of
from support_exudyn.model.linkage import Linkage


@dataclass(frozen=True)
class Mobility:
    """Degrees of freedom.

    Arguments:
        bodies, pins, guides, driven: how many there are.
        counted: by Gruebler's formula, 3 a body less 2 a pin and 2 a guide.
        free: by the rank of the constraints' Jacobian.
        left: the same with the driven parts held.
    """

    bodies: int
    pins: int
    guides: int
    driven: int
    counted: int
    free: int
    left: int

    def said(self) -> str:
        """In a sentence."""
        return (
            f"degrees of freedom: 3 x {self.bodies} bodies - 2 x {self.pins} pins"
            + (f" - 2 x {self.guides} guides" if self.guides else "")
            + f" = {self.counted} (by the rank of the constraints: {self.free}); driven: {self.driven}; "
            f"left: {self.left}"
        )


def mobility(linkage: Linkage) -> Mobility:
    """Of a linkage in its start posture."""
    bodies, pins, guides = len(linkage.bodies), len(linkage.pins), len(linkage.slides)
    kinetics = kinetics_of(linkage)
    rows = kinetics.rows(np.zeros(3 * bodies))
    driven = kinetics.driven()
    undriven = np.delete(rows, np.arange(driven.start, driven.stop), axis=0)
    return Mobility(
        bodies=bodies,
        pins=pins,
        guides=guides,
        driven=driven.stop - driven.start,
        counted=3 * bodies - 2 * pins - 2 * guides,
        free=3 * bodies - _rank(undriven, kinetics),
        left=3 * bodies - _rank(rows, kinetics),
    )


def _rank(rows: np.ndarray, kinetics: Kinetics) -> int:
    """Rank with turns counted by the path of a point at a typical distance, so that units do not matter."""
    points = np.array([item.body.centre for item in kinetics.bodies.values()])
    points = np.vstack([points, *([pin.first_point] for pin in kinetics.linkage.pins.values())])
    size = max(float(np.ptp(points, axis=0).max()), 1e-9)
    scaled = rows.copy()
    scaled[:, 2::3] /= size
    lengths = np.linalg.norm(scaled, axis=1, keepdims=True)
    return int(np.linalg.matrix_rank(scaled / np.where(lengths > 0.0, lengths, 1.0), tol=1e-9))
