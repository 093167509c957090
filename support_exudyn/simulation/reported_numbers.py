"""The numbers that every result reports, and how each is measured."""

import math
import numbers
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from support_exudyn.mechanics.contact_state import Onset
from support_exudyn.mechanics.extremes import largest, missed
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation import impulses
from support_exudyn.simulation.recorded_run import RecordedRun
from user_forces.values.value import InputError, short

Series = npt.NDArray[np.float64]
NEWTON = 5.0  # tolerances of Newton's method that are left of a number at any step; 1.6 of an impact's speed
ROUNDING = 1e-10  # share of a number, or of the largest of its kind, that no estimate is below
# of gravity over the machine's size: the angular acceleration [rad/s^2] of which rounding is counted as a share
# in a machine at rest, which has none of its own
SLOW = 1e-3
# of forces; the largest is of the magnitude, the extremes have their sign
STATISTICS: Mapping[str, Callable[[Series], float]] = {
    "mean": np.mean,
    "std": np.std,
    "largest": largest,
    "min": np.min,
    "max": np.max,
}
SIGNED, AVERAGED = ("min", "max"), ("mean", "std")
FORCE, ANGULAR_ACCELERATION = ".force", ".angular_acceleration"  # how names of channels end
ONSETS = 3  # of every clearance pin that are reported; each multiplies the errors of those before


def measured(scenario: Scenario) -> tuple[str, ...]:
    """Names of the channels that the numbers of `measures`, and so all estimates, are taken from."""
    points = {f"{point}.{axis}" for point in scenario.linkage.points for axis in ("x", "y")}
    return tuple(
        name
        for name in scenario.channel_definitions
        if name.endswith((FORCE, ANGULAR_ACCELERATION)) or name in points
    )


Measure = Callable[[RecordedRun], float]


def _nothing(run: RecordedRun) -> float:
    del run
    return 0.0


class ReportedNumber(NamedTuple):
    """How a number is measured.

    unit: its unit. measure: gives it, from a result. size: of the largest number of its kind. family: of
    numbers that are wrong by like shares; empty: none. of: the force or impact that it is of; empty: of none.
    left: share of it that steps do not make smaller. missed: by how much it may be off because it is taken
    from records; of extremes, see `extremes.missed`. values: the largest value that it is computed from, which
    rounding and what Newton's method leaves are shares of: a least value can be next to nothing beside it.
    step: by how much a single step may be wrong, which counts where runs agree but for rounding.
    settles: whether it tends to something as steps become shorter; the time of a largest value may jump from
    peak to peak, and says nothing of how fast other numbers settle.
    """

    unit: str
    measure: Measure
    size: float = 0.0
    family: str = ""
    of: str = ""
    left: float = 0.0
    missed: Measure = _nothing
    values: float = 0.0
    step: float = 0.0
    settles: bool = True


