"""What acts on a machine besides its weight, one kind a file."""

from support_exudyn.model.loads.applied_force import AppliedForce
from support_exudyn.model.loads.applied_torque import AppliedTorque
from support_exudyn.model.loads.course import HarmonicCourse, LoadCourse, TableCourse
from support_exudyn.model.loads.falling_block import FallingBlock
from support_exudyn.model.loads.load import ActingLoad, Load, LoadChannel, LoadedPoint, Powers
from support_exudyn.model.loads.moment_load import MomentLoad, TurnedBody
from support_exudyn.model.loads.roof import Roof
from support_exudyn.model.loads.spring_damper import SpringDamper
from support_exudyn.model.loads.torsion_spring import TorsionSpring

__all__ = [
    "ActingLoad",
    "AppliedForce",
    "AppliedTorque",
    "FallingBlock",
    "HarmonicCourse",
    "Load",
    "LoadChannel",
    "LoadCourse",
    "LoadedPoint",
    "MomentLoad",
    "Powers",
    "Roof",
    "SpringDamper",
    "TableCourse",
    "TorsionSpring",
    "TurnedBody",
]
