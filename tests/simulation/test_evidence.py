"""Numbers with errors: what may be said of them, and what the errors leave open."""

from __future__ import annotations

import itertools

from hypothesis import given
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
