"""What springs and dampers between two points look like: a zigzag and a rod, or a dashpot."""

import math

import numpy as np
from shapely.geometry import LineString

from support_exudyn.model.loads.springs import SpringDamper
from support_exudyn.model.to_space import at
from support_exudyn.postprocessing.look.shapes import plate, tube
from support_exudyn.postprocessing.look.solid import DrawnActuator
from support_exudyn.scenario.scenario import Scenario

TURNS = 6  # of a zigzag
ZIGZAG = (0.15, 0.75)  # of the length at the start, between which it lies
WIRE = 0.22  # half the thickness of what it is drawn with, of its half width
DASHPOT = 0.55  # length of a damper's cylinder, of its own at the start
OVERLAP = 1.05  # length of the rod that reaches into it


def springs(scenario: Scenario, half_width: float) -> list[DrawnActuator]:
    """A strut for each spring and damper between two points of a scenario; half_width: of a zigzag [m].

    The zigzag stays as it is while the rod at its other end follows.
    """
    loads = scenario.acting_loads.items()
    sides = 1.0 if scenario.dimensions == 3 else 0.0
    return [_strut(name, load, half_width, sides) for name, load in loads if isinstance(load, SpringDamper)]


def _strut(name: str, load: SpringDamper, half_width: float, sides: float) -> DrawnActuator:
    """sides: by which lateral places count, 0 in the plane."""
    foot, head = at(load.other_point, sides * load.other_lateral), at(load.point, sides * load.lateral)
    length, ends = math.dist(foot, head), (load.other, load.body, foot, head)
    if load.stiffness == 0.0:
        pot = tube((0.0, 0.0, 0.0), (DASHPOT * length, 0.0, 0.0), half_width)
        reach = OVERLAP - DASHPOT
        return DrawnActuator(
            name, *ends, pot, tube((-reach * length, 0.0, 0.0), (0.0, 0.0, 0.0), 0.4 * half_width)
        )
    first, last = (share * length for share in ZIGZAG)
    places = np.linspace(first, last, 2 * TURNS + 1)
    aside = [0.0, *(half_width * (-1.0) ** n for n in range(2 * TURNS - 1)), 0.0]
    wire = LineString([(0.0, 0.0), *zip(places.tolist(), aside, strict=True)])
    zigzag = plate(wire.buffer(WIRE * half_width, join_style="mitre"), 0.0, 2.0 * half_width)
    rod = tube((last - length, 0.0, 0.0), (0.0, 0.0, 0.0), WIRE * half_width)
    return DrawnActuator(name, *ends, zigzag, rod)
