"""Valves of hydraulic legs, through which oil gets from room to room: data, and their flows as kernels.

Rooms of a leg are its "piston" and "rod" sides, the "tube" of two stages, the "line", and those that valves
bring. Sources, of constant pressure, are the "tank" and the "supply" of the inlet.
"""

from __future__ import annotations

import math
from abc import ABC
from collections.abc import Callable, Mapping
from functools import cached_property
from types import MappingProxyType
from typing import ClassVar, NamedTuple

from pydantic import model_validator

from support_exudyn.model.hydraulics.elements import Shared, TrappedAir
from user_forces.kernel import Formula, formula_of, kernel
from user_forces.values.units import (
    CubicMetres,
    CubicMetresPerSecond,
    Kilograms,
    NewtonSecondsPerMetre,
    NewtonsPerMetre,
    Pascals,
)
from user_forces.values.value import NonNegative, Positive, Value, value

SMOOTH = 1e-3  # share of the nominal drop below which flow is laminar
SEAT = 100.0  # a poppet's seat is so many times as stiff as its spring, and critically damped
DRAINED = 0.1  # of the opening pressure, below which an open poppet passes less, and nothing without pressure
SHUT = -1e300  # a gap that nothing closes: the inlet is shut
NO_GAP = math.nan  # of a valve with which nothing happens
INPUTS = 6  # numbers of an action before states
OWN = "own"  # the room that a valve brings
NO_CHECK = (0.0, 0.0, 1.0, 0.0)  # numbers of a check valve that is not there


class LegChannel(NamedTuple):
    """A channel of a leg: its unit, and what it is."""

    unit: str
    meaning: str


class Room(NamedTuple):
    """A chamber of a leg.

    volume: at the start [m^3]. by_travel, by_length: growth of the volume by the extension of the outer stage,
    and by that of the whole leg [m^2]; without a second stage they are the same. air: trapped in it.
    """

    volume: float
    by_travel: float = 0.0
    by_length: float = 0.0
    air: TrappedAir | None = None


class Path(NamedTuple):
    """A way of the oil in a leg.

    formula: the action, see `LegValve`, and its parameters. before, after: rooms or sources. back: in place of
    `before` while the opening of the inlet is negative; empty: the same. flow, passed, loss: channels of the
    flow, of the oil that has passed, and of the energy that is lost; empty: none. Others: see `LegValve`.
    """

    formula: Formula
    before: str
    after: str
    back: str = ""
    flow: str = ""
    passed: str = ""
    loss: str = ""
    event: str = ""
    states: Mapping[str, LegChannel] = MappingProxyType({})
    sizes: tuple[float, ...] = ()
    remembers: bool = False
    joins: bool = False


