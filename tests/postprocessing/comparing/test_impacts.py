"""Impacts: matched in two runs, found in a curve of a force, and when curves without errors part."""

from __future__ import annotations

import math
from itertools import combinations, pairwise, product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support_exudyn.postprocessing.comparing.found_impacts import impacts_of_force
from support_exudyn.postprocessing.comparing.matched_impacts import match_impacts
from support_exudyn.postprocessing.comparing.parting import parting_of_impacts
from tests.often import often
from user_forces import InputError
from user_forces.contact_state import Onset


def onsets(*times: float, speed: float = 1.0) -> tuple[Onset, ...]:
    return tuple(Onset(time, speed) for time in times)


def pairs(first: tuple[Onset, ...], second: tuple[Onset, ...]) -> list[tuple[float, float]]:
    return [(one.time, other.time) for one, other in match_impacts(first, second).pairs]


def test_an_impact_that_one_run_lacks_leaves_the_others_matched() -> None:
    first, second = onsets(1.0, 1.1, 1.15, 1.2, 1.3), onsets(1.001, 1.101, 1.202, 1.303)
    found = match_impacts(first, second)
    assert [one.time for one in found.only_first] == [1.15]
    assert found.only_second == ()
    assert pairs(first, second) == [(1.0, 1.001), (1.1, 1.101), (1.2, 1.202), (1.3, 1.303)]


def test_a_late_burst_is_matched_in_its_order() -> None:
    first, second = onsets(0.0, 0.010, 0.013, 0.014, 0.2), onsets(0.002, 0.012, 0.015, 0.016, 0.2)
    assert pairs(first, second) == [(one.time, other.time) for one, other in zip(first, second, strict=True)]


def test_runs_with_one_impact_or_none() -> None:
    assert match_impacts((), ()) == ((), (), ())
    assert match_impacts(onsets(1.0), ()).only_first == onsets(1.0)
    assert pairs(onsets(1.0), onsets(1.0)) == [(1.0, 1.0)]
    assert pairs(onsets(1.0), onsets(0.5, 1.1, 1.6)) == [(1.0, 1.1)]


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


def test_curves_part_where_their_difference_is_a_tenth_of_the_time_between_impacts() -> None:
    first, second = grown(20, 1e-6, 2.0)
    found = parting_of_impacts({"pin": first}, {"pin": second})
    # 1e-6 2^n > 0.01 s first for n = 14
    assert found.time == pytest.approx(1.5)
    assert found.contact == "pin"
    assert found.impacts == 14
    assert found.growth == pytest.approx(2.0)


def test_a_sudden_difference_parts_them_before() -> None:
    first, second = grown(20, 1e-6, 2.0)
    late = [*second[:9], *(one._replace(time=one.time + 5e-3) for one in second[9:])]
    found = parting_of_impacts({"pin": first}, {"pin": late})
    # of 2.6e-4 s ten times 2 are explained, not 5.5e-3; a small one, below 1 % of 0.1 s, may be sudden
    assert found.time == pytest.approx(1.0)
    small = [*second[:2], *(one._replace(time=one.time + 5e-4) for one in second[2:])]
    assert parting_of_impacts({"pin": first}, {"pin": small}).time > 1.0


def test_equal_curves_do_not_part() -> None:
    first, _ = grown(20, 0.0, 1.0)
    found = parting_of_impacts({"pin": first, "other": first}, {"pin": first, "third": ()})
    assert (found.time, found.because, found.impacts) == (math.inf, "", 20)
    assert math.isnan(found.growth)
    assert parting_of_impacts({}, {}).time == math.inf


def test_a_lost_impact_parts_them_unless_it_is_light() -> None:
    first, _ = grown(9, 0.0, 1.0)
    lost = (*first[:5], *first[6:])
    found = parting_of_impacts({"pin": first}, {"pin": lost})
    assert found.time == pytest.approx(0.6)
    assert "lacks" in found.because
    light = (*first[:5], first[5]._replace(speed=1e-3), *first[6:])
    assert parting_of_impacts({"pin": light}, {"pin": lost}).time == math.inf


def test_other_speeds_part_them_if_they_are_known() -> None:
    first, second = grown(9, 1e-9, 1.0)
    faster = (*second[:4], second[4]._replace(speed=1.2), *second[5:])
    assert parting_of_impacts({"pin": first}, {"pin": faster}).time == pytest.approx(0.5)
    unknown = tuple(one._replace(speed=math.nan) for one in second)
    assert parting_of_impacts({"pin": first}, {"pin": unknown}).time == math.inf


def test_times_are_compared_to_their_resolution() -> None:
    first, second = grown(9, 0.02, 1.0)
    assert parting_of_impacts({"pin": first}, {"pin": second}).time == pytest.approx(0.1)
    assert parting_of_impacts({"pin": first}, {"pin": second}, resolution=0.03).time == math.inf
    double = tuple(sorted((*first, first[4]._replace(time=first[4].time + 0.005))))
    assert parting_of_impacts({"pin": double}, {"pin": first}, resolution=0.003).time == math.inf
    assert parting_of_impacts({"pin": double}, {"pin": first}).because.endswith("that the other lacks")
    told = parting_of_impacts({"pin": double}, {"pin": first}, resolution=0.0024).because
    assert told == "pin: one shows an impact that the other does not, read to 0.0024 s"
