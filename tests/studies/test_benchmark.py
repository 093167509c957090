"""The benchmark's arithmetic, its rows and what it writes; what it measures is not asserted."""

from __future__ import annotations

from pathlib import Path

import pytest
from matplotlib import image

from studies.benchmarking import benchmark, trade
from studies.benchmarking.benchmark import Row, beside
from studies.benchmarking.trade import COMMON, TradePoint, cheapest


def point(program: str, error: float, seconds: float = 1.0, setting: str = "") -> TradePoint:
    return TradePoint(program, setting or f"{error:g}", seconds, 10.0 * seconds, error)


HERE = [point(*COMMON[:1], 1e-8, 0.5, COMMON[1]), point("MuJoCo", 2e-4, 9.0, "step 0.02 ms")]


# --- what accuracy costs ---


def test_errors_are_distances_from_a_tight_run() -> None:
    exact = trade.exact_force()
    assert exact.value == pytest.approx(444589.8641, rel=2e-8)
    assert exact.error < 1e-8 * exact.value  # measured: 1e-10


@pytest.mark.parametrize(
    ("errors", "best"),
    [((1e-2, 1e-4, 1e-5), 1e-4), ((1e-4, 1e-2, 1e-5), 1e-5), ((1e-4, 1e-5, 1e-2), None), ((), None)],
)
def test_the_cheapest_setting_is_good_and_all_finer_ones_too(
    errors: tuple[float, ...], best: float | None
) -> None:
    found = cheapest([point("MuJoCo", error) for error in errors], "MuJoCo")
    assert (found.error if found else None) == best


# --- rows ---


def test_a_ratio_is_the_median_of_its_turns(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(benchmark, "TURNS", 3)
    ours, other = iter([9.0, 1.0, 8.0, 3.0]), iter([9.0, 2.0, 2.0, 2.0])
    row = beside("name", "work", "ours", lambda: next(ours), "other", lambda: next(other))
    assert (row.seconds, row.other, row.ratio) == (3.0, 2.0, 1.5)  # the first turn compiles
    assert row.cells()[3:] == ("3 s", "other", "2 s", "1.5", "")
    assert Row("name", "work", "ours", 1.0, "other", 8.0, 0.125).cells()[6] == "1/8"
    assert Row("name", "work", "ours", None, note="no C compiler").cells()[3:] == (
        "",
        "",
        "",
        "",
        "no C compiler",
    )


@pytest.mark.parametrize(("other", "verdict"), [(1.0, "met"), (0.5, "missed")])
def test_the_user_function_has_a_ratio_that_is_asked_for(
    other: float, verdict: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    times = {"function": 1.0, "joint": 1.0, "built_in": other}
    ran: list[str] = []

    def run(scenario: object, step: float, contact: str) -> tuple[float, None]:
        ran.append(contact)
        return times[contact], None

    monkeypatch.setattr(benchmark, "run_connector", run)
    assert benchmark.connector("function").note == f"asked at most 1.25: {verdict}"
    assert ran[:4] == ["function", "built_in"] * 2
    assert benchmark.connector("joint").note == ""


# --- the command ---


def test_tables_and_figure_are_written(tmp_path: Path) -> None:
    benchmark.write(tmp_path, [Row("what", "work", "how", 1.0, "against", 2.0, 0.5)], HERE, 12.0)
    text = (tmp_path / "RESULTS.md").read_text("utf-8")
    assert "| what | work | how | 1 s | against | 2 s | 1/2 |" in text
    assert "| MuJoCo | step 0.02 ms | 9 | 90 | 2.0e-04 |" in text
    assert image.imread(tmp_path / f"{benchmark.FIGURE}.png").shape[0] > 100
