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
from user_forces.values.places import keep_classes, offered

if TYPE_CHECKING:
    from support_exudyn.files.machines import (
        cylinders_and_rods,
        load_machine,
        load_support,
        machine,
        reference_support,
    )
    from support_exudyn.files.own_modules import trusted
    from support_exudyn.files.scenarios.scenario_file import read_scenario
    from support_exudyn.files.scenarios.simple_scenario import simple_scenario
    from support_exudyn.machines.four_column_support import HydraulicSupport
    from support_exudyn.machines.free_impact import ImpactStand
    from support_exudyn.machines.planar_linkage import PlanarLinkage
    from support_exudyn.machines.slider_crank import SliderCrank, ravn_slider_crank
    from support_exudyn.machines.two_leg_shield import TwoLegShield
    from support_exudyn.mechanics.trajectory import Impulse
    from support_exudyn.model.actuators import (
        ActuatorModel,
        CylinderAndRod,
        Lumped,
        OwnBody,
        PartModel,
        RigidActuator,
        bore_area,
    )
    from support_exudyn.model.bushing_pin import BushingPin
    from support_exudyn.model.drives.drive import (
        CubicStep,
        Drive,
        Held,
        Reciprocating,
        Steady,
        Stroke,
        UniformSpeed,
    )
    from support_exudyn.model.drives.table_drive import TableDrive
    from support_exudyn.model.guides import ClearanceGuide, Guide, IdealGuide
    from support_exudyn.model.hydraulics.elements import (
        CheckValve,
        EndStops,
        Line,
        Poppet,
        PumpStation,
        SealFriction,
        SecondStage,
        TrappedAir,
        YieldValve,
    )
    from support_exudyn.model.hydraulics.inlets import ClosedInlet, Inlet, RampedOpening, SuddenOpening
    from support_exudyn.model.hydraulics.leg import HydraulicCylinder, OilColumn
    from support_exudyn.model.linkage import (
        Body,
        Crank,
        Gear,
        LinearActuator,
        Linkage,
        Part,
        PinPlace,
        Slide,
        TracePoint,
    )
    from support_exudyn.model.loads.applied import AppliedForce, AppliedTorque, HarmonicCourse, TableCourse
    from support_exudyn.model.loads.falling_block import FallingBlock
    from support_exudyn.model.loads.load import (
        Load,
        LoadChannel,
        LoadedPoint,
        LoadedStretch,
        MomentLoad,
        StretchLoad,
        TurnedBody,
    )
    from support_exudyn.model.loads.roofs import BeddedRoof, GroundReaction, Roof
    from support_exudyn.model.loads.springs import SpringDamper, TorsionSpring
    from support_exudyn.model.machine import Machine
    from support_exudyn.model.pins import ClearancePin, CompliantPin, IdealPin, Pin
    from support_exudyn.model.to_space import Width
    from support_exudyn.postprocessing.comparing.files_compared import FilesCompared, compare_files
    from support_exudyn.postprocessing.export.solution_file import save_solution
    from support_exudyn.postprocessing.known_channels import channels
    from support_exudyn.postprocessing.side_by_side import RunsSideBySide, compare
    from support_exudyn.scenario.recorded_channels import Channel
    from support_exudyn.scenario.scenario import Scenario
    from support_exudyn.scenario.solver_settings import SolverSettings
    from support_exudyn.scene.contract import Failure, SimulationError
    from support_exudyn.simulation.estimate import Estimate
    from support_exudyn.simulation.recommend import Recommendation, recommend
    from support_exudyn.simulation.result import Result
    from support_exudyn.simulation.simulate import simulate
    from user_forces.contact import JournalContact
    from user_forces.contact_state import Onset
    from user_forces.friction.law import FrictionLaw
    from user_forces.journal import JournalBearing
    from user_forces.normal.law import NormalLaw
    from user_forces.values.value import InputError, value

__all__ = [
    "ActuatorModel",
    "AppliedForce",
    "AppliedTorque",
    "BeddedRoof",
    "Body",
    "BushingPin",
    "Channel",
    "CheckValve",
    "ClearanceGuide",
    "ClearancePin",
    "ClosedInlet",
    "CompliantPin",
    "Crank",
    "CubicStep",
    "CylinderAndRod",
    "Drive",
    "EndStops",
    "Estimate",
    "Failure",
    "FallingBlock",
    "FilesCompared",
    "FrictionLaw",
    "Gear",
    "GroundReaction",
    "Guide",
    "HarmonicCourse",
    "Held",
    "HydraulicCylinder",
    "HydraulicSupport",
    "IdealGuide",
    "IdealPin",
    "ImpactStand",
    "Impulse",
    "Inlet",
    "InputError",
    "JournalBearing",
    "JournalContact",
    "Line",
    "LinearActuator",
    "Linkage",
    "Load",
    "LoadChannel",
    "LoadedPoint",
    "LoadedStretch",
    "Lumped",
    "Machine",
    "MomentLoad",
    "NormalLaw",
    "OilColumn",
    "Onset",
    "OwnBody",
    "Part",
    "PartModel",
    "Pin",
    "PinPlace",
    "PlanarLinkage",
    "Poppet",
    "PumpStation",
    "RampedOpening",
    "Reciprocating",
    "Recommendation",
    "Result",
    "RigidActuator",
    "Roof",
    "RunsSideBySide",
    "Scenario",
    "SealFriction",
    "SecondStage",
    "SimulationError",
    "Slide",
    "SliderCrank",
    "SolverSettings",
    "SpringDamper",
    "Steady",
    "StretchLoad",
    "Stroke",
    "SuddenOpening",
    "TableCourse",
    "TableDrive",
    "TorsionSpring",
    "TracePoint",
    "TrappedAir",
    "TurnedBody",
    "TwoLegShield",
    "UniformSpeed",
    "Width",
    "YieldValve",
    "bore_area",
    "channels",
    "compare",
    "compare_files",
    "cylinders_and_rods",
    "load_machine",
    "load_support",
    "machine",
    "ravn_slider_crank",
    "read_scenario",
    "recommend",
    "reference_support",
    "save_solution",
    "simple_scenario",
    "simulate",
    "trusted",
    "value",
]

