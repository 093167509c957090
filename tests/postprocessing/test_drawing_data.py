"""The data of a drawing as a table."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from studies.common.panels import letters
from support_exudyn.postprocessing.figures.drawing_data import save_drawing_data


def saved(drawing: Figure, folder: Path) -> tuple[list[str], list[dict[str, str]]]:
    """The lines on the axes' labels, and the rows."""
    path = folder / "figure.csv"
    assert save_drawing_data(drawing, path)
    lines = path.read_text(encoding="utf-8").splitlines()
    notes = [line for line in lines if line.startswith("#")]
    return notes, list(csv.DictReader(lines[len(notes) :]))


def test_lines_are_written_as_far_as_their_panel_shows_them(tmp_path: Path) -> None:
    figure = Figure()
    whole, part = figure.subplots(2, 1)
    time = np.linspace(0.0, 5.0, 501)
    for axes in (whole, part):
        axes.plot(time, np.sin(time) / 3.0, label="1.5 mm, no friction")
        axes.plot(time, 0.0 * time)
        axes.axvline(3.0, label="start")
        axes.set(xlabel="time [s]", ylabel="pin force\n[kN]")
    part.set_xlim(3.0, 5.0)
    letters([whole, part])
    notes, rows = saved(figure, tmp_path)
    assert notes == [f"# panel {one}: x = time [s]; y = pin force [kN]" for one in "ab"]
    names = {(row["panel"], row["curve"]) for row in rows}
    assert names == {(panel, curve) for panel in "ab" for curve in ("1.5 mm, no friction", "line 2")}
    first = [row for row in rows if row["panel"] == "a" and row["curve"] != "line 2"]
    assert [float(row["x"]) for row in first] == pytest.approx(time.tolist())
    assert [float(row["y"]) for row in first] == pytest.approx((np.sin(time) / 3.0).tolist(), rel=1e-6)
    second = [float(row["x"]) for row in rows if row["panel"] == "b"]
    assert (min(second), max(second)) == (3.0, 5.0)


def test_bars_and_points_have_names_and_the_ends_of_their_error_bars(tmp_path: Path) -> None:
    figure = Figure()
    upright, points, bare = figure.subplots(3, 1)
    upright.bar([0, 1], [3.0, 4.0], label="mean")
    upright.set_xticks([0, 1], ["rear base", "shield canopy"])
    points.errorbar([1.0, 2.0], [10.0, 20.0], xerr=0.5, yerr=[[1.0, 2.0], [3.0, 4.0]], fmt="o", label="found")
    bare.errorbar([1.0], [10.0], yerr=2.0, fmt="none")
    _, rows = saved(figure, tmp_path)
    a, b, c = ([row for row in rows if row["panel"] == letter] for letter in "abc")
    assert [(r["curve"], r["x_name"], r["y"]) for r in a] == [
        ("mean", "rear base", "3"), ("mean", "shield canopy", "4"),
    ]  # fmt: skip
    ends = ("x", "y", "x_low", "x_high", "y_low", "y_high")
    assert [" ".join(r[name] for name in ends) for r in b] == ["1 10 0.5 1.5 9 13", "2 20 1.5 2.5 18 24"]
    assert [(r["x"], r["y"], r["y_low"], r["y_high"]) for r in c] == [("1", "10", "8", "12")]
