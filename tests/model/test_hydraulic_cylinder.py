"""Inlets of hydraulic cylinders, what a cylinder carries at the start, and what is refused."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import (
    ClosedInlet,
    Held,
    HydraulicCylinder,
    Inlet,
    RampedOpening,
    Scenario,
    SuddenOpening,
)
from support_exudyn.mechanics.hydraulic_legs import PreloadedLeg
from support_exudyn.model.linkage import GROUND, LinearActuator
from support_exudyn.scenario.timescales import timescales
from tests.cases.machine_cases import support
from user_forces import InputError

CYLINDER = HydraulicCylinder(
    bore_area=0.1,
    rod_side_area=0.02,
    oil_length=0.5,
    rod_side_length=1.0,
    bulk_modulus=1.5e9,
    system_pressure=30e6,
    tank_pressure=0.5e6,
    nominal_flow=6e-3,
    damping=1e4,
)
ACTUATOR = LinearActuator(foot=GROUND, head="ram", foot_point=(0.0, 0.0), head_point=(0.0, 1.6))


@pytest.mark.parametrize(
    "inlet",
    [
        ClosedInlet(),
        SuddenOpening(start=0.2, end=1.0, extent=-0.5),
        RampedOpening(start=0.2, end=1.0, ramp=0.1, extent=0.7),
        RampedOpening(start=0.0, end=1.0, ramp=0.5),
    ],
)
def test_an_inlet_jumps_at_its_breaks_and_nowhere_else(inlet: Inlet) -> None:
    tiny = 1e-9
    for t in inlet.breaks:
        before, after = inlet.opening(t - tiny), inlet.opening(t + tiny)
        # a ramp of 0.1 s opens by 1e-8 in that time
        assert inlet.opening(t) == pytest.approx(before, abs=1e-7)
        assert inlet.opening(t) + inlet.opening_jump(t) == pytest.approx(after, abs=1e-7)
    times = np.linspace(0.0, 1.2, 1201) + 0.0005
    openings = np.array([inlet.opening(t) for t in times])
    steep = np.abs(np.diff(openings)) > 0.011  # a ramp opens by 0.01 in a millisecond at most
    jumps = [t for t in inlet.breaks if inlet.opening_jump(t) != 0.0]
    assert steep.sum() == len(jumps)
    assert inlet.opening(-1.0) == inlet.opening(2.0) == 0.0


def test_wrong_inlets_are_refused() -> None:
    with pytest.raises(InputError, match=r"end = 1\.0 s: allowed: > start"):
        SuddenOpening(start=1.0, end=1.0)
    with pytest.raises(InputError, match=r"ramp = 0\.6 s: allowed: at most half of end - start, 0\.5 s"):
        RampedOpening(start=1.0, end=2.0, ramp=0.6)
    with pytest.raises(InputError, match="extent"):
        SuddenOpening(extent=1.5)


@pytest.mark.parametrize("load", [4e4, -3e4, 0.0])
def test_the_start_carries_the_load_with_one_chamber_at_tank_pressure(load: float) -> None:
    start = PreloadedLeg("jack", ACTUATOR, CYLINDER, load).pressures
    pushes = CYLINDER.bore_area * start["piston"] - CYLINDER.rod_side_area * start["rod"]
    assert pushes == pytest.approx(load, abs=1e-9)
    assert min(start.values()) == 0.5e6


@given(
    start=st.integers(0, 100),
    open_for=st.integers(20, 200),
    share=st.integers(5, 45),
    extent=st.integers(-10, 10),
)
def test_between_its_breaks_an_inlet_is_straight(start: int, open_for: int, share: int, extent: int) -> None:
    begins, ends = start / 100, (start + open_for) / 100
    inlet = RampedOpening(start=begins, end=ends, ramp=share / 100 * (ends - begins), extent=extent / 10)
    assert len(inlet.breaks) == 4
    for begin, end in pairwise((begins - 0.1, *inlet.breaks, ends + 0.1)):
        here, middle, there = (inlet.opening(t) for t in (begin, 0.5 * (begin + end), end))
        assert middle == pytest.approx(0.5 * (here + there), abs=1e-12)  # rounding of a share


def test_steps_have_to_follow_the_valve() -> None:
    assert SuddenOpening(start=0.2, end=0.5).shortest_time == pytest.approx(0.3)
    assert RampedOpening(start=0.2, end=0.9, ramp=0.15).shortest_time == 0.15
    assert ClosedInlet().shortest_time == float("inf")
    quick = replace(CYLINDER, inlet=RampedOpening(start=0.2, end=0.9, ramp=0.15))
    slow = replace(CYLINDER, inlet=SuddenOpening(start=0.2, end=0.9))
    scenario = Scenario(
        machine=support(), duration=1.0, drive=Held(), actuators={"front_column": slow, "rear_column": quick}
    )
    assert timescales(scenario).drive == pytest.approx(0.15)
