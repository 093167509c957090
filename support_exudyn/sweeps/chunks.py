"""Work in chunks: small runs are sent many at a time, and no process waits long for another at the end."""

import math
from collections.abc import Iterator
from itertools import islice
from typing import Generic, TypeVar

T = TypeVar("T")

LONG = 0.3  # [s] that a chunk is to take
MOST = 64  # items of a chunk
PARTS = 4  # of a process's share of what is left, of which a chunk is one at most


class Chunks(Generic[T]):
    """Items in chunks, in their order; each is as large as those that have ended took time.

    Arguments:
        items: what is to be done.
        number: of the items, as far as it is known.
        workers: number of processes.
    """

    def __init__(self, items: Iterator[T], number: float, workers: int) -> None:
        self._items = items
        self._left, self._workers = number, workers
        self._seconds = math.inf  # for an item
        self._numbers = 0
        self.under_way: dict[int, list[T]] = {}

    def __iter__(self) -> Iterator[list[T]]:
        """Every chunk; it is under way until `ended` is told its number, from 0."""
        while chunk := list(islice(self._items, self._size())):
            self._left -= len(chunk)
            self.under_way[self._numbers] = chunk
            self._numbers += 1
            yield chunk

    def ended(self, number: int, seconds: float) -> list[T]:
        """The items of a chunk that has ended, and took so long [s]."""
        chunk = self.under_way.pop(number)
        self._seconds = seconds / len(chunk)
        return chunk

    def _size(self) -> int:
        allowed = min(MOST, LONG / max(self._seconds, LONG / MOST), self._left / (PARTS * self._workers))
        return max(1, int(allowed))