# imported when they are asked for, so that others need not wait: what a run is made of, and what it is read by
_PLACES = {
    "user_forces.contact_state": ("Onset",),
    ".files.machines": ("cylinders_and_rods", "load_machine", "load_support", "machine", "reference_support"),
    ".scene.contract": ("Failure", "SimulationError"),
    ".machines.four_column_support": ("HydraulicSupport",),
    ".machines.free_impact": ("ImpactStand",),
    ".machines.planar_linkage": ("PlanarLinkage",),
    ".machines.slider_crank": ("SliderCrank", "ravn_slider_crank"),
    ".machines.two_leg_shield": ("TwoLegShield",),
    ".mechanics.trajectory": ("Impulse",),
    ".model.actuators": (
        "ActuatorModel",
        "CylinderAndRod",
        "Lumped",
        "OwnBody",
        "PartModel",
        "RigidActuator",
        "bore_area",
    ),
    ".model.bushing_pin": ("BushingPin",),
    ".model.drives.drive": ("CubicStep", "Drive", "Held", "Reciprocating", "Steady", "Stroke", "UniformSpeed"),
    ".model.drives.table_drive": ("TableDrive",),
    ".model.guides": ("ClearanceGuide", "Guide", "IdealGuide"),
    ".model.hydraulics.elements": (
        "CheckValve",
        "EndStops",
        "Line",
        "Poppet",
        "PumpStation",
        "SealFriction",
        "SecondStage",
        "TrappedAir",
        "YieldValve",
    ),
    ".model.hydraulics.inlets": ("ClosedInlet", "Inlet", "RampedOpening", "SuddenOpening"),
    ".model.hydraulics.leg": ("HydraulicCylinder", "OilColumn"),
    ".model.linkage": (
        "Body",
        "Crank",
        "Gear",
        "LinearActuator",
        "Linkage",
        "Part",
        "PinPlace",
        "Slide",
        "TracePoint",
    ),
    ".model.loads.applied": ("AppliedForce", "AppliedTorque", "HarmonicCourse", "TableCourse"),
    ".model.loads.falling_block": ("FallingBlock",),
    ".model.loads.load": (
        "Load",
        "LoadChannel",
        "LoadedPoint",
        "LoadedStretch",
        "MomentLoad",
        "StretchLoad",
        "TurnedBody",
    ),
    ".model.loads.roofs": ("BeddedRoof", "GroundReaction", "Roof"),
    ".model.loads.springs": ("SpringDamper", "TorsionSpring"),
    ".model.machine": ("Machine",),
    ".model.pins": ("ClearancePin", "CompliantPin", "IdealPin", "Pin"),
    ".model.to_space": ("Width",),
    ".scenario.recorded_channels": ("Channel",),
    ".scenario.scenario": ("Scenario",),
    ".scenario.solver_settings": ("SolverSettings",),
    ".simulation.estimate": ("Estimate",),
    ".simulation.recommend": ("Recommendation", "recommend"),
    ".simulation.result": ("Result",),
    ".simulation.simulate": ("simulate",),
    "user_forces.contact": ("JournalContact",),
    "user_forces.friction.law": ("FrictionLaw",),
    "user_forces.journal": ("JournalBearing",),
    "user_forces.normal.law": ("NormalLaw",),
    "user_forces.values.value": ("InputError", "value"),
    ".files.own_modules": ("trusted",),
    ".files.scenarios.scenario_file": ("read_scenario",),
    ".files.scenarios.simple_scenario": ("simple_scenario",),
}
# what needs the engine or draws
_SHOWN = {
    ".postprocessing.export.solution_file": ("save_solution",),
    ".postprocessing.comparing.files_compared": ("FilesCompared", "compare_files"),
    ".postprocessing.known_channels": ("channels",),
    ".postprocessing.side_by_side": ("RunsSideBySide", "compare"),
}

__getattr__, __dir__ = offered(__name__, _PLACES | _SHOWN)
keep_classes(__name__, _PLACES)


def _presenter() -> Presenter:
    from support_exudyn.postprocessing import notebook

    return notebook


present_by(_presenter)
