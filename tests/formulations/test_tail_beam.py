"""The tail beam as a body of its own on a jack, against the one that is fixed to the shield beam."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from studies.common.paper_machine import JACK
from support_exudyn import (
    CubicStep,
    Held,
    OwnBody,
    Result,
    UniformSpeed,
    reference_support,
    simulate,
)
from support_exudyn.model.plane_geometry import moved
from support_exudyn.postprocessing.pytest_plugin import AssertClose, SimulateCached
from tests.cases.run_cases import FORCE, support

G = 9.81
RISE = CubicStep(start=0.05, end=0.45, stroke=0.1)
RIGID = {"tail_beam": OwnBody()}
SOFT = {"tail_beam": OwnBody(jack=JACK)}


@pytest.fixture(scope="module")
def lumped(simulate_cached: SimulateCached) -> Result:
    return simulate_cached(support(drive=RISE, duration=0.5))


def test_a_rigid_jack_holds_the_tail_beam_as_if_it_were_fixed(
    lumped: Result, assert_close: AssertClose
) -> None:
    own = simulate(replace(lumped.scenario, parts=RIGID))
    assert_close(own, lumped, "1e-9 mm", channels=["tip.*"])  # rounding
    assert_close(own, lumped, "1e-12 rad", channels=["rear_link.angle"])
    np.testing.assert_allclose(np.ptp(own["tail_beam.angle"] - own["shield.angle"]), 0.0, atol=1e-12)
    off = np.abs(own[FORCE] - lumped[FORCE])
    # Newton's tolerance of 1e-8; in the steps after the drive's breaks, where joint forces overshoot, 5e-6
    assert np.median(off) < 1e-7 * lumped[FORCE].max()
    assert off.max() < 2e-5 * lumped[FORCE].max()
    for energy in ("kinetic", "potential", "work"):
        np.testing.assert_allclose(own[f"energy.{energy}"], lumped[f"energy.{energy}"], atol=1e-4)  # of 5 kJ


@pytest.mark.parametrize("parts", [RIGID, SOFT], ids=["rigid", "oil"])
def test_the_jack_carries_the_weight_about_the_hinge(parts: dict[str, OwnBody]) -> None:
    still = simulate(support(parts=parts, drive=Held(), duration=0.1))
    machine = reference_support()
    assert machine.tail_hinge is not None
    assert machine.tail_jack_foot is not None
    assert machine.tail_jack_head is not None
    start = machine.start()
    (tail,) = (part for part in machine.parts["shield"] if part.name == "tail_beam")
    hinge, foot, head, centre = (
        np.array(moved(point, machine.rear_shield, start.rear_shield, start.shield))
        for point in (machine.tail_hinge, machine.tail_jack_foot, machine.tail_jack_head, tail.centre)
    )
    u = (head - foot) / math.dist(head, foot)
    arm = head - hinge
    lever = arm[0] * u[1] - arm[1] * u[0]
    push = tail.mass * G * (centre - hinge)[0] / lever
    # Newton's tolerance of 1e-8
    np.testing.assert_allclose(still["tail_jack.force"], push, rtol=1e-7)
    pin = np.array([still["pin.shield_tail.force_x"][-1], still["pin.shield_tail.force_y"][-1]])
    np.testing.assert_allclose(pin, [0.0, tail.mass * G] - push * u, rtol=1e-6)
    # and stays where it is; rounding
    np.testing.assert_allclose(still["tail_beam.angle"], still["tail_beam.angle"][0], atol=1e-12)
    np.testing.assert_allclose(still["tip.y"], still["tip.y"][0], atol=1e-12)


def test_a_rigid_jack_takes_part_in_the_impulse_of_a_sudden_start() -> None:
    scenario = support(drive=UniformSpeed(stroke=0.05, start=0.05, end=0.25), duration=0.1)
    (one,), (rigid,), (soft,) = (
        simulate(replace(scenario, parts=parts)).impulses for parts in ({}, RIGID, SOFT)
    )
    assert sorted(rigid.actuators) == ["front_column", "rear_column", "tail_jack"]
    assert sorted(soft.actuators) == ["front_column", "rear_column"]
    # the same masses are set in motion; rounding
    for name, impulse in one.actuators.items():
        assert rigid.actuators[name] == pytest.approx(impulse, rel=1e-9)
    assert rigid.energy == pytest.approx(one.energy, rel=1e-9)
