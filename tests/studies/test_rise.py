"""What is measured of a rise, against closed forms for known courses."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt
import pytest

from studies.common import rise

Series = npt.NDArray[np.float64]
BEGIN, END = rise.START + rise.PAPER.window, rise.END - rise.PAPER.window
PERIODS = (1e-3, 2e-3)  # of the records [s]


@dataclass(frozen=True)
class Record:
    """A run that is known in closed form."""

    period: float = 1e-3
    courses: dict[str, Callable[[Series], Series]] = field(default_factory=dict)

    @property
    def time(self) -> Series:
        return np.arange(round(5.0 / self.period) + 1) * self.period

    def __getitem__(self, name: str) -> Series:
        return self.courses[name](self.time)


def response(frequency: float, period: float) -> float:
    """How much of a sine the trend keeps: the trapezoidal rule over the window."""
    half, turn = 0.05 / period, 2.0 * np.pi * frequency * period
    return float(np.sin(half * turn) / (2.0 * half * np.tan(0.5 * turn)))


def rms(values: Series) -> float:
    """Root mean square over time, by the trapezoidal rule."""
    squares = values**2
    return float(np.sqrt((squares.sum() - 0.5 * (squares[0] + squares[-1])) / (values.size - 1)))


# --- trend and RMS fluctuation ---


@pytest.mark.parametrize("period", PERIODS)
@pytest.mark.parametrize("frequency", [4.0, 12.0, 20.0, 37.0])
def test_the_ripple_of_a_sine_on_a_slope_is_known(period: float, frequency: float) -> None:
    def sine(time: Series) -> Series:
        return 0.3 * np.sin(2 * np.pi * frequency * time + 0.4)

    run = Record(period, {"x": lambda time: 50.0 - 7.0 * time + sine(time)})
    left = (1.0 - response(frequency, period)) * rms(sine(run.time[rise.between(run, BEGIN, END)]))
    # a slope is its own moving mean; rounding of the moving sum over values of 50
    assert rise.PAPER.rms_fluctuation(run, run["x"]) == pytest.approx(left, abs=1e-11)


def test_only_what_is_between_the_times_counts() -> None:
    run = Record(courses={"x": lambda t: np.where((t > 3.7) & (t < 4.3), np.sin(2 * np.pi * 20.0 * t), 0.0)})
    found = {name: rise.PAPER.rms_fluctuation(run, run["x"], *times) for name, times in rise.STAGES.items()}
    assert found["middle"] == pytest.approx(np.sqrt(0.5), rel=0.02)  # a window is more than two periods
    assert found["early"] <= 1e-15  # rounding of sums of zeros
    assert found["late"] <= 1e-13  # of what the moving sum has passed
    # six of 18 tenths of a second shake, ten records of 600 more or less where the trend sees the borders
    assert rise.PAPER.rms_fluctuation(run, run["x"]) == pytest.approx(np.sqrt(0.5 / 3.0), rel=0.05)


# --- likeness ---


def test_the_same_course_is_alike_whatever_its_size_and_shaking() -> None:
    def alike(other: Callable[[Series], Series]) -> float:
        one, two = (Record(courses={"x": course}) for course in (np.sin, other))
        found = rise.PAPER.likeness(one, two, "x")
        assert rise.PAPER.likeness(two, one, "x") == pytest.approx(found, abs=1e-12)
        return found

    assert alike(np.sin) == pytest.approx(1.0, abs=1e-12)  # rounding
    assert alike(lambda t: 5.0 - 3.0 * np.sin(t)) == pytest.approx(-1.0, abs=1e-12)
    # of the shaking the trend keeps 1 %, 0.003, of a course whose standard deviation is 0.66
    shaken = alike(lambda t: 2.0 * np.sin(t) + 0.3 * np.sin(2 * np.pi * 20.0 * t))
    assert shaken == pytest.approx(1.0, abs=1e-4)


# --- means, departures, angles ---


@pytest.mark.parametrize("stage", rise.STAGES)
def test_the_mean_of_a_stage_is_of_magnitudes(stage: str) -> None:
    begin, end = rise.STAGES[stage]
    run = Record(courses={"x": lambda t: -2.0 * t, "y": lambda t: np.sign(t - 0.5 * (begin + end) + 1e-6)})
    assert rise.PAPER.stage_mean_of("x", stage)(run) == pytest.approx(begin + end, rel=1e-12)  # rounding
    assert rise.PAPER.stage_mean_of("y", stage)(run) == 1.0


@pytest.mark.parametrize(("column", "forward"), [("front_column", 0.2), ("rear_column", -0.2)])
def test_angles_are_those_of_figure_12(column: str, forward: float) -> None:
    run = Record(courses={f"{column}.angle": lambda t: np.full_like(t, 0.5 * np.pi - forward)})  # x is forward
    # from the rearward horizontal; rounding
    assert rise.rearward_angle(run, column) == pytest.approx(0.5 * np.pi + forward, rel=1e-15)
    assert rise.lean(run, column) == pytest.approx(0.2, rel=1e-14)
