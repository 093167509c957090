"""Numbers of a result with their estimated errors.

Three runs of a scene, each with half the steps' length of the one before, give a number three values a, b, c.
How fast its distances d2 = |b - a| and d1 = |c - b| fall is more or less the same for all numbers of a scene:

    r = d1 / d2, the median of all numbers

If they go on to fall so, the distance of c from what it tends to is d1 r / (1 - r). The estimate is a
factor of the formulation (`Formulation.safety`) times that, with an r of its own for a number that falls
slower than others. Two runs can agree by chance, so d1 is not believed below

- a share of d2: r, or where steps are chosen by a tolerance CHOSEN, and CHOSEN_OF_LOOSE where that is large.
  Distances fall by eight there, but irregularly: the errors of two runs can be alike, and so can be those of
  all of their numbers;
- of a spread or an extreme, ALIKE times the larger distance of mean and spread of the same force; of a speed,
  of time and speed of the same impact; these as shares of their sizes;
- ALIKE times, as a share of sizes, the middle one of its family: means, spreads and extremes of all
  forces, spreads of angular accelerations, places.

What Newton's method leaves is added: two runs do not show it. It is a share of the force; of a spread that is
small beside the mean it is more than a share of that.

Where steps are chosen by a tolerance, they can be the same up to an impact whatever the tolerance is, as after
the first step. Runs then agree in that touch but for rounding. Its error is what a single step may be wrong
by: the tolerance times the clearance over the impact's speed, and times that speed.

Measured: of 12 920 numbers of `tests/simulation/test_accuracy.py` 99.5 % are covered, the worst true error is
4.4 times the estimated one, and estimates are 12 times as large in the median. The command
`tests/simulation/test_coverage.py` measures drawn scenes; the page `accuracy.md` has its results.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from support_exudyn.formulations.registry import formulation
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scene.limits import rounding_of_positions
from support_exudyn.simulation.recorded_run import RecordedRun
from support_exudyn.simulation.reported_numbers import (
    ROUNDING,
    STATISTICS,
    Measure,
    ReportedNumber,
    left_by_newton,
    left_of_spread,
    measures,
    over,
    path_of,
)
from user_forces.contact_state import Onset

Values = npt.NDArray[np.float64]  # of any shape
# share of a number's own d1 / d2 that its r is at least, and the most of that: where steps are chosen by a
# tolerance, and where they are halved, which some numbers answer by half only (means with friction)
OWN, SLOWEST_OWN = 0.7, 0.35
OWN_OF_STEPS, SLOWEST_OF_STEPS = 1.0, 0.6
# share of the distance before that the last is at least, where steps are chosen by a tolerance; and where that
# is larger than LOOSE: steps are so long then that errors do not fall regularly yet (measured at 1.6e-7: CHOSEN
# leaves 2 of 100 numbers uncovered, at tighter tolerances 0.4 of 100)
CHOSEN, CHOSEN_OF_LOOSE, LOOSE = 0.18, 0.4, 1e-7
ALIKE = 0.5  # of the distances of numbers that go wrong alike, that each is at least
SAFETY_OF_WORST = 6.0  # covers all of two thousand runs at the extremes (`studies/extremes/run.py`)
IRREGULAR = 4.0  # times that, where Newton's method failed: steps then are not those that were asked for
# r: three runs tell nothing beyond. Within a step a channel is a cubic, wrong by the fourth power of the step
# that follows the fifth root of a tolerance, an eighth of the one before. Where steps are halved, errors
# are of order 2.
FASTEST, FASTEST_OF_STEPS, SLOWEST = 8.0**-0.8, 0.25, 0.8
MOST_DIGITS = 12  # of a number that is printed
FIRST_ORDER = 0.5  # r where there are two runs only
SMALLEST_SPREAD = 1e-3  # of the mean
SMALLEST_EXTENT = (
    1e-8  # of a path, of its distance from the machine's pins: below, a machine is at rest but for rounding
)


class Estimate(NamedTuple):
    """A number, its estimated numerical error and its unit."""

    value: float
    error: float
    unit: str

    def __str__(self) -> str:
        """The number to the first digit of its error, of `MOST_DIGITS` at most, and its unit."""
        if not (math.isfinite(self.error) and self.error > 0.0 and math.isfinite(self.value)):
            return f"{self.value:.9g} ± {self.error:.1g} {self.unit}"
        size = math.floor(math.log10(abs(self.value))) if self.value else 0
        decimals = min(-math.floor(math.log10(float(f"{self.error:.1g}"))), MOST_DIGITS - 1 - size)
        if decimals <= 0:
            return f"{round(self.value, decimals):.0f} ± {round(self.error, decimals):.0f} {self.unit}"
        return f"{self.value:.{decimals}f} ± {self.error:.1g} {self.unit}"


def fall(result: RecordedRun) -> float:
    """r: by what factor the distances of a scene's numbers fall from run to run; FIRST_ORDER if two are all."""
    coarser = result.coarser
    coarsest = coarser.coarser if coarser else None
    if coarser is None or coarsest is None:
        return FIRST_ORDER
    ratios = []
    for kind in measures(result, 0.0, math.inf).values():
        if not kind.settles:
            continue
        a, b, c = (kind.measure(run) for run in (coarsest, coarser, result))
        if abs(b - a) > ROUNDING * max(abs(c), kind.size):
            ratios.append(abs(c - b) / abs(b - a))
    fastest = FASTEST if result.scenario.chooses_steps else FASTEST_OF_STEPS
    r = float(np.median(ratios)) if ratios else fastest
    return min(max(r, fastest), SLOWEST)


