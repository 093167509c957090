"""What a competitor's run gives, and how its touches are found afterwards."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from support_exudyn.formulations.engine_settings import quiet_engine
from support_exudyn.mechanics.contact_state import Onset
from support_exudyn.simulation.single_run import paused_collector

Series = npt.NDArray[np.float64]


@dataclass(frozen=True)
class PeerRun:
    """Outcome of a competitor's run; all series at the scenario's records.

    time: [s]. force: magnitude in the loose pin [N]. angular_velocity, angular_acceleration: of the link that
    the loose pin ends (rear link, rod) [rad/s], [rad/s^2]. x, y: canopy tip or slider [m]. onsets: by
    interpolation of the depth at the ends of steps. largest_force: at the end of any step [N]. wall_time: of
    everything [s]; solve_time: of the solver alone [s]. steps: accepted. user_function_calls: of the force, in
    Python; 0 where they are not counted.
    newton_iterations, jacobians: of the solver, 0 if it has none.
    """

    time: Series
    force: Series
    angular_velocity: Series
    angular_acceleration: Series
    x: Series
    y: Series
    onsets: tuple[Onset, ...]
    largest_force: float
    wall_time: float
    solve_time: float
    steps: int
    user_function_calls: int
    newton_iterations: int
    jacobians: int

    def rise(self, start: float = 3.0, end: float = 5.0) -> tuple[float, float]:
        """Mean and standard deviation of the force over the records between two times [s]."""
        inside = (self.time >= start - 1e-9) & (self.time <= end + 1e-9)
        return float(self.force[inside].mean()), float(self.force[inside].std())


def touches(time: Sequence[float], depth: Sequence[float], rate: Sequence[float]) -> tuple[Onset, ...]:
    """Touches from time [s], depth [m] and its rate [m/s] at the ends of all steps, and how they end.

    Between two steps the depth is the cubic that fits depth and rate at both; where it passes zero is found by
    bisection, and its slope there is the speed.
    """
    t, d, r = (np.asarray(series, dtype=np.float64) for series in (time, depth, rate))
    found: list[Onset] = []
    for n in np.flatnonzero((d[:-1] <= 0.0) != (d[1:] <= 0.0)).tolist():
        h = float(t[n + 1] - t[n])
        x, slope = _crossing(float(d[n]), float(d[n + 1]), h * float(r[n]), h * float(r[n + 1]))
        if d[n] <= 0.0:
            found.append(Onset(float(t[n]) + x * h, slope / h))
        elif found:  # else it began in contact
            found[-1] = found[-1].parted(float(t[n]) + x * h, -slope / h)
    return tuple(found)


def _crossing(first: float, last: float, first_slope: float, last_slope: float) -> tuple[float, float]:
    """Where between 0 and 1 the cubic with these values and slopes at both passes zero, and its slope there."""
    a, b, c = last - first, first_slope, last_slope
    cubic = np.array([b + c - 2.0 * a, 3.0 * a - 2.0 * b - c, b, first])
    low, high = 0.0, 1.0
    for _ in range(60):
        x = 0.5 * (low + high)
        if (np.polyval(cubic, x) > 0.0) == (last > 0.0):
            high = x
        else:
            low = x
    return high, float(np.polyval(np.polyder(cubic), high))


@contextmanager
def undisturbed() -> Iterator[None]:
    """No output of the engine, no collection of garbage: neither is part of what is measured."""
    with quiet_engine(), paused_collector():
        yield
