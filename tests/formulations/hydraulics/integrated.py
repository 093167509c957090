"""Masses on legs, and a block that falls on one, by scipy with every kink and jump located."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import Radau
from scipy.optimize import brentq

from support_exudyn import Scenario
from tests.formulations.hydraulics.single_leg import Leg, Sides, State

EVENTS = 20_000  # more than that is chatter
LONGEST = 1e-3  # step [s]: so that no short opening is missed


@dataclass
class Trajectory:
    """What came out at the times asked for, by names; the switches that changed: time, name, new side."""

    time: np.ndarray
    values: dict[str, np.ndarray]
    events: list[tuple[float, str, bool]]

    def __getitem__(self, name: str) -> np.ndarray:
        return self.values[name]

    def switched(self, name: str) -> list[float]:
        return [t for t, what, _ in self.events if what == name]


@dataclass(frozen=True)
class Block:
    """Falls through a height on the mass of the first leg, which is a linear spring there."""

    mass: float
    height: float
    stiffness: float


class Stand:
    """All legs of a scenario whose bodies are upright masses, one on each."""

    def __init__(self, scenario: Scenario, block: Block | None = None) -> None:
        self.gravity = -scenario.gravity[1]
        self.pump, self.block = scenario.pump, block
        self.legs = []
        for name, model in scenario.actuators.items():
            body = scenario.linkage.bodies[scenario.linkage.actuators[name].head]
            drive = scenario.drive_of(name)
            self.legs.append(Leg(name, model, body.mass, self.gravity, body.velocity[1], drive, self.pump))
        self.breaks = sorted({t for t in scenario.breaks if 0.0 < t < scenario.duration})
        self.start: State = {f"{leg.name}.{k}": v for leg in self.legs for k, v in leg.start.items()}
        if self.pump is not None:
            self.start |= {"pump.w": 0.0, "pump.in": 0.0}
        if block is not None:
            self.start |= {"block.y": block.height, "block.v": 0.0}
        self.names = list(self.start)
        self.scale = np.array([_scale(name) for name in self.names])
        self.end = scenario.duration

    # --- equations ---

    def pump_pressure(self, y: State) -> float:
        """Of the oil between pump and legs."""
        if self.pump is None:
            return math.nan
        return self.pump.pressure + self.pump.bulk_modulus / self.pump.line_volume * y["pump.w"]

    def switches(self, t: float, y: State, sides: Sides, after: bool) -> State:
        found: State = {}
        pump = self.pump_pressure(y)
        for leg in self.legs:
            mine = _of(leg.name, sides)
            here = leg.switches(t, _of(leg.name, y), mine, pump, after)
            found |= {f"{leg.name}.{key}": value for key, value in here.items()}
        if self.pump is not None:
            room = self.pump.pressure - pump
            found |= {"pump.gives": room, "pump.gives all": room - self.pump.pressure_range}
        if self.block is not None:
            found["block.touches"] = y[f"{self.legs[0].name}.e"] - y["block.y"]
        return found

    def rates(self, t: float, y: State, sides: Sides, after: bool) -> State:
        found: State = {}
        pump, drawn = self.pump_pressure(y), 0.0
        push = 0.0
        if self.block is not None and sides["block.touches"]:
            push = self.block.stiffness * (y[f"{self.legs[0].name}.e"] - y["block.y"])
        for n, leg in enumerate(self.legs):
            on_top = push if n == 0 else 0.0
            here, mine = leg.rates(t, _of(leg.name, y), _of(leg.name, sides), pump, after, on_top)
            found |= {f"{leg.name}.{key}": value for key, value in here.items()}
            drawn += mine
        if self.pump is not None:
            share = (self.pump.pressure - pump) / self.pump.pressure_range if sides["pump.gives"] else 0.0
            q = self.pump.flow * (1.0 if sides["pump.gives all"] else share)
            found["pump.in"] = q
            found["pump.w"] = found["pump.in"] - drawn
        if self.block is not None:
            found["block.y"], found["block.v"] = y["block.v"], push / self.block.mass - self.gravity
        return found

    # --- integration ---

    def run(self, records: np.ndarray, rtol: float = 1e-10, method: Any = Radau) -> Trajectory:
        """Integrate to the end with all switches located."""
        y = np.array([self.start[name] for name in self.names]) / self.scale
        sides: Sides = {}
        found: list[tuple[float, np.ndarray, Sides]] = []
        events: list[tuple[float, str, bool]] = []
        edges = [0.0, *self.breaks, self.end]
        for begin, end in itertools.pairwise(edges):
            sides = {name: g > 0.0 for name, g in self._switched(begin, y, sides, begin).items()}
            t = begin
            while t < end:
                t, y, sides = self._piece(t, y, sides, (begin, end), rtol, method, records, found, events)
        return Trajectory(np.array([t for t, _, _ in found]), self._outputs(found), events)

    def _piece(
        self, t: float, y: np.ndarray, sides: Sides, edges: tuple[float, float], rtol: float, method: Any,
        records: np.ndarray, found: list[tuple[float, np.ndarray, Sides]],
        events: list[tuple[float, str, bool]],
    ) -> tuple[float, np.ndarray, Sides]:  # fmt: skip
        """Integrate until the first switch, or the end."""
        begin, end = edges

        def rate(at: float, z: np.ndarray) -> np.ndarray:
            rates = self.rates(at, self._named(z), sides, at == begin)
            return np.array([rates[name] for name in self.names]) / self.scale

        solver = method(rate, t, y, end, rtol=rtol, atol=rtol, max_step=LONGEST)
        while solver.status == "running":
            problem = solver.step()
            assert problem is None, problem
            before, now, within = solver.t_old, solver.t, solver.dense_output()
            changed = [
                self._root(name, within, sides, begin, before, now)
                for name, g in self._switched(now, solver.y, sides, begin).items()
                if (g > 0.0) != sides[name]
            ]
            stop, name = min(changed, default=(now, ""))
            asked = records[(records >= before) & (records < stop) | (records == stop) & (stop == self.end)]
            found += [(at, within(at), sides) for at in asked.tolist()]
            if name:
                events.append((stop, name, not sides[name]))
                assert len(events) < EVENTS, "chatter"
                return stop, within(stop), sides | {name: not sides[name]}
        return end, solver.y, sides

    def _root(
        self, name: str, within: Any, sides: Sides, begin: float, before: float, now: float
    ) -> tuple[float, str]:
        """When a switch changes in a step."""

        def value(at: float) -> float:
            return self._switched(at, within(at), sides, begin)[name]

        if (value(before) > 0.0) == (value(now) > 0.0):  # it has just come back
            return before, name
        return float(brentq(value, before, now, xtol=1e-15, rtol=1e-14)), name

    def _named(self, z: np.ndarray) -> State:
        return dict(zip(self.names, (z * self.scale).tolist(), strict=True))

    def _switched(self, at: float, z: np.ndarray, sides: Sides, begin: float) -> State:
        return self.switches(at, self._named(z), sides, at == begin)

    def _outputs(self, found: list[tuple[float, np.ndarray, Sides]]) -> dict[str, np.ndarray]:
        rows = []
        for t, state, sides in found:
            y = self._named(state)
            row = dict(y)
            for leg in self.legs:
                p = leg.pressures(leg.lawful(t, _of(leg.name, y)), _of(leg.name, sides))
                row |= {f"{leg.name}.{key}": value for key, value in p.items()}
            if self.pump is not None:
                row["pump.p"] = self.pump_pressure(y)
            rows.append(row)
        return {name: np.array([row[name] for row in rows]) for name in rows[0]}


def _of(prefix: str, given: dict[str, Any]) -> dict[str, Any]:
    cut = len(prefix) + 1
    return {key[cut:]: value for key, value in given.items() if key.startswith(prefix + ".")}


def _scale(name: str) -> float:
    """Of a state: what it usually is, so that one tolerance fits all."""
    key = name.partition(".")[2]
    return {"e": 1e-2, "v": 1.0, "s": 1e-2, "sr": 1.0, "y": 1e6, "y1": 1e6, "yr": 1e9, "y1r": 1e9}.get(
        key, 1e-4
    )
