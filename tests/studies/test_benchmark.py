"""The benchmark's arithmetic; what it measures is not asserted anywhere."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest

from studies.benchmarking import benchmark, process
from studies.benchmarking.benchmark import (
    BenchmarkLine,
    cheapest_way,
    in_turns,
    long_lines,
    restless,
    sheet,
    whole,
)
from studies.benchmarking.scenes import SCENES
from studies.benchmarking.variants import Way, with_tolerance
from studies.benchmarking.yardstick import YardstickError, compiled, run_yardstick
from support_exudyn import Failure, Scenario, SimulationError, simulate
from support_exudyn.simulation.result_checks import energy_open


@pytest.mark.parametrize(("ours", "other", "ratio"), [(1.0, 8.0, "1/8"), (3.0, 2.0, "1.5"), (2.0, 2.0, "1/1")])
def test_a_ratio_says_who_is_faster(ours: float, other: float, ratio: str) -> None:
    line = BenchmarkLine("what", "how", ours, "against", other, "1/8")
    assert line.ratio == ratio
    assert ratio in str(sheet([line]).rows)
    assert line.is_missed is (ours > other / 8.0)
    assert not BenchmarkLine("what", "how", ours, "against", other, "").is_missed


def test_ways_are_timed_in_turns_and_the_fastest_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    order: list[str] = []
    clock = [0.0]
    monkeypatch.setattr(process.time, "perf_counter", lambda: clock[0])

    def job(name: str, seconds: Iterator[float]) -> Callable[[], None]:
        def run() -> None:
            order.append(name)
            clock[0] += next(seconds)

        return run

    found = in_turns(job("one", iter([8.0, 2.0, 4.0])), job("other", iter([1.0, 1.0, 0.5])), turns=3)
    assert order == ["one", "other"] * 3
    assert found == [2.0, 0.5]


def test_the_cheapest_way_meets_the_goal() -> None:
    scene = SCENES["drop"]
    tried = [with_tolerance(scene, "compiled", t) for t in (1e-2, 1e-8)]
    way = cheapest_way("drop", tried)
    assert way is tried[1]
    assert cheapest_way("drop", tried[:1]) is None


def refuse(*unused: object) -> None:
    raise SimulationError(Failure("energy does not add up", "Take a smaller step.", 0.1))


def test_a_way_that_cannot_be_finished_is_not_the_cheapest() -> None:
    fine = with_tolerance(SCENES["drop"], "compiled", 1e-8)
    broken = Way("compiled", "too coarse", refuse, refuse)  # type: ignore[arg-type]
    assert cheapest_way("drop", [broken, fine]) is fine


def test_a_run_that_is_refused_is_a_row_and_not_the_end(monkeypatch: pytest.MonkeyPatch) -> None:
    def run(scenario: Scenario) -> None:
        if scenario.formulation == "redundant":
            refuse()

    monkeypatch.setattr(benchmark, "simulate", run)
    lines = list(long_lines())
    assert [line.what for line in lines] == ["four times the time: redundant", "four times the time: reduced"]
    assert lines[0].ratio == "refused"
    assert not lines[0].is_missed
    assert not lines[1].refused
    assert "refused: energy does not add up" in str(sheet(lines).rows)


def test_what_ends_a_part_of_the_table_is_its_last_row() -> None:
    def part() -> Iterator[BenchmarkLine]:
        """A part."""
        yield BenchmarkLine("what", "how", 1.0, "against", 2.0, "")
        refuse()

    first, last = whole(part)
    assert not first.refused
    assert last.what == "A part."
    assert last.refused == "refused: energy does not add up"


def test_the_pin_that_bounces_all_the_time_keeps_its_energy() -> None:
    result = simulate(restless("redundant", 1.5))
    open_by, allowed = energy_open(result.scenario, result.channels)
    # measured: 0.4 J of 17 J; 17 J are open after 1.5 s with steps of 2 ms
    assert open_by.max() < 0.1 * allowed


def test_the_yardstick_integrates_the_same_machine() -> None:
    try:
        with compiled() as program:
            found = run_yardstick(SCENES["rise"].scenario, 1e-9, program=program, runs=1)
    except YardstickError as error:
        pytest.skip(str(error))  # no C compiler
    assert found.mean == pytest.approx(51503.83074, rel=1e-8)  # of `references.json`, at this tolerance
    assert found.onsets[2].speed == pytest.approx(0.07207928559623947, rel=1e-6)


def test_importing_is_timed_in_a_process_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(process, "IMPORTS", 1)
    assert "beyond exudyn's import" in process.importing()
