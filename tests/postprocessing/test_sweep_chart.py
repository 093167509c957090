"""What the figure of a sweep joins, and in which unit."""

from __future__ import annotations

import pyarrow as pa
import pytest

from support_exudyn.postprocessing.figures.sweeps import sweep_chart

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
