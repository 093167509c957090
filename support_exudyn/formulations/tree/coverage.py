"""What the tree formulation covers; everything else is refused with what to do instead."""

from __future__ import annotations

from typing import NoReturn

from support_exudyn.formulations.tree.branches import LoopError, LooseError, branches
from support_exudyn.model.columns import TwoBodyColumn
from support_exudyn.model.hydraulic_cylinder import HydraulicCylinder
from support_exudyn.scenario.scenario import Scenario
from user_forces.values.value import InputError

INSTEAD = "formulation = 'redundant' covers it."


def check(scenario: Scenario) -> None:
    """Raise InputError if the tree formulation does not cover the scenario."""
    if scenario.dimensions == 3:
        _refuse("dimensions", "3", "2")
    if scenario.solver.backend in ("symbolic", "compiled"):
        # setting the variables of an expression and asking for it takes longer than calling the law
        _refuse("solver.backend", repr(scenario.solver.backend), "'auto', 'python'")
    for name, column in scenario.columns.items():
        if isinstance(column, HydraulicCylinder):
            _refuse(f"columns.{name}", "HydraulicCylinder, whose pressures are coordinates too", "OilColumn")
        if isinstance(column, TwoBodyColumn):
            _refuse(f"columns.{name}", "TwoBodyColumn, whose slide closes a loop", "OilColumn")
    for name, load in scenario.loads.items():
        _refuse(f"loads.{name}", type(load).__name__, "no loads")
    for name, pin in scenario.pins.items():
        if refused := pin.refused_by("tree"):
            _refuse(f"pins.{name}{refused.part}", refused.what, refused.allowed)
    for name, part in scenario.own_bodies.items():
        if part.jack.oil is None:
            _refuse(f"parts.{name}.jack", "rigid, a constraint that closes a loop", "OilColumn")
    linkage = scenario.linkage
    for kind, items in (("slides", linkage.slides), ("cranks", linkage.cranks)):
        for name in items:
            _refuse(f"{kind}.{name}", "a constraint that ties a branch to the ground", f"no {kind}")
    for name in linkage.columns:
        if name not in scenario.oil_columns:
            _refuse(f"columns.{name}", "rigid, a constraint that closes a loop", "OilColumn")
    try:
        branches(linkage, scenario.clearance_pins)
    except LoopError as loop:
        _refuse(f"pins.{loop}", "ideal, which closes a loop", "clearance in one pin of every loop")
    except LooseError as loose:
        _refuse(f"bodies.{loose}", "no chain of ideal pins to the ground", "exactly one")


def _refuse(where: str, what: str, allowed: str) -> NoReturn:
    raise InputError(f"{where} = {what}: not covered by formulation = 'tree'; allowed: {allowed}. {INSTEAD}")
