"""Pins of a run as pictures show them: forces, journals in their bores, and the scales of both."""

import math
from contextlib import suppress
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.pins import ClearancePin
from support_exudyn.postprocessing.look.poses import Poses, placed_pins
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError, short

WHY = "pictures show it"
SHOWN = 0.2  # clearance in the picture, of the bore's radius, at least
STEPS = (1.0, 2.0, 5.0, 10.0)
MOST = 0.97  # share of forces that arrows and axes are made for; what is beyond is cut


@dataclass(frozen=True)
class Bore:
    """A journal in its bore, at the records.

    Arguments:
        pin: of the scenario.
        eccentricity: of the journal's centre from the bore's, forward and up, shape (n, 2) [m]; in space
            that of the middle of the bearing.
        closed: whether it is in contact, shape (n,).
        carrier: name of the body that has the bore.
        can_tilt: whether the journal may make contact with an edge while its middle is away from the wall.
    """

    pin: ClearancePin
    eccentricity: Series
    closed: npt.NDArray[np.bool_]
    carrier: str
    can_tilt: bool = False

    @property
    def enlargement(self) -> float:
        """By how much the clearance is enlarged in pictures, so that it is seen."""
        bearing = self.pin.contact.bearing
        return max(1.0, round_up(SHOWN * bearing.bore_radius / bearing.clearance))


@dataclass(frozen=True)
class PinView:
    """A pin at the records.

    Arguments:
        name: of the pin, as the channels know it.
        on: on which body, or journal, the force acts.
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


def pin_view(result: Result, name: str | None = None) -> PinView | None:
    """A pin by its name; None: the first with clearance, or the first of all, or nothing without pins.

    Raises InputError if there is no such pin, or if a channel that this needs was not recorded.
    """
    pins = sorted(placed_pins(result.scenario), key=lambda pin: pin.with_clearance is None)
    known = {pin.name: pin for pin in pins}
    if name is None and not known:
        return None
    if name is not None and name not in known:
        raise InputError(f"pin = {short(name)}: no such pin; allowed: {', '.join(known) or 'none'}")
    pin = pins[0] if name is None else known[name]

    def vector(what: str) -> Series:
        return np.column_stack([result.recorded(f"pin.{pin.name}.{what}_{axis}", WHY) for axis in "xy"])

    force = vector("force") * (-1.0 if pin.bore_is_second else 1.0)
    path = Poses(result).of(pin.bore.body).path(pin.bore.point)
    if pin.with_clearance is None:
        return PinView(pin.name, pin.second.body.replace("_", " "), force, path, None)
    in_space = result.scenario.dimensions == 3
    ends = [vector(f"{side}eccentricity") for side in (("left_", "right_") if in_space else ("",))]
    closed = np.hypot(*force.T) > 0.0
    bore = Bore(pin.with_clearance, np.mean(ends, axis=0), closed, pin.bore.body, in_space)
    return PinView(pin.name, "journal", force, path, bore)


def pin_views(result: Result, name: str | None = None) -> list[PinView]:
    """A pin as `pin_view` gives it, then all other clearance pins whose force and journal were recorded."""
    views = [view for view in [pin_view(result, name)] if view is not None]
    for pin in placed_pins(result.scenario):
        if views and pin.with_clearance is not None and pin.name != views[0].name:
            with suppress(InputError):  # not recorded
                views += [view for view in [pin_view(result, pin.name)] if view is not None]
    return views


# --- round numbers for scales ---


def round_up(number: float) -> float:
    """The next of ..., 1, 2, 5, 10, ...; 1 for what is not above 0."""
    if not number > 0.0:
        return 1.0
    power = 10.0 ** math.floor(math.log10(number))
    return next(step * power for step in STEPS if step * power >= number * (1.0 - 1e-9))


def round_down(number: float) -> float:
    """The last of ..., 1, 2, 5, 10, ... that is not above it; 1 for what is not above 0."""
    return 1.0 / round_up(1.0 / number) if number > 0.0 else 1.0


def usual(sizes: Series) -> float:
    """A size that nearly all, without those that are 0, do not exceed; 1 if there are none."""
    there = sizes[sizes > 0.0]
    return float(np.quantile(there, MOST)) if there.size else 1.0


def said(number: float) -> str:
    """A round number as it is written."""
    return f"{number:,.0f}".replace(",", " ") if number >= 1.0 else f"{number:g}"
