"""Whether the two columns of a support can follow drives that are not alike."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import TypeVar

import numpy as np

from support_exudyn.model.drives.drive import Drive
from user_forces.values.value import InputError

P = TypeVar("P")  # of a posture
Reached = Callable[[Sequence[float], P], P | None]  # the posture for lengths of both columns, near another one

SAMPLES = 32  # of a stretch without breaks, and of a period
MOST_SAMPLES = 1024  # of a stretch; an oscillation that goes on for longer has been everywhere by then
SHORTEST = 2.0**-24  # of a run: time between two postures at which the way is given up


def check_path(
    start: P, lengths: Mapping[str, float], reached_by: Reached[P], drives: Mapping[str, Drive], duration: float
) -> None:
    """Raise InputError unless the linkage closes from the start posture on, as the drives go.

    Postures are looked at in small steps between the breaks of the drives; each is searched for from the one
    before, so that the way leads over no dead centre.

    Arguments:
        start: posture at the start. lengths: of both columns in it [m], by name.
        reached_by: finds the posture for two lengths [m] near another one; None if there is none.
        drives: of both columns, by name. duration: of the run [s].
    """

    def at(time: float) -> list[float]:
        return [length + drives[name].extension(time) for name, length in lengths.items()]

    reached, posture = 0.0, start
    for goal in times(tuple(drives.values()), duration):
        while reached < goal:
            step = goal - reached
            while (following := reached_by(at(reached + step), posture)) is None:
                step /= 2.0
                if step < SHORTEST * duration:
                    then = at(min(goal, reached + 2.0**12 * step))
                    _refuse(reached_by, drives, tuple(lengths), reached, at(reached), then, posture)
            reached, posture = (goal if step == goal - reached else reached + step), following


def times(drives: Sequence[Drive], duration: float) -> Iterator[float]:
    """Times of a run at which postures are looked at [s], in order; breaks and the end are among them."""
    breaks = {t for drive in drives for t in drive.breaks if 0.0 < t < duration}
    ends = [0.0, *sorted(breaks), duration]
    period = min((one for drive in drives if (one := getattr(drive, "period", None))), default=duration)
    for first, last in pairwise(ends):
        count = min(MOST_SAMPLES, SAMPLES * max(1, int(np.ceil(min(1e6, (last - first) / period)))))
        yield from np.linspace(first, last, count + 1)[1:].tolist()


def _refuse(
    reached_by: Reached[P],
    drives: Mapping[str, Drive],
    names: tuple[str, ...],
    time: float,
    now: Sequence[float],
    then: Sequence[float],
    posture: P,
) -> None:
    """Name the column that cannot go on, while the other could."""
    alone = [
        reached_by([then[n] if n == moving else now[n] for n in range(len(names))], posture) is not None
        for moving in range(len(names))
    ]
    stuck = [name for name, can in zip(names, alone, strict=True) if not can]
    told = stuck if len(stuck) == 1 else list(names)
    reached = ", ".join(f"{name} extended by {drives[name].extension(time):.4f} m" for name in names)
    raise InputError(
        f"drives.{' and drives.'.join(told)}: {' and '.join(told)} cannot follow beyond {time:.4g} s "
        f"({reached}): the linkage locks or opens there; allowed: extensions that keep the linkage closed"
    )
