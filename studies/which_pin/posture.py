"""What the closed form says of clearance pins: over the rise of a run, and under other loads."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

import numpy as np
import numpy.typing as npt

from studies.common.numbers import Number
from studies.common.rise import DEGREES, END, START
from studies.which_pin import closed_form as clearance
from studies.which_pin.closed_form import Press, Stand
from support_exudyn import ClearancePin, CubicStep, Scenario, Steady, reference_support
from support_exudyn.machines.four_bar_shield import PINS

Matrix = npt.NDArray[np.float64]

INSTANTS = 41  # of the rise; twice as many change its means by 1e-5
PLACES = 11  # of the stroke
STROKE = 0.5  # [m]
CREEP = 1e-3  # [m/s]: so slow that nothing has inertia


@cache
def _rise() -> tuple[Stand, ...]:
    return tuple(clearance.stands(reference_support(), CubicStep(), np.linspace(START, END, INSTANTS).tolist()))


def mean_shift(pins: Mapping[str, ClearancePin]) -> Matrix:
    """Mean shift over the rise, of clearance pins together:

    tip forward and up [m], canopy's tilt [rad], (3,).
    """
    found = np.array([sum(clearance.shifts(stand, pins).values()) for stand in _rise()])
    inner = found[1:-1].sum(axis=0) + 0.5 * (found[0] + found[-1])  # the rule of trapezoids
    mean: Matrix = inner / (INSTANTS - 1)
    return mean


def posture_numbers(case: str, scenario: Scenario) -> list[Number]:
    """The closed form's numbers for a case that was run."""
    along, up, tilt = mean_shift(scenario.clearance_pins).tolist()
    return [
        Number("closed_form_tip_shift_forward", case, 1e3 * along, "mm", 0.0),
        Number("closed_form_tip_shift_up", case, 1e3 * up, "mm", 0.0),
        Number("closed_form_canopy_tilt", case, DEGREES * tilt, "deg", 0.0),
    ]


@dataclass(frozen=True)
class UnderLoad:
    """What each pin moves the tip by under a load, along the stroke.

    extension: of the columns [m], (n,). shift: by pin, forward [m], (n,). thrust: least of both columns on the
    way [N]; negative: one is pulled.
    """

    extension: Matrix
    shift: Mapping[str, Matrix]
    thrust: float

    def mean(self, name: str) -> float:
        """Mean along the stroke [m]."""
        return float(self.shift[name].mean())


def loads(pin: ClearancePin) -> dict[str, UnderLoad]:
    """A pin without friction in all five places, under several loads, at rest."""
    support = reference_support()
    start = support.start()
    middle = tuple(
        0.5 * (a + b) for a, b in zip(start.ends["front_head"], start.ends["rear_head"], strict=True)
    )
    over = {"columns": (middle[0], middle[1]), "hinge": start.hinge, "tip": start.tip}
    presses = {
        "weight alone": (),
        "1 MN down over the columns": (Press("canopy", over["columns"], (0.0, -1e6)),),
        "100 kN down over the hinge": (Press("canopy", over["hinge"], (0.0, -1e5)),),
        "100 kN down on the tip": (Press("canopy", over["tip"], (0.0, -1e5)),),
        "100 kN to the rear": (Press("canopy", over["columns"], (-1e5, 0.0)),),
        "100 kN forward": (Press("canopy", over["columns"], (1e5, 0.0)),),
    }
    extension = np.linspace(0.0, STROKE, PLACES)
    along = clearance.stands(support, Steady(rate=CREEP), (extension / CREEP).tolist())
    return {name: _under(pin, along, extension, press) for name, press in presses.items()}


def _under(pin: ClearancePin, along: list[Stand], extension: Matrix, presses: tuple[Press, ...]) -> UnderLoad:
    pins = dict.fromkeys(PINS, pin)
    found = [clearance.shifts(stand, pins, presses) for stand in along]
    thrust = min(-float(clearance.forces(stand, {}, presses)[2 * len(PINS) :].max()) for stand in along)
    return UnderLoad(extension, {name: np.array([one[name][0] for one in found]) for name in PINS}, thrust)
