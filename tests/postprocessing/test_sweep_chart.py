"""What the figure of a sweep joins, and in which unit."""

from __future__ import annotations

import pyarrow as pa
import pytest

from support_exudyn.postprocessing.figures.sweeps import sweep_chart
from support_exudyn.postprocessing.sweep_runs import SweepRuns, as_latex, as_markdown

SIZES = [1.0, 2.0, 3.0]


def table(friction: list[float], tip: list[float]) -> pa.Table:
    """Of a sweep over two fields, with one number in metres."""
    varied = {b"meaning": b"varied"}
    fields = [
        pa.field("run", pa.string()),
        pa.field("pins.hinge.clearance_mm", pa.float64(), metadata=varied),
        pa.field("pins.hinge.friction", pa.float64(), metadata=varied),
        pa.field("status", pa.string()),
        pa.field("wall_time_s", pa.float64()),
        pa.field("tip.x.mean_m", pa.float64(), metadata={b"unit": b"m"}),
    ]
    columns = [["a", "b", "c"], SIZES, friction, ["done"] * 3, SIZES, tip]
    return pa.table([pa.array(one) for one in columns], schema=pa.schema(fields))


@pytest.mark.parametrize(("friction", "style"), [([0.1, 0.1, 0.1], "-"), ([0.1, 0.3, 0.2], "None")])
def test_only_runs_that_differ_in_nothing_else_are_joined(friction: list[float], style: str) -> None:
    drawing = sweep_chart(table(friction, [4.1, 4.2, 4.3]), "pins.hinge.clearance_mm", "tip.x.mean")
    line = drawing.axes[0].containers[0][0]
    assert line.get_linestyle() == style


def test_runs_are_a_table_for_a_text_in_units_that_are_read_best() -> None:
    runs = SweepRuns(table([0.1, 0.3, 0.2], [4.1, 4.2, 4.3]))
    columns = [*runs.numbers.values()]
    head, _, first, *_ = as_markdown(runs, columns).splitlines()
    assert head == "| run | pins.hinge.clearance [mm] | pins.hinge.friction | tip.x.mean [mm] |"
    assert first == "| a | 1 | 0.1 | 4100 |"
    assert r"a & 1 & 0.1 & 4100 \\" in as_latex(runs, columns)
