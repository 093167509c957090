"""Coverage: what is drawn, how a number is judged, what is told of all, and that a planted fault is found."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from studies.benchmarking import coverage, covered
from studies.benchmarking.coverage import ALL, Chosen, offender_sheet, run_scenes, share
from studies.benchmarking.covered import CoveredRun, Judged, Reference, judge
from studies.benchmarking.fresh_scenes import LINKAGES, MACHINES, RECORDS, Fresh, fresh
from studies.extremes.runs import HangError
from support_exudyn import Estimate, Failure, Result, Scenario, SimulationError, SolverSettings, simulate
from support_exudyn.sweeps.workers import Workers
from tests.at_once import AtOnce

FORCE = "pin.rear_base.force.mean"
CRANK = fresh(19, 8, "slider-crank")  # an eighth of a turn, without friction


# --- what is drawn ---


def test_a_seed_and_a_number_tell_the_scene() -> None:
    for number in range(4 * len(MACHINES)):
        assert fresh(5, number) == fresh(5, number)
    scenes = [fresh(seed, number).scenario for seed in (5, 6) for number in range(4 * len(MACHINES))]
    assert all(one != other for n, one in enumerate(scenes) for other in scenes[:n])


def test_kinds_follow_each_other_and_are_what_they_say() -> None:
    found = [fresh(7, number) for number in range(8 * len(MACHINES))]
    assert [one.kind for one in found[::2]] == 4 * list(MACHINES)
    assert {one.kind for one in found[1::2]} == set(LINKAGES)
    kinds = {kind: [one.scenario for one in found if one.kind == kind] for kind in MACHINES | LINKAGES}
    assert all(set(one.clearance_pins) == {"rear_base"} for one in kinds["rear pin"])
    assert len({name for one in kinds["any pin"] for name in one.clearance_pins}) > 1
    assert all(len(one.clearance_pins) > 1 for one in kinds["several pins"])
    assert all(set(one.legs) == {"front_column", "rear_column"} for one in kinds["oil columns"])
    assert all(set(one.cylinders) == {"front_column", "rear_column"} for one in kinds["cylinders"])
    assert all(all(leg.elements for leg in one.legs.values()) for one in kinds["hydraulic legs"])
    assert all(set(one.loads) == {"rock"} for one in kinds["falling block"])
    assert all(set(one.own_bodies) == {"tail_beam"} for one in kinds["tail beam"])
    assert all(one.linkage.cranks for one in kinds["slider-crank"])
    assert all(one.dimensions == 3 for one in kinds["space"])
    assert {len(one.linkage.bodies) for one in kinds["drawn chain"]} == {3, 5, 7}
    assert all(set(one.guides) == {"guide"} for one in kinds["drawn guide"])
    assert all(len(one.clearance_pins) == 4 for one in kinds["loose parallelogram"])
    # none asks for an accuracy by itself; machines have as many records as they need, linkages far too few
    for one in found:
        assert one.scenario.goal is None
        count = one.scenario.duration / one.scenario.record_period
        assert count < 13 if one.kind in LINKAGES else count == pytest.approx(RECORDS)


def test_all_that_matters_varies() -> None:
    scenes = [fresh(9, number).scenario for number in range(0, 16 * len(MACHINES), 2)]
    pins = [pin for one in scenes for pin in one.clearance_pins.values()]
    assert len({type(pin.contact.normal) for pin in pins}) > 5
    assert len({pin.contact.normal.rest_velocity for pin in pins}) >= 2  # type: ignore[attr-defined]
    assert len({type(pin.contact.friction) for pin in pins}) == 6
    assert {pin.bore for pin in pins} == {"first", "second"}
    assert {pin.offset == (0.0, 0.0) for pin in pins} == {True, False}
    assert {one.start for one in scenes} == {"concentric", "settled"}
    assert len({type(one.drive) for one in scenes}) == 5
    assert {one.formulation for one in scenes} == {"auto", "exudyn"}


# --- how a number is judged ---


def known(formulation: str, value: float, error: float) -> Reference:
    """A reference of one number, whose own error is as told."""
    away = error / covered.OF_DISTANCE
    return Reference(formulation, {FORCE: value}, {FORCE: value + away}, {FORCE: value + 5.0 * away}, 0.25)


def judged(claimed: float, *references: Reference) -> Judged:
    """A value of 100 of the compiled formulation."""
    return judge(FORCE, 100.0, claimed, "compiled", references)


def test_another_formulation_judges_where_it_is_sharp_enough() -> None:
    own, other = known("compiled", 100.5, 1e-6), known("exudyn", 100.4, 0.09)
    found = judged(1.0, own, other)
    assert (found.by, found.apart) == ("exudyn", False)
    assert found.away == pytest.approx(0.4)
    assert found.ratio == pytest.approx(0.4)
    # with a smaller error claimed it no longer can
    assert judged(0.39, own, other).by == "compiled"


def test_what_no_reference_can_tell_is_set_apart() -> None:
    found = judged(0.01, known("compiled", 100.0, 0.005), known("exudyn", 100.01, 0.1))
    assert found.apart
    assert judge(FORCE, 100.0, 1.0, "compiled", ()).apart
    assert judged(1.0, known("compiled", math.nan, 0.0)).apart


def test_a_blunt_reference_that_is_surely_further_away_counts() -> None:
    own, other = known("compiled", 100.0, 1e-9), known("exudyn", 105.0, 0.4)
    found = judged(0.01, own, other)
    assert (found.by, found.apart) == ("exudyn", False)
    assert found.ratio == pytest.approx(500.0)


def test_a_reference_that_agrees_by_chance_is_as_wrong_as_its_family() -> None:
    names = [f"pin.p{n}.force.mean" for n in range(5)]
    fine = dict.fromkeys(names, 100.0)
    coarse = dict(zip(names, (100.0, 101.0, 101.0, 102.0, 103.0), strict=True))
    reference = Reference("compiled", fine, coarse, coarse, 0.25)
    assert reference.error(names[0]) == pytest.approx(covered.OF_DISTANCE)
    assert reference.error(names[4]) == pytest.approx(3.0 * covered.OF_DISTANCE)


def test_what_judges_a_largest_value_judges_its_time() -> None:
    value, at = "pin.A.force.largest", "pin.A.force.largest_time"
    blunt = {value: 100.05, at: 0.003}  # another peak is the largest of this reference
    sharp = {value: 100.0 + 1e-8, at: 0.03 + 1e-9}
    references = [
        Reference("exudyn", blunt, {value: 100.09, at: 0.003}, {value: 100.2, at: 0.003}, 0.25),
        Reference("compiled", sharp, {value: 100.0, at: 0.03}, {value: 100.0, at: 0.03}, 0.25),
    ]
    numbers = {value: Estimate(100.0, 1e-4, "N"), at: Estimate(0.03, 1e-5, "s")}
    run: Any = SimpleNamespace(numbers=lambda: numbers, scenario=SimpleNamespace(formulation="compiled"))
    assert [(one.by, one.ratio <= 1.0) for one in covered.judged(run, references)] == [("compiled", True)] * 2


def three(fine: float, coarse: float, coarsest: float) -> Reference:
    """Of the engine, by steps of a length, twice and four times that."""
    return Reference("exudyn", {FORCE: fine}, {FORCE: coarse}, {FORCE: coarsest}, 0.25)


def test_the_last_distance_is_not_believed_below_what_the_one_before_makes_it() -> None:
    assert three(105.0, 106.0, 110.0).error(FORCE) == pytest.approx(covered.OF_DISTANCE, rel=1e-4)
    assert three(105.0, 105.5, 109.5).error(FORCE) == pytest.approx(covered.OF_DISTANCE, rel=1e-4)
    # two agree by chance: they are as wrong as the third is away
    assert three(105.0, 105.1, 109.1).error(FORCE) == pytest.approx(4.0 * covered.OF_DISTANCE, rel=1e-4)


@pytest.mark.parametrize(("coarse", "coarsest"), [(105.001, 105.3), (105.3, 105.301), (105.3, 104.9)])
def test_a_number_of_a_reference_that_does_not_converge_tells_of_no_other_unless_sharp(
    coarse: float, coarsest: float
) -> None:
    irregular = three(105.0, coarse, coarsest)
    assert not irregular.converges(FORCE)  # too near by chance; further than before; the other way
    assert judged(0.1, known("compiled", 100.0, 1e-9), irregular).by == "compiled"
    assert judged(4.0, known("compiled", 100.0, 1e-9), irregular).by == "exudyn"


def test_a_number_near_zero_is_known_as_well_as_the_values_that_it_is_of() -> None:
    names = ["rear_column.force.mean", "rear_column.force.std"]
    runs = [dict(zip(names, (1e5, spread), strict=True)) for spread in (2.1e-6, 2.9e-6, 4e-6)]
    reference = Reference("exudyn", *runs, 0.25)
    assert reference.error(names[1]) >= covered.NEWTON * 1e5


def test_what_three_runs_agree_in_but_for_rounding_converges() -> None:
    assert three(105.0, 105.0, 105.0).converges(FORCE)
    assert judged(0.1, three(105.0, 105.0, 105.0)).by == "exudyn"


# --- what is told of all ---


def row(*numbers: tuple[float, float], **changes: object) -> CoveredRun:
    """A run whose numbers have these claimed and true errors."""
    found = tuple(Judged(FORCE, 1.0, claimed, true, 0.0, "compiled") for claimed, true in numbers)
    return replace(CoveredRun("rear pin", 0, "draft", "compiled", "", True, found), **changes)


def test_shares_are_those_of_the_judged_numbers() -> None:
    apart = replace(row((1.0, 9.0)).judged[0], by="")
    rows = [row((2.0, 1.0), (4.0, 1.0), (1.0, 3.0)), row(judged=(apart,)), row(refused="why", met=False)]
    found = share(rows)
    assert (found.runs, found.refused, found.met, found.numbers, found.apart) == (3, 1, 2, 3, 1)
    assert found.covered == pytest.approx(2.0 / 3.0)
    assert found.worst == 3.0
    assert found.overstated == 2.0


def test_offenders_are_told_with_their_scene_the_worst_first() -> None:
    rows = [row((1.0, 2.0), (1.0, 0.5), number=4), row((1.0, 7.0), number=8)]
    assert [line[0] for line in offender_sheet(rows).rows] == ["8", "4"]


# --- the command ---


@pytest.fixture
def chosen(tmp_path: Path) -> Chosen:
    return Chosen(3, 2, None, tmp_path, Workers(AtOnce(), [0.0] * 10))


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Numbers of the scenes that are run, each of which is told to have one number."""
    done: list[int] = []

    def rows(scene: Fresh) -> Iterator[CoveredRun]:
        done.append(scene.number)
        yield row((1.0, 3.0), (math.inf, 1.0), kind=scene.kind, number=scene.number)

    monkeypatch.setattr(covered, "rows", rows)
    return done


