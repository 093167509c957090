"""Pins of a run as pictures show them: forces, journals in their bores, and the scales of both."""

import math
from contextlib import suppress
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.look.poses import PlacedPin, Poses, placed_pins
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError, short

WHY = "pictures show it"
SHOWN = 0.2  # clearance in the picture, of the bore's radius, at least
STEPS = (1.0, 2.0, 5.0, 10.0)
MOST = 0.97  # share of forces that arrows and axes are made for; what is beyond is cut


@dataclass(frozen=True)
class PinView:
    """A pin at the records.

    Arguments:
        pin: with its two ends.
        force: on the journal, of an ideal pin on the second body; forward and up, shape (n, 2) [N].
        path: of the bore, shape (n, 3) [m].
        eccentricity: of the journal's centre from the bore's, forward and up, shape (n, 2) [m]; in space in the
            middle of the bearing. Zero if the pin is ideal.
    """

    pin: PlacedPin
    force: Series
    path: Series
    eccentricity: Series

    @property
    def name(self) -> str:
        """The name of the pin, as the channels know it."""
        return self.pin.name

    @property
    def is_loose(self) -> bool:
        """Whether the pin has clearance."""
        return self.pin.with_clearance is not None

    @property
    def size(self) -> Series:
        """Magnitude of the force in the plane (n,) [N]."""
        size: Series = np.hypot(*self.force.T)
        return size

    @property
    def closed(self) -> npt.NDArray[np.bool_]:
        """Whether the journal is in contact (n,)."""
        return self.size > 0.0

    @property
    def enlargement(self) -> float:
        """The factor by which the clearance is enlarged in pictures, so that it is seen."""
        assert self.pin.with_clearance is not None
        bearing = self.pin.with_clearance.contact.bearing
        return max(1.0, round_up(SHOWN * bearing.bore_radius / bearing.clearance))

    def enlarged(self, records: int | slice, radius: float) -> tuple[Series, float]:
        """The journal's centre from the bore's, and its radius, in the unit of the drawn bore's radius."""
        assert self.pin.with_clearance is not None
        bearing = self.pin.with_clearance.contact.bearing
        scale = self.enlargement * radius / bearing.bore_radius
        return scale * self.eccentricity[records], radius - scale * bearing.clearance


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
    return PinView(pin, force, path, vector("eccentricity") if pin.with_clearance else np.zeros_like(force))


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
