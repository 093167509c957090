"""Blocks of rock that fall on a machine."""

from __future__ import annotations

from shapely.geometry import box

from support_exudyn.model.loads.falling_block import FallingBlock
from support_exudyn.postprocessing.look.shapes import plate
from support_exudyn.postprocessing.look.solid import Role, Solid
from support_exudyn.scenario.scenario import Scenario


def blocks(scenario: Scenario) -> list[Solid]:
    """A cube for each falling block, of its mass and density, where it starts."""
    found = []
    for name, load in scenario.loads.items():
        if isinstance(load, FallingBlock):
            x, y = scenario.linkage.bodies[name].centre
            half = 0.5 * load.side
            mesh = plate(box(x - half, y - half, x + half, y + half), 0.0, load.side)
            found.append(Solid(name, name, Role.ROCK, mesh))
    return found
