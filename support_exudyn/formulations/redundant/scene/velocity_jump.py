"""Velocities that fit the constraints: after a jump of the drive's speed, which is an impulse, and else.

With rigid columns the bodies' velocities jump too, see `kinetics`. Clearance pins and oil columns transmit no
impulse: their force is finite.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from support_exudyn.mechanics.impulse import Impulse

if TYPE_CHECKING:
    from support_exudyn.formulations.redundant.scene.engine_scene import EngineScene
    from support_exudyn.formulations.redundant.scene.scene import Scene


def align_velocities(scene: Scene, time: float) -> float:
    """Give the bodies velocities that the constraints have at a time [s]; work of the drives in it [J].

    Constraints of index 3 hold positions: velocities at the end of a long step are off by second order in it. A
    short step that follows would make up for it within itself, by accelerations a thousand times too large.
    """
    data, kinetics = scene.mbs.systemData, scene.kinetics
    position, before = data.GetODE2Coordinates(), data.GetODE2Coordinates_t()
    rates = kinetics.rates(lambda name: scene.scenario.drive_of(name).speed(time))
    change, impulses = kinetics.respond(
        position, np.zeros_like(before), rates - kinetics.rows(position) @ before
    )
    data.SetODE2Coordinates_t(before + change)
    return -float(impulses @ rates)


def slide(scene: EngineScene, rest: float) -> None:
    """Move on by a time [s] that is not worth a step, by the rates that the last one has ended with.

    Positions are then off by third order in it, and velocities and pressures by second. See
    `steps.shortest_step`.
    """
    data = scene.mbs.systemData
    velocity, acceleration = data.GetODE2Coordinates_t(), data.GetODE2Coordinates_tt()
    data.SetODE2Coordinates(data.GetODE2Coordinates() + rest * (velocity + 0.5 * rest * acceleration))
    data.SetODE2Coordinates_t(velocity + rest * acceleration)
    if scene.cylinders:
        data.SetODE1Coordinates(data.GetODE1Coordinates() + rest * data.GetODE1Coordinates_t())
    scene.refresh_memory()


def jump_velocities(scene: Scene, time: float) -> Impulse | None:
    """Give the bodies the velocities that belong to drives whose speed has jumped at a break [s].

    None if nothing is struck, because all that jumps gives.
    """
    data, kinetics = scene.mbs.systemData, scene.kinetics
    jump = kinetics.rates(lambda name: scene.scenario.drive_of(name).speed_jump(time))
    if not jump.any():
        return None
    position, before = data.GetODE2Coordinates(), data.GetODE2Coordinates_t()
    mass = kinetics.mass()
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
