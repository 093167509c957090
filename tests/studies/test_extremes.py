"""Extremes: what is tried, that the judge catches every kind of wrong result, and what the study writes."""

from __future__ import annotations

import json
import math
import signal
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest

from studies.common.options import Options
from studies.common.words import Chapter
from studies.extremes import judge as judge_module
from studies.extremes import long_runs, scenes
from studies.extremes import run as extremes
from studies.extremes.drawn import Point
from studies.extremes.judge import GOOD, REFUSED, SILENT, Judgement, judge, oil_open
from studies.extremes.scenes import ALL, BOX, HYDRAULICS, MAPS, PIN, Case, cases, mapped
from support_exudyn import Failure, Held, Result, Scenario, SimulationError, simulate
from support_exudyn.machines.free_impact import ImpactStand
from support_exudyn.mechanics.time_statistics import TimeStatistics
from support_exudyn.scene.limits import DEEPEST
from support_exudyn.simulation.reported_numbers import measured
from support_exudyn.simulation.result_checks import turned_over
from tests.at_once import at_once
from tests.hostile import posix_only
from user_forces import InputError

POWERS = np.array([1, 2, 1, 1, 1, 0, 1, 0])  # of a factor, in the columns of statistics


def fall() -> Scenario:
    """The support falls through its clearance rear pin; the compiled formulation covers it, too."""
    return replace(scenes.fallen(Point()), duration=0.08)


def impact() -> Scenario:
    """Two free bodies that meet once."""
    return scenes.at_steps(
        Point(),
        machine=ImpactStand(bore_mass=1000.0, journal_mass=1000.0, speed=1.0),
        pins={"pin": Point(restitution=0.5).pin},
        gravity=(0.0, 0.0),
        duration=6e-3,
        step=6e-3 / 101.0,
        record_period=6e-3 / 50.0,
    )


# --- what is tried ---


def made_of(case: Case) -> Scenario | str:
    """Its scenario, or why there is none."""
    try:
        return case.scenario()
    except InputError as error:
        return str(error)


def test_every_case_makes_a_scenario_or_says_why_not() -> None:
    made = [made_of(case) for case in cases(ALL)[::7]]
    refused = [one for one in made if isinstance(one, str)]
    assert all("allowed" in one for one in refused)
    # v_s = v_d, and heights that the linkage does not reach
    assert 0 < len(refused) < 0.1 * len(made)


# --- the judge ---


@pytest.fixture(scope="module")
def fallen() -> Result:
    return simulate(fall(), errors=True)


@pytest.fixture(scope="module")
def struck() -> Result:
    return simulate(impact(), errors=True)


def scaled(result: Result, factors: Mapping[str, float]) -> Result:
    """A result whose channels are so many times as large, and those of its coarser runs."""
    wrong = {
        name: replace(channel, values=channel.values * factors.get(name, 1.0))
        for name, channel in result.channels.items()
    }
    coarser = None if result.coarser is None else scaled(result.coarser, factors)
    kept = result.statistics
    assert kept is not None
    rows = {name: rows * factors.get(name, 1.0) ** POWERS for name, rows in kept.channels.items()}
    return replace(result, channels=wrong, coarser=coarser, statistics=TimeStatistics(kept.edges, rows))


def with_channel(result: Result, name: str, change: Callable[[np.ndarray], np.ndarray]) -> Result:
    """A result one channel of which is another, that of its coarser runs as it was."""
    channel = result.channels[name]
    changed = replace(channel, values=change(channel.values.copy()))
    return replace(result, channels={**result.channels, name: changed})


def judged(make: Callable[[], Scenario], result: Result) -> Judgement:
    return judge(make, lambda scenario: result)


def test_what_is_right_is_good(fallen: Result, struck: Result) -> None:
    found = judge(fall)
    assert found.outcome == GOOD, found.reason
    assert judged(fall, fallen).outcome == GOOD
    # measured: error 1.2e-3, half 2.9e-4, other 1.2e-4
    assert 0.0 < found.half < found.error < 1e-2
    assert 0.0 < found.other < found.error
    found = judge(impact)
    assert found.outcome == GOOD, found.reason
    assert found.restitution == pytest.approx(1.0, abs=1e-3)  # 64 steps; measured: 1.00002
    assert 0.0 < found.other < found.error
    space = judge(lambda: replace(fall(), dimensions=3))
    assert space.outcome == GOOD, space.reason
    assert math.isnan(space.other)  # nothing else covers it


