"""A support that moves alike on both sides moves in space as it does in its plane, whichever pin it is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import Result, Scenario, SolverSettings
from support_exudyn.machines.four_bar_shield import PINS
from tests.metamorphic import drawn
from tests.metamorphic.same import EvaluationContext, Run, plain, run, scenes, sizes, told

# If both take the same steps, they have nearly all of their errors in common. Where a pair is with
# clearance its two impacts are located apart: measured 2e-6 of mean forces and 2e-5 of the motion, else 1e-7
SHARE, FORCE, NEAR = 5e-3, 2e-5, 1e-4  # of the errors, of the largest force, of the motion


@st.composite
def with_a_loose_pin(draw: st.DrawFn, pin: str) -> Scenario:
    """A support with this pin with clearance, its actuators rigid or on oil."""
    duration = drawn.MS * draw(st.integers(10, 20))
    kind = drawn.machine(draw(st.sampled_from(drawn.SUPPORTS)))
    return Scenario(
        machine=kind,
        pins={pin: draw(drawn.with_clearance(0.0655, 2.7e10, compiled=False, apart=False))},
        actuators=drawn.on_oil(kind) if draw(st.booleans()) else {},
        drive=draw(drawn.strokes(duration)),
        start=draw(st.sampled_from(("concentric", "settled"))),
        duration=duration,
        record_period=drawn.MS,
        step=1e-4,
        solver=SolverSettings(impact_steps=drawn.IMPACT_STEPS),
        formulation="exudyn",
    )


def sides(name: str) -> tuple[str, ...]:
    """Names in space of what a channel of the plane shows: of the whole, or of both sides."""
    head, _, tail = name.partition(".")
    return name, f"{head}_left.{tail}", f"{head}_right.{tail}"


def share(plane: Run, space: Result) -> float:
    """The part of the plane's error by which both may differ: all of it if they do not take the same steps."""
    return SHARE if plane.result.counts.steps == space.counts.steps else 1.0


def moves_alike(plane: Run, space: EvaluationContext, part: float) -> None:
    """Bodies are where they are in the plane, on both sides."""
    mine, size = plain(plane.result), sizes(plane.result)
    bodies = (*plane.result.scenario.linkage.bodies, "tip")
    for name in (f"{body}.{what}" for body in bodies for what in ("x", "y", "angle")):
        if name in mine:
            found = [side for side in sides(name) if side in space]
            assert found, name
            allowed = part * plane.allowed[name] + NEAR * size[plane.result.unit(name)]
            for side in found:
                off = np.abs(space[side] - mine[name]).max()
                assert off <= allowed, f"{side}: off by {off:.3g}, allowed {allowed:.3g}"


def carries_alike(plane: Run, space: EvaluationContext, part: float) -> None:
    """Pins carry at every record what they do in the plane, both sides together."""
    mine, largest = plain(plane.result), sizes(plane.result)["N"]
    for name in (f"pin.{pin}.force_{axis}" for pin in PINS for axis in "xy"):
        off = np.abs(space[name] - mine[name]).max()
        allowed = part * plane.allowed[name] + FORCE * largest
        assert off <= allowed, f"{name}: off by {off:.3g} of {largest:.3g} N, allowed {allowed:.3g}"


SLOW = ("front_shield", "rear_base")  # as the other pin of a pair, and of no pair, respectively


@pytest.mark.parametrize(
    "pin", [pytest.param(pin, marks=[pytest.mark.slow] if pin in SLOW else []) for pin in PINS]
)
@given(data=st.data())
@scenes(5)
def test_a_support_with_a_loose_pin(pin: str, data: st.DataObject) -> None:
    scene = data.draw(with_a_loose_pin(pin), label="scene")
    plane = run(scene)
    space = told(replace(scene, dimensions=3))
    moves_alike(plane, plain(space), share(plane, space))
    carries_alike(plane, plain(space), share(plane, space))
    for name, onsets in plane.result.onsets.items():
        for side in (name, f"{name}_left", f"{name}_right"):
            if side in space.onsets:
                assert len(space.onsets[side]) == len(onsets), side
