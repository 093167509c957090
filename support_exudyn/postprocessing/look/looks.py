"""Which look a machine has, by its class. A look for a class of one's own is registered here, from anywhere:

@look_of.register
def _(machine: MyMachine, scenario: Scenario) -> Look: ...
"""

from __future__ import annotations

from functools import singledispatch

from support_exudyn.machines.four_column_support import HydraulicSupport
from support_exudyn.machines.two_leg_shield import TwoLegShield
from support_exudyn.model.machine import Machine
from support_exudyn.postprocessing.look import plain, shield
from support_exudyn.postprocessing.look.shapes import Look
from support_exudyn.scenario.scenario import Scenario


@singledispatch
def look_of(machine: Machine, scenario: Scenario) -> Look:
    """The look of a machine in a scenario: plates around its joints unless its class has a look of its own."""
    del machine
    return plain.look(scenario)


@look_of.register(HydraulicSupport)
@look_of.register(TwoLegShield)
def _shield(machine: Machine, scenario: Scenario) -> Look:
    del machine
    return shield.look(scenario)


def look(scenario: Scenario) -> Look:
    """All that pictures, meshes and the viewer show of a scenario's machine, start posture."""
    return look_of(scenario.machine, scenario)
