"""A baseline catches every planted change, and reports nothing of what rounding and steps change."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from support_exudyn import Result, Scenario, simulate
from support_exudyn.postprocessing.comparing.baselines import KeptRun, RunChange, changes, kept_run
from support_exudyn.postprocessing.comparing.compared_channel import ComparedColumn
from support_exudyn.postprocessing.pytest_plugin import SimulateCached
from support_exudyn.simulation.estimate import Estimate
from tests.postprocessing.baselines.scenes import rocker

FACTOR = 1.001


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


def test_the_scene_has_small_errors_and_has_not_changed(run: Result, kept: KeptRun) -> None:
    assert run.met
    assert math.isinf(kept.horizon)
    assert len(run.onsets["B"]) >= 4
    assert set(kept.curves) == set(run.channels) - {"time"}
    assert changes(kept, kept) == changes(kept, kept_run(simulate(rocker()))) == []


# --- changes of what the program computes, each by a thousandth ---


def of_body(name: str, *fields: str) -> Scenario:
    base = rocker()
    machine: Any = base.machine
    body = machine.drawing.bodies[name]
    more = {field: (FACTOR * np.asarray(getattr(body, field))).tolist() for field in fields}
    bodies = {**machine.drawing.bodies, name: replace(body, **more)}
    return replace(base, machine=replace(machine, drawing=replace(machine.drawing, bodies=bodies)))


PLANTED: Mapping[str, Callable[[], Scenario]] = {
    "contact stiffness": lambda: rocker(stiffness_N_per_m_to_n=FACTOR * 1e10),
    "friction": lambda: rocker(friction=FACTOR * 0.1),
    "gravity": lambda: replace(rocker(), gravity=(0.0, -FACTOR * 9.81)),
    "mass": lambda: of_body("rocker", "mass"),
}


@pytest.mark.parametrize("name", PLANTED)
def test_a_thousandth_of_a_quantity_is_caught(name: str, kept: KeptRun) -> None:
    found = changes(kept, kept_run(simulate(PLANTED[name]())))
    assert max(one.ratio for one in found if math.isfinite(one.ratio)) > 100.0
    assert {"number", "channel"} <= {one.what for one in found}


# --- changes of what is recorded ---


def with_values(name: str, change: Callable[[np.ndarray], np.ndarray]) -> Callable[[Any], Any]:
    return lambda one: replace(
        one,
        channels={**one.channels, name: replace(one.channels[name], values=change(one.channels[name].values))},
    )


def renamed(one: Any) -> Any:
    return replace(one, channels={name.replace("slip", "sliding"): it for name, it in one.channels.items()})


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (with_values("pin.B.friction_force", np.negative), {("changed", "channel", "pin.B.friction_force")}),
        (with_values("middle.x", lambda x: x + 1e-8), {("changed", "channel", "middle.x")}),
        (renamed, {("gone", "channel", "pin.B.slip"), ("new", "channel", "pin.B.sliding")}),
    ],
)
def test_a_change_of_the_records_is_caught(
    change: Callable[[Any], Any], expected: set[tuple[str, str, str]], run: Result, kept: KeptRun
) -> None:
    assert told(changes(kept, kept_run(whole(run, change)))) == expected


def test_other_units_numbers_and_keys_are_caught(kept: KeptRun) -> None:
    curves = {**kept.curves, "middle.x": kept.curves["middle.x"]._replace(unit="mm")}
    assert told(changes(kept, replace(kept, curves=curves))) == {("changed", "channel", "middle.x")}
    numbers = dict(kept.numbers)
    moved = numbers.pop("pin.B.force.mean")
    found = changes(kept, replace(kept, numbers={**numbers, "mine": moved}))
    assert told(found) == {("gone", "number", "pin.B.force.mean"), ("new", "number", "mine")}
    one, other = (replace(kept, scenario=rocker(friction=mu).plain) for mu in (0.1, 0.2))
    (key,) = changes(one, other)
    assert (key.kind, key.what, key.values) == ("changed", "key", "0.1 -> 0.2")
    assert key.name.endswith("friction.sliding_coefficient")


# --- what is no change ---


def perturbed(scenario: Scenario, ulps: float) -> Scenario:
    """Gravity off by some units in the last place: all forces are then rounded otherwise."""
    x, y = scenario.gravity
    return replace(scenario, gravity=(x, y * (1.0 + ulps * 2.0**-52)))


@pytest.mark.parametrize(("ulps", "accuracy"), [(20.0, None), (0.0, 2e-5)])
def test_rounding_and_other_steps_are_no_change(
    ulps: float, accuracy: float | None, run: Result, kept: KeptRun
) -> None:
    scene = perturbed(rocker(), ulps)
    other = simulate(scene if accuracy is None else replace(scene, accuracy=accuracy))
    assert any(not np.array_equal(run[name], other[name]) for name in run.channels)
    found = changes(kept, kept_run(other))  # errors cover 98 of 100 numbers, here of 50
    assert len(found) <= 2
    assert all(one.ratio < 2.0 for one in found)


def test_chaos_is_compared_up_to_its_horizon() -> None:
    scene = replace(rocker(0.2, restitution=0.95, friction=0), accuracy="draft", record_period=1e-3)
    runs = [simulate(perturbed(scene, ulps)) for ulps in (0.0, 1.0, -3.0)]
    first, *others = map(kept_run, runs)
    assert first.horizon < 0.15
    assert first.numbers == {}
    # the runs are others, and nothing is reported of that
    forces = [run["pin.B.force"] for run in runs]
    assert not all(np.allclose(forces[0], force, rtol=1e-2) for force in forces[1:])
    assert [changes(first, other) for other in others] == [[], []]
    assert changes(first, kept_run(simulate(replace(scene, gravity=(0.0, -20.0)))))


@pytest.mark.parametrize(
    ("was", "now", "changed"),
    [
        ((1.0, 0.1), (1.19, 0.1), False),
        ((1.0, 0.1), (1.21, 0.1), True),
        ((1.0, 0.0), (1.0 + 1e-15, 0.0), True),
        ((1.0, 0.1), (9.0, math.inf), False),  # not known
        ((1.0, 0.1), (math.nan, 0.1), True),
        ((math.nan, 0.1), (math.nan, 0.1), False),
    ],
)
def test_what_exceeds_both_errors_has_changed(
    was: tuple[float, float], now: tuple[float, float], changed: bool
) -> None:
    runs = [
        KeptRun(
            {"mine": Estimate(value, error, "N")},
            {},
            curves={"c": ComparedColumn("N", np.arange(2.0), np.full(2, value), np.full(2, error))},
        )
        for value, error in (was, now)
    ]
    expected = {("changed", "number", "mine"), ("changed", "channel", "c")} if changed else set()
    assert told(changes(*runs)) == expected