def errors(
    kinds: Mapping[str, ReportedNumber],
    result: RecordedRun,
    r: float,
    among: Mapping[str, ReportedNumber] | None = None,
) -> dict[str, float]:
    """Estimated errors of numbers, by their names; infinite if one is not a number in every run.

    Arguments:
        kinds: the numbers.
        r: see `fall`.
        among: all numbers that families consist of; None: the numbers themselves.

    Raises ValueError if there is no coarser run.
    """
    known = kinds if among is None else among
    scales: dict[tuple[str, str], float] = {}  # of numbers of the same force or impact, in each unit
    for kind in (*known.values(), *kinds.values()):
        key = (kind.of, kind.unit)
        scales[key] = max(scales.get(key, 0.0), _size(kind, result))
    families: dict[str, list[float]] = {}
    origins: dict[str, list[float]] = {}
    for kind in known.values():
        distance, size = _distance(kind.measure, result, r), _size(kind, result)
        if size > 0.0 and math.isfinite(distance):
            families.setdefault(kind.family, []).append(distance / size)
            origins.setdefault(kind.of, []).append(distance / scales[kind.of, kind.unit])
    found = {}
    for name, kind in kinds.items():
        size = _size(kind, result)
        usual = float(np.median(families[kind.family])) if kind.family in families and kind.family else 0.0
        worst = max(origins[kind.floor_of]) if kind.floor_of in origins and kind.floor_of else 0.0
        least = ALIKE * max(usual * size, worst * max(size, scales.get((kind.floor_of, kind.unit), 0.0)))
        values = max(size, kind.values)
        own = error(kind.measure, result, r, values, least)
        if own <= 2.0 * ROUNDING * values:
            own = max(own, kind.step)
        found[name] = own + kind.left * values + kind.missed(result) + kind.rounding
    return found


def error(measure: Measure, result: RecordedRun, r: float, size: float = 0.0, least: float = 0.0) -> float:
    """Estimated error of a number by itself; infinite if it is not a number in every run.

    Arguments:
        r: see `fall`.
        size: of the largest number of its kind, or the largest value that it is computed from.
        least: distance of the runs below which they are taken to agree by chance.

    Raises ValueError if there is no coarser run.
    """
    last, before = _distances(measure, result)
    distance = np.maximum(believed(result, r, last, before), least)
    found = float(multiple(result, r, last, before) * distance) + ROUNDING * max(abs(measure(result)), size)
    return found if math.isfinite(found) else math.inf


