"""Drives that a linkage can follow, and those at which it locks, against closed forms."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest

from support_exudyn import CubicStep, Held, Reciprocating, Steady, UniformSpeed, ravn_slider_crank
from support_exudyn.mechanics.closing import Conditions
from support_exudyn.mechanics.following import follow
from support_exudyn.model.linkage import GROUND, Crank, LinearActuator, Linkage, pinned
from tests.drawn.drawn_linkages import bar_of
from tests.linkages import four_bar
from user_forces import InputError

ROCKER = 0.1, 0.4, 0.3, 0.35  # Grashof: 0.1 + 0.4 < 0.3 + 0.35
DOUBLE_ROCKER = 0.3, 0.2, 0.3, 0.45


def driven(linkage: Linkage, *cranks: str) -> Linkage:
    return replace(linkage, cranks={name: Crank(body=name) for name in cranks})


def said(linkage: Linkage, drives: dict[str, object], duration: float) -> str:
    with pytest.raises(InputError) as raised:
        follow(linkage, drives, duration)  # type: ignore[arg-type]
    return str(raised.value)


@pytest.fixture
def postures(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """One entry for each posture at which conditions were asked for."""
    asked: list[int] = []
    own = Conditions.short

    def short(self: Conditions, *given: Any) -> Any:
        asked.append(1)
        return own(self, *given)

    monkeypatch.setattr(Conditions, "short", short)
    return asked


def test_a_crank_turns_right_round_and_costs_one_revolution(postures: list[int]) -> None:
    linkage = driven(four_bar(*ROCKER), "crank")
    follow(linkage, {"crank": Steady(rate=2.0 * math.pi)}, 1.0)
    once = len(postures)
    postures.clear()
    follow(linkage, {"crank": Steady(rate=-2.0 * math.pi)}, 1e5)
    assert len(postures) < 1.2 * once
    follow(ravn_slider_crank().linkage(), {"crank": Steady(rate=500.0)}, 100.0)


def test_a_double_rocker_locks_where_coupler_and_rocker_lie_in_line() -> None:
    a, b, c, g = DOUBLE_ROCKER
    limit = math.acos((a**2 + g**2 - (b + c) ** 2) / (2.0 * a * g))
    start = math.radians(60.0)
    text = said(driven(four_bar(a, b, c, g), "crank"), {"crank": Steady(rate=1.0)}, 100.0)
    assert text.startswith("drives.crank: crank cannot follow beyond")
    assert f"{limit - start:.4g} s" in text
    assert f"turned by {math.degrees(limit - start):.4f} degrees" in text
    # smoothly, there and back
    follow(driven(four_bar(a, b, c, g), "crank"), {"crank": CubicStep(stroke=0.99 * (limit - start))}, 10.0)
    text = said(driven(four_bar(a, b, c, g), "crank"), {"crank": Reciprocating(stroke=2.0, period=4.0)}, 100.0)
    when = 4.0 / (2.0 * math.pi) * math.acos(1.0 - (limit - start))
    assert f"beyond {when:.4g} s" in text


def arm() -> Linkage:
    """A boom on a cylinder, and a stick that another cylinder moves against it."""
    pivot, foot, head, tip = (0.0, 0.0), (0.5, -0.5), (1.0, 0.6), (2.0, 1.0)
    horn, end = (2.3, 1.4), (2.6, -0.2)
    return Linkage(
        bodies={"boom": bar_of(pivot, tip), "stick": bar_of(tip, end)},
        pins={"P": pinned(GROUND, "boom", pivot), "Q": pinned("boom", "stick", tip)},
        actuators={
            "lift": LinearActuator(foot=GROUND, head="boom", foot_point=foot, head_point=head),
            "crowd": LinearActuator(foot="boom", head="stick", foot_point=(1.0, 0.9), head_point=horn),
        },
    )


def test_the_cylinder_that_locks_is_named_among_several() -> None:
    linkage = arm()
    follow(linkage, {"lift": CubicStep(stroke=0.3), "crowd": CubicStep(stroke=0.1)}, 10.0)
    longest = math.hypot(1.0, 0.6) + math.hypot(0.5, 0.5)
    rise = UniformSpeed(stroke=1.0, start=0.0, end=10.0)
    text = said(linkage, {"lift": rise, "crowd": CubicStep(stroke=0.1)}, 10.0)
    assert text.startswith("drives.lift: lift cannot follow beyond")
    when = 10.0 * (longest - linkage.actuators["lift"].start_length)
    assert f"beyond {when:.4g} s" in text


def test_two_cranks_that_fight_cannot_go() -> None:
    linkage = driven(four_bar(*ROCKER), "crank", "rocker")
    text = said(linkage, {"crank": Steady(rate=1.0), "rocker": Steady(rate=1.0)}, 1.0)
    assert text.startswith("drives.crank and drives.rocker: ")
    text = said(linkage, {"crank": Steady(rate=1.0), "rocker": Held()}, 1.0)
    assert "cannot follow beyond 0 s" in text
