"""Several runs in one figure."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from support_exudyn import Result
from support_exudyn.files.series.read import read_series
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.overlay import difference, overlay
from tests import figure_checks, synthetic
from tests.cases.run_cases import loose_support
from user_forces.values.value import InputError

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
    assert axes.get_ylabel() == "length [mm]"
    assert drawing.get_suptitle() == "a and b, 0 to 2 s"


def test_a_difference_is_taken_where_both_have_records() -> None:
    drawing = difference({"a": run(0.1), "b": run(0.3, TIME[::2])}, ["tip.x"], until=1.0)
    (line,) = drawing.axes[0].lines
    shared = TIME[::2][TIME[::2] <= 1.0]
    assert line.get_xdata() == pytest.approx(shared)
    assert line.get_ydata() == pytest.approx(200.0 * np.sin(shared))
    assert drawing.get_suptitle() == "b less a, 0 to 1 s"


@pytest.mark.parametrize(
    ("title", "scale"), [("tip.x_mm", 1e-3), ("tip.x [mm]", 1e-3), ("tip.x_m", 1.0), ("tip.x [m]", 1.0)]
)
def test_curves_of_files_are_read_by_their_units(tmp_path: Path, title: str, scale: float) -> None:
    path = tmp_path / "a.csv"
    path.write_text(f"time_ms,{title}\n0,1\n500,2\n", encoding="utf-8")
    drawing = overlay({"a": run(0.1)}, ["tip.x"], curves={"b": read_series(path)})
    line = drawing.axes[0].lines[1]
    assert line.get_xdata() == pytest.approx([0.0, 0.5])
    assert line.get_ydata() == pytest.approx([1e3 * scale, 2e3 * scale])


def test_measured_points_are_markers_and_those_beyond_the_run_are_told(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text("time_s,tip.x_mm\n0,1\n1,2\n2.5,3\n3,3\n", encoding="utf-8")
    drawing = overlay({"a": run(0.1)}, ["tip.x"], curves={"b": read_series(path)})
    line = drawing.axes[0].lines[1]
    assert (line.get_marker(), line.get_linestyle()) == ("o", "None")
    said = " ".join(drawing.get_supxlabel().split())
    assert "2 points of b beyond the end of the run, 2 s, are not drawn" in said
    assert "Nothing is said of the errors of b" in said


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("time_s,pin_mm\n0,1\n1,2\n", "has a series of none of these channels; allowed: .*tip.x; it has pin"),
        ("time_s,tip.x\n0,1\n1,2\n", r"tip.x: its file gives no unit, and m is asked for; .*'tip.x \[m\]'"),
        ("time_s,tip.x_kN\n0,1\n1,2\n", "tip.x: is in kN, which cannot be given in m"),
        ("time_s,tip.x_mm\n5,1\n6,2\n", "its times, 5 to 6 s, have no number between 0 and 2 s"),
    ],
)
def test_each_fault_of_a_file_has_a_sentence_of_its_own(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "a.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=message):
        overlay({"a": run(0.1)}, ["tip.x"], curves={"b": read_series(path)})


def test_nothing_is_cut_off() -> None:
    with style.look():
        runs = {"a first run with a long name": run(0.1), "a second one": run(0.2)}
        figure_checks.check(overlay(runs, ["tip.x", "pin.rear_base.depth"]))
        figure_checks.check(difference(runs, ["tip.x"]))
