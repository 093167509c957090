# ruff: noqa: N803 - the engine goes by the names of arguments
"""Hydraulic legs with elements in the engine: a leg, or all legs that share a pump.

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
from typing import Any

import exudyn
import numpy as np

from support_exudyn.mechanics.hydraulic_legs import PreloadedLeg
from support_exudyn.mechanics.oil_column import LENGTHS
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.actuators import OilColumn
from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.hydraulic_cylinder import HydraulicCylinder, Inlet
from support_exudyn.model.hydraulics.lines import PumpStation
from support_exudyn.scene.hydraulics.fill import fill_legs, weigh_states
from support_exudyn.scene.hydraulics.implicit import advance_legs
from support_exudyn.scene.hydraulics.leg import evaluate_legs
from support_exudyn.scene.hydraulics.records import BOOKED, RELIEF, YIELD, Matrix, Records
from support_exudyn.scene.hydraulics.rest import rest_legs
from support_exudyn.scene.hydraulics.series import TOLD
from user_forces.lawful import LawError

CURRENT = exudyn.ConfigurationType.Current
NAME = "springForceUserFunction"  # the engine's, of its springs
ENERGY, PLAY = 1e3, 1e-3  # [J], [m] that states are weighed by
AHEAD = 1e-5  # of a step, over which gaps are differenced


@dataclass(frozen=True)
class LegItem:
    """A leg in the engine: what it is, markers of foot and head, its connector, and what lets oil in."""

    preloaded: PreloadedLeg
    markers: Sequence[Any]
    object: Any
    source: Drive | Inlet

    @property
    def rounding(self) -> float:
        """Scatter of the force [N] that the rounding of the length causes."""
        model, actuator = self.preloaded.model, self.preloaded.actuator
        assert isinstance(model, OilColumn | HydraulicCylinder)  # PreloadedLeg has looked
        stiffness = model.stiffness(0.0) + (model.end_stops.stiffness if model.end_stops else 0.0)
        size = max(actuator.start_length, *map(abs, (*actuator.foot_point, *actuator.head_point)))
        return float(LENGTHS * sys.float_info.epsilon * stiffness * size)

    def told(self, t: float) -> tuple[float, float, float]:
        """What a drive has let in at t [s], as an extension [m], its rate [m/s], and the inlet's opening."""
        source = self.source
        if isinstance(source, Inlet):
            return 0.0, 0.0, source.opening(t)
        # at the start the speed is the one just after it
        return source.extension(t), source.speed(t) if t > 0.0 else source.initial_speed, 0.0

    def told_after(self, t: float) -> tuple[float, float, float]:
        """What a drive has let in just after a break t [s]; values as of `told`."""
        inflow, rate, opening = self.told(t)
        source = self.source
        if isinstance(source, Inlet):
            return inflow, rate, opening + source.opening_jump(t)
        return inflow, rate + (source.speed_jump(t) if t > 0.0 else 0.0), opening

    def look(self, t: float) -> None:
        """Raise LawError if what lets oil in is no number at t [s]."""
        if not all(map(math.isfinite, self.told(t))):
            raise LawError(
                f"{self.preloaded.name}: {type(self.source).__name__} is no finite number at {t:.9g} s"
            )


