"""The benchmark's arithmetic, its rows and what it writes; what it measures is not asserted."""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace

import pytest
from matplotlib import image

from studies import __main__ as all_studies
from studies.benchmarking import benchmark, rows, trade
from studies.benchmarking.rows import Row, beside, of_points
from studies.benchmarking.trade import COMMON, ONCE, OURS_COMPILED, PROGRAMS, TradePoint, cheapest, with_kept


def point(program: str, error: float, seconds: float = 1.0, setting: str = "") -> TradePoint:
    return TradePoint(program, setting or f"{error:g}", seconds, 10.0 * seconds, error)


HERE = [point(*COMMON[:1], 1e-8, 0.5, COMMON[1]), point("MuJoCo", 2e-4, 9.0, "step 0.02 ms")]


# --- what accuracy costs ---


def test_what_is_not_measured_is_taken_as_a_ratio_to_the_common_row() -> None:
    points = {(one.program, one.setting): one for one in with_kept(HERE)}
    assert points[COMMON] == HERE[0]
    assert points["MuJoCo", "step 0.02 ms"] == HERE[1]
    kept = json.loads(trade.KEPT.read_text("utf-8"))
    ratio, error = kept["points"]["Drake"]["accuracy 1e-05"]
    assert points["Drake", "accuracy 1e-05"] == TradePoint(
        "Drake", "accuracy 1e-05", 0.5 * ratio, ratio, error, True
    )
    # every setting of every program is there, so that a figure has all lines
    assert set(points) == {(name, label) for name, one in PROGRAMS.items() for label in one.settings}


def test_the_caption_names_what_was_kept_with_its_machine_date_and_versions() -> None:
    kept = json.loads(trade.KEPT.read_text("utf-8"))
    said = trade.caption(with_kept(HERE))
    for word in (kept["date"], kept["machine"], f"MuJoCo {kept['versions']['mujoco']}", "Drake"):
        assert word in said
    assert "Not measured here" not in trade.caption(HERE)


def test_errors_are_distances_from_a_tight_run() -> None:
    exact = trade.exact_force()
    assert exact.value == pytest.approx(444589.8641, rel=2e-8)  # errors in kept.json are distances from it
    assert exact.error < 1e-8 * exact.value  # measured: 1e-10


def test_programs_that_are_not_installed_are_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    absent = {"none": trade.PeerProgram("none", {"x": 1.0}, lambda scenario, x: x, "no_such_package")}
    monkeypatch.setattr(trade, "PROGRAMS", {**PROGRAMS, **absent})
    assert list(trade.measured(["none"])) == []


def test_a_program_is_measured_beside_the_common_row() -> None:
    found = list(trade.measured([OURS_COMPILED + ONCE]))
    assert [one.setting for one in found] == list(PROGRAMS[OURS_COMPILED + ONCE].settings)
    for one in found:
        assert 0.0 < one.ratio < 1.0  # a run to an accuracy makes at least three
    assert found[-1].error < 1e-4  # measured: 8e-6 at a tolerance of 1e-6


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
    monkeypatch.setattr(rows, "TURNS", 3)
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


def test_rows_against_others_come_from_the_points() -> None:
    found = list(of_points([*HERE, point(OURS_COMPILED + ONCE, 1e-5, 0.1)]))
    assert [row.name for row in found][:2] == ["accuracy", "Exudyn, stock recipe"]
    (mujoco,) = (row for row in found if row.name == "MuJoCo")
    assert mujoco.ratio == pytest.approx(1.0 / 90.0)
    assert next(row for row in found if row.name == "Drake").note == "no setting of theirs is as close"


@pytest.mark.parametrize(("other", "verdict"), [(1.0, "met"), (0.5, "missed")])
def test_the_user_function_has_a_ratio_that_is_asked_for(
    other: float, verdict: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    times = {"function": 1.0, "joint": 1.0, "built_in": other}
    ran: list[str] = []

    def run(scenario: object, step: float, contact: str, sensors: bool) -> SimpleNamespace:
        ran.append(contact)
        return SimpleNamespace(solve_time=times[contact])

    monkeypatch.setattr(rows, "run_built_in", run)
    assert rows.connector("function").note == f"asked at most 1.25: {verdict}"
    assert ran[:4] == ["function", "built_in"] * 2
    assert rows.connector("joint").note == ""


# --- the command ---


def test_tables_and_figure_are_written(tmp_path: Path) -> None:
    benchmark.write(tmp_path, [Row("what", "work", "how", 1.0, "against", 2.0, 0.5)], with_kept(HERE), 12.0)
    text = (tmp_path / "RESULTS.md").read_text("utf-8")
    assert "| what | work | how | 1 s | against | 2 s | 1/2 |" in text
    assert "| MuJoCo | step 0.02 ms | 9 | 90 | 2.0e-04 | here |" in text
    assert image.imread(tmp_path / f"{benchmark.FIGURE}.png").shape[0] > 100


def test_the_command_stands_beside_the_studies(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    done: list[Path] = []
    monkeypatch.setattr(benchmark, "study", done.append)
    assert all_studies.main(["benchmark", "--out", str(tmp_path)]) == 0
    assert done == [tmp_path]
    assert all_studies.main(["--list"]) == 0
    assert "benchmark" in capsys.readouterr().out
