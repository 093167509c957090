"""What happens in the legs of a circuit within steps: valves open and close, cavities grow, stops are met.

Each is a gap that passes zero, see `hydraulics.records`. Over a step it is taken as the cubic that fits the gap
and its rate at both ends. A step that passes zero inside is repeated so that it ends there, as for a contact.
The force has a kink there; only a valve with hysteresis does something else from then on.
"""

from __future__ import annotations

import math

import numpy as np

from support_exudyn.formulations.exudyn.scene.leg_circuit import LegCircuit
from support_exudyn.mechanics.trajectory import OilEvent
from support_exudyn.scene.hydraulics.flows import OPEN
from support_exudyn.scene.hydraulics.gaps import begin_sides
from support_exudyn.scene.hydraulics.implicit import WATCHED, passes_gap
from support_exudyn.scene.hydraulics.records import GAP_NAMES, HIGH_2, LOW
from user_forces.contact_events import BEYOND, SHARE
from user_forces.roots import DepthPath, first_rise

NEAR_PRESSURE, NEAR_LENGTH = 0.1, 1e-12  # [Pa], [m] beyond zero that rounding may be


class LegEvents:
    """Where within steps things happen in the legs of a circuit.

    Arguments:
        circuit: that is run.
    """

    def __init__(self, circuit: LegCircuit) -> None:
        self.circuit = circuit
        self.found: list[list[OilEvent]] = [[] for _ in circuit.items]
        self._watched = np.zeros((WATCHED, *circuit.gaps.shape))
        self._sides, self._near, self._gaps, self._rates, self._rates_at_end = self._watched
        self._near[:] = NEAR_PRESSURE
        self._near[:, LOW : HIGH_2 + 1] = NEAR_LENGTH
        self._pending: list[tuple[int, int, float]] = []  # leg, gap, time: at the end of the tried step
        self.landing, self.wants_cut, self.happens = math.inf, False, False

    def start(self) -> None:
        """The run begins: on which side of zero each gap is."""
        begin_sides(self.circuit.records, self.circuit.gaps, self._sides)
        self.happens = bool(self._sides.any())
        self.keep()

    def keep(self) -> None:
        """Gaps are those at the start of a step from now on."""
        if self.happens:
            self._passes_any(1.0)
            self._begin_step()

    def _begin_step(self) -> None:
        self._gaps[:], self._rates[:] = self.circuit.gaps, self._rates_at_end
        self.circuit.keep_inputs()

    def _passes_any(self, h: float) -> bool:
        circuit = self.circuit
        return bool(passes_gap(circuit.records, circuit.pumps, circuit.gaps, h, circuit.known, self._watched))

    def begin_try(self) -> None:
        """Begin to try a step: nothing has happened in it."""
        self._pending, self.wants_cut = [], False

    def judge(self, t: float) -> float | None:
        """Decide on a solved step that would end at t [s]: None if it may stand, else see `ClearanceJoint`."""
        h = self.circuit.step
        if not self.happens or not self._passes_any(h):
            return None
        gaps, rates, again = self.circuit.gaps.copy(), self._rates_at_end, None
        beyond = -self._sides * gaps > self._near
        turns = (self._sides * self._rates < 0.0) & (self._sides * rates > 0.0)
        for n, k in np.argwhere((self._sides != 0.0) & (beyond | turns)).tolist():
            asked = self._one(n, k, t, h, (float(gaps[n, k]), float(rates[n, k])))
            if asked is not None:
                again = asked if again is None else min(again, asked)
        self.wants_cut = again is not None and again < math.inf
        if again is not None:
            self._pending = []
        return again

    def _one(self, n: int, k: int, t: float, h: float, end: tuple[float, float]) -> float | None:
        """Judge a step by one gap, see `judge`; end: the gap and its rate at the end of the step."""
        if OPEN in (self._gaps[n, k], end[0]):  # an inlet is opened just after a break, or closed just before
            self._pending.append((n, k, t if end[0] == OPEN else t - h))
            return None
        x = self._passes(n, k, h, end)
        if x > 1.0:
            return None
        if x <= SHARE:  # the step begins where it happens
            self._pass(n, k, t - h + x * h)
            if self.circuit.jumps(n, k):
                self.circuit.refresh_start()
                self.keep()
                return math.inf
            self._gaps[n, k] = self._sides[n, k] * float(self._near[n, k])
            x = self._passes(n, k, h, end)
            if x > 1.0:
                return None
        if x >= 1.0 - SHARE:
            self._pending.append((n, k, t - (1.0 - x) * h))
            return None
        goal = x + BEYOND * SHARE
        self.landing = min(self.landing, t - (1.0 - goal) * h)
        # the engine shortens a repeated step to three quarters or less, so a late one is reached in two
        return (goal if goal <= 0.75 else 0.5 * goal) * h

    def _passes(self, n: int, k: int, h: float, end: tuple[float, float]) -> float:
        """The fraction of the step at which a gap passes zero to the other side; infinite if it does not."""
        side, near = -float(self._sides[n, k]), float(self._near[n, k])
        before, after = side * float(self._gaps[n, k]), side * end[0]
        if before > 0.0 and after > near:  # it did steps ago, by less than counted then
            return 0.0
        path = DepthPath(min(before, -1e-3 * near), side * float(self._rates[n, k]), after, side * end[1], h)
        return first_rise(path)

    def _pass(self, n: int, k: int, t: float) -> None:
        self._sides[n, k] = -self._sides[n, k]
        begins = bool(self._sides[n, k] > 0.0)
        self.circuit.pass_gap(n, k, begins)
        self.found[n].append(OilEvent(t, GAP_NAMES[k], begins))

    def accept(self, t: float) -> bool:
        """The step to t [s] stands: note what has happened at its end; whether anything has."""
        happened = bool(self._pending)
        for n, k, at in sorted(self._pending, key=lambda one: one[2]):
            self._pass(n, k, at)
        self._pending = []
        if happened or not self.landing > t:
            self.landing = math.inf
        if happened:
            self.circuit.refresh()
            self.keep()
        elif self.happens:
            self._begin_step()
        return happened
