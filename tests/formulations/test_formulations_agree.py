"""The same scenario by the engine and by the compiled formulation: numbers that agree."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from support_exudyn import (
    ClearancePin,
    CubicStep,
    Held,
    OilColumn,
    Reciprocating,
    Result,
    Scenario,
    SolverSettings,
    UniformSpeed,
    bore_area,
    simulate,
)
from tests.cases.run_cases import (
    PIN,
    SLIDER_PIN,
    loose_slider_crank,
    loose_support,
    paper_contact,
    slider_crank_contact,
    support,
)

OIL = OilColumn(bore_area=bore_area(0.25, number=2), oil_length=0.5, bulk_modulus=1.5e9)
BOTH = {"front_column": OIL, "rear_column": OIL}
RISE = CubicStep(stroke=0.02, start=0.02, end=0.1)


def pressed_apart(clearance_mm: float, mu: float, bore: str) -> dict[str, ClearancePin]:
    """The support's clearance pin, damped by its depth and losing half of the speed of an impact."""
    base = paper_contact(clearance_mm, mu)
    law = replace(base.normal, restitution=0.5)
    return {PIN: ClearancePin(contact=replace(base, normal=law), bore=bore)}


def turning(mu: float, bore: str) -> Scenario:
    pin = ClearancePin(contact=slider_crank_contact(mu), bore=bore)
    return replace(loose_slider_crank(2e-3, gravity=(0.0, -9.81)), pins={SLIDER_PIN: pin})


SCENES = {
    "drop": loose_support(drive=Held(), duration=0.06),
    "drop, friction, bore in the link": support(
        drive=Held(), duration=0.06, pins=pressed_apart(1.0, 0.25, "second")
    ),
    "rise": support(drive=RISE, duration=0.08, pins=pressed_apart(1.0, 0.0, "first")),
    "sudden rise": loose_support(0.5, 0.1, drive=UniformSpeed(stroke=0.02, start=0.02, end=0.1), duration=0.06),
    "ideal rise": support(drive=RISE, duration=0.12),
    "ideal, up and down": support(drive=Reciprocating(stroke=0.02, period=0.1), duration=0.1),
    "up and down": loose_support(1.0, drive=Reciprocating(stroke=0.02, period=0.1), duration=0.06),
    "slider-crank": turning(0.0, "first"),
    "slider-crank, friction, bore in the rod": turning(0.1, "second"),
}
ON_OIL = {
    "drop on oil": loose_support(1.0, 0.25, drive=Held(), duration=0.05, actuators=BOTH),
    "rise on oil": loose_support(1.0, 0.0, drive=RISE, duration=0.06, actuators=BOTH),
    "up and down on oil": loose_support(
        1.0, drive=Reciprocating(stroke=0.02, period=0.1), duration=0.06, actuators=BOTH
    ),
    "rise on oil, damped by depth": support(
        drive=RISE, duration=0.12, actuators=BOTH, pins=pressed_apart(1.0, 0.0, "first")
    ),
}
WAYS = {  # with settings that are ten times as fine as what is asserted needs
    "exudyn": {"formulation": "exudyn", "solver": SolverSettings(impact_steps=512)},
    "compiled": {"formulation": "compiled", "solver": SolverSettings(tolerance=1e-9)},
}
STEPS = {"slider-crank": 1e-6, "slider-crank, friction, bore in the rod": 1e-6}  # others: 0.1 ms


@cache
def run(scene: str, way: str) -> Result:
    scenario = replace((SCENES | ON_OIL)[scene], step=STEPS.get(scene, 1e-4), **WAYS[way])  # type: ignore[arg-type]
    return simulate(scenario)


PAIRS = [(scene, "compiled", "exudyn") for scene in (*SCENES, *ON_OIL)]
# of which every part is in another scene, too
SLOW = ("up and down", "slider-crank", "rise on oil, damped by depth")
EVERY_PAIR = pytest.mark.parametrize(
    "pair",
    [
        pytest.param(pair, marks=[pytest.mark.slow] if pair[0] in SLOW and "exudyn" in pair else [])
        for pair in PAIRS
    ],
    ids=", ".join,
)


def closeness(first: str, second: str) -> float:
    """How well two ways agree: two methods of error control, or one with fixed steps of second order."""
    # 1e-9 times what three to five impacts make of it; steps of 1/170 of a flight and 512 an impact
    return 1e-3 if "exudyn" in (first, second) else 2e-6


