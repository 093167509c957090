"""What presses on a machine besides its weight, one kind a file."""

from support_exudyn.model.loads.applied_force import AppliedForce
from support_exudyn.model.loads.falling_block import FallingBlock
from support_exudyn.model.loads.load import Load, LoadChannel, LoadedPoint, Powers
from support_exudyn.model.loads.roof import Roof

__all__ = ["AppliedForce", "FallingBlock", "Load", "LoadChannel", "LoadedPoint", "Powers", "Roof"]
