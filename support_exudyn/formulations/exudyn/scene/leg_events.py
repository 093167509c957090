"""What happens in legs within steps: valves open and close, cavities grow, stops are met.

Each is a gap that passes zero, see `hydraulics.records`. Over a step it is taken as the cubic that fits the gap
and its rate at both ends. A step that passes zero inside is repeated so that it ends there, as for a contact.
The force has a kink there; only a valve with hysteresis does something else from then on.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from support_exudyn.mechanics.trajectory import OilEvent, Series
from support_exudyn.model.hydraulics.valves import SHUT
from support_exudyn.scene.hydraulics.fill import Legs
from support_exudyn.scene.hydraulics.implicit import passes_gap
from support_exudyn.scene.hydraulics.records import Matrix
from support_exudyn.scene.hydraulics.rest import begin_sides
from support_exudyn.scene.hydraulics.series import INPUTS
from user_forces.contact_events import BEYOND, SHARE
from user_forces.roots import DepthPath, first_rise

NEAR = 10.0  # times as far beyond zero as where a gap is met may be by rounding


class LegEvents:
    """Where within steps things happen in legs.

    Arguments:
        legs: all of a scene.
        known: what is known of their states, see `hydraulics.implicit`.
        evaluate: evaluates legs with the states and inputs at the start of a step.
    """

    def __init__(self, legs: Legs, known: Matrix, evaluate: Callable[[], None]) -> None:
        self.legs, self.known, self._evaluate = legs, known, evaluate
        self.found: list[list[OilEvent]] = [[] for _ in legs.names]
        self._gaps, self._valves = legs.arrays.gaps, legs.arrays.valves
        self._start: dict[str, Series] = {}  # inputs of the legs at the start of a step
        self._gaps["near"] *= NEAR
        self._pending: list[tuple[int, float]] = []  # gap, time: at the end of the tried step
        self.landing, self.wants_cut, self.happens = math.inf, False, False

    def start(self) -> None:
        """The run begins: on which side of zero each gap is."""
        begin_sides(self._gaps, self._valves)
        self.happens = bool(self._gaps["side"].any())
        self.keep()

    def keep(self) -> None:
        """Gaps are those at the start of a step from now on."""
        if self.happens:
            self._passes_any(1.0)
            self._begin_step()

    def _begin_step(self) -> None:
        self._gaps["before"], self._gaps["rate_before"] = self._gaps["now"], self._gaps["rate"]
        self._start = {name: self.legs.records[name].copy() for name in INPUTS}

    def _passes_any(self, h: float) -> bool:
        return bool(passes_gap(self.legs.arrays, h, self.known))

    def begin_try(self) -> None:
        """Begin to try a step: nothing has happened in it."""
        self._pending, self.wants_cut = [], False

    def judge(self, t: float, h: float) -> float | None:
        """Decide on a solved step of h [s] to t [s]: None if it may stand, else see `ClearanceJoint`."""
        if not self.happens or not self._passes_any(h):
            return None
        gaps, again = self._gaps, None
        beyond = -gaps["side"] * gaps["now"] > gaps["near"]
        turns = (gaps["side"] * gaps["rate_before"] < 0.0) & (gaps["side"] * gaps["rate"] > 0.0)
        ends = gaps[["now", "rate"]].tolist()  # where a valve opens at the start, all is evaluated there
        for k in np.flatnonzero((gaps["side"] != 0.0) & (beyond | turns)).tolist():
            asked = self._one(k, t, h, ends[k])
            if asked is not None:
                again = asked if again is None else min(again, asked)
        self.wants_cut = again is not None and again < math.inf
        if again is not None:
            self._pending = []
        return again

    def _one(self, k: int, t: float, h: float, end: tuple[float, float]) -> float | None:
        """Judge a step by one gap, see `judge`; end: the gap and its rate at the end of the step."""
        gap = self._gaps[k]
        if SHUT in (gap["before"], end[0]):  # an inlet is opened just after a break, or closed just before
            self._pending.append((k, t if end[0] == SHUT else t - h))
            return None
        x = self._passes(k, h, end)
        if x > 1.0:
            return None
        if x <= SHARE:  # the step begins where it happens
            self._pass(k, t - h + x * h)
            if gap["valve"] >= 0 and self._valves[gap["valve"]]["jumps"]:
                for name, values in self._start.items():  # begin anew from there
                    self.legs.records[name] = values
                self._evaluate()
                self.keep()
                return math.inf
            gap["before"] = gap["side"] * gap["near"]
            x = self._passes(k, h, end)
            if x > 1.0:
                return None
        if x >= 1.0 - SHARE:
            self._pending.append((k, t - (1.0 - x) * h))
            return None
        goal = x + BEYOND * SHARE
        self.landing = min(self.landing, t - (1.0 - goal) * h)
        # the engine shortens a repeated step to three quarters or less, so a late one is reached in two
        return (goal if goal <= 0.75 else 0.5 * goal) * h

    def _passes(self, k: int, h: float, end: tuple[float, float]) -> float:
        """The fraction of the step at which a gap passes zero to the other side; infinite if it does not."""
        gap = self._gaps[k]
        side, near = -float(gap["side"]), float(gap["near"])
        before, after = side * float(gap["before"]), side * end[0]
        if before > 0.0 and after > near:  # it did steps ago, by less than counted then
            return 0.0
        path = DepthPath(min(before, -1e-3 * near), side * float(gap["rate_before"]), after, side * end[1], h)
        return first_rise(path)

    def _pass(self, k: int, t: float) -> None:
        gap = self._gaps[k]
        gap["side"] = -gap["side"]
        begins = bool(gap["side"] > 0.0)
        if gap["valve"] >= 0:
            self._valves[gap["valve"]]["memory"] = float(begins)
        self.found[gap["leg"]].append(OilEvent(t, self.legs.gaps[k], begins))

    def accept(self, t: float) -> bool:
        """The step to t [s] stands: note what has happened at its end; whether anything has, see `keep`."""
        happened = bool(self._pending)
        for k, at in sorted(self._pending, key=lambda one: one[1]):
            self._pass(k, at)
        self._pending = []
        if happened or not self.landing > t:
            self.landing = math.inf
        if self.happens and not happened:
            self._begin_step()
        return happened
