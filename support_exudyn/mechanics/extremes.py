"""Extremes of what has a sign, and how far records miss them."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from support_exudyn.mechanics.trajectory import Series

AT_A_BREAK = 1e-9  # [s]: times of records are sums of periods


def largest(values: Series) -> float:
    """The largest magnitude: a pull counts like a push."""
    return float(np.abs(values).max())


# how far values go towards an extreme, by its name
TOWARDS: Mapping[str, Callable[[Series], Series]] = {
    "largest": np.abs,
    "max": lambda values: values - values.min(),
    "min": lambda values: values.max() - values,
}


def missed(extreme: str, values: Series, time: Series, breaks: Sequence[float] = ()) -> float:
    """Amount by which an extreme between records may exceed that of the records, >= 0; 0 of what is no extreme.

    Of a parabola through three records, the middle one the largest, the top is at most an eighth of the second
    difference above it. Across a break of the drive, where a record holds the value before it, there is no
    parabola: the course goes on backwards from the two records after it.

    Arguments:
        extreme: its name, see TOWARDS.
        values, time: (n,) of the records that are looked at, time in [s].
        breaks: times at which values may jump [s].
    """
    if extreme not in TOWARDS:
        return 0.0
    sizes = TOWARDS[extreme](values)
    n = int(sizes.argmax())
    before = abs(sizes[n] - sizes[n - 1]) if n > 0 else None
    after = abs(sizes[n] - sizes[n + 1]) if n + 1 < sizes.size else None
    begun = time[n - 1] if n > 0 else time[n]
    if any(begun - AT_A_BREAK <= one < time[n] - AT_A_BREAK for one in breaks):  # it jumped just before
        return float(after or 0.0)
    if any(abs(one - time[n]) <= AT_A_BREAK for one in breaks):  # it jumps just after
        after = None
    if before is None or after is None:
        return 0.0  # it ends there
    return float((before + after) / 8.0)
