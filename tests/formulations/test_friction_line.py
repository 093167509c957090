"""The line that stands for a law of friction, in a step whose slip hangs on friction as one solution tells."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.often import often
from user_forces import Ambrosio
from user_forces.connector.friction_line import TRIES, FrictionLine
from user_forces.friction.law import FrictionLaw
from user_forces.friction.laws import BrownMcPhee, CubicCoulomb, Threlfall

LAWS = [
    Ambrosio(sliding_coefficient=0.3, static_speed=1e-7, dynamic_speed=1.1e-7),
    Ambrosio(sliding_coefficient=1.5, static_speed=0.0, dynamic_speed=1e-12),
    Ambrosio(sliding_coefficient=0.2),
    CubicCoulomb(sliding_coefficient=0.3, dynamic_speed=1e-8),
    Threlfall(sliding_coefficient=0.3, dynamic_speed=1e-8),
    BrownMcPhee(static_coefficient=0.4, sliding_coefficient=0.3, transition_speed=1e-7),
]


def solved(line: FrictionLine, free: float, softness: float, guess: float, force: float) -> float:
    """The slip of a step, `free` without friction; the line is told a guess of the softness."""
    line.begin()
    while True:
        # slip = free + softness (offset + slope slip)
        slip = (free + softness * line.offset) / (1.0 - softness * line.slope)
        if line.meets(slip, force, guess * softness):
            return slip
        assert not line.exhausted


@pytest.mark.parametrize("law", LAWS, ids=str)
@settings(max_examples=often(40))
@given(
    free=st.floats(-2.0, 2.0),
    softness=st.floats(1e-6, 10.0),
    guess=st.floats(0.3, 3.0),
    start=st.floats(-0.1, 0.1),
)
def test_the_step_ends_with_the_friction_of_the_law(
    law: FrictionLaw, free: float, softness: float, guess: float, start: float
) -> None:
    force = 1e5
    line = FrictionLine(law)
    line.lay(start, force)
    slip = solved(line, free, softness, guess, force)
    ratio = law(slip, force) / force
    assert slip == pytest.approx(free + softness * ratio, abs=2e-6 * softness + 1e-15)
    # friction does not turn it round, but for what line and law may differ by
    assert slip * math.copysign(1.0, free) >= -2e-6 * softness - 1e-15


def test_few_lines_are_enough_and_the_next_step_begins_with_the_last() -> None:
    law, force = LAWS[0], 1e5
    line = FrictionLine(law)
    line.lay(0.05, force)
    tried = []

    def counted(free: float) -> int:
        line.begin()
        for n in range(TRIES):
            slip = (free + 0.1 * line.offset) / (1.0 - 0.1 * line.slope)
            if line.meets(slip, force, 0.05):
                return n
        raise AssertionError

    # from sliding to next to no slip, on a ramp of 1e-8 m/s; then on it
    tried = [counted(free) for free in (0.02, 0.021, 0.019, -0.015, 0.5)]
    assert tried[0] <= 5
    assert tried[1] == tried[2] == 0
    assert max(tried) <= 5


def test_where_nothing_presses_every_line_will_do() -> None:
    line = FrictionLine(LAWS[0])
    assert line.meets(0.1, 0.0, 1.0)
    assert math.isclose(line.offset, 0.0)
