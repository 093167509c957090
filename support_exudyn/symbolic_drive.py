"""Cranks that follow their drive by an expression of the engine, so that Python is not asked at every step.

The engine takes an expression for the angle of a crank. For the length of a rigid column it takes none: that is
a parameter, which Python sets before every step.
"""

from __future__ import annotations

from typing import Any, cast

from exudyn.advancedUtilities import CreateSymbolicUserFunction

from support_exudyn.scene import Scene
from support_exudyn.symbolic_force import Symbol, engine

NAME = "offsetUserFunction"  # the engine's, of its connector of two coordinates


def turns_by_itself(scene: Scene) -> bool:
    """Give the cranks their drive as an expression; whether nothing is left that has to be set at every step.

    Nothing is done where something would be left: columns, constraints of velocities, or a drive that
    branches on time.
    """
    drive = scene.scenario.drive
    if scene.rigid_columns or scene.oil_columns or scene.scenario.solver.constraint_index == 2:
        return False

    def angle(mbs: Any, t: Any, item: Any, offset: Any) -> Any:
        found: Any = drive.extension(cast(float, Symbol(t)))
        return found.real if isinstance(found, Symbol) else engine.Real(found)

    try:
        angle(None, engine.Real(0.0), None, None)
    except TypeError:  # see `scalar.Expression`
        return False
    for crank in scene.cranks.values():
        function = CreateSymbolicUserFunction(scene.mbs, angle, NAME, crank.object)
        scene.mbs.SetObjectParameter(crank.object, NAME, function)
    return True
