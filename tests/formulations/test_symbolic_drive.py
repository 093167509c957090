"""Which drives the engine follows by itself, and that it goes where they say."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from support_exudyn import (
    CubicStep,
    Drive,
    Held,
    Reciprocating,
    Scenario,
    SimulationError,
    Steady,
    UniformSpeed,
    ravn_slider_crank,
    simulate,
)
from support_exudyn.formulations.redundant.inventory import inventory
from tests.cases.machine_cases import support
from user_forces import value

TURN = Scenario(
    machine=ravn_slider_crank(),
    drive=Steady(rate=300.0),
    duration=0.01,
    step=2e-5,
    record_period=1e-4,
    channels=("crank.*", "slider.*", "pin.*"),
)


@value
class Branching(Held):
    """Steady from a time on, when its speed jumps, but it decides by `if`."""

    def extension(self, t: float) -> float:
        """300 rad/s from 2 ms on."""
        return 300.0 * (t - 2e-3) if t > 2e-3 else 0.0

    def speed(self, t: float) -> float:
        """Its rate."""
        return 300.0 if t > 2e-3 else 0.0

    def speed_jump(self, t: float) -> float:
        """At 2 ms."""
        return 300.0 if t == 2e-3 else 0.0

    @property
    def breaks(self) -> tuple[float, ...]:
        """Where it jumps."""
        return (2e-3,)

    def span(self, duration: float) -> tuple[float, float]:
        """Up to the end."""
        return 0.0, 300.0 * duration


@value
class Swinging(Branching):
    """A function that knows numbers only."""

    def extension(self, t: float) -> float:
        """A sine."""
        return 0.1 * math.sin(100.0 * t)

    def speed(self, t: float) -> float:
        """Its rate."""
        return 10.0 * math.cos(100.0 * t)

    def speed_jump(self, t: float) -> float:
        """None."""
        return 0.0

    @property
    def breaks(self) -> tuple[float, ...]:
        """None."""
        return ()


@pytest.mark.parametrize(
    ("drive", "callbacks"),
    [
        (Steady(rate=300.0), 0),
        (CubicStep(stroke=1.0, start=2e-3, end=8e-3), 0),
        (UniformSpeed(stroke=1.0, start=2e-3, end=8e-3), 0),
        (Reciprocating(stroke=1.0, period=4e-3), 0),
        (Held(), 0),
        (Branching(), 1),
        (Swinging(), 1),
    ],
    ids=lambda item: type(item).__name__,
)
def test_cranks_need_python_only_for_drives_that_branch(drive: Drive, callbacks: int) -> None:
    # energies are not asked for
    assert inventory(_unaudited(replace(TURN, drive=drive))).callbacks == callbacks
    # the result checks asks for them: one more, but nothing works where nothing moves
    works = not isinstance(drive, Held) or callbacks
    assert inventory(replace(TURN, drive=drive)).callbacks == (callbacks + 1 if works else 0)


def test_actuators_need_python() -> None:
    rise = Scenario(machine=support(), drive=Steady(rate=0.01), duration=0.1, channels=("tip.*",))
    assert inventory(_unaudited(rise)).callbacks == 1
    assert inventory(rise).callbacks == 2


def _unaudited(scenario: Scenario) -> Scenario:
    return replace(scenario, solver=replace(scenario.solver, result_checks=False))


@pytest.mark.parametrize(
    "drive",
    [
        Steady(rate=300.0),
        CubicStep(stroke=1.0, start=2e-3, end=8e-3),
        UniformSpeed(stroke=1.0, start=2e-3, end=8e-3),
        Reciprocating(stroke=1.0, period=4e-3),
        Branching(),
    ],
    ids=lambda item: type(item).__name__,
)
def test_the_crank_is_where_the_drive_says(drive: Drive) -> None:
    result = simulate(replace(TURN, drive=drive))
    start = TURN.linkage.bodies["crank"].angle
    wanted = start + np.array([drive.extension(t) for t in result.time.tolist()])
    # Newton's method ends at 1e-8 of the first residual; rounding of a few radians is 1e-15
    np.testing.assert_allclose(result["crank.angle"], wanted, rtol=0.0, atol=1e-11)


@value
class Silent(Branching):
    """Its speed jumps, and it does not say so."""

    def speed_jump(self, t: float) -> float:
        """None is told."""
        return 0.0

    @property
    def breaks(self) -> tuple[float, ...]:
        """None is told."""
        return ()


@pytest.mark.parametrize("step", [2e-5, 2e-6])
def test_a_jump_that_a_drive_does_not_tell_is_refused_at_any_step(step: float) -> None:
    # the work is off by 21 J however short steps are; at the longer one forces just after it by a third
    with pytest.raises(SimulationError, match=r"energy does not add up.*has to say so in its `breaks`"):
        simulate(replace(TURN, drive=Silent(), step=step))


def test_python_and_the_engine_agree(monkeypatch: pytest.MonkeyPatch) -> None:
    alone = simulate(TURN)
    solver = "support_exudyn.formulations.redundant.solver.solver"
    monkeypatch.setattr(f"{solver}.turns_by_itself", lambda scene: False)
    told = simulate(TURN)
    for name in alone.channels:
        # the same product of rate and time: to the last bit
        np.testing.assert_array_equal(alone[name], told[name])