def test_forces_that_are_wrong_at_all_steps_alike_are_seen_by_the_other_formulation(fallen: Result) -> None:
    forces = dict.fromkeys((name for name in measured(fallen.scenario) if name.endswith(".force")), 1.05)
    found = judged(fall, scaled(fallen, forces))
    assert found.outcome == SILENT
    assert "formulation compiled is" in found.reason
    assert "half the steps" not in found.reason  # which are as wrong
    assert found.other == pytest.approx(0.05, rel=0.1)  # of what is wrong


class Boasting(Result):
    """Reports a hundredth of its error."""

    @property
    def worst_error(self) -> float:
        return 0.01 * super().worst_error


def boasting(result: Result) -> Boasting:
    given = {field.name: getattr(result, field.name) for field in fields(Result)}
    coarser = None if result.coarser is None else boasting(result.coarser)
    return Boasting(**(given | {"coarser": coarser}))


@pytest.mark.parametrize("scene", ["fall", "impact"])
def test_an_error_that_is_reported_too_small_is_seen_by_half_the_steps(
    scene: str, fallen: Result, struck: Result
) -> None:
    make, result = {"fall": (fall, fallen), "impact": (impact, struck)}[scene]
    found = judged(make, boasting(result))
    assert found.outcome == SILENT
    assert "half the steps are" in found.reason


