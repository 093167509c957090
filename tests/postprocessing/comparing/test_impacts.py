"""Impacts: matched in two runs, found in a curve of a force, and when curves without errors part."""

from __future__ import annotations

import math
from itertools import combinations, pairwise, product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support_exudyn.postprocessing.comparing.impacts import impacts_of_force, match_impacts
from support_exudyn.postprocessing.comparing.parting import parting_of_impacts
from tests.often import often
from user_forces import InputError
from user_forces.contact_state import Onset


def onsets(*times: float, speed: float = 1.0) -> tuple[Onset, ...]:
    return tuple(Onset(time, speed) for time in times)


@pytest.mark.parametrize(
    ("first", "second", "matched"),
    [
        ((), (), []),
        ((1.0,), (), []),
        ((1.0,), (1.0,), [(0, 0)]),
        ((1.0,), (0.5, 1.1, 1.6), [(0, 1)]),
        ((1.0, 1.1, 1.15, 1.2, 1.3), (1.001, 1.101, 1.202, 1.303), [(0, 0), (1, 1), (3, 2), (4, 3)]),
        ((0.0, 0.010, 0.013, 0.014, 0.2), (0.002, 0.012, 0.015, 0.016, 0.2), [(n, n) for n in range(5)]),
    ],
)
def test_impacts_are_matched_in_their_order(
    first: tuple[float, ...], second: tuple[float, ...], matched: list[tuple[int, int]]
) -> None:
    found = match_impacts(onsets(*first), onsets(*second))
    assert [(one.time, other.time) for one, other in found.pairs] == [(first[i], second[j]) for i, j in matched]
    alone = set(first) - {first[i] for i, _ in matched}, set(second) - {second[j] for _, j in matched}
    assert ({one.time for one in found.only_first}, {one.time for one in found.only_second}) == alone


@settings(max_examples=often(60))
@given(
    first=st.lists(st.integers(0, 60), max_size=5, unique=True).map(sorted),
    second=st.lists(st.integers(0, 60), max_size=5, unique=True).map(sorted),
)
def test_the_sum_of_costs_is_least(first: list[int], second: list[int]) -> None:
    def reaches(times: list[int]) -> list[float]:
        span = float(max([*first, *second], default=0) - min([*first, *second], default=0))
        gaps = [late - early for early, late in pairwise(times)]
        return [0.5 * max(gaps[max(n - 1, 0) : n + 1]) if gaps else span for n in range(len(times))]

    mine, its = reaches(first), reaches(second)

    def cost(chosen: tuple[tuple[int, int], ...]) -> float:
        alone = sum(mine) + sum(its) - sum(mine[i] + its[j] for i, j in chosen)
        return alone + sum(abs(first[i] - second[j]) for i, j in chosen)

    best = min(
        cost(tuple(zip(some, others, strict=True)))
        for count in range(min(len(first), len(second)) + 1)
        for some, others in product(
            combinations(range(len(first)), count), combinations(range(len(second)), count)
        )
    )
    found = match_impacts(onsets(*map(float, first)), onsets(*map(float, second)))
    chosen = tuple((first.index(int(a.time)), second.index(int(b.time))) for a, b in found.pairs)
    assert chosen == tuple(sorted(chosen))
    assert len({i for i, _ in chosen}) == len({j for _, j in chosen}) == len(chosen)
    assert cost(chosen) == pytest.approx(best)
    assert len(found.only_first) == len(first) - len(chosen)


def test_impacts_of_a_force() -> None:
    time = np.linspace(0.0, 1.0, 1001)
    force = 500.0 * np.maximum(0.0, np.sin(6.0 * np.pi * (time - 0.05)))  # pressed from 0.05 on, for 1/6 s each
    found = impacts_of_force(time, force)
    np.testing.assert_allclose([one.time for one in found], [0.05, 0.05 + 1 / 3, 0.05 + 2 / 3], atol=1e-3)
    np.testing.assert_allclose(
        [one.separation_time for one in found], [0.05 + 1 / 6, 0.05 + 1 / 2, 0.05 + 5 / 6], atol=1e-3
    )
    assert all(math.isnan(one.speed) for one in found)


def test_a_force_that_goes_on_at_the_ends() -> None:
    time = np.arange(6.0)
    found = impacts_of_force(time, np.array([5.0, 0.0, np.nan, 5.0, 5.0, 5.0]))
    assert len(found) == 1
    assert 2.0 <= found[0].time <= 3.0
    assert found[0].separation_time == math.inf
    assert impacts_of_force(time, np.zeros(6)) == ()
    assert impacts_of_force(time[:0], time[:0]) == ()
    with pytest.raises(InputError, match="a force of -1"):
        impacts_of_force(time, -np.ones(6))


# --- parting without errors ---


def grown(count: int, first: float, growth: float) -> tuple[tuple[Onset, ...], tuple[Onset, ...]]:
    """Impacts 0.1 s apart, of which the second run's come later and later."""
    times = 0.1 * np.arange(1, count + 1)
    return onsets(*times), onsets(*(times + first * growth ** np.arange(count)))


FIRST, SECOND = grown(20, 1e-6, 2.0)
NINE, LATE = grown(9, 0.02, 1.0)
LOST = (*NINE[:5], *NINE[6:])
DOUBLE = tuple(sorted((*NINE, NINE[4]._replace(time=NINE[4].time + 0.005))))


def later(after: int, by: float) -> tuple[Onset, ...]:
    return (*SECOND[:after], *(one._replace(time=one.time + by) for one in SECOND[after:]))


def at_speed(number: int, speed: float) -> tuple[Onset, ...]:
    return (*NINE[:number], NINE[number]._replace(speed=speed), *NINE[number + 1 :])


@pytest.mark.parametrize(
    ("first", "second", "resolution", "time", "because"),
    [
        # 1e-6 2^n > 0.01 s first for n = 14: a tenth of the time between impacts
        (FIRST, SECOND, 0.0, 1.5, "pin: impacts are 0.016 s apart"),
        # of 2.6e-4 s ten times 2 are explained, not 5.5e-3; a small distance, below 1 % of 0.1 s, may be sudden
        (FIRST, later(9, 5e-3), 0.0, 1.0, "s apart"),
        (FIRST, later(2, 5e-4), 0.0, 1.5, "s apart"),
        (FIRST, FIRST, 0.0, math.inf, ""),
        (NINE, LOST, 0.0, 0.6, "pin: one has an impact that the other lacks"),
        (at_speed(5, 1e-3), LOST, 0.0, math.inf, ""),  # a light impact
        (NINE, at_speed(4, 1.2), 0.0, 0.5, "impacts hit at 1 and 1.2 m/s"),
        (NINE, tuple(one._replace(speed=math.nan) for one in NINE), 0.0, math.inf, ""),
        (NINE, LATE, 0.0, 0.1, "s apart"),
        (NINE, LATE, 0.03, math.inf, ""),
        (DOUBLE, NINE, 0.003, math.inf, ""),  # two that a curve may show as one
        (DOUBLE, NINE, 0.0024, 0.505, "one shows an impact that the other does not, read to 0.0024 s"),
    ],
)
def test_when_curves_without_errors_part(
    first: tuple[Onset, ...], second: tuple[Onset, ...], resolution: float, time: float, because: str
) -> None:
    found = parting_of_impacts({"other": (), "pin": first}, {"pin": second}, resolution=resolution)
    assert found.time == pytest.approx(time, abs=1e-6)
    assert because in found.because
    assert found.contact == ("pin" if because else "")
    assert parting_of_impacts({"pin": first}, {"third": second}).time == math.inf
