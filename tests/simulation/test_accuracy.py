"""Runs that are asked for an accuracy: what they choose, when they stop, and whether their errors are true."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from itertools import product
from typing import NamedTuple

import numpy as np
import pytest

from support_exudyn import (
    ClearancePin,
    CubicStep,
    Drive,
    Held,
    Result,
    Scenario,
    SolverSettings,
    simulate,
)
from support_exudyn.scene.contract import Progress
from support_exudyn.simulation import to_accuracy
from support_exudyn.simulation.reported_numbers import measures
from support_exudyn.simulation.to_accuracy import FEWEST_RUNS, MOST_RUNS, PATIENCE
from tests.cases.run_cases import (
    FORCE,
    PIN,
    SLIDER_PIN,
    loose_slider_crank,
    loose_support,
    paper_contact,
    slider_crank_contact,
    support,
)
from user_forces import (
    Ambrosio,
    Frictionless,
    Hertz,
    JournalContact,
    LankaraniNikravesh,
)

DROP = loose_support(drive=Held(), duration=0.05)

# --- what is chosen, and what comes back ---


@pytest.fixture(scope="module")
def drop() -> Result:
    return simulate(DROP, accuracy="standard")


def test_the_result_has_the_settings_that_were_chosen(drop: Result) -> None:
    assert drop.goal == 1e-3
    assert drop.scenario.accuracy is None
    assert drop.scenario.formulation == "compiled"
    # each run has half the steps' length of the one before, which is an eighth of the tolerance
    middle = drop.coarser
    assert middle is not None
    assert middle.coarser is not None
    tolerances = [run.scenario.solver.tolerance for run in (middle.coarser, middle, drop)]
    assert tolerances[:2] == pytest.approx([2.0**3 * t for t in tolerances[1:]])
    assert middle.coarser.coarser is None
    assert drop.met


@pytest.mark.parametrize("scene", ["compiled", "ideal", "exudyn"])
def test_progress_only_rises_and_ends_at_one(scene: str) -> None:
    short = replace(DROP, duration=0.03)
    scenario = {
        "compiled": short,
        "ideal": support(duration=0.05),
        "exudyn": replace(short, formulation="exudyn"),
    }[scene]
    shares: list[float] = []
    result = simulate(scenario, accuracy="draft", progress=shares.append)
    assert result.met
    assert shares == sorted(shares)
    assert shares[-1] == 1.0
    assert 0.0 <= shares[0] < 1.0
    # each run takes half of what is left
    assert {0.5, 0.75, 0.875} <= set(shares)


# --- ideal machines ---


@pytest.mark.parametrize("formulation", ["auto", "exudyn"])
def test_a_machine_with_ideal_pins_has_errors_too(formulation: str) -> None:
    drive = CubicStep(stroke=0.05, start=0.02, end=0.2)
    result = simulate(support(drive=drive, duration=0.25, formulation=formulation), accuracy="standard")
    exact = simulate(support(drive=drive, duration=0.25, formulation="compiled"))
    assert result.met
    assert result.onsets == {}
    if formulation == "auto":  # nothing is free to move, and means are of every step; measured 1.1e-6
        assert result.worst_error < 5e-6
    else:
        assert 1e-9 < result.worst_error <= 1e-3
    known = {name: kind.measure(exact) for name, kind in measures(exact, 0.0, math.inf).items()}
    covered = []
    for name, number in result.numbers().items():
        true = abs(number.value - known[name])
        covered.append(true <= number.error)
        # measured 9e-5, in the front column's largest force
        assert true <= 1e-3 * abs(known[name]), name
    # an estimate covers 95 of 100
    assert np.mean(covered) >= 0.9


# --- goals that cannot be met ---


def runs_of(monkeypatch: pytest.MonkeyPatch) -> list[Scenario]:
    """Scenarios of the runs that are made from now on."""
    made: list[Scenario] = []
    once = to_accuracy.single_run
    monkeypatch.setattr(
        to_accuracy,
        "single_run",
        lambda scenario, progress: (made.append(scenario), once(scenario, progress))[1],
    )
    return made


def bouncing(duration: float) -> Scenario:
    """A journal that loses nothing when it strikes, so that errors grow from impact to make contact."""
    contact = replace(paper_contact(1.5, 0.0), normal=Hertz(stiffness=paper_contact(1.5, 0.0).normal.stiffness))
    return replace(DROP, pins={PIN: ClearancePin(contact=contact)}, duration=duration)


def test_a_scene_that_forgets_its_start_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    made = runs_of(monkeypatch)
    result = simulate(bouncing(2.0), accuracy="standard")
    assert len(result.onsets[PIN]) > 50
    assert not result.met
    assert result.worst_error > result.goal  # type: ignore[operator]
    assert FEWEST_RUNS + PATIENCE <= len(made) <= MOST_RUNS
    # but what comes first is known all the same
    first = result.numbers()[f"pin.{PIN}.onset_1.speed"]
    assert first.error < 1e-5 * first.value


def test_a_goal_beyond_the_finest_steps_gives_what_can_be_had(monkeypatch: pytest.MonkeyPatch) -> None:
    made = runs_of(monkeypatch)
    result = simulate(replace(DROP, duration=0.018, formulation="exudyn", record_period=1e-4), accuracy=1e-7)
    assert len(made) == FEWEST_RUNS  # 2500, 5000, 10000 steps an impact; there are no finer ones
    assert made[-1].solver.impact_steps == 10000
    assert result.goal == 1e-7
    assert not result.met
    # in steps of 4 us rounding shows in the forces of actuators; that is told too
    assert 1e-7 < result.worst_error < math.inf
    assert all(math.isfinite(number.error) for number in result.numbers().values())


@pytest.mark.parametrize("tilted", [False, True])
def test_sections_become_more_only_as_long_as_they_tell_anything(
    tilted: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    once = to_accuracy.single_run

    def tilting(scenario: Scenario, progress: Progress) -> Result:
        """A run whose forces depend on the number of sections, as those of a tilted pin do."""
        # it is made with the fewest
        run = once(replace(scenario, solver=replace(scenario.solver, sections=5)), progress)
        channel = run.channels[FORCE]
        channel = replace(channel, values=(1.0 + 1e-3 / scenario.solver.sections) * channel.values)
        return replace(run, scenario=scenario, channels={**run.channels, FORCE: channel}, statistics=None)

    monkeypatch.setattr(to_accuracy, "single_run", tilting if tilted else once)
    made = runs_of(monkeypatch)
    monkeypatch.setattr(Result, "worst_error", property(lambda run: 0.5 ** len(made)))
    # beyond the first impact
    result = simulate(replace(DROP, duration=0.02, record_period=2e-3, dimensions=3), accuracy=0.02)
    assert f"pin.{PIN}.left.onset_1.speed" in result.numbers()
    # a section's share of the force depends on how many there are
    assert f"pin.{PIN}.left.largest_force" not in result.numbers()
    sections = [run.solver.sections for run in made]
    # the fourth is the first again, with as many sections as the third
    assert sections[:4] == [5, 9, 17, 17]
    assert made[3].step == made[0].step
    assert sections[4:] == ([33, 64] if tilted else [5, 5])


# --- are the estimated errors the true ones? ---

GOALS = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
TIGHT = SolverSettings(tolerance=1e-13)


class Case(NamedTuple):
    """What a run says and what is true.

    goal: asked for. met: what it says of that. off: the worst true error of what an accuracy is of. true, said:
    errors of all numbers.
    """

    kind: str
    goal: float
    met: bool
    off: float
    true: np.ndarray
    said: np.ndarray


def dropping(c_mm: float, restitution: float, mu: float, bore: str, speed: float, drive: Drive) -> Scenario:
    base = paper_contact(c_mm, mu)
    law = LankaraniNikravesh(stiffness=base.normal.stiffness, restitution=restitution, rest_velocity=speed)
    pin = ClearancePin(contact=replace(base, normal=law), bore=bore)
    return support(pins={PIN: pin}, drive=drive, duration=0.3)


def turning(c_mm: float, restitution: float, mu: float, gravity: float, speed: float) -> Scenario:
    base = slider_crank_contact(mu)
    law = LankaraniNikravesh(stiffness=base.normal.stiffness, restitution=restitution, rest_velocity=speed)
    contact = JournalContact(
        bearing=replace(base.bearing, clearance=c_mm / 1e3),
        normal=law,
        friction=Ambrosio(sliding_coefficient=mu) if mu else Frictionless(),
    )
    return replace(
        loose_slider_crank(6e-3, gravity=(0.0, -gravity)), pins={SLIDER_PIN: ClearancePin(contact=contact)}
    )


SPEEDS = (1e-3, 1e-2)  # rest velocities [m/s]
RISE = CubicStep(stroke=0.06, start=0.05, end=0.25)


def cases() -> dict[str, list[Scenario]]:
    """Half of all combinations; constants were chosen by these too, so fresh ones judge them."""
    bores = ("first", "second")
    supports = list(product((0.5, 1.0, 2.0), (0.5, 0.9), (0.0, 0.25), bores, SPEEDS))
    return {
        # every other combination, so that both bores and both speeds go with all else
        "drop": [dropping(*scene, Held()) for n, scene in enumerate(supports) if (n + n // 2 + n // 4) % 2],
        "rise": [dropping(*scene, RISE) for n, scene in enumerate(supports) if (n + n // 2 + n // 4) % 2 == 0],
        "slider-crank": [turning(*x) for x in product((0.2, 0.5), (0.5, 0.9), (0.0, 0.1), (0.0, 9.81), SPEEDS)],
    }


def off(run: Result, tight: Result) -> float:
    """The worst true error of what an accuracy is of."""
    wrong = [0.0]
    for pin in run.scenario.machine.linkage().pins:
        one, other = run[f"pin.{pin}.force"], tight[f"pin.{pin}.force"]
        wrong += [abs(f(one) / f(other) - 1.0) for f in (np.mean, np.std, np.max)]
    for point in run.scenario.machine.linkage().points:
        path, true = (np.array([r[f"{point}.x"], r[f"{point}.y"]]) for r in (run, tight))
        clearance = max(pin.contact.bearing.clearance for pin in run.scenario.clearance_pins.values())
        extent = max(float(np.hypot(*np.ptp(true, axis=1))), clearance)
        wrong.append(float(np.hypot(*(path - true)).max()) / extent)
    return max(wrong)


ALL = pytest.param(1, marks=pytest.mark.slow)


@pytest.fixture(scope="module", params=[6, ALL])
def checked(request: pytest.FixtureRequest) -> list[Case]:
    """Every so many-th scene run to all goals, compared with a tolerance of 1e-13."""
    found = []
    for kind, scenes in cases().items():
        for scene in scenes[:: request.param]:
            tight = simulate(replace(scene, formulation="compiled", solver=TIGHT))
            known = {n: kind_.measure(tight) for n, kind_ in measures(tight, 0.0, math.inf).items()}
            for goal in GOALS:
                run = simulate(scene, accuracy=goal)
                assert run.scenario.formulation == "compiled"
                numbers = {
                    n: number
                    for n, number in run.numbers().items()
                    if n in known and not n.endswith("largest_time") and not n.endswith("largest_force_time")
                }
                true = np.array([abs(number.value - known[n]) for n, number in numbers.items()])
                said = np.array([number.error for number in numbers.values()])
                found.append(Case(kind, goal, run.met, off(run, tight), true, said))
    return found


def figures(chosen: list[Case]) -> Mapping[str, float]:
    true = np.concatenate([case.true for case in chosen])
    said = np.concatenate([case.said for case in chosen])
    some = true > 0.0
    return {
        "numbers": true.size,
        "covered": float(np.mean(true <= said)),
        "worst": float((true[some] / said[some]).max()),
        "overstated": float(np.median(said[some] / true[some])),
    }


def test_estimates_cover_the_true_errors_without_much_overstatement(
    checked: list[Case], request: pytest.FixtureRequest
) -> None:
    for kind in cases():
        print(kind, figures([case for case in checked if case.kind == kind]))
    for goal in GOALS:
        print(goal, figures([case for case in checked if case.goal == goal]))
    everything = figures(checked)
    print("all", everything)
    assert everything["numbers"] > (10_000 if request.node.callspec.params["checked"] == 1 else 1_500)
    # what is promised; measured: 0.995
    assert everything["covered"] >= 0.99
    # as far as runs are not as close as rounding, which is added to every estimate; measured: 11.8. Extremes,
    # which steps of other lengths meet at other points, are overstated by 19 to 33: 99 of 100 are covered
    more = 1.0 if request.node.callspec.params["checked"] == 1 else 1.25  # samples scatter from 11.5 to 16.2
    assert figures([case for case in checked if case.goal > GOALS[-1]])["overstated"] <= 13.0 * more
    assert everything["overstated"] <= 14.0 * more  # measured: 12.1


def test_no_number_is_off_by_more_than_five_errors(checked: list[Case]) -> None:
    assert figures(checked)["worst"] < 5.0  # measured: 4.4


def test_a_goal_that_is_said_to_be_met_is_met(checked: list[Case]) -> None:
    said = [case for case in checked if case.met]
    print("worst share of the goal", max(case.off / case.goal for case in said))
    # none of these scenes goes on so long that it cannot be met
    assert len(said) == len(checked)
    # each could fail by the five in a hundred that an estimate does not cover; settings are chosen so
    # cautiously that the worst was 0.57 of its goal
    for case in said:
        assert case.off <= case.goal
