"""Dynamics of linkages with clearance in their pins, on Exudyn.

    from support_exudyn import ClearancePin, CubicStep, Scenario, machine, simulate

    pin = ClearancePin.simple(clearance=0.5e-3, bore_radius=0.06, length=0.5, friction=0.1)
    pins = {"rear_base": pin}
    result = simulate(Scenario(machine=machine("zf18000"), pins=pins, drive=CubicStep(), duration=5.0))
    result["pin.rear_base.force"]  # newton, at result.time

One entry, `simulate`; everything else is a value that is handed in. SI units and radians.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from support_exudyn.simulation import at_start as at_start

# isort: split

from support_exudyn.scenario.presentation import Presenter, present_by
from user_forces.values.places import for_types, keep_classes, offered

if TYPE_CHECKING:
    from support_exudyn.files.machines import cylinders_and_rods as cylinders_and_rods
    from support_exudyn.files.machines import load_machine as load_machine
    from support_exudyn.files.machines import machine as machine
    from support_exudyn.files.machines import reference_support as reference_support
    from support_exudyn.files.own_modules import trusted as trusted
    from support_exudyn.files.scenarios.scenario_file import read_scenario as read_scenario
    from support_exudyn.files.scenarios.scenario_file import simple_scenario as simple_scenario
    from support_exudyn.machines.four_column_support import HydraulicSupport as HydraulicSupport
    from support_exudyn.machines.free_impact import ImpactStand as ImpactStand
    from support_exudyn.machines.planar_linkage import PlanarLinkage as PlanarLinkage
    from support_exudyn.machines.slider_crank import SliderCrank as SliderCrank
    from support_exudyn.machines.slider_crank import ravn_slider_crank as ravn_slider_crank
    from support_exudyn.machines.two_leg_shield import TwoLegShield as TwoLegShield
    from support_exudyn.mechanics.trajectory import Impulse as Impulse
    from support_exudyn.model.actuators import ActuatorModel as ActuatorModel
    from support_exudyn.model.actuators import CylinderAndRod as CylinderAndRod
    from support_exudyn.model.actuators import Lumped as Lumped
    from support_exudyn.model.actuators import OwnBody as OwnBody
    from support_exudyn.model.actuators import PartModel as PartModel
    from support_exudyn.model.actuators import RigidActuator as RigidActuator
    from support_exudyn.model.actuators import bore_area as bore_area
    from support_exudyn.model.bushing_pin import BushingPin as BushingPin
    from support_exudyn.model.drives.drive import CubicStep as CubicStep
    from support_exudyn.model.drives.drive import Drive as Drive
    from support_exudyn.model.drives.drive import Held as Held
    from support_exudyn.model.drives.drive import Reciprocating as Reciprocating
    from support_exudyn.model.drives.drive import Steady as Steady
    from support_exudyn.model.drives.drive import Stroke as Stroke
    from support_exudyn.model.drives.drive import UniformSpeed as UniformSpeed
    from support_exudyn.model.drives.table_drive import TableDrive as TableDrive
    from support_exudyn.model.guides import ClearanceGuide as ClearanceGuide
    from support_exudyn.model.guides import Guide as Guide
    from support_exudyn.model.guides import IdealGuide as IdealGuide
    from support_exudyn.model.hydraulics.elements import EndStops as EndStops
    from support_exudyn.model.hydraulics.elements import PumpStation as PumpStation
    from support_exudyn.model.hydraulics.elements import SealFriction as SealFriction
    from support_exudyn.model.hydraulics.elements import SecondStage as SecondStage
    from support_exudyn.model.hydraulics.elements import TrappedAir as TrappedAir
    from support_exudyn.model.hydraulics.inlets import ClosedInlet as ClosedInlet
    from support_exudyn.model.hydraulics.inlets import Inlet as Inlet
    from support_exudyn.model.hydraulics.inlets import RampedOpening as RampedOpening
    from support_exudyn.model.hydraulics.inlets import SuddenOpening as SuddenOpening
    from support_exudyn.model.hydraulics.leg import HydraulicCylinder as HydraulicCylinder
    from support_exudyn.model.hydraulics.leg import OilColumn as OilColumn
    from support_exudyn.model.hydraulics.valves import CheckValve as CheckValve
    from support_exudyn.model.hydraulics.valves import LegChannel as LegChannel
    from support_exudyn.model.hydraulics.valves import LegValve as LegValve
    from support_exudyn.model.hydraulics.valves import Line as Line
    from support_exudyn.model.hydraulics.valves import Poppet as Poppet
    from support_exudyn.model.hydraulics.valves import YieldValve as YieldValve
    from support_exudyn.model.linkage import Body as Body
    from support_exudyn.model.linkage import Crank as Crank
    from support_exudyn.model.linkage import Gear as Gear
    from support_exudyn.model.linkage import LinearActuator as LinearActuator
    from support_exudyn.model.linkage import Linkage as Linkage
    from support_exudyn.model.linkage import Part as Part
    from support_exudyn.model.linkage import PinPlace as PinPlace
    from support_exudyn.model.linkage import Slide as Slide
    from support_exudyn.model.linkage import TracePoint as TracePoint
    from support_exudyn.model.loads.applied import AppliedForce as AppliedForce
    from support_exudyn.model.loads.applied import AppliedTorque as AppliedTorque
    from support_exudyn.model.loads.applied import HarmonicCourse as HarmonicCourse
    from support_exudyn.model.loads.applied import TableCourse as TableCourse
    from support_exudyn.model.loads.falling_block import FallingBlock as FallingBlock
    from support_exudyn.model.loads.load import Load as Load
    from support_exudyn.model.loads.load import LoadChannel as LoadChannel
    from support_exudyn.model.loads.load import LoadedPoint as LoadedPoint
    from support_exudyn.model.loads.load import LoadedStretch as LoadedStretch
    from support_exudyn.model.loads.load import MomentLoad as MomentLoad
    from support_exudyn.model.loads.load import StretchLoad as StretchLoad
    from support_exudyn.model.loads.load import TurnedBody as TurnedBody
    from support_exudyn.model.loads.roofs import BeddedRoof as BeddedRoof
    from support_exudyn.model.loads.roofs import GroundReaction as GroundReaction
    from support_exudyn.model.loads.roofs import Roof as Roof
    from support_exudyn.model.loads.springs import SpringDamper as SpringDamper
    from support_exudyn.model.loads.springs import TorsionSpring as TorsionSpring
    from support_exudyn.model.machine import Machine as Machine
    from support_exudyn.model.pins import ClearancePin as ClearancePin
    from support_exudyn.model.pins import CompliantPin as CompliantPin
    from support_exudyn.model.pins import IdealPin as IdealPin
    from support_exudyn.model.pins import Pin as Pin
    from support_exudyn.model.to_space import Width as Width
    from support_exudyn.postprocessing.comparing.files_compared import FilesCompared as FilesCompared
    from support_exudyn.postprocessing.comparing.files_compared import compare_files as compare_files
    from support_exudyn.postprocessing.export.solution_file import save_solution as save_solution
    from support_exudyn.postprocessing.known_channels import channels as channels
    from support_exudyn.postprocessing.side_by_side import RunsSideBySide as RunsSideBySide
    from support_exudyn.postprocessing.side_by_side import compare as compare
    from support_exudyn.scenario.recorded_channels import Channel as Channel
    from support_exudyn.scenario.scenario import Scenario as Scenario
    from support_exudyn.scenario.solver_settings import SolverSettings as SolverSettings
    from support_exudyn.scene.contract import Failure as Failure
    from support_exudyn.scene.contract import SimulationError as SimulationError
    from support_exudyn.simulation.estimate import Estimate as Estimate
    from support_exudyn.simulation.recommend import Recommendation as Recommendation
    from support_exudyn.simulation.recommend import recommend as recommend
    from support_exudyn.simulation.result import Result as Result
    from support_exudyn.simulation.simulate import simulate as simulate
    from user_forces.contact import JournalContact as JournalContact
    from user_forces.contact_state import Onset as Onset
    from user_forces.friction.law import FrictionLaw as FrictionLaw
    from user_forces.journal import JournalBearing as JournalBearing
    from user_forces.normal.law import NormalLaw as NormalLaw
    from user_forces.values.value import InputError as InputError
    from user_forces.values.value import value as value

# imported when they are asked for, so that others need not wait: what a run is made of, and what it is read by
_PLACES = for_types(__file__)
__getattr__, __dir__ = offered(__name__, _PLACES)
# what needs the engine or draws has no classes of values
keep_classes(__name__, {name: names for name, names in _PLACES.items() if ".postprocessing." not in name})


def _presenter() -> Presenter:
    from support_exudyn.postprocessing import notebook

    return notebook


present_by(_presenter)