def test_what_is_kept_is_not_run_again(chosen: Chosen, made: list[int]) -> None:
    first = run_scenes(chosen, range(2))
    assert run_scenes(chosen, range(3))[:2] == first
    assert made == [0, 1, 2]
    next((chosen.out / "scenes").glob("3-1-*")).write_text('[{"kind"')  # damaged
    assert run_scenes(chosen, range(2)) == first
    run_scenes(replace(chosen, seed=4), range(1))
    assert made == [0, 1, 2, 1, 0]


def test_a_scene_that_fails_unexplained_is_a_row(chosen: Chosen, monkeypatch: pytest.MonkeyPatch) -> None:
    def rows(scene: Fresh) -> Iterator[CoveredRun]:
        raise ZeroDivisionError("by zero")

    monkeypatch.setattr(covered, "rows", rows)
    assert [one.refused for one in run_scenes(chosen, range(2))] == 2 * ["ZeroDivisionError: by zero"]


def test_everything_is_written(chosen: Chosen, made: list[int], capsys: pytest.CaptureFixture[str]) -> None:
    coverage.study(chosen)
    told = capsys.readouterr().out
    assert "Errors claimed and true" in told
    assert "rear pin" in told
    summary = json.loads((chosen.out / "summary.json").read_text())
    assert (summary["seed"], summary["scenes"]) == (3, 2)
    told_of_all = {one["name"]: one["value"] for one in summary["numbers"] if one["case"] == f"{ALL}, {ALL}"}
    assert (told_of_all["numbers"], told_of_all["covered"]) == (4, 0.5)