@value
class LegValve(Shared, Value, ABC):
    """Something through which oil flows between two rooms of a leg, by a function of numbers, its `action`.

        action(before, after, pilot, opening, travel, memory, *states, *parameters)
            = (flow, gap, *rates of its states, *states at which it rests with these pressures)

    It is a static method and a `user_forces.kernel.kernel`, in plain Python with `if` and `math`, which Python
    runs and numba compiles. Both solvers, the static equilibrium and the records call it. It takes pressures
    before and behind it, and that with which the inlet supplies the rod side [Pa], the opening of the inlet,
    the extension of the (outer) stage since the start [m], and its memory: 1 if its gap became positive last,
    else 0. Parameters are named as attributes of the valve; the last one may be `*name`, for a tuple. The flow
    [m^3/s] is positive from before to after, continuous, and smooth but where the gap [Pa] passes zero, at
    which solvers end a step; NO_GAP if nothing happens. All that the action gives are floats.

    The energy that is lost follows from flow and pressures. A new kind of valve is one class: its action, and
    in the class BEFORE and AFTER, the rooms that it joins, "own" for the `room` that it brings; EVENT, what
    begins where its gap becomes positive; STATES, by name, with the channels that they are recorded as; JOINS,
    whether both rooms have the same pressure in a static equilibrium.
    """

    action: ClassVar[Callable[..., tuple[float, ...]]]
    BEFORE: ClassVar[str] = "piston"
    AFTER: ClassVar[str] = "tank"
    EVENT: ClassVar[str] = "open"
    JOINS: ClassVar[bool] = False
    STATES: ClassVar[Mapping[str, LegChannel]] = {}

    @cached_property
    def formula(self) -> Formula:
        """The action with this valve's parameters."""
        return formula_of(self, type(self).action, INPUTS + len(self.STATES))

    @property
    def room(self) -> Room | None:
        """The room that it brings, of constant volume; none by default."""
        return None

    @property
    def sizes(self) -> tuple[float, ...]:
        """Sizes of its states over that of the leg's pressure, by which errors are weighed; 1 by default."""
        return (1.0,) * len(self.STATES)

    @property
    def remembers(self) -> bool:
        """Whether the flow depends on its memory; not by default."""
        return False

    def path(self, name: str) -> Path:
        """The way of the oil through it, if it has this name in its leg."""
        return Path(
            self.formula,
            before=name if self.BEFORE == OWN else self.BEFORE,
            after=name if self.AFTER == OWN else self.AFTER,
            flow=f"{name}.flow",
            passed=f"{name}.passed",
            loss=f"{name}.loss",
            event=f"{name} {self.EVENT}",
            states={f"{name}.{state}": channel for state, channel in self.STATES.items()},
            sizes=self.sizes,
            remembers=self.remembers,
            joins=self.JOINS,
        )


# --- inlet, check valve, line ---


@kernel
def orifice(drop: float, smooth: float) -> float:
    """Root of a pressure drop [Pa^0.5] with its sign, laminar below `smooth` [Pa]."""
    size = drop * drop + smooth * smooth
    return drop / math.sqrt(math.sqrt(size)) if size > 0.0 else 0.0


@kernel
def checked(
    ahead: float, pressure: float, pilot: float, there: float, ratio: float, width: float, cracking: float
) -> tuple[float, float]:
    """Pressure drop that moves oil into the piston side [Pa], and the share of its flow that passes.

    Arguments:
        ahead: pressure before the piston side less that in it [Pa]. pressure: in it. pilot: that releases it.
        there, ratio, width, cracking: see `CheckValve.numbers`.
    """
    if there == 0.0:
        return ahead, 1.0
    if ahead > cracking:
        return ahead - cracking, 1.0
    return min(0.0, ahead), min(1.0, max(0.0, (ratio * pilot - pressure) / width))


@kernel
def let_in(
    before: float, after: float, pilot: float, opening: float, travel: float, memory: float,
    factor: float, smooth: float, there: float, ratio: float, width: float, cracking: float,
) -> tuple[float, float]:  # fmt: skip
    """Action of one side of an inlet, with a check valve or without."""
    drop, share = checked(before - after, after, pilot, there, ratio, width, cracking)
    gap = NO_GAP
    if there != 0.0:
        gap = before - after - cracking if opening > 0.0 else SHUT
    return share * factor * abs(opening) * orifice(drop, smooth), gap


@kernel
def pass_line(
    before: float, after: float, pilot: float, opening: float, travel: float, memory: float,
    resistance: float, there: float, ratio: float, width: float, cracking: float,
) -> tuple[float, float]:  # fmt: skip
    """Action of a line, and of a check valve behind it."""
    drop, share = checked(before - after, after, pilot, there, ratio, width, cracking)
    return share * drop / resistance, before - after - cracking if there != 0.0 else NO_GAP


