"""Compiling ahead of time."""

from dataclasses import replace

from support_exudyn.files.machines import reference_support
from support_exudyn.model.hydraulics.elements import EndStops, SecondStage
from support_exudyn.model.hydraulics.leg import HydraulicCylinder, HydraulicLeg, OilColumn
from support_exudyn.model.hydraulics.valves import Line, Poppet, YieldValve
from support_exudyn.model.pins import ClearancePin
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scene.contract import silent
from user_forces.contact import JournalContact
from user_forces.journal import JournalBearing
from user_forces.normal.power_laws import Hertz


def warm_up(with_legs: bool = True) -> None:
    """Compile what scenes need, and keep it on disk for other processes.

    Runs of a moment: compiled code does not depend on the numbers.

    Arguments:
        with_legs: whether scenes have hydraulic legs, which take code of their own, in both formulations.
    """
    from support_exudyn.formulations import compiled  # and the compiler
    from support_exudyn.formulations.exudyn.run import run as run_exudyn

    contact = JournalContact(
        bearing=JournalBearing(bore_radius=0.0655, clearance=0.001), normal=Hertz(stiffness=1e10)
    )
    with_clearance = Scenario(
        machine=reference_support(), pins={"rear_base": ClearancePin(contact=contact)}, duration=1e-3
    )
    compiled.run(with_clearance, silent)
    compiled.run(replace(with_clearance, pins={}), silent)
    compiled.run(replace(with_clearance, start="settled"), silent)
    if with_legs:
        on_legs = replace(with_clearance, pins={}, actuators=_legs(), start="settled")
        compiled.run(on_legs, silent)
        run_exudyn(replace(on_legs, formulation="exudyn", step=1e-4), silent)


def _legs() -> dict[str, HydraulicLeg]:
    """Legs with valves of all kinds."""
    relief = YieldValve(
        opening_pressure=40e6,
        rated_flow=4e-3,
        rated_overpressure=1e6,
        poppet=Poppet(mass=0.5, stiffness=2e6, damping=300.0),
    )
    hose = Line(volume=4e-3, nominal_flow=5e-3, nominal_drop=2e6)
    stops = EndStops(lowest=-0.1, highest=0.5)
    stage = SecondStage(bore_area=0.06, oil_length=0.4, stops=stops, tube_mass=600.0, nominal_flow=8e-3)
    column = OilColumn(
        bore_area=0.098,
        oil_length=0.5,
        bulk_modulus=1.5e9,
        yield_valve=relief,
        line=hose,
        end_stops=stops,
        second_stage=stage,
    )
    cylinder = HydraulicCylinder(
        bore_area=0.098,
        rod_side_area=0.03,
        oil_length=0.5,
        rod_side_length=1.0,
        bulk_modulus=1.5e9,
        system_pressure=31.5e6,
        nominal_flow=6e-3,
        rod_relief=replace(relief, poppet=None),
    )
    return {"front_column": column, "rear_column": cylinder}
