# ruff: noqa: N803 - the engine goes by the names of arguments
"""Hydraulic legs in the engine: springs, and connectors whose force follows from states that are solved for.

The states of legs are no coordinates of the engine. Each leg is a connector, whose force at the end of a step
follows from its length and rate there, and from the states that the step has begun with: they are solved for
within the force, see `hydraulics.implicit`. Nothing is kept from one evaluation to the next, so that the engine
may difference the force and repeat steps as it likes; a step that is accepted gives new states to begin with.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import exudyn
import numpy as np

from support_exudyn.formulations.exudyn.scene.driven_parts import Supply, supply_at
from support_exudyn.formulations.exudyn.scene.leg_events import LegEvents
from support_exudyn.mechanics.hydraulic_legs import PreloadedLeg
from support_exudyn.mechanics.trajectory import LegSeries, OilEvent, Series
from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.hydraulics.elements import PumpStation
from support_exudyn.model.hydraulics.inlets import Inlet
from support_exudyn.model.hydraulics.leg import OilColumn
from support_exudyn.scene.hydraulics.fill import empty_legs, fill_legs, weigh_states
from support_exudyn.scene.hydraulics.implicit import (
    END,
    END_RATE,
    KNOWN,
    START,
    START_RATE,
    WEIGHT,
    Places,
    powers_of_legs,
    pull_of_leg,
)
from support_exudyn.scene.hydraulics.leg import evaluate_legs
from support_exudyn.scene.hydraulics.rest import rest_legs
from support_exudyn.scene.hydraulics.series import INPUTS, leg_series

CURRENT, INITIAL = exudyn.ConfigurationType.Current, exudyn.ConfigurationType.Initial
OUTPUT = exudyn.OutputVariableType
FORCE = "springForceUserFunction"  # the engine's name, of its springs
ENERGY, PLAY = 1e3, 1e-3  # [J], [m] that states are weighed by
NO_STATES = np.zeros(0, np.int64), np.empty((0, 1))
LENGTHS = 4  # that are rounded, each by up to half a unit in its last place, until there is a force


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


class EngineLegs:
    """Hydraulic legs in the engine; there may be none.

    A leg whose force is linear in its length is a spring of the engine, with stiffness and free length by the
    kernel. The states of the others are solved for, each by itself, or with a pump all together.

    Arguments:
        items: legs. pump: that all cylinders share, if any.
        weight: of the machine [N].
    """

    def __init__(self, items: Sequence[LegItem], pump: PumpStation | None, weight: float) -> None:
        self.items = tuple(items)
        self._mbs: Any = items[0].mbs if items else None
        self.names = tuple(item.preloaded.name for item in items)
        self.legs = legs = fill_legs([item.preloaded for item in items], pump, 0)
        self.arrays, self.records = legs.arrays, legs.records
        self.known = np.zeros((KNOWN, legs.states))
        self.known[WEIGHT], self.known[START], self.known[END] = 1.0, legs.start, legs.start
        if items:
            pressure = weight / float(legs.records["bore"].max())
            weigh_states(legs, self.known[WEIGHT], pressure, ENERGY, PLAY)
        self._springs: dict[int, Supply | None] = {n: None for n, item in enumerate(items) if item.is_spring}
        solved = [n for n in range(len(items)) if n not in self._springs]
        self._together = pump is not None
        self._places = {n: self._places_of(n) for n in solved}
        self._groups = solved[:1] if self._together else solved  # a leg of all that are solved together
        self.step = 0.0  # that is being tried [s]
        self._settles = False  # whether a static equilibrium is looked for
        self._sources: list[Drive | Inlet] = []  # each once
        for item in items:
            if item.source not in self._sources:
                self._sources.append(item.source)
        self._source_of = [self._sources.index(item.source) for item in items]
        self.happenings = LegEvents(legs, self.known, self._evaluate)
        for n in solved:
            items[n].mbs.SetObjectParameter(items[n].object, FORCE, self._pull(n))

    def _places_of(self, n: int) -> tuple[Places, Series]:
        """Places of the states that the force of leg n follows from, then of their integrals; room for them."""
        integral = np.zeros(self.known.shape[1], bool)
        for places in self.legs.places:
            integral[[*places.oil.values(), *places.losses.values()]] = True
        integral[self.arrays.pumps["given"]] = True
        own = np.full(integral.size, self._together)
        first = self.records[n]["first"]
        own[first : first + self.records[n]["states"]] = True
        free = np.flatnonzero(own & ~integral)
        return np.concatenate([free, np.flatnonzero(own & integral)]), np.empty((free.size, free.size + 1))

    # --- forces ---

    def _pull(self, n: int) -> Callable[..., float]:
        """The force with which a leg pulls its ends together, of the engine's signature."""
        start = self.items[n].preloaded.actuator.start_length

        def pull(mbs: Any, t: float, itemNumber: int, stretch: float, rate: float, *others: Any) -> float:
            if self._together:
                self._tell()
            if self._settles:
                self.records[n]["length"], self.records[n]["rate"] = start + stretch, rate
                rest_legs(self.arrays, self.known[START], self.known[END_RATE])
                return -float(self.records[n]["force"])
            return self._solve(n, start + stretch, rate)

        return pull

    def _solve(self, n: int, length: float, rate: float) -> float:
        """Force of leg n that pulls its ends together [N], with the states at the end of the step."""
        places, rows = self._places[n]
        together = self._together
        return float(pull_of_leg(self.arrays, self.step, self.known, places, rows, n, together, length, rate))

    def _press_spring(self, n: int, length: float) -> float:
        """Force of leg n, which has no states, that pulls its ends together [N], at a length [m]."""
        return float(pull_of_leg(self.arrays, 0.0, self.known, *NO_STATES, n, False, length, 0.0))

    def _set_spring(self, n: int, inflow: float) -> None:
        """Give the engine's spring of leg n the stiffness [N/m] and the free length [m] of its oil."""
        item = self.items[n]
        leg, length = item.preloaded.model, item.preloaded.actuator.start_length + inflow
        reach = leg.oil_length + inflow
        near, far = self._press_spring(n, length), self._press_spring(n, length + reach)
        stiffness = (far - near) / reach
        self._mbs.SetObjectParameter(item.object, "stiffness", stiffness)
        self._mbs.SetObjectParameter(item.object, "referenceLength", length - near / stiffness)

    def _tell(self, state: Any = CURRENT) -> None:
        """Write lengths [m] and rates [m/s] of all legs into their records."""
        for record, item in zip(self.records, self.items, strict=True):
            record["length"], record["rate"] = item.motion(state)

    def _evaluate(self) -> None:
        known = self.known
        evaluate_legs(self.arrays, known[START], known[START_RATE])
        known[END], known[END_RATE] = known[START], known[START_RATE]

    # --- a run ---

    def begin(self) -> None:
        """The bodies stand where the run begins."""
        self._springs = dict.fromkeys(self._springs)
        self.switch(0.0)
        if self.solves:
            self._tell(INITIAL)
            self._evaluate()
            self.happenings.start()

    def follow(self, t: float, after: bool = False) -> None:
        """Let drives and inlets be as they are at t [s], or just after it."""
        supplies = [supply_at(source, t, after) for source in self._sources]
        for n, k in enumerate(self._source_of):
            if supplies[k] != self._springs.get(n):
                self._tell_supply(n, supplies[k])
                if n in self._springs:
                    self._springs[n] = supplies[k]
                    self._set_spring(n, supplies[k].extension)

    def _tell_supply(self, n: int, supply: Supply) -> None:
        record = self.records[n]
        record["inflow"], record["inflow_rate"], record["opening"] = supply

    def switch(self, t: float) -> None:
        """Let drives and inlets be as they are just after a break t [s]."""
        self.follow(t, after=True)

    def refresh(self) -> None:
        """The engine's velocities, a drive, an inlet or a valve have jumped: rates of the states anew."""
        if self.solves:
            self._tell()
            self._evaluate()
            self.happenings.keep()

    def begin_try(self, step: float) -> None:
        """Begin to try a step of this length [s]."""
        self.step = step
        self.happenings.begin_try()

    def after_newton(self, t: float) -> float | None:
        """Decide on a solved step that would end at t [s]: None if it may stand.

        Else with which length [s] it is to be repeated; infinite: with the same, for a valve opened or closed.
        Raises ArithmeticError if the states at its end are not found.
        """
        if not self.solves:
            return None
        self._tell()
        for n in self._groups:
            if math.isnan(self._solve(n, self.records[n]["length"], self.records[n]["rate"])):
                names = [self.names[k] for k in (self._places if self._together else [n])]
                raise ArithmeticError(f"the pressures of {', '.join(names)} not found")
        return self.happenings.judge(t, self.step)

    def accept(self, t: float) -> bool:
        """The step to t [s] stands; whether anything has happened at its end."""
        self.known[START], self.known[START_RATE] = self.known[END], self.known[END_RATE]
        self.step = 0.0
        if happened := self.happenings.accept(t):
            self.refresh()
        return happened

    def slide(self, rest: float) -> None:
        """Move on by a time [s] that is not worth a step."""
        self.known[START] += rest * self.known[START_RATE]

    @property
    def solves(self) -> bool:
        """Whether there are legs whose states are solved for."""
        return bool(self._groups)

    @property
    def rounding(self) -> float:
        """Scatter [N] of the forces that the rounding of lengths causes."""
        return sum(item.rounding for item in self.items)

    def powers(self) -> tuple[float, float, float]:
        """Powers [W] of what gives oil, of flows and dampers, and of seals, now."""
        of_springs = 0.0
        for n, supply in self._springs.items():
            if supply is not None and supply.rate != 0.0:
                self._tell_supply(n, supply)
                self._press_spring(n, self._mbs.GetObjectOutput(self.items[n].object, OUTPUT.Distance))
                of_springs += float(self.records[n]["work"])
        if not self.solves:
            return of_springs, 0.0, 0.0
        self.records["work"][[*self._springs]] = 0.0  # which is counted
        work, loss, friction = powers_of_legs(self.arrays)
        return work + of_springs, loss, friction

    @property
    def states_count(self) -> int:
        """How many states all legs and the pump have."""
        return self.legs.states

    def states(self) -> Series:
        """States of all legs, and of the pump, at the end of the last step."""
        return np.asarray(self.known[START])

    @contextmanager
    def settling(self) -> Iterator[None]:
        """Let oil be closed inside, and tubes look for their places."""
        self._settles = True
        try:
            yield
        finally:
            self._settles = False

    def lengths(self) -> dict[str, float]:
        """Lengths of all legs now [m]."""
        return {name: item.motion()[0] for name, item in zip(self.names, self.items, strict=True)}

    def empty(self) -> str:
        """Which leg has no room or no oil left, in words; empty if none."""
        for n in self._springs:
            self._press_spring(n, self._mbs.GetObjectOutput(self.items[n].object, OUTPUT.Distance))
        return empty_legs(self.legs, self.arrays)

    @property
    def events(self) -> dict[str, tuple[OilEvent, ...]]:
        """What has happened in each leg with elements."""
        return {
            name: tuple(found)
            for name, item, found in zip(self.names, self.items, self.happenings.found, strict=True)
            if item.preloaded.model.elements and not item.is_spring
        }

    def series(
        self, time: Series, motion: Mapping[str, tuple[Series, Series]], states: Series
    ) -> dict[str, LegSeries]:
        """All legs at the records, and the pump; motion: length [m] and its rate [m/s] of each leg (n,)."""
        supplies = [np.array([supply_at(source, t) for t in time.tolist()]).T for source in self._sources]
        told = {}
        for name, k in zip(self.names, self._source_of, strict=True):
            told[name] = dict(zip(INPUTS, (*motion[name], *supplies[k]), strict=True))
        return leg_series(self.legs, time, told, states, self.events)
