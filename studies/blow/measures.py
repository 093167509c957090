"""What is measured of a blow: pressures of legs, flow through valves, forces of pins, tilt of the canopy."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from studies.blow.cases import PERIOD, Blow
from studies.common.numbers import Found, Number, measured
from studies.common.rise import DEGREES, MeasuredRun, Series, between
from studies.common.support_legs import PAIRS
from support_exudyn import Result
from support_exudyn.machines.four_bar_shield import PINS as ALL_PINS

BEFORE = 4 * PERIOD  # a blow, when all is still at rest [s]
Ran = Mapping[str, tuple[Blow, Result]]


@dataclass(frozen=True)
class Struck:
    """The records of a run from just before the blow on."""

    blow: Blow
    run: MeasuredRun

    def of(self, channel: str) -> Series:
        """A channel from just before the blow on, shape (n,)."""
        inside = between(self.run, self.blow.strike - BEFORE, float(self.run.time[-1]))
        found: Series = self.run[channel][inside]
        return found

    @property
    def pressure(self) -> float:
        """Largest pressure in any leg [Pa]."""
        return max(float(self.of(f"{name}.pressure").max()) for name in PAIRS)

    @property
    def rise(self) -> float:
        """Largest rise of the pressure of any leg above that before the blow [Pa]."""
        courses = [self.of(f"{name}.pressure") for name in PAIRS]
        return max(float((one - one[0]).max()) for one in courses)

    @property
    def least_pressure(self) -> float:
        """Least pressure in any leg [Pa]."""
        return min(float(self.of(f"{name}.pressure").min()) for name in PAIRS)

    @property
    def flow(self) -> float:
        """Largest flow through the yield valves of a pair of legs [m^3/s]."""
        return max(float(self.of(f"{name}.yield_flow").max()) for name in PAIRS)

    @property
    def volume(self) -> float:
        """Oil that all valves have let out [m^3]."""
        return sum(float(self.of(f"{name}.yielded")[-1]) for name in PAIRS)

    @property
    def pin_force(self) -> float:
        """Largest force of any pin [N]."""
        return max(self.force_of(pin) for pin in ALL_PINS)

    def force_of(self, pin: str) -> float:
        """Largest force of a pin [N]."""
        return float(self.of(f"pin.{pin}.force").max())

    @property
    def tilt(self) -> float:
        """Largest turn of the canopy from where it was, with its sign [rad]; negative: its tip goes down."""
        turn = self.of("canopy.angle") - self.of("canopy.angle")[0]
        return float(turn[np.argmax(np.abs(turn))])

    @property
    def block_force(self) -> float:
        """Largest force of the block [N]."""
        return float(self.of("block.force").max())


MEASURES = {  # unit and scale from SI, by the name of a property
    "pressure": ("MPa", 1e-6),
    "rise": ("MPa", 1e-6),
    "least_pressure": ("MPa", 1e-6),
    "flow": ("l/min", 6e4),
    "volume": ("l", 1e3),
    "pin_force": ("kN", 1e-3),
    "tilt": ("deg", DEGREES),
    "block_force": ("kN", 1e-3),
}
OF_VALVES = ("flow", "volume")


def numbers(ran: Ran) -> list[Number]:
    """All numbers of the study."""
    return [
        measured(measure, name, unit, run, _of(blow, measure, scale))
        for name, (blow, run) in ran.items()
        for measure, (unit, scale) in MEASURES.items()
        if blow.valve or measure not in OF_VALVES
    ]


def _of(blow: Blow, measure: str, scale: float) -> Callable[[MeasuredRun], float]:
    return lambda run: scale * float(getattr(Struck(blow, run), measure))


def ratios(found: Found, measure: str, blows: list[Blow], change: Callable[[Blow], Blow]) -> list[float]:
    """A measure of blows over that of what they are changed into, those alone that were run both."""
    pairs = [(blow.name, change(blow).name) for blow in blows]
    return [
        found[measure, name].value / found[measure, other].value
        for name, other in pairs
        if name != other and (measure, name) in found and (measure, other) in found
    ]


def strongest_pin(blow: Blow, run: MeasuredRun) -> str:
    """The pin of the linkage whose force is the largest in a blow."""
    struck = Struck(blow, run)
    return max(ALL_PINS, key=struck.force_of)