@EVERY_PAIR
def test_channels_are_the_same(pair: tuple[str, str, str]) -> None:
    scene, *ways = pair
    one, other = (run(scene, way) for way in ways)
    assert [(n, c.unit, c.meaning) for n, c in one.channels.items()] == [
        (n, c.unit, c.meaning) for n, c in other.channels.items()
    ]
    np.testing.assert_array_equal(one.time, other.time)
    assert set(one.onsets) == set(other.onsets)
    assert set(one.largest_force) == set(other.largest_force)


@EVERY_PAIR
def test_touches_are_the_same(pair: tuple[str, str, str]) -> None:
    scene, *ways = pair
    one, other = (run(scene, way) for way in ways)
    close = closeness(*ways)
    for pin, onsets in one.onsets.items():
        assert len(onsets) == len(other.onsets[pin]) >= 2
        fastest = max(onset.speed for onset in onsets)
        for mine, theirs in zip(onsets, other.onsets[pin], strict=True):
            # of the run's length; the sixth impact of the rise measured 0.5 of it
            assert mine.time == pytest.approx(theirs.time, abs=close * one.time[-1])
            # late impacts are slow, and off by what the fast ones before them left
            assert mine.speed == pytest.approx(theirs.speed, abs=5.0 * close * fastest)
        assert one.largest_force[pin] == pytest.approx(other.largest_force[pin], rel=close)
    assert len(one.impulses) == len(other.impulses)
    for struck, theirs in zip(one.impulses, other.impulses, strict=True):
        assert struck.time == theirs.time
        assert struck.energy == pytest.approx(theirs.energy, rel=close)


@EVERY_PAIR
def test_means_and_spreads_are_the_same(pair: tuple[str, str, str]) -> None:
    scene, *ways = pair
    one, other = (run(scene, way) for way in ways)
    close = closeness(*ways)
    sizes: dict[str, float] = {}  # largest value in each unit
    for channel in other.channels.values():
        largest = float(np.abs(channel.values).max())
        sizes[channel.unit] = max(sizes.get(channel.unit, 0.0), largest)
    # a record at a break of the drive is of before it in one run and of after it in the other
    first = 1 if 0.0 in one.scenario.breaks else 0
    for name in one.channels:
        if name == "energy.balance":  # nothing but errors
            continue
        mine, theirs = one[name][first:], other[name][first:]
        size = float(np.abs(other[name]).max())
        # less than this share of the largest in its unit is rounding, which steps of 1 us show in accelerations
        rounding = 1e-6 if "exudyn" in ways else 1e-8
        allowed = close * size + rounding * sizes[one.channels[name].unit]
        assert abs(mine.mean() - theirs.mean()) <= allowed, name
        # a record beside an impact may be before it in one run and after it in the other
        assert abs(mine.std() - theirs.std()) <= 5.0 * allowed, name


@EVERY_PAIR
def test_energies_are_the_same_and_add_up(pair: tuple[str, str, str]) -> None:
    scene, *ways = pair
    one, other = (run(scene, way) for way in ways)
    close = closeness(*ways)
    turned = max(float(np.ptp(one["energy.kinetic"])), float(np.ptp(one["energy.potential"])))
    for name in ("kinetic", "potential", "elastic", "damping_loss", "friction_loss", "work"):
        last = [result[f"energy.{name}"][-1] for result in (one, other)]
        assert last[0] == pytest.approx(last[1], abs=5.0 * close * turned), name
    for result, way in ((one, ways[0]), (other, ways[1])):
        # trapezoids over fixed steps of work and losses; quadrature as good as the steps
        share = 1e-3 if way == "exudyn" else 1e-5
        assert result.energy_error <= share * turned, way


@pytest.mark.parametrize(
    "scene",
    [
        pytest.param("rise", marks=pytest.mark.slow),
        pytest.param("slider-crank, friction, bore in the rod", marks=pytest.mark.slow),
        "rise on oil",
    ],
)
def test_runs_to_an_accuracy_agree_within_what_they_say(scene: str) -> None:
    scenario = (SCENES | ON_OIL)[scene]
    runs = [
        simulate(replace(scenario, formulation=name), accuracy="standard") for name in ("exudyn", "compiled")
    ]
    assert all(result.met for result in runs)
    one, other = (result.numbers() for result in runs)
    assert set(one) == set(other)
    within = [abs(one[name].value - other[name].value) <= one[name].error + other[name].error for name in one]
    # an estimate covers 95 of 100; those of a scene hang together
    assert np.mean(within) >= 0.9
    for pin in scenario.machine.linkage().pins:
        for word in ("mean", "std", "largest"):
            name = f"pin.{pin}.force.{word}"
            # each may be off by a thousandth
            assert one[name].value == pytest.approx(other[name].value, rel=2e-3), name
