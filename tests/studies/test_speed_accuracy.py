"""The study of speed against accuracy: one figure, with the numbers that it is drawn from."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from studies.benchmarking import benchmark, trade
from studies.benchmarking.trade import COMMON, ONCE, OURS_COMPILED, PROGRAMS, TradePoint
from studies.common.options import Options
from studies.speed_accuracy import run as speed_accuracy
from tests.at_once import at_once

HERE = [
    TradePoint(*COMMON, 0.5, 1.0, 1e-8),
    *(
        TradePoint(OURS_COMPILED + ONCE, label, 0.05, 0.1, 1e-5)
        for label in PROGRAMS[OURS_COMPILED + ONCE].settings
    ),
    *(TradePoint(trade.STOCK, label, 2.0, 4.0, 0.1) for label in PROGRAMS[trade.STOCK].settings),
]


def test_a_figure_and_its_numbers_are_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(trade, "measured", lambda: iter(HERE))
    chapter = speed_accuracy.study(Options(tmp_path, at_once()))
    assert [picture.stem for picture in chapter.pictures] == [benchmark.FIGURE]
    assert (tmp_path / f"{benchmark.FIGURE}.png").stat().st_size > 10_000
    said = " ".join([chapter.answer, *chapter.findings])
    assert "takes 50 ms compiled and shorter fixed steps than those that were tried by a script" in said
    sheet = chapter.sheets[0]
    assert len(sheet.rows) == len(HERE)
    numbers = json.loads((tmp_path / "summary.json").read_text("utf-8"))["numbers"]
    assert len(numbers) == 1 + len(sheet.rows)
    assert all(number["numerical_error"] > 0.0 for number in numbers)
