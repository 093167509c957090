# ruff: noqa: N803 - the engine goes by the names of arguments
"""Hydraulic legs in the engine whose states are solved for: a leg, or all legs that share a pump.

The states of legs are no coordinates of the engine. Each leg is a connector, whose force at the end of a step
follows from its length and rate there, and from the states that the step has begun with: they are solved for
within the force, see `hydraulics.implicit`. Nothing is kept from one evaluation to the next, so that the engine
may difference the force and repeat steps as it likes; a step that is accepted gives new states to begin with.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import exudyn
import numpy as np

from support_exudyn.mechanics.hydraulic_legs import PreloadedLeg
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.hydraulics.elements import PumpStation
from support_exudyn.model.hydraulics.inlets import Inlet
from support_exudyn.model.hydraulics.leg import OilColumn
from support_exudyn.scene.hydraulics.fill import fill_legs, weigh_states
from support_exudyn.scene.hydraulics.implicit import (
    END,
    END_RATE,
    KNOWN,
    START,
    START_RATE,
    WEIGHT,
    powers_of_legs,
    pull_of_leg,
)
from support_exudyn.scene.hydraulics.leg import evaluate_legs
from support_exudyn.scene.hydraulics.rest import rest_legs
from support_exudyn.scene.hydraulics.series import INPUTS
from user_forces.lawful import LawError

CURRENT = exudyn.ConfigurationType.Current
OUTPUT = exudyn.OutputVariableType
FORCE = "springForceUserFunction"  # the engine's name, of its springs
ENERGY, PLAY = 1e3, 1e-3  # [J], [m] that states are weighed by
LENGTHS = 4  # that are rounded, each by up to half a unit in its last place, until there is a force


class Supply(NamedTuple):
    """What lets oil in, at an instant: extension by a drive [m] and its rate [m/s], opening of an inlet."""

    inflow: float
    inflow_rate: float
    opening: float


def supply_at(source: Drive | Inlet, t: float, after: bool = False) -> Supply:
    """What a drive or an inlet lets in at t [s], at the start just after it; after: just after a break.

    Raises LawError if that is no number.
    """
    if isinstance(source, Inlet):
        found = Supply(0.0, 0.0, source.opening(t) + (source.opening_jump(t) if after else 0.0))
    elif t > 0.0:
        speed = source.speed(t) + (source.speed_jump(t) if after else 0.0)
        found = Supply(source.extension(t), speed, 0.0)
    else:
        found = Supply(source.extension(t), source.initial_speed, 0.0)
    if not math.isfinite(sum(found)):
        raise LawError(f"{type(source).__name__} is no finite number at {t:.9g} s")
    return found


@dataclass(frozen=True)
class LegItem:
    """A leg in the engine.

    mbs: the engine's system. preloaded: what it is. markers: of foot and head. object: its connector.
    source: what lets oil in.
    """

    mbs: Any
    preloaded: PreloadedLeg
    markers: Sequence[Any]
    object: Any
    source: Drive | Inlet

    @property
    def is_spring(self) -> bool:
        """Whether the force is linear in the length, and only the drive changes it."""
        model = self.preloaded.model
        return isinstance(model, OilColumn) and not {*model.elements} - {"setting_pressure"}

    @property
    def rounding(self) -> float:
        """Scatter of the force [N] that the rounding of the length causes."""
        model, actuator = self.preloaded.model, self.preloaded.actuator
        stiffness = model.stiffness(0.0) + (model.end_stops.stiffness if model.end_stops else 0.0)
        size = max(actuator.start_length, *map(abs, (*actuator.foot_point, *actuator.head_point)))
        return float(LENGTHS * sys.float_info.epsilon * stiffness * size)

    def motion(self, state: Any = CURRENT) -> tuple[float, float]:
        """Length [m] of the leg and its rate [m/s].

        By the markers: asked for them, the engine's connector would call the function that asks.
        """
        (x, y, z), (vx, vy, vz) = self._apart(OUTPUT.Position, state), self._apart(OUTPUT.Velocity, state)
        length = math.sqrt(x * x + y * y + z * z)
        return length, (x * vx + y * vy + z * vz) / length

    def _apart(self, what: Any, state: Any) -> tuple[float, float, float]:
        foot, head = (self.mbs.GetMarkerOutput(marker, what, state).tolist() for marker in self.markers)
        return head[0] - foot[0], head[1] - foot[1], head[2] - foot[2]


class LegCircuit:
    """Legs that oil joins: one, or all that share a pump.

    Arguments:
        items: legs. pump: that they share.
        weight: of the machine [N].
    """

    def __init__(self, items: Sequence[LegItem], pump: PumpStation | None, weight: float) -> None:
        self.items = tuple(items)
        self.legs = legs = fill_legs([item.preloaded for item in items], pump, 0)
        self.arrays, self.records = legs.arrays, legs.records
        self.known = np.zeros((KNOWN, legs.states))
        self.known[WEIGHT], self.known[START], self.known[END] = 1.0, legs.start, legs.start
        weigh_states(legs, self.known[WEIGHT], weight / float(legs.records["bore"].max()), ENERGY, PLAY)
        integrals = np.zeros(legs.states, bool)
        for places in legs.places:
            integrals[[*places.oil.values(), *places.losses.values()]] = True
        integrals[legs.arrays.pumps["given"]] = True
        self._places = np.concatenate([np.flatnonzero(~integrals), np.flatnonzero(integrals)])
        free = int((~integrals).sum())
        self._rows = np.empty((free, free + 1))
        self.step = 0.0  # that is being tried [s]
        self._start: dict[str, Series] = {}  # inputs of the legs at its start
        self.settles = False  # whether a static equilibrium is looked for
        for n, item in enumerate(items):
            item.mbs.SetObjectParameter(item.object, FORCE, self._pull(n))

    def _pull(self, n: int) -> Callable[..., float]:
        """The force with which a leg pulls its ends together, of the engine's signature."""
        start, alone = self.items[n].preloaded.actuator.start_length, len(self.items) == 1

        def pull(mbs: Any, t: float, itemNumber: int, stretch: float, rate: float, *others: Any) -> float:
            if not alone:
                self._tell()
            if self.settles:
                self.records[n]["length"], self.records[n]["rate"] = start + stretch, rate
                rest_legs(self.arrays, self.known[START], self.known[END_RATE])
                return -float(self.records[n]["force"])
            return self._solve(n, start + stretch, rate)

        return pull

    def _solve(self, n: int, length: float, rate: float) -> float:
        """Force of leg n that pulls its ends together [N], with the states at the end of the step."""
        return float(pull_of_leg(self.arrays, self.step, self.known, self._places, self._rows, n, length, rate))

    def let_in(self, n: int, supply: Supply) -> None:
        """Let a drive or an inlet let so much oil into leg n."""
        record = self.records[n]
        record["inflow"], record["inflow_rate"], record["opening"] = supply

    def _tell(self, state: Any = CURRENT) -> tuple[float, float]:
        """Write lengths [m] and rates [m/s] of all legs into their records; those of the last."""
        motion = 0.0, 0.0
        for record, item in zip(self.records, self.items, strict=True):
            record["length"], record["rate"] = motion = item.motion(state)
        return motion

    def solve(self) -> None:
        """Find the states at the end of the step that the engine has solved. Raises ArithmeticError if not."""
        if math.isnan(self._solve(len(self.items) - 1, *self._tell())):
            raise ArithmeticError(
                f"the pressures of {', '.join(i.preloaded.name for i in self.items)} not found"
            )

    def accept(self) -> None:
        """The step stands: the states at its end are those that the next begins with."""
        self.known[START], self.known[START_RATE] = self.known[END], self.known[END_RATE]
        self.step = 0.0

    def keep_inputs(self) -> None:
        """Keep the inputs of the legs as those at the start of a step, see `refresh_start`."""
        self._start = {name: self.records[name].copy() for name in INPUTS}

    def refresh(self, state: Any = CURRENT) -> None:
        """The engine's velocities, a drive, an inlet or a valve have jumped: rates of the states anew."""
        self._tell(state)
        self._evaluate()

    def refresh_start(self) -> None:
        """A valve has opened or closed where the step begins that has been tried: begin anew from there."""
        for name, values in self._start.items():
            self.records[name] = values
        self._evaluate()

    def _evaluate(self) -> None:
        known = self.known
        evaluate_legs(self.arrays, known[START], known[START_RATE])
        known[END], known[END_RATE] = known[START], known[START_RATE]

    def pass_gap(self, k: int, positive: bool) -> None:
        """A gap has passed zero; valves remember."""
        if (valve := self.arrays.gaps[k]["valve"]) >= 0:
            self.arrays.valves[valve]["memory"] = float(positive)

    def jumps(self, k: int) -> bool:
        """Whether a gap is that of a valve with hysteresis."""
        valve = self.arrays.gaps[k]["valve"]
        return bool(valve >= 0 and self.arrays.valves[valve]["jumps"])

    def states(self) -> bytes:
        """States at the end of the last step, as bytes."""
        states: bytes = self.known[START].tobytes()
        return states

    def slide(self, rest: float) -> None:
        """Move on by a time [s] that is not worth a step."""
        self.known[START] += rest * self.known[START_RATE]

    def powers(self) -> tuple[float, float, float]:
        """Power [W] of pump, drive and tank, of what is lost in flows and dampers, and of seals, now."""
        work, loss, friction = powers_of_legs(self.arrays)
        return work, loss, friction
