"""Numbers with errors: what may be said of them, and what the errors leave open."""

from __future__ import annotations

import itertools
import math

from hypothesis import example, given
from hypothesis import strategies as st

from studies.claims.evidence import (
    Measured,
    Verdict,
    every,
    rising,
    some,
    within,
)

TRUTHS: tuple[Verdict, ...] = (True, None, False)
RANK = {False: 0, None: 1, True: 2}  # by Kleene: and is the least, or the greatest, not the mirror image

# whole numbers: sums and differences are exact, so that bounds of errors can be asked for without tolerance
wholes = st.integers(-(10**6), 10**6).map(float)
errors = st.integers(0, 10**4).map(float)
measured = st.builds(Measured, wholes, errors)
sizes = st.floats(1e-9, 1e9)
signed = sizes | sizes.map(lambda x: -x)


def possible(m: Measured) -> tuple[float, float]:
    """Between what bounds the number lies."""
    return m.value - m.error, m.value + m.error


def ends(one: Measured, other: Measured) -> list[tuple[float, float]]:
    """The corners of what two numbers can be."""
    return list(itertools.product(possible(one), possible(other)))


# --- comparisons ---


@given(one=measured, other=measured)
def test_a_comparison_is_decided_if_nothing_possible_contradicts_it(one: Measured, other: Measured) -> None:
    verdict = one.above(other)
    if verdict is True:
        assert all(a > b for a, b in ends(one, other))
    elif verdict is False:
        assert all(a < b for a, b in ends(one, other))
    else:
        assert possible(one)[0] <= possible(other)[1]
        assert possible(other)[0] <= possible(one)[1]
    assert other.below(one) is verdict


# --- logic ---


@given(verdicts=st.lists(st.sampled_from(TRUTHS), max_size=5))
def test_every_and_some_obey_kleenes_logic(verdicts: list[Verdict]) -> None:
    ranks = [RANK[v] for v in verdicts]
    assert RANK[every(verdicts)] == min(ranks, default=2)
    assert RANK[some(verdicts)] == max(ranks, default=0)
    assert every(iter(verdicts)) is every(verdicts)
    assert some(iter(verdicts)) is some(verdicts)


# --- rows ---


def test_rows_as_known() -> None:
    assert rising([Measured(1.0), Measured(2.0), Measured(3.0)]) is True
    assert rising([Measured(1.0), Measured(3.0), Measured(2.0)]) is False
    assert rising([Measured(1.0), Measured(2.0, 1.5), Measured(3.0)]) is None
    assert rising([Measured(3.0), Measured(2.0, 0.5), Measured(1.0, 10.0)]) is False
    assert within([Measured(100.0), Measured(103.0), Measured(98.0)], 0.06) is True
    assert within([Measured(100.0), Measured(103.0), Measured(98.0)], 0.04) is False
    assert within([Measured(100.0, 1.0), Measured(103.0), Measured(98.0, 1.0)], 0.05) is None
    assert within([Measured(-100.0), Measured(-103.0)], 0.05) is True  # a share of the size, not of the sign
    assert within([Measured(1.0), Measured(2.0)], 0.05, Measured(100.0)) is True
    assert within([Measured(1.0), Measured(2.0)], 0.05, Measured(-10.0)) is False


# --- in words ---


@given(value=signed | st.just(0.0), error=sizes, digits=st.integers(1, 9))
@example(value=51503.8, error=255.0, digits=5)
@example(value=3.0, error=20.0, digits=4)
@example(value=-0.0004, error=0.003, digits=3)
@example(value=9.9996, error=0.001, digits=4)
def test_no_digit_is_said_that_the_error_does_not_leave(value: float, error: float, digits: int) -> None:
    text = Measured(value, error).format(digits)
    place = math.floor(math.log10(error))  # of the error's first digit
    decimals = len(text.partition(".")[2])
    assert decimals <= max(0, -place)
    # in front of the decimal point zeros stand for digits that are not known
    assert place <= 0 or int(text) % 10**place == 0
    # what is said is right to half of its last place, or of the place asked for; rounding aside
    last = max(float(place), math.floor(math.log10(max(abs(value), error))) + 1.0 - digits)
    assert abs(float(text) - value) <= 0.5 * 10.0**last * (1.0 + 1e-9) + 1e-15 * abs(value)
