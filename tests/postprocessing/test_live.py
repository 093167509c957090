"""Figures to look into: what is kept of their curves, their files, and what a page is given."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from matplotlib.figure import Figure

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.page.live import of_drawing, thinned
from tests.often import often

MOST = 60
VALUES = st.floats(-1e6, 1e6) | st.just(float("nan"))


def drawing() -> Figure:
    figure = Figure()
    upper, lower = figure.subplots(2, 1)
    time = np.linspace(0.0, 5.0, 20_001)
    for axes, size in ((upper, 1.0), (lower, 30.0)):
        axes.plot(time, size * np.sin(time), label="under", color="#0072B2", lw=0.9, zorder=1)
        axes.plot(time, size * np.cos(time), label="over", color="#000000", ls=(0, (4, 2)), zorder=3)
        axes.plot([1.0, 2.0], [0.0, size], "x", label="paper", color="#882255", zorder=4)
        axes.plot(time, 0.0 * time, color="#777777")
        axes.axvline(3.0, label="start")
        axes.set_ylabel("pin force\n[kN]")
    lower.set_xlabel("time [s]")
    return figure


@given(arrays.arrays(float, st.integers(1, 800), elements=VALUES))
@settings(max_examples=often(60), deadline=None)
def test_every_piece_keeps_its_extremes_and_its_gaps(curve: Series) -> None:
    kept = thinned(curve, MOST)
    assert np.array_equal(kept, np.unique(kept))
    if curve.size <= MOST:
        assert kept.size == curve.size
        return
    assert kept.size <= MOST + 2
    assert {0, curve.size - 1} <= set(kept.tolist())
    for piece in np.array_split(np.arange(curve.size), MOST // 3):
        inside, whole = curve[np.intersect1d(kept, piece)], curve[piece]
        if np.isfinite(whole).any():
            assert np.nanmin(inside) == np.nanmin(whole)
            assert np.nanmax(inside) == np.nanmax(whole)
        assert np.isnan(whole).any() == np.isnan(inside).any()  # a gap is still one


def test_curves_of_a_drawing_are_its_labelled_lines_from_the_undermost() -> None:
    found = of_drawing(drawing(), [1, 0])
    assert found.x_label == "time [s]"
    assert [panel.label for panel in found.panels] == ["pin force [kN]"] * 2
    under, over, paper = found.panels[0].curves
    assert (under.label, under.colour, under.dash, under.width) == ("under", "#0072b2", "solid", 0.9)
    assert (over.label, over.dash) == ("over", "dashed")
    assert (paper.dash, paper.x, paper.y) == ("points", (1.0, 2.0), (0.0, 30.0))
    assert max(v for v in under.y if v is not None) == 30.0
