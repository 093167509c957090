"""Whether a linkage can follow its drives."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise, takewhile

import numpy as np

from support_exudyn.mechanics.closing import Conditions, moved_on
from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.linkage import Linkage
from user_forces.values.value import InputError

TURN = 2.0 * math.pi
MOST_TURNS = 64  # of a crank that moves the linkage alone, until all has come back to where it was
EVERY = 4  # samples of a run of several drives: in each such one a crank that turns fast turns right round
SAME = 1e-7  # of the size: how near all has to come back
DETERMINED = 1e-9  # singular values below this are of movements that no drive determines
SAMPLES = 16  # of a stretch without breaks, and of a period
MOST_SAMPLES = 1024  # of a stretch; an oscillation that lasts longer has reached its extremes by then
HALVINGS = 60
MOST_REMEMBERED = 64

_followed: list[tuple[Linkage, dict[str, Drive], float]] = []  # scenarios are checked again and again


def follow(linkage: Linkage, drives: Mapping[str, Drive], duration: float) -> None:
    """Raise InputError unless the linkage closes from the start posture on, as the drives go.

    If all parts that move do so alike, they are followed over their span, a crank no farther than until the
    linkage has come back to its start. Otherwise postures are computed in order of time; of a crank that turns
    over and over, whole revolutions are left out.

    A linkage that can move with all drives held is not checked: forces decide where it goes. Neither is a
    linkage of which a driven part has no drive, such as a cylinder with an inlet. Nothing is checked from the
    time on at which a drive has no finite extension: the run is refused there, with the name of the drive.

    Arguments:
        linkage: in its start posture.
        drives: of its driven parts, by name.
        duration: of the run [s].
    """
    if not drives.keys() >= set(linkage.driven) or (linkage, drives, duration) in _followed:
        return
    conditions = Conditions(linkage)
    values = np.linalg.svd(conditions.rows(conditions.still), compute_uv=False)
    moving = {name: drive for name, drive in drives.items() if drive.span(duration) != (0.0, 0.0)}
    if moving and np.count_nonzero(values > DETERMINED) == conditions.still.size:
        first, *others = moving.values()
        if all(drive == first for drive in others) and not (others and moving.keys() & linkage.cranks.keys()):
            _alike(conditions, tuple(moving), first, duration)
        else:
            _together(conditions, moving, duration)
    _followed[:] = [*_followed[1 - MOST_REMEMBERED :], (linkage, dict(drives), duration)]


def times(drives: Sequence[Drive], duration: float) -> Iterator[float]:
    """Times of a run at which postures are computed [s], in order; breaks and the end are among them."""
    breaks = {t for drive in drives for t in drive.breaks if 0.0 < t < duration}
    ends = [0.0, *sorted(breaks), duration]
    period = min((one for drive in drives if (one := getattr(drive, "period", None))), default=duration)
    for first, last in pairwise(ends):
        count = min(MOST_SAMPLES, SAMPLES * max(1, int(np.ceil(min(1e6, (last - first) / period)))))
        yield from np.linspace(first, last, count + 1)[1:].tolist()


def _alike(conditions: Conditions, names: Sequence[str], drive: Drive, duration: float) -> None:
    """Follow a crank, or actuators that extend alike, over the span of their drive."""
    extensions = list(takewhile(math.isfinite, map(drive.extension, times((drive,), duration))))
    low, high = min(0.0, *extensions), max(0.0, *extensions)
    crank = names[0] in conditions.linkage.cranks
    for goal in (one for one in (high, low) if one != 0.0):
        moved, reached = conditions.still, 0.0
        for _ in range(MOST_TURNS):
            following = reached + math.copysign(min(abs(goal - reached), TURN), goal) if crank else goal
            moved, share = moved_on(conditions, moved, dict.fromkeys(names, following))
            if share < 1.0:
                limit = reached + share * (following - reached)
                when = _reached(drive, limit, duration)
                raise InputError(_message(names, dict.fromkeys(names, limit), conditions.linkage, when))
            reached, back = following, moved.copy()
            back[2::3] = np.mod(back[2::3] / conditions.arms[2::3] + math.pi, TURN) - math.pi
            if crank and np.abs(back).max() < SAME * conditions.size:  # all bodies lie as at the start
                return
            if reached == goal:
                break


def _reached(drive: Drive, limit: float, duration: float) -> float:
    """The time [s] at which a drive first goes beyond a limit."""

    def beyond(time: float) -> bool:
        extension = drive.extension(time)
        return (extension - limit) * limit > 0.0 if limit else extension != 0.0

    last, first = 0.0, duration
    for time in times((drive,), duration):
        if beyond(time):
            first = time
            break
        last = time
    for _ in range(HALVINGS):
        middle = 0.5 * (last + first)
        last, first = (last, middle) if beyond(middle) else (middle, first)
    return last


def _together(conditions: Conditions, drives: Mapping[str, Drive], duration: float) -> None:
    """Follow several drives in order of time."""
    linkage, moved = conditions.linkage, conditions.still
    last, gone = 0.0, dict.fromkeys(drives, 0.0)
    true = {name: drive.extension(0.0) for name, drive in drives.items()}
    for number, time in enumerate(times(tuple(drives.values()), duration)):
        following = {name: drive.extension(time) for name, drive in drives.items()}
        if not all(map(math.isfinite, following.values())):
            return
        goal = {}
        for name, extension in following.items():
            step = extension - true[name]
            if name in linkage.cranks:  # whole revolutions beyond the first are left out
                whole = math.trunc(step / TURN)
                step -= TURN * (whole - math.copysign(min(abs(whole), number % EVERY == 0), whole))
            goal[name] = gone[name] + step
        reached, share = moved_on(conditions, moved, goal)
        if share < 1.0:
            # which of them cannot go on by itself
            alone = {name: {**gone, name: goal[name]} for name in drives if goal[name] != gone[name]}
            stuck = [name for name, ends in alone.items() if moved_on(conditions, moved, ends)[1] < 1.0]
            when = last + share * (time - last)
            extensions = {name: drive.extension(when) for name, drive in drives.items()}
            raise InputError(_message(stuck if len(stuck) == 1 else list(drives), extensions, linkage, when))
        last, moved, gone, true = time, reached, goal, following


def _message(stuck: Sequence[str], extensions: Mapping[str, float], linkage: Linkage, time: float) -> str:
    """The message on drives that cannot be followed beyond a time [s]."""
    reached = ", ".join(
        f"{name} turned by {math.degrees(extension):.4f} degrees"
        if name in linkage.cranks
        else f"{name} extended by {extension:.4f} m"
        for name, extension in extensions.items()
    )
    return (
        f"drives.{' and drives.'.join(stuck)}: {' and '.join(stuck)} cannot follow beyond {time:.4g} s "
        f"({reached}): the linkage locks or opens there; allowed: motions that keep the linkage closed"
    )
