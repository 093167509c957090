"""The postures of a support over its used height."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from support_exudyn.machines.four_bar_shield import FourBarShield
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.mechanics.closing import Conditions, moved_on
from support_exudyn.mechanics.kinetics import kinetics_of
from support_exudyn.mechanics.postures import laid_out
from support_exudyn.model.linkage import GROUND, Linkage
from user_forces.values.value import InputError


@dataclass(frozen=True)
class UsedPosture:
    """A posture.

    stroke: by how much the legs are longer than at the start [m]. linkage: laid out there.
    """

    stroke: float
    linkage: Linkage


def used_postures(data: MachineData, count: int) -> list[UsedPosture]:
    """Postures evenly over the used stroke, from the lowest on.

    A shield support goes as its drives lead it, with legs or columns that extend alike (the ram of a two-leg
    shield keeps the canopy level). In any other machine all actuators on the ground extend alike and the others
    keep their lengths; without a stroke it has its start posture alone.

    Raises InputError if the linkage does not go so far.
    """
    machine = data.machine
    linkage = machine.linkage()
    legs, stroke, led = legs_of(linkage), data.stroke, linkage
    if isinstance(machine, FourBarShield):
        stroke, led = machine.usual_stroke if stroke is None else stroke, machine.led_linkage()
    if stroke is None or not legs:
        return [UsedPosture(0.0, linkage)]
    conditions, closed = Conditions(led), kinetics_of(linkage)
    at, reached = np.zeros(3 * len(linkage.bodies)), 0.0
    postures: list[UsedPosture] = []
    for goal in np.linspace(0.0, stroke, count).tolist():
        at, share = moved_on(conditions, at, dict.fromkeys(legs, goal))
        if share < 1.0:
            raise InputError(
                f"stroke = {stroke:.6g} m: the linkage locks before; allowed: up to "
                f"{reached + share * (goal - reached):.4g} m"
            )
        reached = goal
        postures.append(UsedPosture(goal, laid_out(closed, at / conditions.arms)))
    return postures


def legs_of(linkage: Linkage) -> tuple[str, ...]:
    """Names of the actuators that stand on the ground: legs and columns; the others are rams."""
    return tuple(name for name, one in linkage.actuators.items() if one.foot == GROUND)
