"""Which channels a scenario asks for, and what of a run they need."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from support_exudyn import Scenario, SolverSettings
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.channels import EVERYTHING, DataNeeds, chosen
from support_exudyn.mechanics.observed_run import Trajectory
from support_exudyn.scenario.recorded_channels import channels, needs
from tests.cases.machine_cases import support
from user_forces import InputError

SUPPORT = support()
PLAIN = Scenario(machine=SUPPORT, duration=1.0)
NAMES = list(PLAIN.channel_definitions)


def scenario(*asked: str, **changes: Any) -> Scenario:
    """Without result checks, which looks at everything."""
    fields = {
        "machine": SUPPORT,
        "duration": 1.0,
        "channels": asked,
        "solver": SolverSettings(result_checks=False),
    }
    return Scenario(**fields | changes)


def names(one: Scenario) -> list[str]:
    return chosen(one.channel_definitions, one.channels)


def test_all_are_asked_for_unless_said_otherwise() -> None:
    assert PLAIN.channels == ("*",)
    assert names(PLAIN) == NAMES
    assert needs(PLAIN) == EVERYTHING
    assert len(NAMES) == len(set(NAMES))


def test_a_pattern_asks_for_what_it_matches_and_time_is_always_there() -> None:
    assert names(scenario("tip.*")) == ["time", "tip.x", "tip.y"]
    assert names(scenario("tip.y", "tip.?")) == ["time", "tip.x", "tip.y"]
    assert names(scenario("pin.rear_base.force")) == ["time", "pin.rear_base.force"]
    assert names(scenario()) == ["time"]
    assert names(scenario("time")) == ["time"]
    assert names(scenario("[!pe]*")) == [name for name in NAMES if name[0] not in "pe"]


@pytest.mark.parametrize("wrong", ["pin.rear_bse.*", "Tip.*", "tip", "", "pin.rear_base.depth"])
def test_a_pattern_that_matches_nothing_is_refused(wrong: str) -> None:
    with pytest.raises(InputError) as caught:
        scenario("tip.*", wrong)
    said = str(caught.value)
    assert said.startswith(
        f"Scenario: channels = {wrong!r}: matches no channel; allowed: names of channels, or "
    )
    assert any(name in said for name in NAMES[1:])  # what is near, or the first of them


@pytest.mark.parametrize("name", NAMES)
def test_what_is_needed_is_enough(name: str) -> None:
    """Every channel follows from the parts that it says, all others being without columns or entries."""
    one = scenario(name)
    linkage, part = one.linkage, needs(one)
    rows = 3

    def motion(which: DataNeeds) -> np.ndarray:
        return np.ones((rows, 3 * len(linkage.bodies) if which in part else 0))

    def named(known: object, shape: tuple[int, ...]) -> dict[str, np.ndarray]:
        return {key: np.ones(shape) for key in known} if DataNeeds.JOINTS in part else {}  # type: ignore[attr-defined]

    integral = np.ones(rows if DataNeeds.INTEGRALS in part else 0)
    run = Trajectory(
        linkage=linkage,
        gravity=one.gravity,
        time=np.arange(rows, dtype=float),
        motion=BodyMotion(linkage, motion(DataNeeds.POSITION), motion(DataNeeds.VELOCITY)),
        acceleration=motion(DataNeeds.ACCELERATION),
        pins=named(linkage.pins, (rows, 2)),
        actuators=named(linkage.actuators, (rows,)),
        work=integral,
        damping_loss=integral,
        friction_loss=integral,
    )
    assert channels(one, run)[name].values.shape == (rows,)