def multiple(result: RecordedRun, r: float, last: Values, before: Values) -> Values:
    """The factor by which a number's error is estimated from its last distance; r: see `fall`.

    last, before: distances of the number, from run to run, or of many; of two runs alone before is 0.
    """
    chosen = result.scenario.chooses_steps
    share, slowest = (OWN, SLOWEST_OWN) if chosen else (OWN_OF_STEPS, SLOWEST_OF_STEPS)
    own = share * np.divide(last, before, out=np.zeros_like(last), where=before > 0.0)
    falls: Values = np.maximum(np.full_like(last, r), np.minimum(own, slowest))
    return formulation(result.scenario.formulation).safety * falls / (1.0 - falls)


def believed(result: RecordedRun, r: float, last: Values, before: Values) -> Values:
    """The last distance as far as it is believed to have fallen, see `multiple`; keeps what is no number."""
    share = r
    if result.scenario.chooses_steps:
        share = CHOSEN_OF_LOOSE if result.scenario.solver.tolerance > LOOSE else CHOSEN
    return np.maximum(last, share * before)


def _distance(measure: Measure, result: RecordedRun, r: float) -> float:
    """Of a number from that of the coarser run, as far as it is believed; nan if it is none in one of them."""
    return float(believed(result, r, *_distances(measure, result)))


def _distances(measure: Measure, result: RecordedRun) -> tuple[Values, Values]:
    """Of a number from run to run, the last first; 0 before that if there are two runs."""
    if result.coarser is None:
        raise ValueError("no coarser run to compare with")
    other, coarsest = measure(result.coarser), result.coarser.coarser
    before = 0.0 if coarsest is None else abs(other - measure(coarsest))
    return np.asarray(abs(measure(result) - other)), np.asarray(before)


def _size(kind: ReportedNumber, result: RecordedRun) -> float:
    return max(abs(kind.measure(result)), kind.size)


def worst_error(result: RecordedRun, r: float) -> float:
    """See `Result.worst_error`; r: see `fall`.

    Of three runs, also by the worst distances themselves: those of a few numbers may fall slower than most do.
    They are not believed to fall faster than by half, for two runs can agree by chance.
    """
    scenario = result.scenario
    left = left_by_newton(scenario)
    found = _worst(result, lambda measure: error(measure, result, r), rounding_of_forces(scenario), left)
    coarser = result.coarser
    if coarser is None or coarser.coarser is None:
        return found
    last, before = disagreement(coarser, result), disagreement(coarser.coarser, coarser)
    r = min(max(last / before, FIRST_ORDER), SLOWEST) if before > 0.0 else SLOWEST
    runs = (result, coarser, coarser.coarser)
    irregular = IRREGULAR if any(run.counts.failed_newton for run in runs) else 1.0
    return max(found, irregular * SAFETY_OF_WORST * max(last, FIRST_ORDER * before) * r / (1.0 - r))


def disagreement(result: RecordedRun, other: RecordedRun) -> float:
    """How far another run of the same scene is away, in the measure of `worst_error`."""
    return _worst(result, lambda measure: abs(measure(result) - measure(other)))


def rounding_of_forces(scenario: Scenario) -> float:
    """What rounding leaves of itself in the joint forces of a run [N].

        R mass size epsilon / step^2

    Constraints of index 3 hold positions, which are rounded by a share of the machine's size; accelerations
    are their differences over the step's square. Other formulations do not divide by steps, nor does what
    joints of the plane carry, see `reactions`.
    """
    if scenario.chooses_steps or scenario.dimensions == 2:
        return 0.0
    step = min(scenario.step, scenario.recorded_every)
    heaviest = max(body.mass for body in scenario.linkage.bodies.values())
    return heaviest * rounding_of_positions(scenario) / step**2


