"""What pictures show of a pin: the force in it, and the journal in its bore, at all records."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.pins import ClearancePin
from support_exudyn.postprocessing.look.placed_pins import placed_pins
from support_exudyn.postprocessing.look.poses import Poses
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError, short

WHY = "pictures show it"


@dataclass(frozen=True)
class Bore:
    """A journal in its bore, at the records.

    Arguments:
        pin: of the scenario.
        eccentricity: of the journal's centre from the bore's, forward and up, shape (n, 2) [m]; in space
            that of the middle of the bearing.
        touching: whether it is in contact, shape (n,).
        carrier: name of the body that has the bore.
        can_tilt: whether the journal may touch with an edge while its middle is away from the wall.
    """

    pin: ClearancePin
    eccentricity: Series
    touching: npt.NDArray[np.bool_]
    carrier: str
    can_tilt: bool = False


@dataclass(frozen=True)
class PinView:
    """A pin at the records.

    Arguments:
        name: of the pin, as the channels know it.
        on: of what the force is said to be on.
        force: forward and up, shape (n, 2) [N].
        path: where the pin is, shape (n, 3) [m].
        bore: None if the pin is ideal.
    """

    name: str
    on: str
    force: Series
    path: Series
    bore: Bore | None

    @property
    def size(self) -> Series:
        """Magnitude of the force, as far as it is in the plane (n,) [N]."""
        size: Series = np.hypot(self.force[:, 0], self.force[:, 1])
        return size


def pin_names(result: Result) -> list[str]:
    """All pins, by what channels call them; loose ones first."""
    known = sorted(placed_pins(result.scenario), key=lambda pin: pin.loose is None)
    return [pin.name for pin in known]


def pin_view(result: Result, name: str | None = None) -> PinView | None:
    """A pin by its name; None: the first loose one, or the first of all, or nothing if the machine has no pins.

    Raises InputError if there is no such pin, or if a channel that this needs was not recorded.
    """
    names = pin_names(result)
    if name is None and not names:
        return None
    if name is not None and name not in names:
        raise InputError(f"pin = {short(name)}: no such pin; allowed: {', '.join(names) or 'none'}")
    name = name or names[0]
    pin = next(pin for pin in placed_pins(result.scenario) if pin.name == name)
    sign = -1.0 if pin.bore_is_second else 1.0
    force = sign * np.column_stack([result.recorded(f"pin.{name}.force_{axis}", WHY) for axis in "xy"])
    path = Poses(result).of(pin.bore.body).path(pin.bore.point)
    if pin.loose is None:
        return PinView(name, pin.second.body.replace("_", " "), force, path, None)
    bore = Bore(
        pin.loose,
        _eccentricity(result, name),
        np.hypot(*force.T) > 0.0,
        pin.bore.body,
        result.scenario.dimensions == 3,
    )
    return PinView(name, "journal", force, path, bore)


def _eccentricity(result: Result, name: str) -> Series:
    sides = ("left_", "right_") if result.scenario.dimensions == 3 else ("",)
    ends = [
        np.column_stack([result.recorded(f"pin.{name}.{side}eccentricity_{axis}", WHY) for axis in "xy"])
        for side in sides
    ]
    middle: Series = np.mean(ends, axis=0)
    return middle
