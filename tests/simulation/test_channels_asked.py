"""What a run records is what was asked for, with the numbers of a run that records everything."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from support_exudyn import (
    ClearancePin,
    CubicStep,
    Held,
    OilColumn,
    Result,
    Scenario,
    SolverSettings,
    Steady,
    UniformSpeed,
    bore_area,
    ravn_slider_crank,
    simulate,
)
from support_exudyn.formulations.engine_settings import engine_settings
from tests.cases.run_cases import FORCE, PIN, loose_support, support
from user_forces import JournalBearing, JournalContact, LankaraniNikravesh, LuGre

OIL = OilColumn(bore_area=bore_area(0.25, 2), oil_length=0.5, bulk_modulus=1.5e9)
OILS = {"front_column": OIL, "rear_column": OIL}
BEARING = JournalBearing(bore_radius=0.0655, clearance=0.0005)
BRISTLES = JournalContact(
    bearing=BEARING,
    normal=LankaraniNikravesh(stiffness=1e9, restitution=0.5),
    friction=LuGre(static_coefficient=0.3, sliding_coefficient=0.2),
)
GENTLE = CubicStep(stroke=0.0005, start=0.005, end=0.02)
SHORT: dict[str, Any] = {"duration": 0.025, "drive": GENTLE, "record_period": 2.5e-3}
SCENES = {
    "ideal, held": support(**SHORT | {"drive": Held()}),
    "ideal, driven": support(**SHORT),
    "ideal, struck": support(**SHORT | {"drive": UniformSpeed(stroke=0.001, start=0.006, end=0.02)}),
    "ideal, struck at once": support(**SHORT | {"drive": UniformSpeed(stroke=0.001, start=0.0, end=0.02)}),
    "ideal, growing steps": support(**SHORT, solver=SolverSettings(growth=8)),
    "oil": support(**SHORT, actuators=OILS),
    "one column of oil": support(**SHORT, actuators={"rear_column": OIL}),
    "with_clearance": loose_support(0.5, 0.25, **SHORT),
    "clearance, growing steps": loose_support(
        0.5, 0.25, **SHORT, solver=SolverSettings(growth=8), start="settled"
    ),
    "clearance, friction with a state": support(**SHORT, pins={PIN: ClearancePin(contact=BRISTLES)}),
    "slider-crank": Scenario(
        machine=ravn_slider_crank(), drive=Steady(rate=500.0), duration=0.005, step=1e-5, record_period=1e-4
    ),
    "compiled": loose_support(0.5, 0.25, **SHORT, actuators=OILS, formulation="compiled"),
    "compiled, ideal": support(**SHORT, formulation="compiled"),
}


@cache
def whole(scene: str) -> Result:
    return simulate(SCENES[scene])


@pytest.mark.parametrize(
    "scene",
    [
        pytest.param(scene, marks=[pytest.mark.slow] * (scene == "clearance, friction with a state"))
        for scene in SCENES
    ],
)
@settings(max_examples=4, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(data=st.data())
def test_any_choice_has_the_numbers_of_all(scene: str, data: st.DataObject) -> None:
    full = whole(scene)
    asked = tuple(data.draw(st.lists(st.sampled_from(list(full.channels)), max_size=4, unique=True)))
    found = simulate(replace(SCENES[scene], channels=asked))
    assert set(found.channels) == {"time", *asked}
    for name, channel in found.channels.items():
        # the same steps and the same formulas: to the last bit
        np.testing.assert_array_equal(channel.values, full[name])
        assert (channel.unit, channel.meaning) == (full.channels[name].unit, full.channels[name].meaning)
    assert found.counts == full.counts
    assert (found.onsets, found.largest_force) == (full.onsets, full.largest_force)
    assert found.impulses == full.impulses


def test_a_channel_that_was_not_recorded_is_told_from_one_that_does_not_exist() -> None:
    result = simulate(replace(SCENES["ideal, held"], channels=("tip.*",)))
    with pytest.raises(KeyError, match=r"'energy.balance': was not recorded, .* channels = \('tip\.\*',\)"):
        _ = result.energy_error
    with pytest.raises(KeyError, match=r"'energy.damping_loss': was not recorded"):
        _ = result.dissipated
    with pytest.raises(KeyError, match=r"'tip.z': no such channel"):
        _ = result["tip.z"]


def test_estimates_do_not_depend_on_what_is_asked(tmp_path: Path) -> None:
    scenario = replace(SCENES["compiled"], accuracy=1e-3)
    full, few = simulate(scenario), simulate(replace(scenario, channels=("tip.x", "shield.velocity_x")))
    assert few.numbers() == full.numbers()
    assert (few.worst_error, few.fall, few.met) == (full.worst_error, full.fall, full.met)
    assert "shield.velocity_x" in few.channels
    assert "energy.balance" not in few.channels
    assert math.isfinite(few.estimate(lambda run: run["shield.velocity_x"].max()).error)
    back = Result.load(few.save(tmp_path / "run.h5"))
    assert (back.numbers(), back.met) == (few.numbers(), few.met)
    np.testing.assert_array_equal(few[FORCE], full[FORCE])


# --- repeated steps ---


def with_iterations(most: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let Newton's method try so often only, so that it fails."""

    def fewer(*arguments: Any) -> Any:
        made = engine_settings(*arguments)
        made.timeIntegration.newton.maxIterations = most
        return made

    monkeypatch.setattr("support_exudyn.formulations.exudyn.solver.solver.engine_settings", fewer)


HASTY = support(drive=CubicStep(stroke=0.4, start=0.0, end=0.02), duration=0.05, step=0.01, record_period=0.01)


def test_repeated_steps_are_counted_and_the_run_goes_on(monkeypatch: pytest.MonkeyPatch) -> None:
    with_iterations(6, monkeypatch)
    result = simulate(HASTY)
    assert result.counts.failed_newton > 0
    # without any: five of 10 ms, of which those after both breaks are made in 32 parts
    assert result.counts.steps > 3 + 2 * 32
    np.testing.assert_array_equal(result.time, 0.01 * np.arange(6))
    assert result["front_column.length"][-1] - result["front_column.length"][0] == pytest.approx(0.4, abs=1e-9)
