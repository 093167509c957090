"""The numbers that every result reports, and how each is measured."""

import math
import numbers
import operator
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from support_exudyn.mechanics.time_statistics import GREATEST, LEAST, TimeWindow
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation import impulses
from support_exudyn.simulation.recorded_run import RecordedRun
from user_forces.contact_state import Onset
from user_forces.values.value import InputError, short

Series = npt.NDArray[np.float64]
NEWTON = 5.0  # tolerances of Newton's method that are left of a number at any step; 1.6 of an impact's speed
# share of the largest force in a machine that is rounding of every force: forces balance each other
ROUNDING_OF_FORCES = 1e-12
ROUNDING = 1e-10  # share of a number, or of the largest of its kind, that no estimate is below
# of gravity over the machine's size: the angular acceleration [rad/s^2] of which rounding is counted as a share
# in a machine at rest, which has none of its own
SLOW = 1e-3
# of forces; the largest is of the magnitude, the extremes have their sign
STATISTICS: Mapping[str, Callable[[TimeWindow], float]] = {
    "mean": lambda window: window.mean,
    "std": lambda window: window.std,
    "largest": lambda window: window.largest[0],
    "min": lambda window: window.least[0],
    "max": lambda window: window.greatest[0],
}
DOUBTS: Mapping[str, Callable[[TimeWindow], float]] = {  # of the same, where a window ends inside intervals
    "mean": lambda window: window.mean_doubt,
    "std": lambda window: window.std_doubt,
    "largest": lambda window: max(window.least_doubt, window.greatest_doubt),
    "min": lambda window: window.least_doubt,
    "max": lambda window: window.greatest_doubt,
}
LARGEST: Callable[[TimeWindow], tuple[float, float]] = operator.attrgetter("largest")
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
    left: share of it that steps do not make smaller. missed: by how much it may be off because its window ends
    inside an interval of the statistics. values: the largest value that it is computed from, which rounding and
    what Newton's method leaves are shares of: a least value can be next to nothing beside it. rounding: what is
    left of the largest numbers that it is a difference of, in its unit.
    floor_of: the force or impact whose error is a floor of its own error; empty: none. Means and times are
    known better than what is of them.
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
    rounding: float = 0.0
    step: float = 0.0
    settles: bool = True
    floor_of: str = ""


def measures(
    result: RecordedRun, after: float, until: float, sized: bool = True
) -> Mapping[str, ReportedNumber]:
    """The numbers that every result reports: name, unit and how it is measured, see `Result.numbers`.

    sized: whether sizes are told, too, which take as long as the numbers and which errors alone are told by.

    Raises InputError if the run does not last between the times.
    """
    after, until = _time(after, "after"), _time(until, "until")
    result.check_window(after, until)
    found: dict[str, ReportedNumber] = {}
    left = left_by_newton(result.scenario)
    turning = [name for name in result.channels if name.endswith(ANGULAR_ACCELERATION)]
    fastest = max([_slow(result.scenario), *(_most(result, name) for name in turning)]) if sized else 0.0
    rounded = ROUNDING_OF_FORCES * _strongest(result) if sized else 0.0
    for name, channel in result.channels.items():
        if name.endswith(FORCE) and channel.is_determined:
            window, stem = result.window(name, after, until), name.removesuffix(FORCE)
            most = window.largest[0] if sized else 0.0
            for word, statistic in STATISTICS.items():
                if word in SIGNED and (name.startswith("pin.") or stem in result.scenario.linkage.slides):
                    continue  # a magnitude, which has no sign
                measure, between = over(name, statistic, after, until), over(name, DOUBTS[word], after, until)
                of = name if word in AVERAGED else ""  # of a single time, which others average out
                share, values = left, most
                size = 0.0 if word in AVERAGED else most
                floor_of = "" if word == "mean" else name
                if word == "std" and sized:
                    spread, mean = window.std, window.rms
                    # rounding of the forces scatters, and what scatters beside more adds next to nothing
                    values = spread + (math.hypot(spread, ROUNDING * most) - spread) / ROUNDING
                    share = left_of_spread(left, spread, mean) / values if values > 0.0 else left
                family = f"force.{word if word in AVERAGED else 'largest'}"
                found[f"{name}.{word}"] = ReportedNumber(
                    channel.unit, measure, size, family, of, share, between, values, rounded, floor_of=floor_of
                )
                if word == "largest":
                    found[f"{name}.largest_time"] = ReportedNumber(
                        "s",
                        time_of(name, LARGEST, after, until),
                        missed=other_times(name, LARGEST, after, until, rounded),
                        settles=False,
                    )
        elif name in turning:
            measure, between = (over(name, of["std"], after, until) for of in (STATISTICS, DOUBTS))
            found[f"{name}.std"] = ReportedNumber(
                channel.unit, measure, fastest, ANGULAR_ACCELERATION, left=left, missed=between
            )
    for point in result.scenario.linkage.points:
        if not {f"{point}.x", f"{point}.y"} <= result.channels.keys():
            continue  # it was not asked for, and no error either, for whose sake it would have been recorded
        farthest = max([_size_of(result.scenario), *(_most(result, f"{point}.{axis}") for axis in ("x", "y"))])
        for axis in ("x", "y"):
            measure, between = (
                over(f"{point}.{axis}", of["mean"], after, until) for of in (STATISTICS, DOUBTS)
            )
            found[f"{point}.{axis}.mean"] = ReportedNumber("m", measure, farthest, "place", missed=between)
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


