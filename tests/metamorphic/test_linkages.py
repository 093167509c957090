"""Drawn linkages: every formulation moves them alike, and their statistics do not depend on records."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TypeVar

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import Onset, Result, Scenario
from support_exudyn.machines.check.statics import mobility
from tests.metamorphic import drawn_linkages
from tests.metamorphic.same import Run, ToldOnset, plain, run, scenes, told

BETWEEN = 2e-3  # of the largest value in a unit: what two formulations may differ by besides their errors
SLOWEST = 1e-9  # [m/s]
GRAZE = 0.05  # of the fastest impact: whether there is one so slow is for rounding to decide
AnyOnset = TypeVar("AnyOnset", Onset, ToldOnset)


def nearest(onsets: Sequence[AnyOnset], time: float) -> AnyOnset:
    """The impact that is nearest to a time [s]."""
    return min(onsets, key=lambda onset: abs(onset.time - time))


def lone_grazes(one: Run, other: Result) -> np.ndarray:
    """Which records lie in a graze that the other run alone has, (n,), where all faster impacts are in both.

    An impact may lie before the end of one run and behind that of the other.
    """
    time = one.result.time
    fastest = max((onset.speed for onsets in one.onsets.values() for onset in onsets), default=0.0)
    found = np.zeros(time.size, dtype=bool)
    for pin, theirs in other.onsets.items():
        mine = one.onsets[pin]
        way = BETWEEN * one.result.scenario.clearance_pins[pin].contact.bearing.clearance
        for onset in theirs:
            late = way / max(onset.speed, SLOWEST)  # a journal that is so far elsewhere comes so much later
            same = nearest(mine, onset.time) if mine else None
            if same and abs(same.time - onset.time) <= same.time_off + late:
                off = abs(same.speed - onset.speed)
                assert off <= same.speed_off + BETWEEN * fastest, f"{pin}: {onset}, {same}"
                continue
            behind = onset.time > time[-1] - late
            assert onset.speed <= GRAZE * fastest or behind, f"{pin}: {onset} is none of {mine}"
            found |= (time >= onset.time) & (time <= onset.separation_time)
        for same in mine:
            late = same.time_off + way / max(same.speed, SLOWEST)
            if same.speed > GRAZE * fastest and same.time < time[-1] - late:
                assert theirs, f"{pin}: {same} is none"
                assert abs(nearest(theirs, same.time).time - same.time) <= late, f"{pin}: {same} of {theirs}"
    return found


def compare(scene: Scenario, other: Result, finer: float) -> None:
    """The Exudyn formulation at steps so many times shorter shows the same as another run of a scene."""
    one = run(replace(scene, formulation="exudyn").refined(finer))
    records = one.determined() & ~lone_grazes(one, other)
    assert 2 * records.sum() > records.size
    # the impact velocity jumps to 0 at a separation, which may lie on either side of a record
    others = {name: values for name, values in plain(other).items() if not name.endswith("impact_velocity")}
    one.check(others, rounding=BETWEEN, records=records)


@given(scene=drawn_linkages.opened())
@scenes(24)  # 8 of them by hand
def test_both_formulations_move_a_linkage_alike(scene: Scenario) -> None:
    assert mobility(scene.linkage).free == 1
    other = told(scene)
    try:
        compare(scene, other, 2.0)
    except AssertionError:  # an error that is told too small by chance shrinks with the steps
        compare(scene, other, 8.0)


@given(scene=drawn_linkages.driven(), formulation=st.sampled_from(("compiled", "exudyn")))
@scenes(12)
def test_statistics_do_not_depend_on_records(scene: Scenario, formulation: str) -> None:
    # of the Exudyn formulation records cut steps, whose errors impacts multiply: without them
    pins = scene.pins if formulation == "compiled" else {}
    scene = replace(scene, formulation=formulation, pins=pins)  # type: ignore[arg-type]
    fine, coarse = (told(replace(scene, record_period=one)) for one in (2e-5, scene.duration / 3.0))
    share = 1e-9 if formulation == "compiled" else 2e-3
    for name in [name for name in fine.channels if name.endswith((".force", ".angular_acceleration"))]:
        one, other = (run.window(name, 1e-3, scene.duration) for run in (fine, coarse))
        size = one.largest[0] + 1e-6
        assert [one.mean, one.std, one.least[0], one.greatest[0]] == pytest.approx(
            [other.mean, other.std, other.least[0], other.greatest[0]], rel=share, abs=share * size
        )
        inside = fine.time >= 1e-3 - 1e-9  # 500 fine records and more are a curve
        mean = np.trapezoid(fine[name][inside], fine.time[inside]) / np.ptp(fine.time[inside])
        assert abs(one.mean - mean) <= 2e-3 * size, name
