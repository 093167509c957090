"""The benchmark's arithmetic, its budget and its rows; what it measures is not asserted anywhere."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib import image

from studies import __main__ as all_studies
from studies.benchmarking import benchmark, command_rows, contest, rows, stopwatch
from studies.benchmarking.benchmark import Budget, contest_lines, contest_sheet, line_of, write
from studies.benchmarking.command_rows import COMMANDS, CommandRow, command_line, importing
from studies.benchmarking.contest import ENTRANTS, Found, Standing, cheapest_within
from studies.benchmarking.lines import BenchmarkLine, left_out, sheet
from studies.benchmarking.others import OTHERS
from studies.benchmarking.references import references
from studies.benchmarking.row import AUTO, LeftOutError, OurWay, Row, Setting, TimedTurn, tolerance
from studies.benchmarking.row_scenes import SCENES, ladder, restless
from studies.benchmarking.rows import ROWS, coarsest, there, timed_row
from studies.benchmarking.scenes import SCENES as WITH_REFERENCE
from studies.benchmarking.stopwatch import Heard
from studies.benchmarking.yardstick import YardstickError, compiled, run_yardstick
from studies.slider_crank.run import REFERENCE
from support_exudyn import Failure, SimulationError, simulate
from support_exudyn.files.toml.text import load_toml
from support_exudyn.simulation.result_checks import energy_open
from user_forces.contact_state import Onset

# --- lines ---


@pytest.mark.parametrize(("ours", "other", "ratio"), [(1.0, 8.0, "1/8"), (3.0, 2.0, "1.5"), (2.0, 2.0, "1/1")])
def test_a_ratio_says_who_is_faster(ours: float, other: float, ratio: str) -> None:
    line = BenchmarkLine("what", "how", ours, "against", other, "1/8")
    assert line.ratio == ratio
    assert ratio in str(sheet([line]).rows)
    assert line.is_missed is (ours > other / 8.0)
    assert BenchmarkLine("what", "how", ours, "against", other).is_missed is None


def test_a_time_is_asked_for_too() -> None:
    line = BenchmarkLine("what", "how", 2.0, asked="1.5 s")
    assert line.is_missed
    assert not replace(line, ours=1.0).is_missed
    # what was ended has missed what was passed by then; what it would have come to is not known
    assert replace(line, is_more=True).verdict == "missed"
    assert replace(line, is_more=True).cells()[2] == "> 2 s"
    assert replace(line, ours=1.0, is_more=True).is_missed is None
    assert left_out("what", "there is none", asked="1 s").verdict == "there is none"


# --- the budget, and what takes too long ---


def test_what_takes_less_leaves_the_rest_to_others(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = [0.0]
    monkeypatch.setattr(benchmark.time, "monotonic", lambda: clock[0])
    budget = Budget(100.0, 200.0)
    assert budget.share(50.0) == 25.0  # all are cut alike
    clock[0] = 10.0
    assert budget.share(50.0) == pytest.approx(30.0)  # of 90 s for what takes 150 s at most
    clock[0] = 50.0
    assert budget.share(20.0) == pytest.approx(10.0)
    clock[0] = 99.9
    assert budget.share(80.0) == 0.0


def counted(n: int, wait: float) -> Iterator[int]:
    yield from range(n)
    time.sleep(wait)


def failing(kind: str) -> Iterator[int]:
    yield 1
    if kind == "refused":
        raise SimulationError(Failure("energy does not add up", "Take a smaller step.", 0.1))
    if kind == "left out":
        raise LeftOutError("there is no C compiler")
    raise ZeroDivisionError("by nothing")


def test_measurements_are_made_by_a_process_that_can_be_ended() -> None:
    with stopwatch.stopwatch() as watch:
        assert watch.measure(counted, (3, 0.0), 60.0) == Heard([0, 1, 2], "")
        assert watch.measure(failing, ("refused",), 60.0) == Heard([1], "energy does not add up")
        assert watch.measure(failing, ("left out",), 60.0) == Heard([1], "there is no C compiler")
        assert watch.measure(failing, ("other",), 60.0) == Heard([1], "ZeroDivisionError: by nothing")
        # what came before it was ended is kept, and the next goes on
        assert watch.measure(counted, (2, 600.0), 5.0) == Heard([0, 1], "ended after 5 s")
        assert watch.measure(counted, (1, 0.0), 60.0) == Heard([0], "")


def test_short_runs_are_timed_again(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = [0.0]
    monkeypatch.setattr(stopwatch, "clock", lambda: clock[0])
    times = iter([0.04, 0.02, 0.05, 0.01])

    def run() -> None:
        clock[0] += next(times)

    assert stopwatch.fastest(run) == pytest.approx(0.02)  # the third passes what is enough


ROW = Row("what", OurWay("2 s", "compiled"), OurWay("8 s", "compiled"), "2")
BOTH = [TimedTurn(True, "fine", 2.0), TimedTurn(False, "8 s, fine", 1.0)]


def test_a_row_is_the_least_of_its_turns() -> None:
    said = [*BOTH, TimedTurn(True, "fine", 1.5), TimedTurn(False, "8 s, fine", 1.2), *BOTH]
    line = line_of(ROW, "8 s", Heard(said, ""), 5.0)
    assert (line.ours, line.other, line.how, line.against) == (1.5, 1.0, "fine", "8 s, fine")
    assert line.verdict == "met"
    assert line_of(ROW, "8 s", Heard(BOTH, ""), 5.0).verdict == "met; 1 of 3 turns"


def test_a_row_that_was_ended_says_more_than() -> None:
    ended = Heard([], "ended after 5 s")
    line = line_of(replace(ROW, against="", asked="3 s"), "", ended, 5.0)
    assert line.cells()[2] == "> 5 s"
    assert line.verdict == "missed; ended after 5 s"
    # where settings are tried first, nothing is known of the one that would have counted
    searched = replace(ROW, ours=OurWay("rise", "compiled", (tolerance(1e-3), tolerance(1e-4))), asked="3 s")
    assert math.isnan(line_of(searched, "", ended, 5.0).ours)
    half = line_of(ROW, "8 s", Heard(BOTH[:1], "ended after 5 s"), 5.0)
    assert (half.ratio, half.verdict) == ("", "ended after 5 s")


# --- rows ---


def test_rows_are_of_scenes_that_are_there() -> None:
    for row in ROWS:
        for way in (row.ours, row.against):
            if isinstance(way, OurWay):
                assert way.scene in SCENES
                assert way.settings
            else:
                assert not way or way in OTHERS
    assert any(map(there, ROWS))
    assert not there(Row("what", OurWay("rise", "of tomorrow")))  # is left out
    assert there(Row("what", OurWay("rise", AUTO)))


def test_the_coarsest_setting_meets_the_goal(monkeypatch: pytest.MonkeyPatch) -> None:
    loose, fine = tolerance(1e-2), tolerance(1e-8)
    drop = {"drop": lambda: WITH_REFERENCE["drop"].scenario}
    monkeypatch.setattr(rows, "SCENES", drop)
    assert coarsest("drop", "compiled", (loose, fine)) is fine
    with pytest.raises(LeftOutError, match="no setting"):
        coarsest("drop", "compiled", (loose, loose))


def test_a_row_is_timed_in_turns(monkeypatch: pytest.MonkeyPatch) -> None:
    ran: list[str] = []

    def run(scenario: Any) -> None:
        ran.append(f"{scenario.duration:g}")

    monkeypatch.setattr(rows, "simulate", run)
    monkeypatch.setattr(stopwatch, "MOST_REPEATS", 1)
    found = list(timed_row(ROW, 60.0))
    assert [one.is_ours for one in found] == [True, False] * 3
    assert found[1].label == "8 s"
    moment = "0.01"  # of every side first, so that nothing is compiled in what is timed
    assert ran == [moment, moment, *["2", "8"] * 3]
    ran.clear()
    assert len(list(timed_row(ROW, 0.0))) == 2  # once, however little time there is


def test_the_pin_that_bounces_all_the_time_keeps_its_energy() -> None:
    result = simulate(replace(restless(1.5), formulation="exudyn"))
    open_by, allowed = energy_open(result.scenario, result.channels)
    # measured: 0.4 J of 17 J; 17 J are open after 1.5 s with steps of 2 ms
    assert open_by.max() < 0.1 * allowed


@pytest.mark.parametrize("bars", [4, 6, 12])
def test_a_ladder_has_so_many_bars_and_moves_in_one_way(bars: int) -> None:
    linkage = ladder(bars).machine.linkage()
    moving = len(linkage.bodies)
    assert moving == bars - 1  # one is the ground
    assert 3 * moving - 2 * len(linkage.pins) == 1


def test_resting_joints_do_not_part() -> None:
    result = simulate(replace(SCENES["1 joint"](), duration=0.01))
    assert result.onsets["C1"] == ()
    assert result["pin.C1.force"].min() > 0.0


# --- commands ---


def test_commands_are_timed_from_start_to_end(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(command_rows, "TURNS", 1)
    line = command_line(CommandRow("version", ("--version",), "100 s", 60.0), tmp_path, 60.0)
    assert 0.0 < line.ours < 60.0
    assert line.verdict.startswith("met")
    failed = command_line(CommandRow("none", ("show", "none.h5"), "1 s", 60.0), tmp_path, 60.0)
    assert math.isnan(failed.ours)
    assert "none.h5" in failed.verdict
    ended = command_line(CommandRow("version", ("--version",), "0.01 s", 60.0), tmp_path, 0.005)
    assert ended.is_more
    assert "beyond" in importing(60.0).what


def test_memory_is_that_of_the_run_alone() -> None:
    line = command_rows.memory_line("compiled", 100.0)
    assert line.unit == "MB"
    assert line.note or line.is_missed is False  # measured: 1.00; some systems do not tell


# --- the contest ---


def standing(program: str, setting: str, seconds: float, slider: float) -> Standing:
    return Standing(program, setting, seconds, slider, 1e-3 * slider, slider)


FOUND = [
    standing("ours, compiled", "fine", 0.01, 1e-7),
    standing("ours, exudyn", "fine", 0.5, 1e-7),
    standing("scipy's LSODA", "coarse", 0.01, 1e-5),
    standing("scipy's LSODA", "fine", 0.04, 1e-7),
    standing("MuJoCo, limit of a tendon", "fine", 0.2, 1e-4),
]


def test_programs_are_compared_by_what_an_error_costs() -> None:
    assert cheapest_within(FOUND[2:4], 1e-6) is FOUND[3]
    assert cheapest_within(FOUND[4:], 1e-6) is None
    lsoda, mujoco = contest_lines(FOUND)
    assert (lsoda.how, lsoda.against, lsoda.ratio) == ("compiled, fine", "scipy's LSODA, fine", "1/4")
    assert (mujoco.ratio, mujoco.verdict) == ("", "no setting of theirs is as right")


def test_errors_are_the_largest_of_slider_and_impacts() -> None:
    exact = references()["slider-crank"].path[0]
    onsets = [Onset(1e-6 * t, v) for t, v in REFERENCE]
    onsets[3] = Onset(onsets[3].time + 2e-8, onsets[3].speed * 1.001)
    found = Found(np.repeat(exact, 1) + 3e-6, onsets)
    assert contest.errors(found, exact) == pytest.approx((3e-6, 2e-8, 1e-3))
    assert contest.errors(Found(exact, onsets[:4]), exact)[1:] == (math.inf, math.inf)


def test_what_is_not_installed_is_left_out_with_a_word() -> None:
    entrant = replace(ENTRANTS["Drake, force in a system"], package="no_such_package_at_all")
    assert entrant.missing == "no_such_package_at_all is not installed"
    assert ENTRANTS["scipy's LSODA"].missing == ""
    assert replace(ENTRANTS["ours, compiled"], package="of tomorrow").missing == "there is no such formulation"


@pytest.mark.parametrize("name", ["ours, compiled", "ours, exudyn", "Exudyn, hollow spheres, DOPRI5"])
def test_an_entrant_has_time_and_errors(name: str) -> None:
    entrant = ENTRANTS[name]
    scenario, exact = WITH_REFERENCE["slider-crank"].scenario, references()["slider-crank"].path[0]
    coarse = {"ours, exudyn": entrant.settings[0]}.get(name, entrant.settings[2])
    found = contest.standing(entrant, coarse, scenario, exact)
    assert found.seconds > 0.0
    assert found.slider < 1e-4  # measured: 3e-5, 1.2e-5 and 2e-7
    assert found.times < 1e-6


def test_tables_and_figure_are_written(tmp_path: Path) -> None:
    lines = [BenchmarkLine("what", "how", 1.0, "against", 2.0, "1")]
    write(tmp_path, lines, FOUND, ["Drake: left out, pydrake is not installed."], 12.0)
    text = (tmp_path / "RESULTS.md").read_text("utf-8")
    assert "| what | how | 1 s | against | 2 s | 1/2 | 1 | met |" in text
    assert "Drake: left out, pydrake is not installed." in text
    assert "| scipy's LSODA | fine | 0.04 | 1.0e-07 | 1.0e-04 | 1.0e-05 |" in text
    assert image.imread(tmp_path / "work_precision.png").shape[0] > 100
    assert len(contest_sheet(FOUND).rows) == 5
    write(tmp_path, [], [], [], 1.0)  # nothing could be measured


# --- the command ---


def test_the_command_stands_beside_the_studies(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    done: list[Path] = []
    monkeypatch.setattr(benchmark, "study", done.append)
    assert all_studies.main(["benchmark", "--out", str(tmp_path)]) == 0
    assert done == [tmp_path]
    assert all_studies.main(["--list"]) == 0
    assert "benchmark" in capsys.readouterr().out


def test_with_no_time_every_line_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(benchmark, "BUDGET", 0.0)
    monkeypatch.setattr(command_rows, "PREPARING", 0.1)
    benchmark.study(tmp_path)
    text = (tmp_path / "RESULTS.md").read_text("utf-8")
    assert text.count(benchmark.NO_TIME) >= len(list(filter(there, ROWS)))
    assert "LSODA: left out, no time was left." in text


def test_the_yardstick_integrates_the_same_machine() -> None:
    try:
        with compiled() as program:
            found = run_yardstick(WITH_REFERENCE["rise"].scenario, 1e-9, program=program, runs=1)
    except YardstickError as error:
        pytest.skip(str(error))  # no C compiler
    assert found.mean == pytest.approx(51503.83074, rel=1e-8)  # of `references.json`, at this tolerance
    assert found.onsets[2].speed == pytest.approx(0.07207928559623947, rel=1e-6)


def test_a_setting_is_put_into_a_scenario() -> None:
    fine = Setting("fine", {"step": 1e-4}, {"impact_steps": 99})
    made = fine.applied(SCENES["rise"](), "exudyn")
    assert (made.formulation, made.step, made.solver.impact_steps) == ("exudyn", 1e-4, 99)


def test_a_line_that_misses_has_its_reason() -> None:
    reasons = load_toml(benchmark.MISSES)
    missed = BenchmarkLine(next(iter(reasons)), "", 2.0, asked="1 s")
    met = BenchmarkLine(missed.what, "", 0.5, asked="1 s")
    assert benchmark.misses([met]) == []
    assert benchmark.misses([missed, met])[1] == f"- {missed.what}: {reasons[missed.what]}"
    known = {row.what for row in (*ROWS, *COMMANDS)}
    assert set(reasons) <= known
