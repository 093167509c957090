"""All hydraulic legs of a scene in the engine, as the solver and the recorder see them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial

import exudyn
import numpy as np

from support_exudyn.formulations.exudyn.scene.leg_circuit import OUTPUT, LegCircuit, LegItem, Supply, supply_at
from support_exudyn.formulations.exudyn.scene.leg_events import LegEvents
from support_exudyn.mechanics.trajectory import LegSeries, OilEvent, Series
from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.hydraulics.elements import PumpStation
from support_exudyn.model.hydraulics.inlets import Inlet
from support_exudyn.scene.hydraulics.fill import Legs, empty_legs, fill_legs
from support_exudyn.scene.hydraulics.implicit import spring_of_leg
from support_exudyn.scene.hydraulics.series import INPUTS, leg_series

INITIAL = exudyn.ConfigurationType.Initial


class LegSpring:
    """A leg whose force is linear in its length and has no state: the engine's spring has the kernel's numbers.

    Arguments:
        item: the leg.
    """

    def __init__(self, item: LegItem) -> None:
        self._mbs, self.item = item.mbs, item
        self._leg = fill_legs([item.preloaded], None, 0).arrays
        self._supply = Supply(math.nan, 0.0, 0.0)  # that the engine's spring has

    def let_in(self, supply: Supply) -> None:
        """Let a drive let so much oil into the leg."""
        before, self._supply = self._supply, supply
        if supply.inflow != before.inflow:
            stiffness, length, _ = spring_of_leg(self._leg, supply.inflow, 0.0, 0.0)
            self._mbs.SetObjectParameter(self.item.object, "stiffness", stiffness)
            self._mbs.SetObjectParameter(self.item.object, "referenceLength", length)

    def power(self) -> float:
        """Power of the drive now [W]."""
        inflow, rate, _ = self._supply
        if rate == 0.0:
            return 0.0
        length = self._mbs.GetObjectOutput(self.item.object, OUTPUT.Distance)
        return float(spring_of_leg(self._leg, inflow, length, rate)[2])


class EngineLegs:
    """Hydraulic legs in the engine: springs, and circuits of those that have states; there may be none.

    Arguments:
        items: legs. pump: that all cylinders share, if any.
        weight: of the machine [N].
    """

    def __init__(self, items: Sequence[LegItem], pump: PumpStation | None, weight: float) -> None:
        self.items = tuple(items)
        self.names = tuple(item.preloaded.name for item in items)
        self._springs = tuple(LegSpring(item) for item in items if item.is_spring)
        solved = [item for item in items if not item.is_spring]
        together = [solved] if pump is not None and solved else [[item] for item in solved]
        self.circuits = tuple(LegCircuit(one, pump, weight) for one in together)
        self._whole: Legs = fill_legs([item.preloaded for item in items], pump, 0)
        self._events = tuple(LegEvents(circuit) for circuit in self.circuits)
        self._sources: list[Drive | Inlet] = []  # each once
        for item in items:
            if item.source not in self._sources:
                self._sources.append(item.source)
        self._followers = [[*self._following(source)] for source in self._sources]

    def _following(self, source: Drive | Inlet) -> Iterator[Callable[[Supply], None]]:
        """What lets the oil of a source into each leg that follows it."""
        for spring in self._springs:
            if spring.item.source == source:
                yield spring.let_in
        for circuit in self.circuits:
            for n, item in enumerate(circuit.items):
                if item.source == source:
                    yield partial(circuit.let_in, n)

    def begin(self) -> None:
        """The bodies stand where the run begins."""
        self.switch(0.0)
        for circuit, events in zip(self.circuits, self._events, strict=True):
            circuit.refresh(INITIAL)
            events.start()

    def follow(self, t: float, after: bool = False) -> None:
        """Let drives and inlets be as they are at t [s], or just after it."""
        for source, followers in zip(self._sources, self._followers, strict=True):
            supply = supply_at(source, t, after)
            for let_in in followers:
                let_in(supply)

    def switch(self, t: float) -> None:
        """Let drives and inlets be as they are just after a break t [s]."""
        self.follow(t, after=True)

    def refresh(self) -> None:
        """The engine's velocities, drives or inlets have jumped: rates of the states anew."""
        for circuit, events in zip(self.circuits, self._events, strict=True):
            circuit.refresh()
            events.keep()

    def begin_try(self, step: float) -> None:
        """Begin to try a step of this length [s]."""
        for circuit, events in zip(self.circuits, self._events, strict=True):
            circuit.step = step
            events.begin_try()

    def after_newton(self, t: float) -> float | None:
        """Decide on a solved step that would end at t [s]: None if it may stand.

        Else with which length [s] it is to be repeated; infinite: with the same, for a valve opened or closed.
        """
        asked = []
        for circuit, events in zip(self.circuits, self._events, strict=True):
            circuit.solve()
            if (again := events.judge(t)) is not None:
                asked.append(again)
        return min(asked, default=None)

    def accept(self, t: float) -> bool:
        """The step to t [s] stands; whether anything has happened at its end."""
        happened = False
        for circuit, events in zip(self.circuits, self._events, strict=True):
            circuit.accept()
            happened = events.accept(t) or happened
        return happened

    def slide(self, rest: float) -> None:
        """Move on by a time [s] that is not worth a step."""
        for circuit in self.circuits:
            circuit.slide(rest)

    @property
    def wants_cut(self) -> bool:
        """Whether the step just tried is to be repeated with another length."""
        return any(events.wants_cut for events in self._events)

    @property
    def landing(self) -> float:
        """When something is seen to happen next [s]; infinite if nothing is."""
        return min((events.landing for events in self._events), default=math.inf)

    @property
    def rounding(self) -> float:
        """Scatter [N] of the forces that the rounding of lengths causes."""
        return sum(item.rounding for item in self.items)

    def powers(self) -> tuple[float, float, float]:
        """Powers [W] of what gives oil, of flows and dampers, and of seals, now."""
        work, loss, friction = sum(spring.power() for spring in self._springs), 0.0, 0.0
        for circuit in self.circuits:
            powers = circuit.powers()
            work, loss, friction = work + powers[0], loss + powers[1], friction + powers[2]
        return work, loss, friction

    @property
    def states_count(self) -> int:
        """How many states all legs and the pump have."""
        return self._whole.states

    def states(self) -> bytes:
        """States of all legs, and of the pump, at the end of the last step, as bytes."""
        return b"".join(circuit.states() for circuit in self.circuits)

    @contextmanager
    def settling(self) -> Iterator[None]:
        """Let oil be closed inside, and tubes look for their places."""
        for circuit in self.circuits:
            circuit.settles = True
        try:
            yield
        finally:
            for circuit in self.circuits:
                circuit.settles = False

    def lengths(self) -> dict[str, float]:
        """Lengths of all legs now [m]."""
        return {name: item.motion()[0] for name, item in zip(self.names, self.items, strict=True)}

    def empty(self) -> str:
        """Which leg has no room or no oil left, in words; empty if none."""
        for circuit in self.circuits:
            if said := empty_legs(circuit.legs, circuit.arrays):
                return said
        return ""

    @property
    def events(self) -> dict[str, tuple[OilEvent, ...]]:
        """What has happened in each leg with elements."""
        return {
            item.preloaded.name: tuple(found)
            for events in self._events
            for item, found in zip(events.circuit.items, events.found, strict=True)
            if item.preloaded.model.elements
        }

    def series(
        self, time: Series, motion: Mapping[str, tuple[Series, Series]], states: Series
    ) -> dict[str, LegSeries]:
        """All legs at the records, and the pump; motion: length [m] and its rate [m/s] of each leg (n,)."""
        supplies = [np.array([supply_at(source, t) for t in time.tolist()]).T for source in self._sources]
        told = {}
        for name, item in zip(self.names, self.items, strict=True):
            supply = supplies[self._sources.index(item.source)]
            told[name] = dict(zip(INPUTS, (*motion[name], *supply), strict=True))
        return leg_series(self._whole, time, told, states, self.events)
