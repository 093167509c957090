"""A step made again to end where a contact is pressed on again: every look is between the nearest others."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from support_exudyn.formulations.compilation import plain
from support_exudyn.formulations.compiled import depth
from support_exudyn.formulations.compiled import landing as general
from support_exudyn.formulations.compiled.arrays import CONTACT, REPORT

STEP = 0.125


class Turning:
    """A rate that rises over a step, steeply first or last, and passes zero at a share of it."""

    def __init__(self, turn: float, flat: float, late: bool) -> None:
        self.turn, self.flat, self.late = turn, flat, late
        self.looked: list[float] = []

    def rate(self, x: float) -> float:
        if self.late:
            return x**self.flat - self.turn**self.flat
        return (1.0 - self.turn) ** self.flat - (1.0 - x) ** self.flat

    def look(self, length: float) -> float:
        self.looked.append(length / STEP)
        return self.rate(length / STEP)

    def check(self, length: float, guess: float) -> None:
        assert length / STEP == self.looked[-1]  # where it ends is what was made last
        assert self.looked[0] == pytest.approx(guess)
        for n, x in enumerate(self.looked[1:], 1):
            low = max([0.0, *(other for other in self.looked[:n] if self.rate(other) < 0.0)])
            high = min([1.0, *(other for other in self.looked[:n] if self.rate(other) >= 0.0)])
            # rounding
            assert low - 1e-9 <= x <= high + 1e-9


def landed(turning: Turning, guess: float) -> float:
    def advance(scene: SimpleNamespace, t: float, length: float, *rest: object) -> None:
        scene.contacts[0].rate = turning.look(length)

    start, now = (np.zeros(1, CONTACT).view(np.recarray) for _ in range(2))
    start[0].rate, now[0].rate = turning.rate(0.0), turning.rate(1.0)
    scene, report = SimpleNamespace(contacts=now), [0.0] * REPORT
    land = plain(general.land, advance=advance)
    length: float = land(
        scene, 0, 0.0, STEP, depth.RETURN, 0.0, guess, start, None, None, None, None, None, report
    )
    return length


@given(turn=st.floats(0.05, 0.95), guess=st.floats(0.02, 0.98), flat=st.floats(1.0, 8.0), late=st.booleans())
@example(turn=0.16, guess=0.9, flat=8.0, late=False)  # the rate hardly changes from the guess on
@example(turn=0.84, guess=0.1, flat=8.0, late=True)
def test_a_turn_is_sought_between_the_nearest_looks_on_either_side(
    turn: float, guess: float, flat: float, late: bool
) -> None:
    turning = Turning(turn, flat, late)
    turning.check(landed(turning, guess), guess)
