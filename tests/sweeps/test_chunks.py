"""Chunks of work: large where items are small, and small at the end."""

from __future__ import annotations

import math

import pytest

from support_exudyn.sweeps.chunks import LONG, MOST, PARTS, Chunks


def sizes(number: float, seconds: float, workers: int, count: int) -> list[int]:
    """Of all chunks of so many items, each of which takes so long, one chunk after the other."""
    chunks = Chunks(iter(range(count)), number, workers)
    found, items = [], []
    for place, chunk in enumerate(chunks):
        assert chunks.under_way == {place: chunk}
        assert chunks.ended(place, seconds * len(chunk)) == chunk
        found.append(len(chunk))
        items += chunk
    assert items == list(range(count))
    return found


def test_the_first_is_one_item_and_the_others_last_as_long_as_they_should() -> None:
    found = sizes(math.inf, LONG / 10.5, 2, 51)
    assert found == [1, 10, 10, 10, 10, 10]
    assert max(sizes(math.inf, 0.0, 2, 1000)) == MOST


@pytest.mark.parametrize("workers", [1, 2, 7])
def test_none_is_more_than_a_part_of_what_is_left_for_each_process(workers: int) -> None:
    found = sizes(400, 1e-6, workers, 400)
    left = 400
    for size in found:
        assert size <= max(1, left / (PARTS * workers))
        left -= size
    assert found[-1] == 1


def test_long_ones_are_alone() -> None:
    assert set(sizes(20, 2.0 * LONG, 2, 20)) == {1}


def test_what_ended_with_its_process_makes_the_next_small() -> None:
    chunks = Chunks(iter(range(200)), math.inf, 2)
    each = iter(chunks)
    next(each)
    chunks.ended(0, 1e-6)
    assert len(next(each)) == MOST
    chunks.ended(1, math.inf)
    assert len(next(each)) == 1
