"""Several runs in one figure."""

from __future__ import annotations

import numpy as np
import pytest

from support_exudyn import Result
from support_exudyn.postprocessing.figures.overlay import difference, overlay
from tests import synthetic
from tests.cases.run_cases import loose_support

SCENARIO = loose_support(1.5)
TIME = np.linspace(0.0, 2.0, 201)


def run(shift: float, time: np.ndarray = TIME) -> Result:
    still = np.zeros_like(time)
    return synthetic.journal(SCENARIO, time, still, still, [], tip__x=(3.0 + shift * np.sin(time), "m"))


def test_every_run_has_a_curve_in_the_panel_of_its_channel() -> None:
    drawing = overlay({"a": run(0.1), "b": run(0.2)}, ["tip.x"])
    (axes,) = drawing.axes
    assert [line.get_label() for line in axes.lines] == ["a", "b"]
    assert axes.lines[1].get_ydata() == pytest.approx(3000.0 + 200.0 * np.sin(TIME))
    assert axes.get_ylabel() == "position [mm]"
    assert drawing.get_suptitle() == "a and b, 0 to 2 s"


def test_a_difference_is_taken_where_both_have_records() -> None:
    drawing = difference({"a": run(0.1), "b": run(0.3, TIME[::2])}, ["tip.x"], until=1.0)
    (line,) = drawing.axes[0].lines
    shared = TIME[::2][TIME[::2] <= 1.0]
    assert line.get_xdata() == pytest.approx(shared)
    assert line.get_ydata() == pytest.approx(200.0 * np.sin(shared))
    assert drawing.get_suptitle() == "b less a, 0 to 1 s"
