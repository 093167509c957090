"""Which scenarios can be written for ADAMS; the others are refused with a sentence."""

from collections.abc import Iterator

from studies.adams.clearance import check_law
from support_exudyn import CubicStep, Scenario
from support_exudyn.model.actuators import RigidActuator
from support_exudyn.model.drives.drive import Held
from support_exudyn.model.pins import ClearancePin, IdealPin
from user_forces.values.value import InputError


def check(scenario: Scenario) -> None:
    """Raise InputError with a line for everything that the writer has no statements for."""
    reasons = list(_reasons(scenario))
    if reasons:
        raise InputError("\n".join(reasons))


def _reasons(scenario: Scenario) -> Iterator[str]:
    linkage = scenario.linkage
    if scenario.dimensions != 2:
        yield f"dimensions = {scenario.dimensions}: allowed: 2"
    if scenario.start != "concentric":
        yield f"start = {scenario.start!r}: allowed: 'concentric'"
    for name, pin in scenario.pins.items():
        if isinstance(pin, ClearancePin):
            try:
                check_law(name, pin)
            except InputError as error:
                yield str(error)
        elif not isinstance(pin, IdealPin):
            yield f"pins.{name} = {type(pin).__name__}: allowed: ideal pins, and ClearancePin"
        elif pin.friction is not None:
            yield f"pins.{name}.friction = {type(pin.friction).__name__}: allowed: an ideal pin without"
    for name, model in scenario.actuators.items():
        if not isinstance(model, RigidActuator):
            yield f"actuators.{name} = {type(model).__name__}: allowed: RigidActuator"
    for name in scenario.own_bodies:
        yield f"parts.{name}: a body of its own; allowed: parts that are fixed to their bodies"
    for name in (*scenario.acting_loads, *scenario.blocks):
        yield f"loads.{name}: allowed: none but the weight"
    others = {"cranks": linkage.cranks, "slides": linkage.slides, "gears": linkage.gears}
    for kind, items in others.items():
        for name in items:
            yield f"{kind}.{name}: allowed: machines of bodies, pins and columns"
    for name in linkage.actuators:
        drive = scenario.drive_of(name)
        if not isinstance(drive, (CubicStep, Held)):
            yield f"drives.{name} = {type(drive).__name__}: allowed: CubicStep, the STEP function, or Held"
    for name, body in linkage.bodies.items():
        if any(body.velocity) or body.spin:
            yield f"bodies.{name}: moves at the start; allowed: machines that start at rest"
