"""Inlets of hydraulic cylinders, what a cylinder carries at the start, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest

from support_exudyn import (
    ClosedInlet,
    HydraulicCylinder,
    Inlet,
    RampedOpening,
    SuddenOpening,
)
from support_exudyn.mechanics.hydraulic_legs import PreloadedLeg
from support_exudyn.model.linkage import GROUND, LinearActuator
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