def rounding_share(result: RecordedRun) -> float:
    """The largest share of a force that rounding leaves, see `rounding_of_forces`."""
    return _worst(result, lambda measure: 0.0, rounding_of_forces(result.scenario))


def _worst(
    result: RecordedRun, off_by: Callable[[Measure], float], rounding: float = 0.0, left: float = 0.0
) -> float:
    """The largest, relative, of what the numbers are off by that an accuracy is of.

    rounding: of the forces of ideal pins, which adds to what they are off by [N], to their spread as scatter
    does. Those of clearance pins follow from the depth. left: share of forces that Newton's method leaves.
    """
    scenario = result.scenario
    off = [0.0]
    for pin in scenario.linkage.pins:
        name = f"pin.{pin}.force"
        scale = result.window(name).mean
        for word in ("mean", "std", "largest"):
            measure = over(name, STATISTICS[word], 0.0, math.inf)
            value, scatter = measure(result), rounding if scenario.pin(pin).holds else 0.0
            if word == "std":
                scatter = math.hypot(value, scatter) - value + left_of_spread(left, value, scale)
            else:
                scatter += left * value
            # a force that hardly varies has a spread that means nothing to a share of itself
            off.append(_share(off_by(measure) + scatter, max(value, SMALLEST_SPREAD * scale)))
    clearances = [place.play for place in scenario.contact_places.values()]
    for point in scenario.linkage.points:
        path = path_of(result, point)
        extent = float(np.hypot(*np.ptp(path, axis=1)))

        def wandering(run: RecordedRun, path: Values = path, point: str = point) -> float:
            return float(np.hypot(*(path_of(run, point) - path)).max())

        ends = [np.reshape(place.first_point, (2, 1)) for place in scenario.linkage.pins.values()]
        least = SMALLEST_EXTENT * max((float(np.hypot(*(path - end)).max()) for end in ends), default=0.0)
        off.append(_share(off_by(wandering), max([extent, least, *clearances])))
    return max(off)


def _share(error: float, of: float) -> float:
    return error / of if of > 0.0 else 0.0


# --- up to when a run with impacts is determined ---

# Two runs with different steps agree impact by impact, until what an impact leaves to the next has grown to the
# size of the motion itself. What comes later is no result of any run; its means and spreads may be.
APART = 0.1  # of the time since the impact before, or of the initial impact velocity, by which impacts differ


def horizon(result: RecordedRun) -> float:
    """The time [s] of the first impact in which a run differs from the next coarser one; infinite: none does.

    Impacts of a contact are matched in their order. They differ if their times do by more than a tenth of the
    time since the one before, or their initial impact velocities by more than a tenth, or if one run lacks it.

    Raises ValueError if there is no coarser run.
    """
    if result.coarser is None:
        raise ValueError("no coarser run to compare with")
    pairs = ((onsets, result.coarser.onsets.get(name, ())) for name, onsets in result.onsets.items())
    return min((_first_difference(one, other) for one, other in pairs), default=math.inf)


def agreed(result: RecordedRun) -> int:
    """How many impacts lie before the horizon."""
    end = horizon(result)
    return sum(onset.time < end for onsets in result.onsets.values() for onset in onsets)


def _first_difference(one: Sequence[Onset], other: Sequence[Onset]) -> float:
    before = 0.0
    for mine, theirs in zip(one, other, strict=False):
        late = abs(mine.time - theirs.time) > APART * (mine.time - before)
        fast = abs(mine.speed - theirs.speed) > APART * max(mine.speed, theirs.speed)
        if late or fast:
            return min(mine.time, theirs.time)
        before = mine.time
    rest = (*one[len(other) :], *other[len(one) :])
    return min((onset.time for onset in rest), default=math.inf)
