"""All hydraulic legs with elements of a scene, as the solver and the recorder see them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

import exudyn
import numpy as np

from support_exudyn.formulations.exudyn.scene.leg_circuit import LegCircuit, LegItem
from support_exudyn.formulations.exudyn.scene.leg_events import LegEvents
from support_exudyn.mechanics.trajectory import LegSeries, OilEvent, Series
from support_exudyn.model.hydraulics.lines import PumpStation
from support_exudyn.scene.hydraulics.fill import Legs, empty_legs, fill_legs
from support_exudyn.scene.hydraulics.series import leg_series

INITIAL = exudyn.ConfigurationType.Initial


class EngineLegs:
    """Legs with elements in the engine, in circuits; there may be none.

    Arguments:
        mbs: the engine's system.
        items: legs. pump: that all of them share, if any.
        weight: of the machine [N].
    """

    def __init__(self, mbs: Any, items: Sequence[LegItem], pump: PumpStation | None, weight: float) -> None:
        together = [list(items)] if pump is not None and items else [[item] for item in items]
        self.items = tuple(items)
        self.names = tuple(item.preloaded.name for item in items)
        self.circuits = tuple(LegCircuit(mbs, one, pump, weight) for one in together)
        self._whole: Legs = fill_legs([item.preloaded for item in items], pump, 0)
        self._events = tuple(LegEvents(circuit) for circuit in self.circuits)

    def begin(self) -> None:
        """The bodies stand where the run begins."""
        self.switch(0.0)
        for circuit, events in zip(self.circuits, self._events, strict=True):
            circuit.refresh(INITIAL)
            events.start()

    def follow(self, t: float) -> None:
        """Let drives and inlets be as they are at t [s]."""
        for circuit in self.circuits:
            circuit.follow(t)

    def switch(self, t: float) -> None:
        """Let drives and inlets be as they are just after a break t [s]."""
        for circuit in self.circuits:
            circuit.follow(t, after=True)

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
            happened = events.accept(t) or happened
            circuit.accept()
            events.keep()
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
        powers = [circuit.powers() for circuit in self.circuits]
        return sum(p[0] for p in powers), sum(p[1] for p in powers), sum(p[2] for p in powers)

    def states(self) -> Series:
        """States of all legs, and of the pump, at the end of the last step."""
        return np.concatenate([circuit.states for circuit in self.circuits])

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

    def empty(self) -> str:
        """Which leg has no room or no oil left, in words; empty if none."""
        for circuit in self.circuits:
            if said := empty_legs([item.preloaded.name for item in circuit.items], circuit.records):
                return said
        return ""

    def look(self, t: float) -> None:
        """Raise LawError if a drive or an inlet is no number at t [s]."""
        for item in self.items:
            item.look(t)

    @property
    def events(self) -> dict[str, tuple[OilEvent, ...]]:
        """What has happened in each leg."""
        found = [tuple(one) for events in self._events for one in events.found]
        return dict(zip(self.names, found, strict=True))

    def series(
        self, time: Series, motion: Mapping[str, tuple[Series, Series]], states: Series
    ) -> dict[str, LegSeries]:
        """All legs at the records, and the pump; motion: length [m] and its rate [m/s] of each leg (n,)."""
        told = {}
        for item in self.items:
            length, rate = motion[item.preloaded.name]
            inflow, inflow_rate, opening = np.array([item.told(t) for t in time.tolist()]).reshape(-1, 3).T
            told[item.preloaded.name] = {
                "length": length,
                "rate": rate,
                "inflow": inflow,
                "inflow_rate": inflow_rate,
                "opening": opening,
            }
        return leg_series(self._whole, time, told, states, self.events)
