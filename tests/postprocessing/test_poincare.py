"""Poincare sections of motions that are known."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from support_exudyn import CubicStep, Held, Onset, Reciprocating, Result
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.poincare import period, periodic_times, poincare
from tests import figure_checks, synthetic
from tests.cases.run_cases import CRANK_SPEED, loose_slider_crank, loose_support

PERIOD = 0.5  # [s]
SCENARIO = loose_support(1.5, drive=Reciprocating(stroke=0.2, period=PERIOD), duration=5.0)
TIME = np.linspace(0.0, 5.0, 5001)


def swinging(share: float) -> Result:
    """A journal that goes round in its bore so many times in a period of the drive, on the whole 1 mm out."""
    angle = 2.0 * np.pi * share * TIME / PERIOD
    x, y = 1e-3 * np.cos(angle), 1e-3 * np.sin(angle)
    speed = (np.gradient(x, TIME), "rad/s")
    return synthetic.journal(
        SCENARIO, TIME, x, y, rear_link__angle=(x, "rad"), rear_link__angular_velocity=speed
    )


@pytest.mark.parametrize(("share", "points"), [(1.0, 1), (0.5, 2), (1.0 / 3.0, 3)])
def test_a_motion_of_n_periods_is_n_points(share: float, points: int) -> None:
    (marks,) = [
        line for line in poincare(swinging(share), phase=0.25).axes[0].lines if line.get_marker() == "^"
    ]
    # the times fall on records; 1e-6 mm is far below the distance of the points and far above rounding
    assert (
        len({(round(x, 6) + 0.0, round(y, 6) + 0.0) for x, y in zip(*marks.get_data(), strict=True)}) == points
    )
    assert periodic_times(swinging(share), 0.25) == pytest.approx((np.arange(10) + 0.25) * PERIOD)


def test_the_section_is_drawn_in_the_bore_and_of_two_channels() -> None:
    drawing = poincare(swinging(1.0 / 3.0))
    bore, pair = drawing.axes[:2]
    angle = 2.0 * np.pi * np.arange(11) / 3.0
    (points,) = [line for line in bore.lines if line.get_label() == "free flight"]
    assert points.get_color() == style.FLIGHT  # 1 mm of 1.5: it never impacts
    assert points.get_xdata() == pytest.approx(np.cos(angle), abs=1e-9)
    assert bore.get_xlabel() == "eccentricity x [mm]"
    assert pair.get_xlabel() == "rear_link.angle [deg]"
    assert "once in a period" in drawing.get_suptitle()
    assert "(0.5 s)" in figure_checks.words_below(drawing)


def closed(speeds: list[float]) -> Result:
    """A rise, which has no period, with an impact every 0.1 s."""
    onsets = [Onset(0.1 * (n + 1), speed, 0.1 * (n + 1) + 0.01, 0.5 * speed) for n, speed in enumerate(speeds)]
    away = np.minimum(1.4e-3, TIME)
    return synthetic.journal(loose_support(1.5), TIME, away, 0.0 * TIME, onsets)


def test_without_a_period_touches_make_the_section() -> None:
    speeds = [0.2, 0.1, 0.15, 0.05]
    drawing = poincare(closed(speeds))
    places, returns = drawing.axes
    (points,) = [line for line in returns.lines if line.get_label() == "impacts"]
    assert points.get_xdata() == pytest.approx([200.0, 100.0, 150.0])
    assert points.get_ydata() == pytest.approx([100.0, 150.0, 50.0])
    assert places.lines[1].get_xdata() == pytest.approx([0.0] * 4)  # deg
    assert returns.get_xlabel() == "initial impact velocity of an impact [mm/s]"
    assert "by impacts" in drawing.get_suptitle()


def test_periods_are_those_of_the_drives() -> None:
    assert period(SCENARIO) == PERIOD
    assert period(loose_slider_crank(0.02)) == pytest.approx(2.0 * math.pi / CRANK_SPEED)
    assert period(loose_support(1.5)) is None  # a rise
    others = ((Held(), PERIOD), (Reciprocating(stroke=0.2, period=0.7), None), (CubicStep(), None))
    for other, expected in others:
        assert period(replace(SCENARIO, drives={"rear_column": other})) == expected
