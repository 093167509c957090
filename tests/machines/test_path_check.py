"""Columns that are driven apart: the way that they really go has to be there."""

from __future__ import annotations

from itertools import pairwise

import pytest

from support_exudyn import CubicStep, Drive, Reciprocating, Scenario, reference_support
from support_exudyn.machines import drive_path
from support_exudyn.machines.drive_path import times
from user_forces import InputError

SUPPORT = reference_support()


def driven(front: Drive, rear: Drive, duration: float = 5.0) -> Scenario:
    return Scenario(machine=SUPPORT, drives={"front_column": front, "rear_column": rear}, duration=duration)


def test_lengths_are_reached_from_near() -> None:
    start = SUPPORT.start()
    wanted = [length + 0.02 for length in SUPPORT.column_lengths(start)]
    found, alike = SUPPORT.reached(wanted, start), SUPPORT.extended(0.02)
    assert found is not None
    assert alike is not None
    # both solve to 1e-11 m
    assert found.hinge == pytest.approx(alike.hinge, abs=1e-10)


def test_a_way_that_is_open_is_taken_though_its_corners_are_not() -> None:
    """One column alone cannot come so far; both together can, nearly."""
    with pytest.raises(InputError, match="rear_column cannot follow"):
        driven(CubicStep(stroke=0.0), CubicStep(stroke=0.8))
    driven(CubicStep(stroke=0.8), CubicStep(stroke=0.79))


def test_columns_one_after_the_other_are_told_when() -> None:
    """At its own end a drive would do; before the other has come, it does not."""
    with pytest.raises(InputError, match=r"drives\.rear_column: rear_column cannot follow beyond 1\.\d+ s"):
        driven(CubicStep(stroke=0.8, start=3.0, end=4.0), CubicStep(stroke=0.79, start=1.0, end=2.0))


def test_what_was_followed_once_is_not_looked_at_again(monkeypatch: pytest.MonkeyPatch) -> None:
    looked = []
    monkeypatch.setattr(
        "support_exudyn.machines.four_bar_shield.check_path", lambda *given: looked.append(given)
    )
    for _ in range(3):
        driven(CubicStep(stroke=0.111), CubicStep(stroke=0.112))
    assert len(looked) == 1


def test_times_hold_breaks_and_the_end_and_swings() -> None:
    drive = CubicStep(stroke=0.1, start=1.0, end=2.5)
    found = list(times((drive,), 4.0))
    assert {1.0, 2.5, 4.0} <= set(found)
    assert found == sorted(found)
    swinging = list(times((Reciprocating(stroke=0.1, period=0.5),), 4.0))
    assert max(b - a for a, b in pairwise(swinging)) < 0.5 / 16.0
    assert len(list(times((Reciprocating(stroke=0.1, period=1e-3),), 1e6))) == drive_path.MOST_SAMPLES


def test_what_was_followed_for_a_while_is_looked_at_for_longer() -> None:
    """The same drives: so far they go, and then no farther."""
    front, rear = CubicStep(stroke=0.0), CubicStep(stroke=0.8, start=1.0, end=3.0)
    driven(front, rear, duration=1.2)
    with pytest.raises(InputError, match="rear_column cannot follow"):
        driven(front, rear, duration=3.0)