class LegCircuit:
    """Legs that oil joins: one, or all that share a pump.

    Arguments:
        mbs: the engine's system.
        items: legs. pump: that they share.
        weight: of the machine [N].
    """

    def __init__(self, mbs: Any, items: Sequence[LegItem], pump: PumpStation | None, weight: float) -> None:
        self.items = tuple(items)
        self._mbs = mbs
        legs = fill_legs([item.preloaded for item in items], pump, 0)
        self.records, self.pumps, self.gaps = legs.records, legs.pumps, legs.gaps
        self.states = legs.start.copy()  # at the end of the last accepted step
        self.rates = np.zeros_like(self.states)  # of them
        self.solved = self.states.copy()  # at the end of the step that has been tried
        self._slope = np.zeros_like(self.states)
        self._weights = np.ones_like(self.states)
        weigh_states(legs, self._weights, weight / float(legs.records["bore"].max()), ENERGY, PLAY)
        booked = np.zeros(self.states.size, bool)
        for record in legs.records:
            booked[record["booked"] : record["booked"] + BOOKED] = True
        for one in legs.pumps:
            booked[one["state"] + 1] = True
        self._places = np.concatenate([np.flatnonzero(~booked), np.flatnonzero(booked)])
        free = int((~booked).sum())
        self._rows = np.empty((free, free + 1))
        self._records_ahead = self.records.copy()  # room
        self.step = 0.0  # that is being tried [s]
        self._start: dict[str, Series] = {}  # what records were told at its start
        self.settles = False  # whether a static equilibrium is looked for
        self.follow(0.0, after=True)
        for n, item in enumerate(items):
            mbs.SetObjectParameter(item.object, NAME, self._pull(n))

    def _pull(self, n: int) -> Callable[..., float]:
        """The force with which a leg pulls its ends together, of the engine's signature."""
        start = self.items[n].preloaded.actuator.start_length

        def pull(mbs: Any, t: float, itemNumber: int, stretch: float, rate: float, *others: Any) -> float:
            if len(self.items) > 1:
                self._tell()
            record = self.records[n]
            record["length"], record["rate"] = start + stretch, rate
            if self.settles:
                return -self._at_rest(n)
            if not self._advance():
                return math.nan
            return -float(self.records[n]["force"])

        return pull

    def follow(self, t: float, after: bool = False) -> None:
        """Let drives and inlets be as they are at t [s], or just after it."""
        for record, item in zip(self.records, self.items, strict=True):
            told = item.told_after(t) if after else item.told(t)
            record["inflow"], record["inflow_rate"], record["opening"] = told

    def motion(self, n: int, state: Any = CURRENT) -> tuple[float, float]:
        """Length [m] of a leg and its rate [m/s]."""
        output = exudyn.OutputVariableType

        def apart(what: Any) -> Any:
            foot, head = (self._mbs.GetMarkerOutput(marker, what, state) for marker in self.items[n].markers)
            return head - foot

        between = apart(output.Position)
        length = math.sqrt(float(between @ between))
        return length, float(between @ apart(output.Velocity)) / length

    def _tell(self, state: Any = CURRENT) -> None:
        for n, record in enumerate(self.records):
            record["length"], record["rate"] = self.motion(n, state)

    def _advance(self) -> bool:
        """States at the end of the step, with the lengths that the records tell; whether they were found."""
        return bool(
            advance_legs(
                self.records, self.pumps, self.gaps, self.step, self._weights, self.states, self.rates,
                self.solved, self._slope, self._places, self._rows,
            )
        )  # fmt: skip

    def solve(self) -> None:
        """Find the states at the end of the step that the engine has solved. Raises ArithmeticError if not."""
        self._tell()
        if not self._advance():
            raise ArithmeticError(
                f"the pressures of {', '.join(i.preloaded.name for i in self.items)} not found"
            )

    def accept(self) -> None:
        """Keep the states that `solve` has found, and what they change by."""
        self.states[:], self.step = self.solved, 0.0
        self.refresh()

    def refresh(self, state: Any = CURRENT) -> None:
        """The engine's velocities, a drive, an inlet or a valve have jumped: rates of the states anew."""
        self._tell(state)
        self._start = {name: self.records[name].copy() for name in TOLD}
        self._press()
        self.rates[:], self.solved[:] = self._slope, self.states

    def _press(self) -> None:
        evaluate_legs(self.records, self.pumps, self.gaps, self.states, self._slope)

    def gap_rates(self, span: float) -> Matrix:
        """Rates of all gaps [Pa/s], [m/s] where `gaps` were evaluated last; span: length of a step [s]."""
        ahead, records, gaps = AHEAD * span, self._records_ahead, self.gaps.copy()
        records.view(np.uint8)[:] = self.records.view(np.uint8)  # field by field it takes a fifth of a run
        records["length"] += ahead * records["rate"]
        records["inflow"] += ahead * records["inflow_rate"]
        evaluate_legs(records, self.pumps.copy(), gaps, self.solved + ahead * self._slope, self._slope.copy())
        rates: Matrix = np.zeros_like(gaps)
        there = np.isfinite(gaps)  # those of what a leg does not have need not be
        rates[there] = (gaps[there] - self.gaps[there]) / ahead
        return rates

    def pass_gap(self, n: int, k: int, positive: bool) -> None:
        """A gap of a leg has passed zero; valves remember."""
        if k in (YIELD, RELIEF):
            self.records[n]["open" if k == YIELD else "rod_open"] = float(positive)

    def jumps(self, n: int, k: int) -> bool:
        """Whether a gap is that of a valve with hysteresis."""
        record = self.records[n]
        return bool((k == YIELD and record["jumps"]) or (k == RELIEF and record["rod_jumps"]))

    def refresh_start(self) -> None:
        """A valve has opened or closed where the step begins that has been tried: begin anew from there."""
        for name, values in self._start.items():
            self.records[name] = values
        self._press()
        self.rates[:], self.solved[:] = self._slope, self.states

    def slide(self, rest: float) -> None:
        """Move on by a time [s] that is not worth a step."""
        self.states += rest * self.rates

    def powers(self) -> tuple[float, float, float]:
        """Power [W] of pump, drive and tank, of what is lost in flows and dampers, and of seals, now."""
        records: Records = self.records
        work = float(records["work"].sum() + self.pumps["work"].sum())
        return work, float(records["loss"].sum()), float(records["friction"].sum())

    # --- static equilibrium ---

    def _at_rest(self, n: int) -> float:
        """Force [N] of a leg whose oil is closed inside, see `hydraulics.rest`."""
        rest_legs(self.records, self.pumps, self.gaps, self.states, self._slope)
        return float(self.records[n]["force"])
