"""What presses on a machine besides its weight, one kind a file."""

from support_exudyn.loads.load import Load, LoadedPoint, Observed, Powers
from support_exudyn.loads.roof import Roof

__all__ = ["Load", "LoadedPoint", "Observed", "Powers", "Roof"]
