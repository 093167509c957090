"""Numbers of runs: which are printed, in which order, by which names, with which digits."""

import math
from collections.abc import Mapping, Sequence

from support_exudyn.postprocessing.figures.units import readable
from support_exudyn.simulation.estimate import MOST_DIGITS, Estimate
from support_exudyn.simulation.impulses import NO_PEAK
from support_exudyn.simulation.reported_numbers import FORCE, measures
from support_exudyn.simulation.result import Result

DIGITS = 6  # of numbers without known error
LARGEST = ".largest_force"  # of a clearance pin, over the whole run
LARGEST_TIME = f"{LARGEST}_time"
WHOLE_RUN = (LARGEST, LARGEST_TIME)
IMPULSE = ".force.impulse_"  # in place of a peak that has no limit
VAGUE = 0.1  # share of a window; a time with a larger error is that of several alike peaks
IN_WINDOW = (".force.largest", ".force.largest_time")  # the same over the window


def numbers(result: Result, after: float, until: float) -> dict[str, Estimate]:
    """Numbers of the forces and of the energy between two times [s], in SI; an error that is not known is NaN.

    Errors are known if an accuracy was asked for. Largest forces at any step and energies are of the whole run.

    Raises InputError if no record lies between.
    """
    result.check_window(after, until)
    if result.coarser is not None:
        found = dict(result.numbers(after, until))
    else:
        found = {
            name: Estimate(kind.measure(result), math.nan, kind.unit)
            for name, kind in measures(result, after, until).items()
            if f"{FORCE}." in name or name.endswith(WHOLE_RUN)
        }
    names = [f"energy.{name}" for name in ("work", "damping_loss", "friction_loss")]
    energies = {f"{name} at the end": float(result[name][-1]) for name in names if name in result.channels}
    if "energy.balance" in result.channels:
        energies["energy not accounted for, largest"] = result.energy_error
    return found | {name: Estimate(value, math.nan, "J") for name, value in energies.items()}


def hardest_first(found: Mapping[str, Estimate]) -> list[str]:
    """What the numbers of clearance joints begin with, such as `pin.rear_base`, the largest force first.

    found: numbers of the run by name, as `Result.numbers` names them.
    """
    largest = {name.removesuffix(LARGEST): one.value for name, one in found.items() if name.endswith(LARGEST)}
    return sorted(largest, key=lambda joint: -largest[joint])


def shown(
    runs: Sequence[Result], found_of: Sequence[Mapping[str, Estimate]], after: float, until: float
) -> list[dict[str, Estimate]]:
    """The numbers of some runs as they are printed.

    The largest forces of clearance pins over the run come first, the hardest hit pin before the others. The
    largest force over the window repeats them where the window is the whole run, and is left out. The time of a
    largest value is left out where its error exceeds a tenth of the window: there are several alike peaks then.

    Arguments:
        runs: the runs.
        found_of: of each its numbers by name.
        after, until: times between which they were taken [s].

    Returns:
        Of each run the numbers that are printed, in their order.
    """
    first = [f"{joint}{end}" for found in found_of for joint in hardest_first(found) for end in WHOLE_RUN]
    names = list(dict.fromkeys([*first, *(name for found in found_of for name in found)]))
    if all(after <= run.time[0] and until >= run.time[-1] for run in runs):

        def repeats(name: str) -> bool:
            whole = f"{name.rpartition('.force.')[0]}{LARGEST}"
            return name.endswith(IN_WINDOW) and all(whole in found for found in found_of if name in found)

        names = [name for name in names if not repeats(name)]

    def is_vague(name: str, number: Estimate, run: Result) -> bool:
        """Whether a time may be that of another peak; never where its error is not known."""
        first, last = float(run.time[0]), float(run.time[-1])
        if not name.endswith(LARGEST_TIME):
            first, last = max(first, after), min(last, until)
        return name.endswith("_time") and number.error > VAGUE * (last - first)

    pairs = [*zip(runs, found_of, strict=True)]
    return [
        {n: found[n] for n in names if n in found and not is_vague(n, found[n], run)} for run, found in pairs
    ]


def label(name: str) -> str:
    """The name of a number as it is printed; the largest force over the whole run with these words."""
    if IMPULSE in name:
        return f"{name}, {NO_PEAK.partition(', ')[2]}"
    return f"{name}, whole run" if name.endswith(WHOLE_RUN) else name


def side_by_side(found: Sequence[Estimate | None], most: int = DIGITS) -> tuple[str, ...]:
    """Unit, and numbers of several runs in it with their errors, of at most so many digits; None: empty.

    An infinite error is not known; nor is NaN, that of a run without errors, which is not printed.
    """
    there = [one for one in found if one is not None]
    unit = readable(there[0].unit, max(abs(one.value) for one in there))

    def shown(number: Estimate) -> str:
        text = rounded(unit.scale * number.value, unit.scale * number.error, most)
        return f"{text} ± not known" if math.isinf(number.error) else text

    return unit.name, *("" if number is None else shown(number) for number in found)


def with_error(found: Estimate) -> tuple[str, str]:
    """A number with its error to two digits, however small, and the unit of both."""
    unit = readable(found.unit, abs(found.value))
    value, error = unit.scale * found.value, unit.scale * found.error
    if math.isfinite(error) and error > 0.0:
        return rounded(value, error, MOST_DIGITS), unit.name
    unknown = "" if math.isnan(error) else " ± not known" if error else " ± 0"
    return f"{value:.{DIGITS}g}{unknown}", unit.name


def rounded(value: float, error: float, most: int = DIGITS) -> str:
    """A number with its error, both to two digits of the error, at most `most` digits of the number.

    An error below the last of these digits is not printed: all printed digits are right.
    """
    if not math.isfinite(error) or not math.isfinite(value):
        return f"{value:.{most}g}"
    if error == 0.0:
        return f"{value:.9g}" if most == DIGITS else f"{value:.{most}g}"
    if value.is_integer() and error.is_integer() and abs(value) + error < 1e6:
        return f"{value:.0f} ± {error:.0f}"  # counts
    last = most - 1 - math.floor(math.log10(max(abs(value), error)))
    if error < 0.5 * 10.0**-last:
        return _plain(value, last)
    digits = min(last, 1 - math.floor(math.log10(error)))
    return f"{_plain(value, digits)} ± {_plain(error, digits)}"


def _plain(value: float, digits: int) -> str:
    """A number with so many decimals; below 0 that many zeros end it. Small numbers have a power of ten."""
    if digits > 8 and abs(value) < 1e-3:
        return f"{value:.{max(0, digits + math.floor(math.log10(abs(value))))}e}" if value else "0"
    return f"{round(value, digits):.{max(0, digits)}f}"
