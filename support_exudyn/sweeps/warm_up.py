"""Compiling ahead of time."""

from dataclasses import replace

from support_exudyn.files.machines import reference_support
from support_exudyn.model.pins import ClearancePin
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scene.contract import silent
from user_forces.contact import JournalContact
from user_forces.journal import JournalBearing
from user_forces.normal.power_laws import Hertz


def warm_up() -> None:
    """Compile what scenes without hydraulic legs need, and keep it on disk for other processes.

    Runs of a moment: compiled code does not depend on the numbers.
    """
    from support_exudyn.formulations import compiled  # and the compiler

    contact = JournalContact(
        bearing=JournalBearing(bore_radius=0.0655, clearance=0.001), normal=Hertz(stiffness=1e10)
    )
    with_clearance = Scenario(
        machine=reference_support(), pins={"rear_base": ClearancePin(contact=contact)}, duration=1e-3
    )
    compiled.run(with_clearance, silent)
    compiled.run(replace(with_clearance, pins={}), silent)
    compiled.run(replace(with_clearance, start="settled"), silent)
