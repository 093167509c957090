"""What the compiled formulation covers; everything else is refused with what to do instead."""

from typing import NoReturn

import numpy as np

from support_exudyn.formulations.compiled.written import load_source
from support_exudyn.mechanics.kinetics import kinetics_of
from support_exudyn.model.bushing_pin import BushingPin
from support_exudyn.model.pins import ClearancePin, IdealPin, Pin
from support_exudyn.scenario.scenario import Scenario
from user_forces.compilation.flat import UnwrittenLawError, friction_source, law_source
from user_forces.values.value import InputError

WRITTEN = (
    "laws and loads written with the functions of user_forces.expressions.scalar, `where` in place of `if`"
)
PINS: tuple[type[Pin], ...] = (IdealPin, ClearancePin, BushingPin)  # kinds of pins that it has records for
REPEATED = 1e-9  # share of the largest singular value of all rows below which one of them repeats others


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
    rigid = [name for name in scenario.linkage.actuators if name not in scenario.compliant_actuators]
    held = kinetics_of(scenario.guided_linkage, scenario.held_pins, rigid)
    rows = held.rows(np.zeros(3 * len(scenario.linkage.bodies))) / np.sqrt(held.mass())
    if rows.size:
        values = np.linalg.svd(rows / np.linalg.norm(rows, axis=1)[:, None], compute_uv=False)
        if len(rows) > rows.shape[1] or values[-1] < REPEATED * values[0]:
            _refuse("machine", "joints that hold the same twice, or a dead centre", "joints that do not")


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
        "formulation = 'redundant' covers it."
    )
