"""Dynamics of linkages with clearance in their pins, on Exudyn.

    from support_exudyn import ClearancePin, CubicStep, Scenario, reference_support, simulate

    result = simulate(Scenario(machine=reference_support(), drive=CubicStep(), duration=5.0))
    result["pin.rear_base.force"]  # newton, at result.time

One entry, `simulate`; everything else is a value that is handed in. SI units and radians.
"""

from support_exudyn import at_start as at_start
from support_exudyn.channels import Channel
from support_exudyn.columns import ColumnModel, OilColumn, RigidColumn, TwoBodyColumn, bore_area
from support_exudyn.cylinder import HydraulicCylinder
from support_exudyn.drives import CubicStep, Drive, Held, Reciprocating, Steady, Stroke, UniformSpeed
from support_exudyn.errors import Failure, SimulationError
from support_exudyn.estimate import Estimate
from support_exudyn.impulse import Impulse
from support_exudyn.inlet import ClosedInlet, Inlet, RampedOpening, SuddenOpening
from support_exudyn.linkages.hydraulic_support import HydraulicSupport
from support_exudyn.linkages.impact_stand import ImpactStand
from support_exudyn.linkages.slider_crank import SliderCrank, ravn_slider_crank
from support_exudyn.linkages.two_leg_shield import TwoLegShield
from support_exudyn.loads import AppliedForce, FallingBlock, Load, LoadedPoint, Roof
from support_exudyn.machine import Body, Column, Crank, Linkage, Machine, Part, PinPlace, Slide, TracePoint
from support_exudyn.machines import load_support, reference_support, two_body_columns
from support_exudyn.onset import Onset
from support_exudyn.parts import Lumped, OwnBody, PartModel
from support_exudyn.pins import ClearancePin, IdealPin, Pin
from support_exudyn.recommend import Recommendation, recommend
from support_exudyn.result import Result
from support_exudyn.scenario import Scenario
from support_exudyn.simulate import simulate
from support_exudyn.solver_settings import SolverSettings
from support_exudyn.table_drive import TableDrive
from support_exudyn.width import Width

__all__ = [
    "AppliedForce",
    "Body",
    "Channel",
    "ClearancePin",
    "ClosedInlet",
    "Column",
    "ColumnModel",
    "Crank",
    "CubicStep",
    "Drive",
    "Estimate",
    "Failure",
    "FallingBlock",
    "Held",
    "HydraulicCylinder",
    "HydraulicSupport",
    "IdealPin",
    "ImpactStand",
    "Impulse",
    "Inlet",
    "Linkage",
    "Load",
    "LoadedPoint",
    "Lumped",
    "Machine",
    "OilColumn",
    "Onset",
    "OwnBody",
    "Part",
    "PartModel",
    "Pin",
    "PinPlace",
    "RampedOpening",
    "Reciprocating",
    "Recommendation",
    "Result",
    "RigidColumn",
    "Roof",
    "Scenario",
    "SimulationError",
    "Slide",
    "SliderCrank",
    "SolverSettings",
    "Steady",
    "Stroke",
    "SuddenOpening",
    "TableDrive",
    "TracePoint",
    "TwoBodyColumn",
    "TwoLegShield",
    "UniformSpeed",
    "Width",
    "bore_area",
    "load_support",
    "ravn_slider_crank",
    "recommend",
    "reference_support",
    "simulate",
    "two_body_columns",
]
