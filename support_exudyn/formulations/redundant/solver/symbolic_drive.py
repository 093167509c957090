"""Cranks that follow their drive by an expression of the engine, so that Python is not asked at every step.

The engine takes an expression for the angle of a crank. For the length of a rigid actuator it takes none: that
is a parameter, which Python sets before every step.
"""

from collections.abc import Callable
from typing import Any

from exudyn.advancedUtilities import CreateSymbolicUserFunction

from support_exudyn.formulations.redundant.clearance.symbolic_force import is_formula, real, unknown
from support_exudyn.formulations.redundant.scene.engine_scene import EngineScene
from support_exudyn.model.drives.drive import Drive

NAME = "offsetUserFunction"  # the engine's, of its connector of two coordinates


def turns_by_itself(scene: EngineScene) -> bool:
    """Give the cranks their drives as expressions; whether nothing is left that has to be set at every step.

    Nothing is done where something would be left: actuators that move, constraints of velocities, or a drive
    that branches on time.
    """
    if scene.scenario.solver.constraint_index == 2:
        return False
    moving = [parts for parts in scene.driven if parts.moves(scene.scenario.duration)]
    if any(cylinder.moves for cylinder in scene.cylinders.values()):
        return False
    if any(parts.rigid or parts.oil for parts in moving) or not all(
        is_formula(parts.drive.extension, 1) for parts in moving
    ):
        return False
    for parts in moving:
        for crank in parts.cranks:
            function = CreateSymbolicUserFunction(scene.mbs, _angle(parts.drive), NAME, crank.object)
            scene.mbs.SetObjectParameter(crank.object, NAME, function)
    return True


def _angle(drive: Drive) -> Callable[..., Any]:
    """The angle of a crank over time, of the engine's signature."""
    return lambda mbs, t, item, offset: real(drive.extension(unknown(t)))
