"""Impacts of two runs, matched in time."""

from __future__ import annotations

from itertools import combinations, pairwise, product

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support_exudyn.postprocessing.comparing.impacts import match_impacts
from tests.often import often
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
