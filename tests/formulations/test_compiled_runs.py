"""The compiled formulation: how a run in it fails, its energy balance, and the same bits everywhere."""

from __future__ import annotations

import multiprocessing
from concurrent.futures import ProcessPoolExecutor
from typing import Any

import pytest

from support_exudyn import (
    ClearancePin,
    Drive,
    Scenario,
    SimulationError,
)
from support_exudyn.sweeps.warm_up import warm_up
from tests.cases.machine_cases import contact, support
from tests.compiled_runs import simulate_compiled
from user_forces import (
    value,
)

PIN = "rear_base"
FORCE = "pin.rear_base.force"


def scene(pin: ClearancePin | None = None, **changes: Any) -> Scenario:
    fields = {"machine": support(), "duration": 0.05, "pins": {PIN: pin or ClearancePin(contact=contact())}}
    return Scenario(**fields | changes)


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
