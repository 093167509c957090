"""The checks of figures find what they look for."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from support_exudyn.postprocessing.figures import style
from tests import figure_checks


def drawing(label: str = "time [s]") -> tuple[Figure, Axes]:
    figure = Figure(figsize=style.size(100, 60))
    axes = figure.subplots()
    axes.plot([0.0, 1.0], [0.0, 1.0])
    axes.set(xlabel=label, ylabel="force [kN]")
    return figure, axes


def test_a_good_figure_passes() -> None:
    with style.look():
        figure, _ = drawing()
        figure_checks.check(figure)
    assert "time [s]" in [text for text, _ in figure_checks.texts(figure)]


def test_text_over_the_edge_is_found() -> None:
    with style.look():
        figure, _ = drawing()
        figure.text(0.9, 0.5, "far too long for here")
        assert figure_checks.cut_off(figure) == ["far too long for here"]


def test_text_upon_text_is_found() -> None:
    with style.look():
        figure, axes = drawing()
        axes.text(0.5, 0.5, "one")
        axes.text(0.5, 0.5, "other")
        assert figure_checks.overlapping(figure) == [("one", "other")]


def test_labels_without_units_are_found() -> None:
    with style.look():
        assert figure_checks.without_unit(drawing("time")[0]) == ["time"]


def test_ticks_beyond_the_limits_do_not_count() -> None:
    with style.look():
        figure, axes = drawing()
        axes.set_xticks([0.5, 900.0])
        axes.set_xlim(0.0, 1.0)
        context = [text for text, _ in figure_checks.texts(figure)]
    assert "0.5" in context
    assert "900.0" not in context