@pytest.mark.parametrize("wrong", [math.nan, math.inf])
@pytest.mark.parametrize("name", ["tip.x", "energy.kinetic", f"pin.{PIN}.depth", f"pin.{PIN}.force"])
def test_a_number_that_is_not_finite_is_caught(name: str, wrong: float, fallen: Result) -> None:
    def put(values: np.ndarray) -> np.ndarray:
        values[values.size // 2] = wrong
        return values

    found = judged(fall, with_channel(fallen, name, put))
    assert found.outcome == SILENT
    # of an infinite path or force the extent or spread is none, which numpy warns of
    assert "not finite" in found.reason or "RuntimeWarning" in found.reason


def test_oil_that_is_lost_or_made_is_caught() -> None:
    scene = next(case for case in cases() if case.group == HYDRAULICS).scenario()
    result = simulate(replace(scene, formulation="compiled", duration=1e-3, record_period=1e-4))
    (leg,) = result.scenario.legs
    assert oil_open(result) < 0.1 * judge_module.LEAK
    for share, low, high in ((1e-9, 0.5e-9, 2e-9), (1e-3, 0.5e-3, 2e-3)):
        wrong = with_channel(
            result, f"{leg}.oil", lambda values, share=share: values * (1.0 + share * result.time / 1e-3)
        )
        assert low < oil_open(wrong) < high


def with_energy_open(result: Result, share: float) -> Result:
    moved = turned_over(result.channels)
    return with_channel(result, "energy.balance", lambda values: values + share * moved)


def with_restitution(result: Result, share: float) -> Result:
    (onset,) = result.onsets["pin"]
    speed = share * result.scenario.clearance_pins["pin"].contact.normal.delivered_restitution * onset.speed
    return replace(result, onsets={"pin": (onset._replace(separation_velocity=speed),)})


def with_depth(result: Result, share: float) -> Result:
    name = "pin.pin.depth"
    radius = result.scenario.clearance_pins["pin"].contact.bearing.bore_radius
    return scaled(result, {name: share * radius / float(result[name].max())})


@pytest.mark.parametrize(
    ("change", "measure", "share", "fault"),
    [
        (with_energy_open, "energy", 0.06, "energy is open"),  # 5 % are allowed
        (with_energy_open, "energy", 0.04, ""),
        (with_restitution, "restitution", 1.02, "a free impact gives back"),  # 0.5 % are allowed
        (with_restitution, "restitution", 1.004, ""),
        (with_depth, "depth", 1.01 * DEEPEST, "of the bore's radius"),
        (with_depth, "depth", 0.99 * DEEPEST, ""),
    ],
)
def test_a_measure_beyond_its_limit_is_caught(
    change: Callable[[Result, float], Result], measure: str, share: float, fault: str, struck: Result
) -> None:
    found = judged(impact, change(struck, share))
    assert found.outcome == (SILENT if fault else GOOD)
    assert fault in found.reason
    assert getattr(found, measure) == pytest.approx(share, rel=1e-3)  # the run's own energy is open a little


@pytest.mark.parametrize(
    ("error", "outcome"),
    [
        (SimulationError(Failure("the solver gave up", "Take a smaller step.", 0.1)), REFUSED),
        (SimulationError(Failure("the solver gave up", "", 0.1)), SILENT),
        (SimulationError(Failure("", "Take a smaller step.", 0.1)), SILENT),
        (SimulationError(Failure("the solver gave up", "Take a smaller step.", math.nan)), SILENT),
        (InputError("step = -1: allowed: > 0"), REFUSED),
        (ZeroDivisionError("float division"), SILENT),
        (KeyError("x"), SILENT),
    ],
)
def test_a_failure_has_to_say_why_when_and_what_to_do(error: Exception, outcome: str) -> None:
    def run(scenario: Scenario) -> Result:
        raise error

    found = judge(fall, run)
    assert found.outcome == outcome
    if not isinstance(error, (SimulationError, InputError)):
        assert found.reason.startswith(type(error).__name__)
        assert "test_extremes.py" in found.reason  # where it was


# --- hangs and crashes ---


def sleep() -> Scenario:
    time.sleep(60.0)
    return fall()


def crawl() -> Scenario:
    """A step at a time; so short that the engine would take hours."""
    return replace(fall(), step=1e-7, duration=100.0, record_period=1.0)


@posix_only
@pytest.mark.parametrize("make", [sleep, crawl])
def test_a_run_that_hangs_is_a_silent_failure(
    make: Callable[[], Scenario], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(judge_module, "PATIENCE", 0.3)
    before = signal.getsignal(signal.SIGALRM)
    found = judge_module.judged(0, Case("one", "start", make))
    assert found == Judgement(SILENT, "hang: no end after 0.3 s")
    # nothing rings later
    assert signal.getitimer(signal.ITIMER_REAL) == (0.0, 0.0)
    assert signal.getsignal(signal.SIGALRM) == before


# --- the whole study ---

SHORT = 2.0  # [s] of long runs
LARGEST_GAP = 1e-8  # [m] in them
LASTING = (long_runs.IDEAL, long_runs.SMOOTH)


def broken() -> Scenario:
    return Scenario(machine=1, duration=1.0 / 0.0)


def few() -> list[Case]:
    """Two of every map, one of them refused and one that fails silently, and one of the box; all short."""

    def short() -> Scenario:
        return scenes.to_accuracy(Point(), Held(), 0.06, 2e-4, "draft")

    def refused() -> Scenario:
        return Scenario(machine=fall().machine, duration=-1.0)

    pairs = [[case for case in mapped() if case.group == group][:2] for group in MAPS]
    found = [replace(case, scenario=short) for pair in pairs for case in pair]
    found[1], found[5] = replace(found[1], scenario=refused), replace(found[5], scenario=broken)
    return [*found, Case("boxed", BOX, short)]


@pytest.fixture(scope="module")
def out(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    folder = tmp_path_factory.mktemp("results")
    drawn: list[int] = []

    def given(number: int) -> list[Case]:
        drawn.append(number)
        return few()

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(extremes, "cases", given)
        patch.setattr(long_runs, "DURATIONS", dict.fromkeys(LASTING, SHORT))
        extremes.Extremes(Options(folder, at_once(), runs=5)).write()
    assert drawn == [5]
    return folder


def test_the_summary_counts_every_run(out: Path) -> None:
    summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
    assert summary["study"] == "extremes"
    assert [summary[f"runs_{outcome}"] for outcome in (GOOD, REFUSED, SILENT)] == [5, 1, 1]
    numbers = {(number["name"], number["case"]): number["value"] for number in summary["numbers"]}
    assert numbers["good", "physically sensible"] == 1.0
    assert numbers["accuracy_met", "physically sensible"] == 1.0
    assert 0.0 < numbers["largest_half_over_reported", "the 5 good of 7 runs"] < 1.0
    for name in LASTING:
        assert 0.0 < numbers["largest_gap", f"{name}, {SHORT:g} s"] < LARGEST_GAP
    assert all(math.isfinite(value) for value in numbers.values())


def test_the_chapter_can_be_read_and_its_maps_are_there(out: Path) -> None:
    chapter = Chapter.load(out)
    assert chapter.study == "extremes"
    key = chapter.sheets[0]
    assert key.name == "table_kinds"
    assert key.rows[-1] == ("all", "7", "5", "1", "1", "5")
    assert [picture.stem for picture in chapter.pictures] == [
        "map_solvers", "map_step_stiffness", "map_clearance_speed", "map_friction_step",
    ]  # fmt: skip
    for picture in chapter.pictures:
        # some tens of kB; an empty canvas has five
        assert (out / f"{picture.stem}.png").stat().st_size > 10_000
    silent = next(sheet for sheet in chapter.sheets if sheet.title == "Silent failures")
    assert [row[0] for row in silent.rows] == [few()[5].name]