@value
class CheckValve(Value):
    """A pilot-operated check valve on the piston side: oil flows in freely, and out only if it is released.

    Oil flows in while the supply has more than the chamber's pressure and the cracking pressure together. The
    pressure that the inlet connects the rod side to releases it: out flows

        s Q,   s = min(1, max(0, (r pilot - p) / range))

    where Q is what would flow without the valve, and p is the chamber's pressure.

    Arguments:
        pilot_ratio: r, area of the pilot piston over that of the seat [-], > 0.
        pilot_range: of the pressure between the first opening and the full one [Pa], > 0.
        cracking_pressure: that opens it inwards [Pa], >= 0.
    """

    pilot_ratio: Positive = 4.0
    pilot_range: Pascals[Positive] = 1e6
    cracking_pressure: Pascals[NonNegative] = 0.0

    @property
    def numbers(self) -> tuple[float, ...]:
        """1, as it is there, ratio and range of the pilot pressure, and cracking pressure."""
        return 1.0, self.pilot_ratio, self.pilot_range, self.cracking_pressure


@value
class Line(LegValve):
    """A hose between the inlet and the piston side: it holds oil, and resists its flow.

        flow = (p_line - p) / R,   R = nominal_drop / nominal_flow

    The resistance is laminar. What a check valve holds back is between line and leg. Waves in the hose are left
    out: a sudden stop of a flow at c m/s would raise its pressure by density * sound speed * c, some 1.4 MPa
    for 1 m/s.

    Arguments:
        volume: of the oil in it, all legs of a pair together [m^3], > 0.
        nominal_flow: at `nominal_drop`, all together [m^3/s], > 0.
        nominal_drop: of the pressure, at which that flows [Pa], > 0.
    """

    extensive: ClassVar[tuple[str, ...]] = ("volume", "nominal_flow")

    volume: CubicMetres[Positive]
    nominal_flow: CubicMetresPerSecond[Positive]
    nominal_drop: Pascals[Positive]

    @property
    def resistance(self) -> float:
        """R [Pa s/m^3]."""
        return self.nominal_drop / self.nominal_flow

    BEFORE: ClassVar[str] = OWN
    AFTER: ClassVar[str] = "piston"
    JOINS: ClassVar[bool] = True

    @cached_property
    def formula(self) -> Formula:
        """Without a check valve."""
        return self.behind(NO_CHECK)

    def behind(self, check: tuple[float, ...]) -> Formula:
        """The action with a check valve behind the line, see `CheckValve.numbers`."""
        return Formula(pass_line, (self.resistance, *check))

    @property
    def room(self) -> Room:
        """The hose."""
        return Room(self.volume)


# --- relief valves ---


@value
class Poppet(Value):
    """The moving part of a yield valve, which takes its time.

        m s'' = k (p - p_open - s) - d s',   flow = slope max(0, s)

    s is its lift times k over the seat's area, a pressure: at rest it is that above the opening pressure, so
    that the valve at rest passes what it would without inertia. The seat is a hundred times as stiff as the
    spring, and critically damped. A poppet that is still open when the pressure has fallen below a tenth of
    p_open passes less in proportion, and nothing where there is no pressure above the tank's.

    Arguments:
        mass: m, of the poppet and a third of the spring [kg], > 0.
        stiffness: k, of the spring [N/m], > 0.
        damping: d [N s/m], >= 0.
    """

    mass: Kilograms[Positive]
    stiffness: NewtonsPerMetre[Positive]
    damping: NewtonSecondsPerMetre[NonNegative] = 0.0

    @property
    def frequency(self) -> float:
        """Angular frequency of the undamped poppet [rad/s]."""
        return math.sqrt(self.stiffness / self.mass)

    @property
    def decay(self) -> float:
        """d/m [1/s]."""
        return self.damping / self.mass


@kernel
def relieve(
    before: float, after: float, pilot: float, opening: float, travel: float, memory: float,
    jumps: float, opens: float, closes: float, slope: float,
) -> tuple[float, float]:  # fmt: skip
    """Action of a relief valve without a poppet, see `YieldValve`."""
    gap = before - (closes if memory != 0.0 else opens)
    if jumps == 0.0:
        return slope * max(0.0, before - opens), gap
    return slope * max(0.0, before - closes) if memory != 0.0 else 0.0, gap


