"""Channels over time: panels, units, names and errors."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from support_exudyn import Onset, Result
from support_exudyn.postprocessing.figures.channels import error_over_time, over_time
from support_exudyn.postprocessing.figures.overlay import difference, overlay
from support_exudyn.postprocessing.figures.units import readable
from tests import figure_checks, synthetic
from tests.cases.run_cases import loose_support

TIME = np.linspace(0.0, 5.0, 501)
WAVE = np.sin(2.0 * np.pi * TIME)
SCENARIO = loose_support(1.5, formulation="compiled")


def run(error: float = 0.0) -> Result:
    """A clearance pin whose force is off by a share."""
    return synthetic.journal(
        SCENARIO, TIME, 1.6e-3 + 0.0 * TIME, 0.0 * TIME, [Onset(1.0, 0.1)],
        tip__x=(3.0 + 0.1 * WAVE, "m"), tip__y=(2.0 + 0.1 * WAVE, "m"), canopy__angle=(0.1 * WAVE, "rad"),
        canopy__angular_acceleration=(WAVE, "rad/s^2"), rear_column__force=(4e4 * WAVE * (1.0 + error), "N"),
        front_column__force=(2e4 * WAVE, "N"), slide__nothing=(0.0 * WAVE, "J"),
    )  # fmt: skip


@pytest.mark.parametrize(
    ("unit", "size", "expected"),
    [
        ("N", 5e4, ("kN", 1e-3)),
        ("N", 20.0, ("N", 1.0)),
        ("Pa", 3e7, ("MPa", 1e-6)),
        ("m^3/s", 0.02, ("l/min", 6e4)),
        ("m", 1.5e-3, ("mm", 1e3)),
        ("m", 3.0, ("mm", 1e3)),
        ("m", 30.0, ("m", 1.0)),
        ("m", 2e-5, ("µm", 1e6)),
        ("rad", 1.0, ("deg", 180.0 / np.pi)),
        ("s", 1e-3, ("ms", 1e3)),
        ("1", 5.0, ("1", 1.0)),
    ],
)
def test_units_are_those_that_are_read_best(unit: str, size: float, expected: tuple[str, float]) -> None:
    assert readable(unit, size) == (expected[0], pytest.approx(expected[1]))


def test_channels_of_a_unit_share_a_panel_and_are_shown_in_it() -> None:
    drawing = over_time(run(), ["*_column.force", "tip.*", "canopy.*"])
    forces, places, angles, accelerations = drawing.axes
    assert [axes.get_ylabel() for axes in (forces, places, angles)] == [
        "force [kN]",
        "position [mm]",
        "angle [deg]",
    ]
    assert accelerations.get_ylabel().split() == ["angular", "acceleration", "[deg/s²]"]
    assert forces.lines[0].get_ydata() == pytest.approx(40.0 * WAVE)
    assert angles.lines[0].get_ydata() == pytest.approx(np.degrees(0.1 * WAVE))
    assert [line.get_label() for line in places.lines[:2]] == [
        "tip.x: meaning of tip.x",
        "tip.y: meaning of tip.y",
    ]
    assert accelerations.get_xlabel() == "time [s]"


def test_a_piece_is_chosen_and_touches_are_marked() -> None:
    drawing = over_time(run(), ["tip.x"], after=0.98, until=1.04)
    (axes,) = drawing.axes
    assert axes.get_xlabel() == "time [ms]"
    assert axes.get_xlim() == pytest.approx((980.0, 1040.0))
    assert axes.lines[0].get_xdata() == pytest.approx([980.0, 990.0, 1000.0, 1010.0, 1020.0, 1030.0, 1040.0])
    assert axes.lines[1].get_xdata() == pytest.approx([1000.0])  # the impact


def test_errors_are_those_of_the_estimate() -> None:
    """At every record what `Result.estimate` says of the value there."""
    found = replace(run(), goal=1e-3, coarser=replace(run(0.01), coarser=run(0.03)))
    errors = error_over_time(found, "rear_column.force")
    assert errors is not None
    for n in (20, 130, 333):
        estimate = found.estimate(lambda r, n=n: r["rear_column.force"][n])
        # rounding is that of the channel's largest value, not of each
        assert errors[n] == pytest.approx(estimate.error, rel=1e-6)
    drawing = over_time(found, ["rear_column.force"])
    (band,) = drawing.axes[0].collections
    around = band.get_paths()[0].vertices
    at = around[np.isclose(around[:, 0], TIME[130])][:, 1]  # below and above
    value = 1e-3 * found["rear_column.force"][130]
    assert [at.min(), at.max()] == pytest.approx([value - 1e-3 * errors[130], value + 1e-3 * errors[130]])
    assert "rear_column.force" in figure_checks.words_below(drawing)


# --- several runs ---

TIMES = np.linspace(0.0, 2.0, 201)


def moved(shift: float, time: np.ndarray) -> Result:
    still = np.zeros_like(time)
    return synthetic.journal(SCENARIO, time, still, still, [], tip__x=(3.0 + shift * np.sin(time), "m"))


def test_every_run_has_a_curve_in_the_panel_of_its_channel() -> None:
    drawing = overlay({"a": moved(0.1, TIMES), "b": moved(0.2, TIMES)}, ["tip.x"])
    (axes,) = drawing.axes
    assert [line.get_label() for line in axes.lines] == ["a", "b"]
    assert axes.lines[1].get_ydata() == pytest.approx(3000.0 + 200.0 * np.sin(TIMES))
    assert axes.get_ylabel() == "position [mm]"
    assert drawing.get_suptitle() == "a and b, 0 to 2 s"


def test_a_difference_is_taken_where_both_have_records() -> None:
    drawing = difference({"a": moved(0.1, TIMES), "b": moved(0.3, TIMES[::2])}, ["tip.x"], until=1.0)
    (line,) = drawing.axes[0].lines
    shared = TIMES[::2][TIMES[::2] <= 1.0]
    assert line.get_xdata() == pytest.approx(shared)
    assert line.get_ydata() == pytest.approx(200.0 * np.sin(shared))
    assert drawing.get_suptitle() == "b less a, 0 to 1 s"
