"""What the compiled formulation covers; everything else is refused with what to do instead."""

from typing import NoReturn

from user_forces.compilation.flat import UnwrittenLawError, friction_source, law_source

from support_exudyn.formulations.compiled.written import load_source
from support_exudyn.mechanics.closing import repeated_count
from support_exudyn.model.bushing_pin import BushingPin
from support_exudyn.model.pins import ClearancePin, IdealPin, Pin
from support_exudyn.scenario.scenario import Scenario
from user_forces.values.value import InputError

WRITTEN = (
    "laws and loads written with the functions of user_forces.expressions.scalar, `where` in place of `if`"
)
PINS: tuple[type[Pin], ...] = (IdealPin, ClearancePin, BushingPin)  # kinds of pins that it has records for


def check(scenario: Scenario) -> None:
    """Raise InputError if the compiled formulation does not cover the scenario."""
    if scenario.dimensions == 3:
        _refuse("dimensions", "3", "2")
    for name, pin in scenario.pins.items():
        if type(pin) not in PINS:
            _refuse(f"pins.{name}", type(pin).__name__, ", ".join(kind.__name__ for kind in PINS))
    if scenario.solver.backend not in ("auto", "compiled"):
        _refuse("solver.backend", repr(scenario.solver.backend), "'auto', 'compiled'")
    _check_written(scenario)
    if repeated_count(scenario.held)[1]:
        _refuse("machine", "its start posture is a dead centre", "one beside it")


def _check_written(scenario: Scenario) -> None:
    """Raise InputError if a law or a load cannot be written out."""
    where = ""
    try:
        for name, place in scenario.contact_places.items():
            where = f"{place.of}.contact" if name in scenario.pins else place.of
            law_source(place.contact)
        for name, friction in scenario.friction_laws.items():
            where = f"{name}.friction"
            friction_source(friction)
        for name, load in scenario.acting_loads.items():
            where = f"loads.{name}"
            load_source(load)
    except UnwrittenLawError as error:
        _refuse(where, str(error), WRITTEN)


def _refuse(where: str, what: str, allowed: str) -> NoReturn:
    raise InputError(
        f"{where} = {what}: not covered by formulation = 'compiled'; allowed: {allowed}. "
        "formulation = 'exudyn' covers it."
    )
