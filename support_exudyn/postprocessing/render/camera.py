"""A camera that stands still: a parallel projection, so that lengths in one plane keep their proportions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.spatial.transform import Rotation

from support_exudyn.mechanics.trajectory import Series

Pixels = npt.NDArray[np.float64]

# from the left side of the machine, so that forward is to the left; then turned to its front and lifted [rad]
TURN, LIFT = 0.26, 0.17


@dataclass(frozen=True)
class Camera:
    """From points in space to pixels.

    Arguments:
        rotation: from ground's axes to right, up and towards the eye.
        centre: the point in the middle of the picture [m].
        height: what of the scene is as high as the picture [m].
        width_px, height_px: size of the picture [pixels].
    """

    rotation: Rotation
    centre: tuple[float, float, float]
    height: float
    width_px: int
    height_px: int

    @property
    def scale(self) -> float:
        """Pixels to a metre."""
        return self.height_px / self.height

    def pixels(self, points: Series) -> Pixels:
        """Where points (n, 3) are in the picture: to the right and down from its upper left corner (n, 2)."""
        seen = self.rotation.apply(np.atleast_2d(points) - np.array(self.centre))
        return np.column_stack(
            [0.5 * self.width_px + self.scale * seen[:, 0], 0.5 * self.height_px - self.scale * seen[:, 1]]
        )

    def arrow(self, vector: Series) -> Pixels:
        """A direction in space (3,) in the picture: per metre, to the right and down [pixels]."""
        right, up, _ = self.rotation.apply(vector)
        return np.array([right, -up]) * self.scale


def direction_of_view() -> Rotation:
    """The machine's left side, seen a little from the front and from above."""
    return Rotation.from_euler("yx", [np.pi + TURN, LIFT])


def fitted(points: Series, width_px: int, height_px: int, margins: tuple[int, int, int, int]) -> Camera:
    """The camera that sees all points (n, 3).

    margins: what is kept free of the picture, left, top, right, bottom [pixels].
    """
    rotation = direction_of_view()
    seen = rotation.apply(points)
    low, high = seen.min(axis=0), seen.max(axis=0)
    left, above, right, below = margins
    free_x, free_y = max(width_px - left - right, 1), max(height_px - above - below, 1)
    wide, tall = (max(side, 1e-9) for side in (high - low)[:2])
    scale = min(free_x / wide, free_y / tall)  # pixels to a metre
    middle = 0.5 * (low + high)
    middle[0] += 0.5 * (right - left) / scale
    middle[1] += 0.5 * (above - below) / scale
    x, y, z = rotation.inv().apply(middle)
    return Camera(rotation, (x, y, z), height_px / scale, width_px, height_px)