def measures(
    result: RecordedRun, after: float, until: float, sized: bool = True
) -> Mapping[str, ReportedNumber]:
    """The numbers that every result reports: name, unit and how it is measured, see `Result.numbers`.

    sized: whether sizes are told, too, which take as long as the numbers and which errors alone are told by.

    Raises InputError if no record lies between the times.
    """
    after, until = _time(after, "after"), _time(until, "until")
    chosen = inside(result, after, until)
    if chosen.start == chosen.stop:
        first, last = result.time[[0, -1]]
        raise InputError(
            f"after = {after} s, until = {until} s: no record lies between; allowed: times around at least "
            f"one, from {first:g} to {last:g} s"
        )
    found: dict[str, ReportedNumber] = {}
    left = left_by_newton(result.scenario)
    turning = [name for name in result.channels if name.endswith(ANGULAR_ACCELERATION)]
    fastest = max([_slow(result.scenario), *(largest(result[name]) for name in turning)]) if sized else 0.0
    for name, channel in result.channels.items():
        if name.endswith(FORCE) and channel.is_determined:
            forces = result[name][chosen]
            most = largest(forces) if sized else 0.0
            for word, statistic in STATISTICS.items():
                if word in SIGNED and name.startswith("pin."):
                    continue  # a magnitude, which has no sign
                measure, between = over(name, statistic, after, until), _missed(word, name, after, until)
                of = name if word in AVERAGED else ""  # of a single record, which others average out
                share, values = left, most
                if word == "std" and sized:
                    spread, mean = measure(result), float(np.abs(forces).mean())
                    # rounding of the forces scatters, and what scatters beside more adds next to nothing
                    values = spread + (math.hypot(spread, ROUNDING * most) - spread) / ROUNDING
                    share = left_of_spread(left, spread, mean) / values if values > 0.0 else left
                family = f"force.{word}"
                found[f"{name}.{word}"] = ReportedNumber(
                    channel.unit, measure, 0.0, family, of, share, between, values
                )
                if word == "largest":
                    found[f"{name}.largest_time"] = ReportedNumber(
                        "s",
                        time_of_largest(name, after, until),
                        missed=_other_times(name, after, until),
                        settles=False,
                    )
        elif name in turning:
            measure = over(name, np.std, after, until)
            found[f"{name}.std"] = ReportedNumber(
                channel.unit, measure, fastest, ANGULAR_ACCELERATION, left=left
            )
    for point in result.scenario.linkage.points:
        if not {f"{point}.x", f"{point}.y"} <= result.channels.keys():
            continue  # it was not asked for, and no error either, for whose sake it would have been recorded
        farthest = largest(path_of(result, point)) if sized else 0.0
        for axis in ("x", "y"):
            measure = over(f"{point}.{axis}", np.mean, after, until)
            found[f"{point}.{axis}.mean"] = ReportedNumber("m", measure, farthest, "place")
    for pin in result.onsets:
        stem = result.scenario.contact_stem(pin)
        # not of an edge in space: a section's share of the force is the less the more sections there are
        if pin.rpartition(".")[0] not in result.onsets:
            found[f"{stem}.largest_force"] = ReportedNumber(
                "N", _largest(pin), family="force.largest", left=left
            )
            if pin in result.largest_force_time:
                found[f"{stem}.largest_force_time"] = ReportedNumber(
                    "s", _time_at_any_step(pin), missed=_other_impacts(pin), settles=False
                )
        found.update(impact_numbers(result, pin, ONSETS))
    return _without_endless(found, result, after, until)


def _without_endless(
    found: Mapping[str, ReportedNumber], result: RecordedRun, after: float, until: float
) -> dict[str, ReportedNumber]:
    """The numbers with impulses in place of those that have no limit, see `impulses`."""
    no_limit = impulses.refused(result, after, until)
    kept = {name: kind for name, kind in found.items() if name not in no_limit}
    for name in impulses.struck(result, after, until):
        for n in range(len(impulses.impulses_of(result, name, after, until))):
            measure = partial(impulses.nth_impulse, channel=name, n=n, after=after, until=until)
            kept[f"{name}.impulse_{n + 1}"] = ReportedNumber("N s", measure)
    return kept


def _slow(scenario: Scenario) -> float:
    """See `SLOW` [rad/s^2]."""
    size = max(math.hypot(*body.centre) for body in scenario.linkage.bodies.values())
    return SLOW * math.hypot(*scenario.gravity) / size if size > 0.0 else 0.0


def impact_numbers(result: RecordedRun, pin: str, most: int) -> dict[str, ReportedNumber]:
    """Time and speed of the first impacts of a clearance pin, `most` of them, by names such as onset_1.time."""
    stem, left = result.scenario.contact_stem(pin), left_by_newton(result.scenario)
    found: dict[str, ReportedNumber] = {}
    for n, onset in enumerate(result.onsets[pin][:most]):
        impact = f"{stem}.onset_{n + 1}"
        late, slow = _of_a_step(result.scenario, pin, onset) if result.scenario.chooses_steps else (0.0, 0.0)
        found[f"{impact}.time"] = ReportedNumber("s", _onset(pin, n, "time"), of=impact, left=left, step=late)
        found[f"{impact}.speed"] = ReportedNumber(
            "m/s", _onset(pin, n, "speed"), of=impact, left=left, step=slow
        )
    return found


def left_by_newton(scenario: Scenario) -> float:
    """Share of a number that Newton's method leaves, whatever the steps."""
    return 0.0 if scenario.chooses_steps else NEWTON * scenario.solver.newton_tolerance


