"""From the steps of a solver to statistics by intervals of time, step by step.

Over a step a channel is the cubic through its values at the nodes of Lobatto's rule. Its mean is exact up to
the fifth power of time, and both ends of the step are nodes, so that what jumps belongs to its own step. A step
that reaches over edges of intervals is divided there.
"""

import math

import numpy as np

from support_exudyn.mechanics.time_statistics import (
    FIRST,
    GREATEST,
    GREATEST_TIME,
    LAST,
    LEAST,
    LEAST_TIME,
    MEAN,
    VARIANCE,
    Series,
)
from support_exudyn.scene.compilation import compiled, entry

OF_STEP = 4  # nodes
INNER = 0.5 - math.sqrt(0.05)  # fraction of a step at its second node
NODES = np.array([0.0, INNER, 1.0 - INNER, 1.0])
POLYNOMIAL = np.linalg.inv(np.vander(NODES, increasing=True))  # of values at the nodes: coefficients
SHORT = 1e-9  # share of a step that is rounding of its ends


@compiled
def coefficient(power: int, one: float, two: float, three: float, four: float) -> float:
    """The coefficient of a power of the cubic through the values at the nodes."""
    first = POLYNOMIAL[power, 0] * one + POLYNOMIAL[power, 1] * two
    return float(first + POLYNOMIAL[power, 2] * three + POLYNOMIAL[power, 3] * four)


@compiled
def cubic(one: float, two: float, three: float, four: float, x: float) -> float:
    """The cubic through the values at the nodes, at a fraction x of the step."""
    total = 0.0
    for power in range(OF_STEP - 1, -1, -1):
        total = total * x + coefficient(power, one, two, three, four)
    return total


@compiled
def least_of(one: float, two: float, three: float, four: float, below: float) -> tuple[float, float]:
    """The least value of the cubic, and at which fraction; of its nodes if it cannot be below another value."""
    least, at = one, 0.0
    for n, value in ((1, two), (2, three), (3, four)):
        if value < least:
            least, at = value, NODES[n]
    reach = max(one, two, three, four) - least
    if not (reach > 0.0 and least - 0.5 * reach < below):
        return least, at
    slope, bend = coefficient(1, one, two, three, four), coefficient(2, one, two, three, four)
    third = 3.0 * coefficient(3, one, two, three, four)
    root = math.sqrt(max(0.0, bend * bend - slope * third))
    half = -(bend + math.copysign(root, bend))  # does not cancel
    for x in (half / third, slope / half):
        if 0.0 < x < 1.0:
            value = cubic(one, two, three, four, x)
            if value < least:
                least, at = value, x
    return least, at


@compiled
def take(
    row: Series, known: float, low: float, size: float, one: float, two: float, three: float, four: float
) -> None:
    """Add a piece with these values at its nodes, that begins at `low` and lasts `size` [s], to an interval.

    known: how much of the interval the row is of already [s].
    """
    mean = (one + 5.0 * (two + three) + four) / 12.0
    square = ((one - mean) ** 2 + 5.0 * ((two - mean) ** 2 + (three - mean) ** 2) + (four - mean) ** 2) / 12.0
    if known == 0.0:
        row[MEAN], row[VARIANCE], row[FIRST], row[LEAST], row[GREATEST] = mean, square, one, math.inf, -math.inf
    else:
        share, apart = size / (known + size), mean - row[MEAN]
        row[MEAN] += share * apart
        row[VARIANCE] += share * (square - row[VARIANCE] + (1.0 - share) * apart * apart)
    row[LAST] = four
    value, at = least_of(one, two, three, four, row[LEAST])
    if value < row[LEAST]:
        row[LEAST], row[LEAST_TIME] = value, low + at * size
    value, at = least_of(-one, -two, -three, -four, -row[GREATEST])
    if -value > row[GREATEST]:
        row[GREATEST], row[GREATEST_TIME] = -value, low + at * size


@entry
def add_steps(time: Series, values: Series, edges: Series, known: Series, rows: Series) -> None:
    """Add steps that follow those before to the statistics of all intervals.

    Arguments:
        time: of the nodes (steps, 4) [s].
        values: of all channels there (channels, 4 steps).
        edges: of the intervals (n + 1,) [s].
        known: how much of each interval has been added (n,) [s].
        rows: of each channel and interval (channels, n, columns of `time_statistics.COLUMNS`).
    """
    interval, final = 0, known.size - 1
    for n in range(time.shape[0]):
        start, end = time[n, 0], time[n, OF_STEP - 1]
        rounding = SHORT * (end - start)
        while interval < final and edges[interval + 1] <= start + rounding:
            interval += 1
        i, low = interval, start
        while low < end:
            high = end if i == final or edges[i + 1] >= end - rounding else edges[i + 1]
            begin, share = (low - start) / (end - start), (high - low) / (end - start)
            for c in range(values.shape[0]):
                k = OF_STEP * n
                one, two, three, four = values[c, k], values[c, k + 1], values[c, k + 2], values[c, k + 3]
                if share < 1.0:
                    one, two, three, four = (
                        cubic(one, two, three, four, begin),
                        cubic(one, two, three, four, begin + share * NODES[1]),
                        cubic(one, two, three, four, begin + share * NODES[2]),
                        cubic(one, two, three, four, begin + share),
                    )
                take(rows[c, i], known[i], low, high - low, one, two, three, four)
            known[i] += high - low
            low, i = high, i + 1
