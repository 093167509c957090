"""Impulses: where velocities jump, the forces of what holds bodies rigidly have no finite peak."""

import math
from collections.abc import Iterator

from support_exudyn.simulation.recorded_run import RecordedRun

NO_PEAK = "impulse, no finite peak"
# statistics that are then refused: extremes, and the deviation, in which the square of an impulse would stand
ENDLESS = ("largest", "largest_time", "min", "min_time", "max", "max_time", "std")
ROUNDING = 1e-9  # share of the largest impulse of an instant that others are rounded by


def impulses_of(run: RecordedRun, channel: str, after: float, until: float) -> list[float]:
    """Impulses [N s] or [N m s] of the joint, actuator or crank of a channel of forces, between two times [s].

    Those of pins and guides are magnitudes; of a pair in space those of both sides are added. None for a
    channel of something else, and where nothing jumps.
    """
    stem, _, quantity = channel.rpartition(".")
    if not quantity.startswith(("force", "moment")):
        return []
    sides = (stem, f"{stem}_left", f"{stem}_right")
    found = []
    for impulse in run.impulses:
        of_all = {**impulse.actuators, **impulse.cranks, **impulse.joints}
        least = ROUNDING * max(map(abs, of_all.values()), default=0.0)
        own = sum(of_all.get(side, 0.0) for side in sides)
        if after <= impulse.time <= until and abs(own) > least:
            found.append(own)
    return found


def refused(run: RecordedRun, after: float, until: float) -> dict[str, str]:
    """Names of the numbers of forces that have no limit between two times [s], and why they are refused."""
    return {
        f"{name}.{word}": f"{NO_PEAK}; allowed: {name}.impulse_1 [N s]"
        for name in struck(run, after, until)
        for word in ENDLESS
    }


def struck(run: RecordedRun, after: float, until: float) -> Iterator[str]:
    """The channels of forces that have an impulse between two times [s]."""
    return (name for name in run.channels if name.endswith(".force") and impulses_of(run, name, after, until))


def nth_impulse(run: RecordedRun, channel: str, n: int, after: float, until: float) -> float:
    """The n-th impulse of a channel between two times [s], from 0 on; not a number if there are fewer."""
    found = impulses_of(run, channel, after, until)
    return found[n] if n < len(found) else math.nan
