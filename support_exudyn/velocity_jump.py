"""What a jump of the drive's speed does: an impulse, and consistent velocities after it.

With rigid columns the bodies' velocities jump too, see `kinetics`. Clearance pins and oil columns transmit no
impulse: their force is finite.
"""

from __future__ import annotations

import numpy as np

from support_exudyn.impulse import Impulse
from support_exudyn.scene import Scene


def jump_velocities(scene: Scene, time: float, speed_jump: float) -> Impulse:
    """Give the bodies the velocities that belong to a drive whose speed has jumped by so much."""
    data, kinetics = scene.mbs.systemData, scene.kinetics
    position, before = data.GetODE2Coordinates(), data.GetODE2Coordinates_t()
    mass = kinetics.mass()
    jump = np.zeros(len(kinetics.rows(position)))
    jump[kinetics.driven()] = speed_jump
    change, impulses = kinetics.respond(position, np.zeros_like(before), jump)
    after = before + change
    data.SetODE2Coordinates_t(after)
    driven = (-impulses[kinetics.driven()]).tolist()
    return Impulse(
        time,
        dict(zip(scene.rigid_columns, driven, strict=False)),
        float(0.5 * (mass * after) @ after - 0.5 * (mass * before) @ before),
        dict(zip(scene.cranks, driven[len(scene.rigid_columns) :], strict=True)),
    )