def left_of_spread(left: float, spread: float, mean: float) -> float:
    """What Newton's method leaves of a spread, where it leaves a share of forces of this mean magnitude.

    It can be as much as that share of the mean, if what is left varies as the force does; mostly it varies with
    less. Of fifty scenes it was at most what is taken here but in seven, in which means moved by more than
    their share, too.
    """
    return left * math.sqrt(mean * spread)


def _of_a_step(scenario: Scenario, pin: str, onset: Onset) -> tuple[float, float]:
    """By how much a step may be wrong about an impact's time [s] and speed [m/s]; 0 of one at the start."""
    if not (onset.time > 0.0 and onset.speed > 0.0):
        return 0.0, 0.0
    tolerance, clearance = scenario.solver.tolerance, scenario.contact_places[pin].play
    return tolerance * clearance / onset.speed, tolerance * onset.speed


def _time(item: Any, name: str) -> float:
    try:
        if isinstance(item, numbers.Real):
            return float(item)
    except OverflowError:  # a whole number of hundreds of digits
        pass
    raise InputError(f"{name} = {short(item)}: allowed: a time in s")


def inside(run: RecordedRun, after: float, until: float) -> slice:
    """Which records lie between two times [s]; none if one of these is no number."""
    after, until = after - 1e-9, until + 1e-9  # times of records are sums of periods
    first = int(run.time.searchsorted(after))
    return slice(first, int(run.time.searchsorted(until, "right")) if until >= after else first)


def over(name: str, statistic: Callable[[np.ndarray], float], after: float, until: float) -> Measure:
    """A statistic of a channel's records between two times [s], in its unit."""

    def measure(run: RecordedRun) -> float:
        return float(statistic(run[name][inside(run, after, until)]))

    return measure


def time_of_largest(name: str, after: float, until: float) -> Measure:
    """The time [s] of the record, between two times [s], at which a channel is largest in magnitude."""

    def measure(run: RecordedRun) -> float:
        chosen = inside(run, after, until)
        return float(run.time[chosen][np.abs(run[name][chosen]).argmax()])

    return measure


def _other_times(name: str, after: float, until: float) -> Measure:
    """How far the time of a largest value may be off [s].

    To the farthest record whose magnitude comes as near to the largest as the runs differ in that, and as
    records may miss of it; and one period of the records.
    """

    def measure(run: RecordedRun) -> float:
        chosen = inside(run, after, until)
        time, values = run.time[chosen], np.abs(run[name][chosen])
        doubt, other = missed("largest", run[name][chosen], time, run.scenario.breaks), run.coarser
        while other is not None:
            doubt = max(doubt, abs(float(values.max()) - largest(other[name][inside(other, after, until)])))
            other = other.coarser
        # the one may be less and the other more
        near = time[values >= values.max() - 2.0 * doubt]
        return float(np.abs(near - time[values.argmax()]).max()) + float(np.diff(time).max(initial=0.0))

    return measure


def _missed(word: str, name: str, after: float, until: float) -> Measure:
    def measure(run: RecordedRun) -> float:
        chosen = inside(run, after, until)
        return missed(word, run[name][chosen], run.time[chosen], run.scenario.breaks)

    return measure


def _largest(pin: str) -> Measure:
    return lambda run: run.largest_force[pin]


def _time_at_any_step(pin: str) -> Measure:
    return lambda run: run.largest_force_time.get(pin, math.nan)


def _other_impacts(pin: str) -> Measure:
    """How far the time of the largest force at any step may be off [s].

    As far as the runs are apart in it, and a step of mean length, for the force is known at the ends of steps.
    """

    def measure(run: RecordedRun) -> float:
        times, other = [run.largest_force_time[pin]], run.coarser
        while other is not None:
            times.append(other.largest_force_time.get(pin, math.nan))
            other = other.coarser
        return max(times) - min(times) + run.scenario.duration / max(1, run.counts.steps)

    return measure


def _onset(pin: str, n: int, field: str) -> Measure:
    def measure(run: RecordedRun) -> float:
        onsets = run.onsets[pin]
        return float(getattr(onsets[n], field)) if n < len(onsets) else float("nan")

    return measure


def path_of(result: RecordedRun, point: str) -> Series:
    """The path of a traced point [m], shape (2, n)."""
    return np.array([result[f"{point}.x"], result[f"{point}.y"]])
