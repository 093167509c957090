"""Columns that are driven apart: the way that they really go has to be there."""

from __future__ import annotations

import pytest

from support_exudyn import CubicStep, Drive, Scenario, reference_support
from user_forces import InputError

SUPPORT = reference_support()


def driven(front: Drive, rear: Drive, duration: float = 5.0) -> Scenario:
    return Scenario(machine=SUPPORT, drives={"front_column": front, "rear_column": rear}, duration=duration)


def test_a_way_that_is_open_is_taken_though_its_corners_are_not() -> None:
    """One column alone cannot come so far; both together can, nearly."""
    with pytest.raises(InputError, match="rear_column cannot follow"):
        driven(CubicStep(stroke=0.0), CubicStep(stroke=0.8))
    driven(CubicStep(stroke=0.8), CubicStep(stroke=0.79))


def test_columns_one_after_the_other_are_told_when() -> None:
    """At its own end a drive would do; before the other has come, it does not."""
    with pytest.raises(InputError, match=r"drives\.rear_column: rear_column cannot follow beyond 1\.\d+ s"):
        driven(CubicStep(stroke=0.8, start=3.0, end=4.0), CubicStep(stroke=0.79, start=1.0, end=2.0))


def test_what_was_followed_for_a_while_is_looked_at_for_longer() -> None:
    """The same drives: so far they go, and then no farther."""
    front, rear = CubicStep(stroke=0.0), CubicStep(stroke=0.8, start=1.0, end=3.0)
    driven(front, rear, duration=1.2)
    with pytest.raises(InputError, match="rear_column cannot follow"):
        driven(front, rear, duration=3.0)
