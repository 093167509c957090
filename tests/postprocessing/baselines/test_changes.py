"""A baseline catches every planted change, and says nothing of what rounding and steps change."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import Result, Scenario, simple_scenario, simulate
from support_exudyn.mechanics.time_statistics import COLUMNS, FIRST, GREATEST, LAST, LEAST, MEAN
from support_exudyn.postprocessing.baselines.changes import RunChange, apart, changes
from support_exudyn.postprocessing.baselines.kept_impacts import kept_impacts
from support_exudyn.postprocessing.baselines.kept_run import KeptCurve, KeptRun, kept_run
from support_exudyn.postprocessing.pytest_plugin import SimulateCached
from support_exudyn.simulation.estimate import Estimate
from tests.postprocessing.baselines.scenes import rocker

FACTOR = 1.001
PLACES = (MEAN, FIRST, LAST, LEAST, GREATEST)


@pytest.fixture(scope="module")
def run(simulate_cached: SimulateCached) -> Result:
    return simulate_cached(rocker())


@pytest.fixture(scope="module")
def kept(run: Result) -> KeptRun:
    return kept_run(run)


def told(found: list[RunChange]) -> set[tuple[str, str, str]]:
    return {(one.kind, one.what, one.name) for one in found}


def whole(run: Any, changed: Callable[[Any], Any]) -> Any:
    """A result changed as by the program: with all runs by which its errors are known."""
    coarser = None if run.coarser is None else whole(run.coarser, changed)
    return replace(changed(run), coarser=coarser)


def with_values(name: str, change: Callable[[np.ndarray], np.ndarray]) -> Callable[[Result], Result]:
    def changed(run: Result) -> Result:
        one = run.channels[name]
        return whole(
            run, lambda r: replace(r, channels={**r.channels, name: replace(one, values=change(r[name]))})
        )

    return changed


def test_the_scene_has_small_errors(run: Result, kept: KeptRun) -> None:
    assert run.met
    assert math.isinf(kept.horizon)
    assert len(kept.impacts["B"]) >= 4
    assert set(kept.curves) == set(run.channels) - {"time"}


def test_nothing_has_changed(run: Result, kept: KeptRun) -> None:
    assert changes(kept, kept) == []
    assert changes(kept, kept_run(simulate(rocker()))) == []


# --- ten changes of what the program computes, each by a thousandth ---


def pin(**changed: float) -> Callable[[], Scenario]:
    return lambda: rocker(**changed)


def of_body(name: str, *fields: str) -> Callable[[], Scenario]:
    def scenario() -> Scenario:
        base = rocker()
        machine: Any = base.machine
        body = machine.drawing.bodies[name]
        more = {field: FACTOR * np.asarray(getattr(body, field)) for field in fields}
        bodies = {
            **machine.drawing.bodies,
            name: replace(body, **{key: one.tolist() for key, one in more.items()}),
        }
        return replace(base, machine=replace(machine, drawing=replace(machine.drawing, bodies=bodies)))

    return scenario


PLANTED: Mapping[str, Callable[[], Scenario]] = {
    "contact stiffness": pin(stiffness_N_per_m_to_n=FACTOR * 1e10),
    "restitution": pin(restitution=FACTOR * 0.8),
    "friction": pin(friction=FACTOR * 0.1),
    "clearance": pin(clearance_mm=FACTOR * 0.5),
    "gravity": lambda: replace(rocker(), gravity=(0.0, -FACTOR * 9.81)),
    "mass": of_body("rocker", "mass"),
    "inertia": of_body("coupler", "inertia", "moments"),
    "drive": lambda: replace(rocker(), drives={"crank": replace(rocker().drives["crank"], rate=FACTOR * 60.0)}),
}


@pytest.mark.parametrize("name", PLANTED)
def test_a_thousandth_of_a_quantity_is_caught(name: str, kept: KeptRun) -> None:
    found = changes(kept, kept_run(simulate(PLANTED[name]())))
    numbers = [one for one in found if one.what == "number" and math.isfinite(one.ratio)]
    assert max(one.ratio for one in found if math.isfinite(one.ratio)) > 100.0
    assert numbers
    assert any(one.what == "impact" for one in found)


# --- changes of what is recorded ---


def test_a_sign_is_caught(run: Result, kept: KeptRun) -> None:
    name = "pin.B.friction_force"
    found = changes(kept, kept_run(with_values(name, np.negative)(run)))
    assert {one.name for one in found} == {name}
    assert found[0].time is not None
    assert found[0].was is not None
    assert found[0].now is not None
    assert found[0].now.value == pytest.approx(-found[0].was.value)


def test_an_offset_is_caught(run: Result, kept: KeptRun) -> None:
    def moved(one: Result) -> Result:
        assert one.statistics is not None
        rows = one.statistics.channels["middle.x"] + np.isin(np.arange(len(COLUMNS)), PLACES) * 1e-8
        statistics = replace(one.statistics, channels={**one.statistics.channels, "middle.x": rows})
        return replace(one, statistics=statistics)

    found = changes(kept, kept_run(whole(with_values("middle.x", lambda x: x + 1e-8)(run), moved)))
    assert {one.name for one in found} == {"middle.x", "middle.x.mean"}


def test_records_that_are_late_by_one_are_caught(run: Result, kept: KeptRun) -> None:
    def late(one: Any) -> Any:
        shifted = {
            name: channel if name == "time" else replace(channel, values=np.roll(channel.values, 1))
            for name, channel in one.channels.items()
        }
        return replace(one, channels=shifted)

    found = changes(kept, kept_run(whole(run, late)))
    assert len([one for one in found if one.what == "channel"]) > 40


def test_a_renamed_channel_is_gone_and_new(run: Result, kept: KeptRun) -> None:
    def renamed(one: Any) -> Any:
        channels = {name.replace("slip", "sliding"): channel for name, channel in one.channels.items()}
        return replace(one, channels=channels)

    found = changes(kept, kept_run(whole(run, renamed)))
    assert told(found) == {("gone", "channel", "pin.B.slip"), ("new", "channel", "pin.B.sliding")}


def test_another_unit_is_caught(run: Result, kept: KeptRun) -> None:
    channels = {**run.channels, "middle.x": replace(run.channels["middle.x"], unit="mm")}
    found = changes(kept, kept_run(replace(run, channels=channels)))
    assert ("changed", "channel", "middle.x") in told(found)


@pytest.mark.parametrize("lost", [0, 1, 3])
def test_one_impact_that_is_lost_is_caught(lost: int, run: Result, kept: KeptRun) -> None:
    def without(one: Any) -> Any:
        onsets = one.onsets["B"]
        return replace(one, onsets={"B": (*onsets[:lost], *onsets[lost + 1 :])})

    found = changes(kept, kept_run(whole(run, without)))
    assert told(found) == {("gone", "impact", f"B: {lost + 1}")}
    back = changes(kept_run(whole(run, without)), kept)
    assert told(back) == {("new", "impact", f"B: {lost + 1}")}


def test_numbers_that_are_gone_and_new_are_told(kept: KeptRun) -> None:
    numbers = dict(kept.numbers)
    moved = numbers.pop("pin.B.force.mean")
    found = changes(kept, replace(kept, numbers={**numbers, "mine": moved}))
    assert told(found) == {("gone", "number", "pin.B.force.mean"), ("new", "number", "mine")}


def test_keys_of_the_scenario_are_told(kept: KeptRun) -> None:
    one, other = (replace(kept, scenario=rocker(friction=mu).plain) for mu in (0.1, 0.2))
    found = changes(one, other)
    assert [(change.kind, change.what, change.said) for change in found] == [("changed", "key", "0.1 -> 0.2")]
    assert found[0].name.endswith("friction.sliding_coefficient")


# --- what is no change ---


def perturbed(scenario: Scenario, ulps: float) -> Scenario:
    """Gravity off by some units in the last place: all forces are then rounded otherwise."""
    x, y = scenario.gravity
    return replace(scenario, gravity=(x, y * (1.0 + ulps * 2.0**-52)))


@pytest.mark.parametrize("ulps", [1.0, -3.0, 20.0])
def test_rounding_is_no_change(ulps: float, run: Result, kept: KeptRun) -> None:
    other = simulate(perturbed(rocker(), ulps))
    assert any(not np.array_equal(run[name], other[name]) for name in run.channels)
    found = changes(kept, kept_run(other))  # errors cover 98 of 100 numbers, here of 50
    assert len(found) <= 1
    assert all(one.ratio < 2.0 for one in found)


@pytest.mark.parametrize("accuracy", [8e-6, 5e-6, 2e-5])
def test_other_steps_are_no_change(accuracy: float, kept: KeptRun) -> None:
    other = kept_run(simulate(rocker(), accuracy=accuracy))
    assert dict(other.numbers) != dict(kept.numbers)
    found = changes(kept, other)  # errors cover 98 of 100 numbers, here of 50
    assert len(found) <= 2
    assert all(one.ratio < 2.0 for one in found)


def test_ideal_machines_are_quiet_too() -> None:
    rise = simple_scenario(
        "reference", duration_s=1, record_period_s=0.02, accuracy="reference",
        drive={"mode": 2, "start_s": 0.2, "end_s": 0.8},
    )  # fmt: skip
    kept = kept_run(simulate(rise))
    assert changes(kept, kept_run(simulate(perturbed(rise, 1.0)))) == []
    heavier = replace(rise, gravity=(0.0, (1.0 + 1e-8) * rise.gravity[1]))
    assert changes(kept, kept_run(simulate(heavier)))


def chaos(accuracy: float | str) -> Scenario:
    return replace(rocker(0.2, restitution=0.95, friction=0), accuracy=accuracy, record_period=1e-3)


def test_chaos_is_compared_up_to_its_horizon_and_by_statistics_beyond() -> None:
    scene = chaos("draft")
    runs = [simulate(perturbed(scene, ulps)) for ulps in (0.0, 1.0, -3.0)]
    first, *others = map(kept_run, runs)
    assert first.horizon < 0.15
    assert set(first.numbers) == {name for name in first.numbers if name.endswith((".mean", ".std"))}
    name = "pin.B.force.mean"
    assert first.numbers[name].error > runs[0].numbers()[name].error
    # the runs are others, and nothing is told of that
    assert not np.allclose(runs[0]["pin.B.force"], runs[1]["pin.B.force"], rtol=1e-2)
    assert [changes(first, other) for other in others] == [[], []]
    faster = replace(scene, gravity=(0.0, -20.0))
    assert changes(first, kept_run(simulate(faster)))


@pytest.mark.slow  # 16 runs of each
@pytest.mark.parametrize(("pins", "friction"), [("B", 0.0), ("ABC", 0.1)])
def test_chaos_is_quiet_whatever_is_rounded(pins: str, friction: float) -> None:
    loose = {one: {"clearance_mm": 0.5, "friction": friction, "restitution": 0.9} for one in pins}
    scene = simple_scenario(
        "crank_rocker", duration_s=1.0, record_period_s=1e-3, accuracy="standard",
        drives={"crank": {"type": "Steady", "rate_rad_per_s": 45}}, pins=loose,
    )  # fmt: skip
    kept = [kept_run(simulate(perturbed(scene, n))) for n in range(16)]
    assert np.median([one.horizon for one in kept]) < 0.5 * scene.duration
    pairs = [(one, other) for one in kept for other in kept if one is not other]
    noisy = [found for one, other in pairs if (found := changes(one, other))]
    assert len(noisy) <= 0.02 * len(pairs)


def test_impacts_are_kept_up_to_the_first_doubtful_one() -> None:
    run = simulate(chaos("draft"))
    impacts, end = kept_impacts(run)
    assert end <= run.horizon
    assert all(one.time.value < end for one in impacts["B"])
    shares = [one.speed.error / one.speed.value for one in impacts["B"]]
    assert all(after > before * (1.0 - 1e-12) for before, after in pairwise(shares))


# --- the rule ---


@given(
    value=st.floats(-1e6, 1e6),
    first=st.floats(1e-6, 1e3),
    second=st.floats(0.0, 1e3),
    share=st.floats(-3.0, 3.0),
)
def test_what_exceeds_both_errors_has_changed(value: float, first: float, second: float, share: float) -> None:
    was = Estimate(value, first, "N")
    now = Estimate(value + share * (first + second), second, "N")
    ratio = apart(was, now)
    assert ratio == pytest.approx(abs(share), abs=1e-3)
    one, other = (
        KeptRun(numbers={"mine": number}, provenance={}, time=np.arange(2.0), curves={"c": curve})
        for number, curve in (
            (was, KeptCurve("N", np.full(2, was.value), np.full(2, was.error))),
            (now, KeptCurve("N", np.full(2, now.value), np.full(2, now.error))),
        )
    )
    assert told(changes(one, other)) == (
        {("changed", "number", "mine"), ("changed", "channel", "c")} if ratio > 1.0 else set()
    )


def test_what_is_not_known_is_not_compared_and_nan_is_a_change() -> None:
    known, unknown, none = (Estimate(v, e, "N") for v, e in ((1.0, 0.1), (9.0, math.inf), (math.nan, 0.1)))
    assert apart(known, unknown) == 0.0
    assert apart(none, none) == 0.0
    assert apart(known, none) == math.inf