@pytest.mark.parametrize("words", [["--seed", "-1"], ["--seed", "x"], ["--seed", "1", "--scenes", "0"], []])
def test_wrong_words_are_refused(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        coverage.main(words)
    assert ended.value.code == 2
    assert "error:" in capsys.readouterr().err


# --- a scene, whole ---


def test_a_scene_is_covered_and_a_planted_fault_is_not(monkeypatch: pytest.MonkeyPatch) -> None:
    period = CRANK.scenario.duration / covered.RECORDS  # with the records of its references
    scene = replace(CRANK, scenario=replace(CRANK.scenario, record_period=period))
    runs: list[tuple[Scenario, Result]] = []

    def once(scenario: Scenario, throw: bool = True) -> Result:
        """The fault is planted in what is made of runs, which are the same."""
        for known, run in runs:
            if known == scenario:
                return run
        runs.append((scenario, simulate(scenario, throw=throw)))  # type: ignore[arg-type]
        return runs[-1][1]

    monkeypatch.setattr(covered, "simulate", once)
    right = share(list(covered.rows(scene)))
    assert (right.refused, right.numbers > 20) == (0, True)
    assert right.covered > 0.9
    numbers = Result.numbers

    def wrong(run: Result) -> dict[str, Estimate]:
        return {name: number._replace(error=1e-4 * number.error) for name, number in numbers(run).items()}

    monkeypatch.setattr(Result, "numbers", wrong)
    assert share(list(covered.rows(scene))).covered < 0.5


def test_the_first_impact_after_a_free_flight_is_covered() -> None:
    scene = fresh(7, 49).scenario
    tight = simulate(replace(scene, formulation="compiled", solver=SolverSettings(tolerance=1e-12)))
    first = simulate(scene, accuracy="draft").numbers()["pin.O.onset_1.time"]
    assert abs(first.value - tight.onsets["O"][0].time) <= first.error


def test_a_run_that_fails_is_refused_with_its_reason(monkeypatch: pytest.MonkeyPatch) -> None:
    failure = Failure("the solver gave up", "Take a smaller step.", 0.01)

    def run(scenario: Scenario, throw: bool = True) -> Failure:
        if throw:
            raise SimulationError(failure)
        return failure

    monkeypatch.setattr(covered, "simulate", run)
    found = list(covered.rows(CRANK))
    assert {one.refused for one in found} == {"the solver gave up"}
    assert share(found).refused == len(found)


def slow_where(monkeypatch: pytest.MonkeyPatch, slow: Callable[[Scenario], bool]) -> list[CoveredRun]:
    """Rows of a scene some of whose runs take longer than anyone has patience for."""
    result = simulate(CRANK.scenario, accuracy="draft")

    def run(scenario: Scenario, throw: bool = True) -> Result:
        if slow(scenario):
            raise HangError("no end after 300 s")  # as `patience` raises it
        return result

    monkeypatch.setattr(covered, "simulate", run)
    return list(covered.rows(CRANK))


def test_a_run_without_an_end_is_refused_and_those_before_it_are_judged(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    found = slow_where(monkeypatch, lambda scenario: scenario.accuracy == "standard")
    assert found[0].accuracy == "draft"
    assert not found[0].refused
    assert len(found[0].judged) > 20
    assert {one.refused for one in found[1:]} == {"no end after 300 s"}


def test_a_reference_without_an_end_is_none_and_refuses_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    found = slow_where(monkeypatch, lambda scenario: scenario.accuracy is None)
    assert not any(one.refused for one in found)
    assert all(number.apart for one in found for number in one.judged)
    assert share(found).apart > 20
