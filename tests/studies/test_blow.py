"""Blows: supports that stand still until they are struck, and what is measured of them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from studies.blow import run as study
from studies.blow.blows import BEFORE, BLOWS, MACHINES, PINS, PLACES, STRIKE, Blow, all_blows, yield_valve
from studies.blow.run import MEASURES
from studies.common.options import Options
from support_exudyn import SolverSettings, simulate

TIP = Blow("reference", "tip", 2.0, 0.5, "ideal", valve=True)


def test_all_is_crossed_but_masses_and_heights() -> None:
    found = all_blows()
    assert len(set(found)) == len(found) == 2 * len(MACHINES) * len(PLACES) * len(BLOWS) * len(PINS)
    assert set(all_blows(small=True)) < set(found)


@pytest.mark.parametrize("height", [0.2, 0.5, 2.0])
def test_every_block_strikes_in_time_with_the_speed_of_its_fall(height: float) -> None:
    block = replace(TIP, height=height).block()
    assert block.speed + 9.81 * STRIKE == pytest.approx(np.sqrt(2.0 * 9.81 * height), rel=1e-12)
    assert block.speed * STRIKE + 0.5 * 9.81 * STRIKE**2 == pytest.approx(block.height, rel=1e-12)


@pytest.mark.parametrize("pins", PINS)
def test_a_support_stands_still_until_it_is_struck(pins: str) -> None:
    blow = replace(TIP, pins=pins)
    run = simulate(replace(blow.scenario(), accuracy=None))
    before = run.time < STRIKE - BEFORE
    assert run["block.force"][before].max() == 0.0
    for name in ("front_column", "rear_column"):
        pressure = run[f"{name}.pressure"][before]
        assert np.ptp(pressure) < 0.01 * pressure[0]
    assert 1e6 * 30 < run["front_column.pressure"][0] < yield_valve("reference").opening_pressure
    pressure, flow, tilt = (MEASURES[name][1](run) for name in ("pressure", "flow", "tilt"))
    assert 1e6 * pressure > yield_valve("reference").opening_pressure  # the valve opens
    assert flow > 0.0
    assert tilt < 0.0  # forward
    # in its first contact the block gives all of its momentum, and twice of it at the most
    first = run.time < STRIKE + 0.05
    momentum = float(np.trapezoid(run["block.force"][first], run.time[first]))
    assert 1.0 < momentum / (2e3 * np.sqrt(2.0 * 9.81 * 0.5)) < 2.0


def test_a_law_that_wavers_between_pressure_and_tension_does_not_hold_up_a_blow() -> None:
    # five loose pins: 73 867 steps if each is cut where a law begins or ceases to ask for tension
    scene = Blow("reference", "between", 2.0, 0.5, "all", valve=True).scenario()
    run = simulate(replace(scene, accuracy=None, duration=0.06, solver=SolverSettings(tolerance=1e-5)))
    finer = simulate(replace(scene, accuracy=None, duration=0.06, solver=SolverSettings(tolerance=1e-7)))
    assert run.counts.steps < 20_000
    for name in ("front_column.pressure", "pin.rear_base.force"):
        np.testing.assert_allclose(run[name], finer[name], atol=1e-3 * np.abs(finer[name]).max())


@pytest.mark.slow
def test_the_small_form_makes_a_chapter(tmp_path: Path) -> None:
    chapter = study.BlowStudy(Options(out=tmp_path, workers=2, runs=1)).write()
    assert (tmp_path / "peaks.png").is_file()
    assert not any(text.strip() == "" for text in (chapter.answer, *chapter.findings))