@kernel
def lift_poppet(
    before: float, after: float, pilot: float, opening: float, travel: float, memory: float,
    lift: float, rate: float, opens: float, slope: float, frequency: float, decay: float,
) -> tuple[float, ...]:  # fmt: skip
    """Action of a relief valve with a poppet, whose seat gives a jolt where the lift passes zero."""
    above, pressed = before - opens, (before - after) / (DRAINED * opens)
    flow = slope * max(0.0, lift) * min(1.0, max(0.0, pressed))
    spring, resisted = lift, decay
    if lift < 0.0:
        spring, resisted = SEAT * lift, 2.0 * math.sqrt(SEAT) * frequency
    bend = frequency * frequency * (above - spring) - resisted * rate
    return flow, lift, rate, bend, above if above > 0.0 else above / SEAT, 0.0


@value
class YieldValve(LegValve):
    """A relief valve: it lets oil out to the tank above a pressure.

        flow = slope max(0, p - p_open),   slope = rated_flow / rated_overpressure

    With a closing pressure below it has hysteresis: once open, it passes slope (p - p_close) until the pressure
    has come down to p_close, so that the flow begins with a jump.

    Arguments:
        opening_pressure: p_open [Pa], > 0.
        rated_flow: at `rated_overpressure`, all valves of a pair of legs together [m^3/s], > 0.
        rated_overpressure: above the opening pressure [Pa], > 0.
        closing_pressure: p_close [Pa], > 0, at most the opening pressure; None: the same.
        poppet: what takes its time; None: nothing. Not together with a closing pressure of its own.
    """

    extensive: ClassVar[tuple[str, ...]] = ("rated_flow",)

    opening_pressure: Pascals[Positive]
    rated_flow: CubicMetresPerSecond[Positive]
    rated_overpressure: Pascals[Positive]
    closing_pressure: Pascals[Positive] | None = None
    poppet: Poppet | None = None

    @model_validator(mode="after")
    def _closes_below(self) -> YieldValve:
        if self.closing_pressure is None:
            return self
        if self.closing_pressure > self.opening_pressure:
            raise ValueError(
                f"closing_pressure = {self.closing_pressure} Pa: allowed: at most opening_pressure = "
                f"{self.opening_pressure} Pa"
            )
        if self.poppet is not None and self.closing_pressure < self.opening_pressure:
            raise ValueError(f"closing_pressure = {self.closing_pressure} Pa: allowed with a poppet: none")
        return self

    @property
    def slope(self) -> float:
        """Flow over pressure [m^3/(s Pa)]."""
        return self.rated_flow / self.rated_overpressure

    @property
    def closes_at(self) -> float:
        """p_close [Pa]."""
        return self.opening_pressure if self.closing_pressure is None else self.closing_pressure

    @property
    def remembers(self) -> bool:
        """Whether it has hysteresis."""
        return self.closes_at < self.opening_pressure

    @cached_property
    def formula(self) -> Formula:
        """With a poppet or without."""
        if (poppet := self.poppet) is None:
            return Formula(relieve, (float(self.remembers), self.opening_pressure, self.closes_at, self.slope))
        return Formula(lift_poppet, (self.opening_pressure, self.slope, poppet.frequency, poppet.decay))

    def path(self, name: str) -> Path:
        """The way of the oil through it; the lift of a poppet is its state."""
        path = super().path(name)
        if self.poppet is None:
            return path
        lift = LegChannel("Pa", "of the poppet, times stiffness over area")
        rate = LegChannel("Pa/s", "of this lift")
        states = {f"{name}.lift": lift, f"{name}.lift_rate": rate}
        return path._replace(states=states, sizes=(1.0, self.poppet.frequency))


# --- the foot valve of a second stage ---


@kernel
def pass_foot(
    before: float, after: float, pilot: float, opening: float, travel: float, memory: float,
    factor: float, smooth: float, lowest: float, release: float,
) -> tuple[float, float]:  # fmt: skip
    """Action of the foot valve, see `SecondStage`: out of the tube only where it stands near its bottom."""
    share = 1.0
    if before < after:
        share = min(1.0, max(0.0, (lowest + release - travel) / release))
    return share * factor * orifice(before - after, smooth), NO_GAP
