"""Pins of a run as pictures show them: forces, journals in their bores, and the scales of both."""

import math
from contextlib import suppress
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.pins import ClearancePin
from support_exudyn.postprocessing.look.poses import PlacedPin, Poses, placed_pins
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
        """The factor by which the clearance is enlarged in pictures, so that it is seen."""
        bearing = self.pin.contact.bearing
        return max(1.0, round_up(SHOWN * bearing.bore_radius / bearing.clearance))

    def enlarged(self, records: int | slice, radius: float) -> tuple[Series, float]:
        """The journal's centre from the bore's, and the journal's radius, in a picture.

        radius: of the drawn bore, in any unit, which is that of the results.
        """
        bearing = self.pin.contact.bearing
        scale = self.enlargement * radius / bearing.bore_radius
        return scale * self.eccentricity[records], radius - scale * bearing.clearance


@dataclass(frozen=True)
class PinView:
    """A pin at the records.

    Arguments:
        name: of the pin, as the channels know it.
        on: the body, or the journal, on which the force acts.
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


def pin_views(result: Result, name: str | None = None) -> list[PinView]:
    """A pin by its name, then all other clearance pins whose force and journal were recorded.

    Without a name the first pin with clearance, or the first of all; nothing of runs without pins.

    Raises InputError if there is no such pin, or if a channel that it needs was not recorded.
    """
    pins = sorted(placed_pins(result.scenario), key=lambda pin: pin.with_clearance is None)
    chosen = pins[0] if pins and name is None else next((pin for pin in pins if pin.name == name), None)
    if chosen is None:
        if name is None:
            return []
        known = ", ".join(pin.name for pin in pins) or "none"
        raise InputError(f"pin = {short(name)}: no such pin; allowed: {known}")
    views = [_view(result, chosen)]
    for pin in pins:
        if pin.with_clearance is not None and pin is not chosen:
            with suppress(InputError):  # not recorded
                views.append(_view(result, pin))
    return views


def _view(result: Result, pin: PlacedPin) -> PinView:
    def vector(what: str) -> Series:
        return np.column_stack([result.recorded(f"pin.{pin.name}.{what}_{axis}", WHY) for axis in "xy"])

    force = vector("force") * (-1.0 if pin.bore_is_second else 1.0)
    path = Poses(result).of(pin.bore.body).path(pin.bore.point)
    if pin.with_clearance is None:
        return PinView(pin.name, pin.second.body.replace("_", " "), force, path, None)
    in_space = result.scenario.dimensions == 3
    ends = [vector(f"{side}eccentricity") for side in (("left_", "right_") if in_space else ("",))]
    bore = Bore(pin.with_clearance, np.mean(ends, axis=0), np.hypot(*force.T) > 0.0, pin.bore.body, in_space)
    return PinView(pin.name, "journal", force, path, bore)


# --- round numbers for scales ---


def round_up(number: float) -> float:
    """The next of ..., 1, 2, 5, 10, ...; 1 for what is not above 0."""
    if not number > 0.0:
        return 1.0
    power = 10.0 ** math.floor(math.log10(number))
    return next(step * power for step in STEPS if step * power >= number * (1.0 - 1e-9))


def usual(sizes: Series) -> float:
    """A size that nearly all, without those that are 0, do not exceed; 1 if there are none."""
    there = sizes[sizes > 0.0]
    return float(np.quantile(there, MOST)) if there.size else 1.0


def format_round(number: float) -> str:
    """A round number as it is written."""
    return f"{number:,.0f}".replace(",", " ") if number >= 1.0 else f"{number:g}"