def _most(run: RecordedRun, name: str) -> float:
    """The largest magnitude of a channel over the run, in its unit."""
    return run.window(name).largest[0]


def _strongest(run: RecordedRun) -> float:
    """The largest force in the machine over the run, at least its weight [N]."""
    weight = math.hypot(*run.scenario.gravity) * sum(one.mass for one in run.scenario.linkage.bodies.values())
    forces = (_most(run, name) for name in run.channels if name.endswith(FORCE))
    return max([weight, *forces, *run.largest_force.values()])


def _size_of(scenario: Scenario) -> float:
    """How far the machine reaches from the origin [m]."""
    return max(math.hypot(*body.centre) for body in scenario.linkage.bodies.values())


def _slow(scenario: Scenario) -> float:
    """See `SLOW` [rad/s^2]."""
    size = _size_of(scenario)
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
            "m/s", _onset(pin, n, "speed"), of=impact, left=left, step=slow, floor_of=impact
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


def over(name: str, statistic: Callable[[TimeWindow], float], after: float, until: float) -> Measure:
    """A statistic of a channel between two times [s], in its unit."""
    return lambda run: statistic(run.window(name, after, until))


def time_of(
    name: str, extreme: Callable[[TimeWindow], tuple[float, float]], after: float, until: float
) -> Measure:
    """The time [s], between two times [s], of an extreme of a channel."""
    return lambda run: extreme(run.window(name, after, until))[1]


def other_times(
    name: str,
    extreme: Callable[[TimeWindow], tuple[float, float]],
    after: float,
    until: float,
    rounding: float = 0.0,
) -> Measure:
    """How far the time of an extreme may be off [s].

    To the farthest interval whose extreme comes as near to it as the runs differ in both, and as rounding makes
    it, in the channel's unit; within its own interval as far as a parabola falls by that; and as far as the
    runs are apart in the time.
    """

    def by_interval(window: TimeWindow) -> Series:
        rows = (
            TimeWindow(window.durations[n : n + 1], window.rows[n : n + 1]) for n in range(len(window.rows))
        )
        return np.array([extreme(row) for row in rows]).T

    def measure(run: RecordedRun) -> float:
        window = run.window(name, after, until)
        (values, times), (value, time) = by_interval(window), extreme(window)
        known = max(window.least_doubt, window.greatest_doubt) + ROUNDING * abs(value) + rounding
        doubts = np.full(values.size, known)
        apart, other = 0.0, run.coarser
        while other is not None:
            its = other.window(name, after, until)
            apart = max(apart, abs(extreme(its)[1] - time))
            if len(its.rows) == values.size:
                doubts = np.maximum(doubts, np.abs(by_interval(its)[0] - values))
            other = other.coarser
        own = int(np.abs(times - time).argmin())
        sign = -1.0 if extreme(window) == window.least else 1.0
        near = sign * values + doubts >= sign * value - doubts[own]  # the one may be less and the other more
        fall = float(window.rows[own, GREATEST] - window.rows[own, LEAST])
        flat = min(1.0, math.sqrt(2.0 * doubts[own] / fall)) if fall > 0.0 and run.statistics else 1.0
        return max(float(np.abs(times[near] - time).max()), apart) + flat * float(window.durations[own])

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
