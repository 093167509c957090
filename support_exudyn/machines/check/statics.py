"""Degrees of freedom of a linkage, and forces that hold weight and loads: ideal pins, massless actuators."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from support_exudyn.mechanics.acting_loads import forces_at_rest
from support_exudyn.mechanics.closing import DRIVEN, Conditions
from support_exudyn.mechanics.constraints import joints_held
from support_exudyn.mechanics.kinetics import kinetics_of
from support_exudyn.model.linkage import Linkage
from support_exudyn.model.loads.load import ActingLoad
from user_forces.values.value import Vector2

Array = npt.NDArray[np.float64]
GRAVITY: Vector2 = (0.0, -9.81)
SAME = 1e-9  # singular values of rows below this are of rounding


@dataclass(frozen=True)
class Statics:
    """Forces in one posture [N].

    Arguments:
        pins: of the first body on the second, by name, each (2,).
        actuators: pushes of actuators, by name; negative: it pulls.
        cranks: moments that hold cranks [N m], by name.
        slides: force across the guide, by name.
        gears: moments on their second bodies [N m], by name.
        error: bound of the numerical error of any of them.
    """

    pins: dict[str, Array]
    actuators: dict[str, float]
    cranks: dict[str, float]
    slides: dict[str, float]
    gears: dict[str, float]
    error: float


def statics(
    linkage: Linkage,
    position: Array,
    loads: Mapping[str, ActingLoad] = MappingProxyType({}),
) -> Statics:
    """The static forces of a linkage whose bodies have moved by `position` (3 bodies,) [m], [rad].

    Solves C^T L + w = 0, C the Jacobian of the constraints, driven parts held, w the weight and loads. The
    error is what the residual can mean at the condition of C.

    loads: besides the weight, by name.
    """
    kinetics = kinetics_of(linkage)
    rows = kinetics.rows(position)
    weight = kinetics.weight(GRAVITY) + forces_at_rest(kinetics, loads, position)
    forces = np.linalg.lstsq(rows.T, -weight, rcond=None)[0]
    residual = float(np.abs(rows.T @ forces + weight).max()) + np.finfo(float).eps * float(np.abs(weight).max())
    error = residual * float(np.linalg.norm(np.linalg.pinv(rows.T), 2)) * len(weight) ** 0.5
    found: dict[str, dict[str, Any]] = {part: {} for part in ("pins", "actuators", "cranks", "slides", "gears")}
    for (part, name), held in joints_held(kinetics.constraints).items():
        found[part][name] = forces[held] if part == "pins" else float(forces[held][0])
    return Statics(**found, error=error)


class DegreesOfFreedom(NamedTuple):
    """Degrees of freedom of a linkage.

    Arguments:
        counted: by Gruebler's formula, 3 a body less 2 a pin or block and 1 a slot, gear or strut. A block does
            not turn in its guide, a pin in a slot does; a strut is an actuator that no drive moves.
        free: by the rank of the constraints' Jacobian.
        driven: how many parts are.
        left: by the rank with the driven parts held.
        formula: Gruebler's count with its numbers.
    """

    counted: int
    free: int
    driven: int
    left: int
    formula: str

    def data(self) -> dict[str, int]:
        """The degrees of freedom as plain data, by these names."""
        return {"counted": self.counted, "free": self.free, "driven": self.driven, "left": self.left}

    def said(self) -> str:
        """The count and the rank in a sentence."""
        return (
            f"degrees of freedom: {self.formula} = {self.counted} (by the rank of the constraints: "
            f"{self.free}); driven: {self.driven}; left: {self.left}"
        )


def mobility(linkage: Linkage) -> DegreesOfFreedom:
    """The degrees of freedom of a linkage in its start posture."""
    bodies, slots = len(linkage.bodies), sum(slide.turns for slide in linkage.slides.values())
    struts = len(linkage.actuators) + len(linkage.cranks) - len(linkage.driven)
    held = [  # freedoms that each takes, how many there are, and what
        (2, len(linkage.pins), "pins"),
        (2, len(linkage.slides) - slots, "guides"),
        (1, slots, "slots"),
        (1, len(linkage.gears), "gears"),
        (1, struts, "struts"),
    ]
    terms = [f"{'2 x ' * (each == 2)}{count} {what}" for each, count, what in held if count or what == "pins"]
    conditions = Conditions(linkage)
    rows, owners = conditions.rows(conditions.still), conditions.kinetics.owners()
    rows = rows / np.maximum(np.linalg.norm(rows, axis=1, keepdims=True), SAME)
    driven = np.array([kind in DRIVEN and name in linkage.driven for kind, name in owners], dtype=bool)
    free, left = (3 * bodies - np.linalg.matrix_rank(some, tol=SAME) for some in (rows[~driven], rows))
    counted, formula = 3 * bodies - sum(each * count for each, count, _ in held), f"3 x {bodies} bodies"
    return DegreesOfFreedom(counted, int(free), len(linkage.driven), int(left), " - ".join([formula, *terms]))
