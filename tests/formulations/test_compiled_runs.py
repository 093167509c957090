"""The compiled formulation: how a run in it fails, its energy balance, and the same bits everywhere."""

from __future__ import annotations

import multiprocessing
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from support_exudyn import (
    ClearancePin,
    CubicStep,
    Drive,
    Held,
    Scenario,
    SimulationError,
    UniformSpeed,
)
from support_exudyn.sweeps.warm_up import warm_up
from tests.cases.machine_cases import contact, support
from tests.compiled_runs import simulate_compiled
from user_forces import (
    Exact,
    Hertz,
    JournalBearing,
    JournalContact,
    value,
)

PIN = "rear_base"
FORCE = "pin.rear_base.force"


def scene(pin: ClearancePin | None = None, **changes: Any) -> Scenario:
    fields = {"machine": support(), "duration": 0.05, "pins": {PIN: pin or ClearancePin(contact=contact())}}
    return Scenario(**fields | changes)


def hertz(stiffness: float) -> ClearancePin:
    bearing = JournalBearing(bore_radius=0.0655, clearance=0.0015)
    return ClearancePin(contact=JournalContact(bearing=bearing, normal=Hertz(stiffness=stiffness)))


# --- failures ---


@value
class Untold(Drive):
    """A drive that jumps at a time that is none of its breaks."""

    at: float = 0.03

    def extension(self, t: float) -> float:
        return 0.01 * (t > self.at)

    def speed(self, t: float) -> float:
        return 0.0

    @property
    def breaks(self) -> tuple[float, ...]:
        return ()

    def span(self, duration: float) -> tuple[float, float]:
        return 0.0, 0.01


def test_a_jump_of_a_drive_at_no_break_is_refused() -> None:
    with pytest.raises(SimulationError, match=r"jumps by .* near 0\.(03|02999)"):
        simulate_compiled(scene(drive=Untold()))


def test_a_support_that_falls_through_its_pin_is_refused() -> None:
    with pytest.raises(SimulationError) as caught:
        simulate_compiled(scene(hertz(1e3), duration=5.0))
    failure = caught.value.failure
    assert "deep in a bore of 65.5 mm radius" in failure.reason
    assert 0.5 < failure.time < 2.0  # a fall of metres


@pytest.mark.parametrize(
    ("law", "bore", "drive"),
    [
        (Hertz(stiffness=2.7e10), "first", CubicStep(stroke=0.05, start=0.05, end=0.25)),
        (Hertz(stiffness=2.7e10), "second", UniformSpeed(stroke=0.02, start=0.05, end=0.2)),
        (Exact(stiffness=2.7e10, restitution=0.6), "first", UniformSpeed(stroke=0.02, start=0.05, end=0.2)),
        (Exact(stiffness=2.7e10, restitution=0.6), "second", Held()),
    ],
)
def test_energy_adds_up(law: Hertz | Exact, bore: str, drive: Drive) -> None:
    pin = ClearancePin(contact=replace(contact(), normal=law), bore=bore)
    result = simulate_compiled(scene(pin, duration=0.3, gravity=(2.0, -9.0), drive=drive), 1e-10)
    # measured 3e-7 at this tolerance, in proportion to it; friction's kinks leave the most
    assert result.dissipated > 1.0
    assert result.energy_error < 1e-6 * result.dissipated
    assert (np.abs(result["energy.work"]).max() > 100.0) == (not isinstance(drive, Held))


# --- the same numbers everywhere ---


def _bytes() -> bytes:
    result = simulate_compiled(scene(duration=0.2))
    return b"".join(channel.values.tobytes() for channel in result.channels.values())


def test_runs_are_the_same_bit_for_bit_also_in_another_process() -> None:
    warm_up(with_legs=False)
    here = _bytes()
    assert _bytes() == here
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        assert pool.submit(_bytes).result() == here


def test_records_do_not_change_the_run() -> None:
    coarse = simulate_compiled(scene(duration=0.2, record_period=0.1))
    fine = simulate_compiled(scene(duration=0.2, record_period=1e-4))
    assert coarse.onsets == fine.onsets
    assert coarse[FORCE][-1] == fine[FORCE][-1]
