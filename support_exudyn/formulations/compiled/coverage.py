"""What the compiled formulation covers; everything else is refused with what to do instead."""

from typing import NoReturn

from support_exudyn.mechanics.closing import repeated_count
from support_exudyn.model.pins import ClearancePin, CompliantPin, IdealPin, Pin
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scene.compilation import UncompiledLawError, address_of, contact_law, load_law
from support_exudyn.scene.setup import friction_law
from user_forces.values.value import InputError

COMPILED = "laws and loads that are functions of numbers, in what numba knows of Python"
PINS: tuple[type[Pin], ...] = (IdealPin, ClearancePin, CompliantPin)  # kinds of pins that it has records for


def check(scenario: Scenario) -> None:
    """Raise InputError if the compiled formulation does not cover the scenario."""
    if scenario.dimensions == 3:
        _refuse("dimensions", "3", "2")
    for name, pin in scenario.pins.items():
        if not isinstance(pin, PINS):
            _refuse(f"pins.{name}", type(pin).__name__, ", ".join(kind.__name__ for kind in PINS))
    _check_compiled(scenario)
    if repeated_count(scenario.held)[1]:
        _refuse("machine", "its start posture is a dead centre", "one beside it")


def _check_compiled(scenario: Scenario) -> None:
    """Raise InputError if a law or a load cannot be compiled."""
    where = what = ""
    try:
        for name, place in scenario.contact_places.items():
            where, what = f"{place.of}.contact" if name in scenario.pins else place.of, "a law"
            address_of(contact_law(place.contact.law_kernel, len(place.contact.law_constants)))
        for name, friction in scenario.friction_laws.items():
            where, what = f"{name}.friction", type(friction).__name__
            address_of(friction_law(friction)[0])
        for name, load in scenario.elements.items():
            where = f"loads.{name}" if name in scenario.acting_loads else name
            what = type(load).__name__
            address_of(load_law(load)[0])
    except UncompiledLawError as error:
        _refuse(where, f"{what} ({error})", COMPILED)


def _refuse(where: str, what: str, allowed: str) -> NoReturn:
    raise InputError(
        f"{where} = {what}: not covered by formulation = 'compiled'; allowed: {allowed}. "
        "formulation = 'exudyn' covers it."
    )
