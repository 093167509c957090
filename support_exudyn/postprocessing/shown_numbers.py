"""Which numbers of runs are printed, in which order, and by which names."""

from collections.abc import Mapping, Sequence

from support_exudyn.postprocessing.figures.units import said
from support_exudyn.simulation.estimate import Estimate
from support_exudyn.simulation.impulses import NO_PEAK
from support_exudyn.simulation.result import Result

LARGEST = ".largest_force"  # of a clearance pin, over the whole run
LARGEST_TIME = f"{LARGEST}_time"
WHOLE_RUN = (LARGEST, LARGEST_TIME)
IMPULSE = ".force.impulse_"  # in place of a peak that has no limit
TIME = "_time"  # of largest values, which may jump from peak to peak
VAGUE = 0.1  # share of a window; a time with a larger error is one of several alike peaks
IN_WINDOW = (".force.largest", ".force.largest_time")  # the same over the window


def hardest_first(found: Mapping[str, Estimate]) -> list[str]:
    """The clearance pins, corners in guides and blocks, by their largest force, the hardest first.

    found: numbers of the run by name, as `Result.numbers` names them.
    """
    largest = {name: one.value for name, one in found.items() if name.endswith(LARGEST)}
    ranked = sorted(largest, key=lambda name: -largest[name])
    return [name.removeprefix("pin.").removesuffix(LARGEST) for name in ranked]


def stem(joint: str, found: Mapping[str, Estimate]) -> str:
    """What a joint's numbers begin with among these; joint: as `hardest_first` names it, without "pin."."""
    return f"pin.{joint}" if f"pin.{joint}{LARGEST}" in found else joint


def ranking(found: Mapping[str, Estimate]) -> str:
    """Which of several clearance pins is hit hardest, how hard and when, then the others; empty for one pin.

    found: numbers of the run that are printed, see `shown`; a time that is not among them is not told.
    """
    told = [_hit(pin, found) for pin in hardest_first(found)]
    return f"hits hardest: {told[0]}; then {'; '.join(told[1:])}" if len(told) > 1 else ""


def _hit(pin: str, found: Mapping[str, Estimate]) -> str:
    own = stem(pin, found)
    force, when = found[f"{own}{LARGEST}"], found.get(f"{own}{LARGEST_TIME}")
    return f"{pin}, {said(force.value, force.unit, 4)}" + (f" at {said(when.value, 's', 4)}" if when else "")


def shown(
    runs: Sequence[Result], numbers: Sequence[Mapping[str, Estimate]], after: float, until: float
) -> list[dict[str, Estimate]]:
    """The numbers of some runs as they are printed.

    The largest forces of clearance pins over the run come first, the hardest hit pin before the others. The
    largest force over the window repeats them where the window is the whole run, and is left out. The time of a
    largest value is left out where its error exceeds a tenth of the window: there are several alike peaks then.

    Arguments:
        runs: the runs.
        numbers: of each its numbers by name.
        after, until: times between which they were taken [s].

    Returns:
        Of each run the numbers that are printed, in their order.
    """
    first = [
        f"{stem(pin, found)}{end}" for found in numbers for pin in hardest_first(found) for end in WHOLE_RUN
    ]
    names = list(dict.fromkeys([*first, *(name for found in numbers for name in found)]))
    left_out = {
        name
        for name in names
        if name.endswith(IN_WINDOW) and all(_has_whole_run(name, found) for found in numbers if name in found)
    }
    if not all(_is_whole(run, after, until) for run in runs):
        left_out = set()
    return [
        {
            name: found[name]
            for name in names
            if name in found and name not in left_out and not _is_vague(name, found[name], run, after, until)
        }
        for run, found in zip(runs, numbers, strict=True)
    ]


def _is_vague(name: str, number: Estimate, run: Result, after: float, until: float) -> bool:
    """Whether a time of a largest value may be that of another peak; never where its error is not known."""
    if not name.endswith(TIME):
        return False
    first, last = float(run.time[0]), float(run.time[-1])
    if not name.endswith(LARGEST_TIME):
        first, last = max(first, after), min(last, until)
    return number.error > VAGUE * (last - first)


def label(name: str) -> str:
    """The name of a number as it is printed; the largest force over the whole run says so."""
    if IMPULSE in name:
        return f"{name}, {NO_PEAK.partition(', ')[2]}"
    if name.endswith(WHOLE_RUN):
        return f"{name}, whole run"
    return name


def _has_whole_run(name: str, found: Mapping[str, Estimate]) -> bool:
    """Whether a run has the number over the whole run, too."""
    return f"{name.rpartition('.force.')[0]}{LARGEST}" in found


def _is_whole(run: Result, after: float, until: float) -> bool:
    return bool(after <= run.time[0] and until >= run.time[-1])
