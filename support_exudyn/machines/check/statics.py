"""Forces that hold a linkage against its weight, with ideal pins and massless columns."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from support_exudyn.mechanics.kinetics import kinetics_of
from support_exudyn.model.linkage import Linkage
from user_forces.values.value import Vector2

Array = npt.NDArray[np.float64]
GRAVITY: Vector2 = (0.0, -9.81)


@dataclass(frozen=True)
class Statics:
    """Forces in one posture [N].

    Arguments:
        pins: of the first body on the second, by name, each (2,).
        columns: pushes of columns, by name; negative: it pulls.
        cranks: moments that hold cranks [N m], by name.
        slides: force across the guide, by name.
        error: bound of the numerical error of any of them.
    """

    pins: dict[str, Array]
    columns: dict[str, float]
    cranks: dict[str, float]
    slides: dict[str, float]
    error: float


def statics(linkage: Linkage, position: Array, gravity: Vector2 = GRAVITY) -> Statics:
    """Of a linkage whose bodies have moved from the start posture by `position` (3 bodies,) [m], [rad].

    Solves C^T L + w = 0, C the Jacobian of the constraints, driven parts held, w the weight. The error is what
    the residual can mean at the condition of C.
    """
    kinetics = kinetics_of(linkage)
    rows, weight = kinetics.rows(position), kinetics.weight(gravity)
    forces = np.linalg.lstsq(rows.T, -weight, rcond=None)[0]
    residual = float(np.abs(rows.T @ forces + weight).max()) + np.finfo(float).eps * float(np.abs(weight).max())
    error = residual * float(np.linalg.norm(np.linalg.pinv(rows.T), 2)) * len(weight) ** 0.5
    pins: dict[str, Array] = {}
    first = 0
    for name in linkage.pins:
        pins[name], first = np.array(forces[first : first + 2]), first + 2
    taken = iter(forces[first:].tolist())
    return Statics(
        pins,
        {name: next(taken) for name in linkage.columns},
        {name: next(taken) for name in linkage.cranks},
        {name: (next(taken), next(taken))[0] for name in linkage.slides},
        error,
    )
