"""What the figure of a sweep joins, and in which unit."""

from __future__ import annotations

from pathlib import Path

import pyarrow as pa
import pytest

from support_exudyn.__main__ import main
from support_exudyn.postprocessing.figures.sweep_chart import sweep_chart

SIZES = [1.0, 2.0, 3.0]


def table(friction: list[float], tip: list[float]) -> pa.Table:
    """Of a sweep over two fields, with one number in metres."""
    varied = {b"meaning": b"varied"}
    fields = [
        pa.field("pins.hinge.clearance_mm", pa.float64(), metadata=varied),
        pa.field("pins.hinge.friction", pa.float64(), metadata=varied),
        pa.field("status", pa.string()),
        pa.field("wall_time_s", pa.float64()),
        pa.field("tip.x.mean_m", pa.float64(), metadata={b"unit": b"m"}),
    ]
    columns = [SIZES, friction, ["done"] * 3, SIZES, tip]
    return pa.table([pa.array(one) for one in columns], schema=pa.schema(fields))


@pytest.mark.parametrize(("friction", "style"), [([0.1, 0.1, 0.1], "-"), ([0.1, 0.3, 0.2], "None")])
def test_only_runs_that_differ_in_nothing_else_are_joined(friction: list[float], style: str) -> None:
    drawing = sweep_chart(table(friction, [4.1, 4.2, 4.3]), "pins.hinge.clearance_mm", "tip.x.mean")
    line = drawing.axes[0].containers[0][0]
    assert line.get_linestyle() == style


@pytest.mark.parametrize(
    ("tip", "unit", "first"),
    [([4.145, 4.144, 4.142], "mm", 4145.0), ([4.1, 3.1, 2.1], "mm", 4100.0)],
)
def test_millimetres_in_metres_are_shown_in_millimetres(tip: list[float], unit: str, first: float) -> None:
    drawing = sweep_chart(table([0.1, 0.1, 0.1], tip), "pins.hinge.clearance_mm", "tip.x.mean")
    axes = drawing.axes[0]
    assert axes.get_ylabel() == f"tip.x.mean [{unit}]"
    line = axes.containers[0][0]
    # one product of floats away
    assert line.get_ydata()[0] == pytest.approx(first, rel=1e-15)


def test_the_only_number_needs_no_name_and_one_input_no_tornado(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    found = table([0.1, 0.1, 0.1], [4.145, 4.144, 4.142])
    for name, cells in (("reason", [""] * 3), ("run", ["a", "b", "c"])):
        found = found.add_column(2, name, pa.array(cells))
    monkeypatch.setattr("support_exudyn.sweeps.table.read_table", lambda path: found)
    assert main(["chart", str(tmp_path)]) == 0
    assert "tip.x.mean_over_pins.hinge.clearance_mm.png" in capsys.readouterr().out
    assert main(["show", str(tmp_path)]) == 0
    said = capsys.readouterr().out
    assert "remark" in said
    assert "words" not in said
    assert "--tornado" in said  # two inputs
    one = found.drop_columns(["pins.hinge.friction"])
    monkeypatch.setattr("support_exudyn.sweeps.table.read_table", lambda path: one)
    assert main(["show", str(tmp_path)]) == 0
    assert "--tornado" not in capsys.readouterr().out
