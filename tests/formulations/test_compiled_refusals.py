"""The compiled formulation: what it refuses, how a run in it fails, peaks, and the same bits everywhere."""

from __future__ import annotations

import importlib
import math
import multiprocessing
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from support_exudyn import (
    ClearancePin,
    CubicStep,
    Drive,
    Held,
    IdealPin,
    Scenario,
    SimulationError,
    UniformSpeed,
    simulate,
)
from support_exudyn.formulations.compilation import compiled_law, plain
from support_exudyn.formulations.compiled import recording
from support_exudyn.formulations.time_grid import record_times
from support_exudyn.sweeps.precompile import precompile
from tests.cases.machine_cases import contact, support
from tests.compiled_runs import simulate_compiled
from user_forces import (
    Exact,
    FrictionLaw,
    Hertz,
    InputError,
    JournalBearing,
    JournalContact,
    LankaraniNikravesh,
    NormalLaw,
    value,
)
from user_forces.compilation.flat import law_source
from user_forces.expressions.scalar import power

PIN = "rear_base"
FORCE = "pin.rear_base.force"


def scene(pin: ClearancePin | None = None, **changes: Any) -> Scenario:
    fields = {"machine": support(), "duration": 0.05, "pins": {PIN: pin or ClearancePin(contact=contact())}}
    return Scenario(**fields | changes)


def hertz(stiffness: float) -> ClearancePin:
    bearing = JournalBearing(bore_radius=0.0655, clearance=0.0015)
    return ClearancePin(contact=JournalContact(bearing=bearing, normal=Hertz(stiffness=stiffness)))


# --- what is refused ---


@value
class Softened(LankaraniNikravesh):
    """A law whose force is no longer that of its family."""

    def elastic_force(self, depth: float) -> float:
        return 0.5 * super().elastic_force(depth)

    def elastic_energy(self, depth: float) -> float:
        return 0.5 * super().elastic_energy(depth)


@value
class Branching(LankaraniNikravesh):
    """A law that branches on its arguments."""

    def __call__(self, depth: float, rate: float, impact_velocity: float) -> float:
        return super().__call__(depth, rate, impact_velocity) if rate > 0.0 else self.elastic_force(depth)


@value
class ByMath(LankaraniNikravesh):
    """A law whose elastic part takes floats alone."""

    def __call__(self, depth: float, rate: float, impact_velocity: float) -> float:
        return self.stiffness * power(depth, 1.5)

    def elastic_force(self, depth: float) -> float:
        return self.stiffness * math.pow(depth, 1.5)


@value
class BranchingFriction(FrictionLaw):
    """A friction law that branches on its arguments."""

    def __call__(self, slip: float, normal_force: float, deflection: float = 0.0) -> float:
        return -0.1 * normal_force * slip if abs(slip) < 1.0 else 0.0


Case = tuple[Callable[[], Scenario], str, str]  # scenario, backend, what the message says
REFUSED: dict[str, Case] = {
    "symbolic": (scene, "symbolic", "solver.backend = 'symbolic'"),
    "python": (scene, "python", "solver.backend = 'python'.*'auto', 'compiled'"),
    "a law that branches": (
        lambda: scene(pin_with(Branching(stiffness=1e10, restitution=0.5))),
        "auto",
        "pins.rear_base.contact = Branching, which cannot be written out as a formula .*`where`",
    ),
    "an elastic part that needs floats": (
        lambda: scene(pin_with(ByMath(stiffness=1e10, restitution=0.5))),
        "compiled",
        "pins.rear_base.contact = ByMath, which cannot be written out",
    ),
    "a friction law that branches": (
        lambda: scene(ClearancePin(contact=replace(contact(), friction=BranchingFriction()))),
        "auto",
        "pins.rear_base.contact = BranchingFriction, which",
    ),
}


def pin_with(law: NormalLaw) -> ClearancePin:
    return ClearancePin(contact=replace(contact(), normal=law))


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_not_covered_is_refused(case: str) -> None:
    make, backend, what = REFUSED[case]
    with pytest.raises(InputError, match=what) as caught:
        simulate_compiled(make(), backend=backend)
    assert "allowed:" in str(caught.value)
    assert str(caught.value).endswith("formulation = 'exudyn' covers it.")


def test_a_changed_law_is_not_taken_for_one_of_its_family() -> None:
    softened = simulate_compiled(scene(pin_with(Softened(stiffness=1e10, restitution=0.5))))
    original = simulate_compiled(scene(pin_with(LankaraniNikravesh(stiffness=1e10, restitution=0.5))))
    assert softened.counts.user_function_calls == original.counts.user_function_calls == 0
    assert softened.largest_force[PIN] < 0.9 * original.largest_force[PIN]


def test_laws_that_differ_in_numbers_alone_are_compiled_once() -> None:
    one, other = (
        law_source(pin_with(Softened(stiffness=stiffness, restitution=0.5)).contact)
        for stiffness in (1e10, 2e10)
    )
    assert one[0] == other[0]
    assert one[1] != other[1]
    assert compiled_law(one[0]) is compiled_law(other[0])


@pytest.mark.parametrize("law", [Branching, ByMath])
def test_a_law_that_cannot_be_compiled_is_left_to_the_redundant_formulation(
    law: type[LankaraniNikravesh],
) -> None:
    scenario = scene(pin_with(law(stiffness=1e10, restitution=0.5)), duration=0.01)
    result = simulate(scenario, accuracy="draft")
    assert result.scenario.formulation == "exudyn"
    assert result.counts.user_function_calls > 0


@pytest.mark.parametrize("tolerance", [0.0, -1e-7, 0.1, float("nan")])
def test_a_tolerance_that_makes_no_sense_is_refused(tolerance: float) -> None:
    with pytest.raises(InputError, match="tolerance"):
        simulate_compiled(scene(), tolerance)


def test_a_pin_may_be_said_to_be_ideal() -> None:
    said = simulate_compiled(scene(pins={PIN: IdealPin()}))
    unsaid = simulate_compiled(scene(pins={}))
    np.testing.assert_array_equal(said[FORCE], unsaid[FORCE])
    assert said.onsets == {}
    assert said.largest_force == {}


def test_an_unknown_channel_is_named() -> None:
    with pytest.raises(KeyError, match="no such channel"):
        simulate_compiled(scene(pins={}))["pin.front_base.depth"]


# --- failures ---


def test_a_support_that_falls_through_its_pin_is_refused() -> None:
    with pytest.raises(SimulationError) as caught:
        simulate_compiled(scene(hertz(1e3), duration=5.0))
    failure = caught.value.failure
    assert "deep in a bore of 65.5 mm radius" in failure.reason
    assert 0.5 < failure.time < 2.0  # a fall of metres


def test_a_run_with_too_many_steps_is_given_up() -> None:
    with pytest.raises(SimulationError, match="more than 10 steps") as caught:
        simulate_compiled(scene(), most_steps=10)
    assert 0.0 < caught.value.failure.time < 0.05


def test_a_run_with_too_many_touches_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    module = importlib.import_module("support_exudyn.formulations.compiled.run")
    monkeypatch.setattr(module, "MOST_IMPACTS", 1)
    with pytest.raises(SimulationError, match="more than 1 impacts"):
        simulate_compiled(scene(hertz(1e10), duration=0.3))


def test_progress_rises_to_one() -> None:
    told: list[float] = []
    simulate_compiled(scene(), progress=told.append)
    assert told == sorted(told)
    assert told[-1] == 1.0
    assert all(0.0 < share <= 1.0 for share in told)


def test_records_are_multiples_of_the_period_and_the_end() -> None:
    np.testing.assert_array_equal(record_times(1.0, 0.25), [0.0, 0.25, 0.5, 0.75, 1.0])
    np.testing.assert_allclose(record_times(1.0, 0.3), [0.0, 0.3, 0.6, 0.9, 1.0], rtol=1e-15)
    assert record_times(0.3, 0.1)[-1] == 0.3
    assert record_times(5.0, 1e-3).size == 5001


@pytest.mark.parametrize("bore", ["first", "second"])
@pytest.mark.parametrize("law", [Hertz(stiffness=2.7e10), Exact(stiffness=2.7e10, restitution=0.6)], ids=str)
@pytest.mark.parametrize(
    "drive",
    [Held(), CubicStep(stroke=0.05, start=0.05, end=0.25), UniformSpeed(stroke=0.02, start=0.05, end=0.2)],
    ids=lambda drive: type(drive).__name__,
)
def test_energy_adds_up(law: Hertz | Exact, bore: str, drive: Drive) -> None:
    pin = ClearancePin(contact=replace(contact(), normal=law), bore=bore)
    result = simulate_compiled(scene(pin, duration=0.3, gravity=(2.0, -9.0), drive=drive), 1e-10)
    # measured 3e-7 at this tolerance, in proportion to it; friction's kinks leave the most
    assert result.dissipated > 1.0
    assert result.energy_error < 1e-6 * result.dissipated
    assert (np.abs(result["energy.work"]).max() > 100.0) == (not isinstance(drive, Held))


# --- the largest force ---


def bend(top: float, x: float) -> float:
    """A force that is largest, 1 N, at a share of a step."""
    return 1.0 - (x - top) ** 2


def peak(top: float, largest: float) -> tuple[float, float]:
    contact = SimpleNamespace(largest=largest, normal=0.0, friction=0.0)
    scene = SimpleNamespace(contacts=[contact])

    def look(scene: Any, n: int, x: float, path: Any, y: Any, slope: Any, forced: bool) -> None:
        contact.normal = bend(top, x)

    found: tuple[float, float] = plain(recording.peak, look=look)(scene, 0, None, bend(top, 1.0), None, None)
    return found


@pytest.mark.parametrize("top", [0.01, 0.06, 0.0625, 0.07, 0.5, 0.93, 0.9375, 0.99])
def test_the_largest_force_is_found_wherever_it_lies_in_a_step(top: float) -> None:
    largest, at = peak(top, 0.0)
    assert largest == pytest.approx(1.0, rel=1e-12)  # flat on top: off by the square of what the place is
    assert at == pytest.approx(top, abs=1e-6)
    # far below what has been before nothing is looked for
    assert peak(top, 10.0)[0] in (10.0, pytest.approx(1.0, abs=4e-3))


# --- the same numbers everywhere ---


def _bytes() -> bytes:
    result = simulate_compiled(scene(duration=0.2))
    return b"".join(channel.values.tobytes() for channel in result.channels.values())


def test_runs_are_the_same_bit_for_bit_also_in_another_process() -> None:
    precompile()
    here = _bytes()
    assert _bytes() == here
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        assert pool.submit(_bytes).result() == here


def test_records_do_not_change_the_run() -> None:
    coarse = simulate_compiled(scene(duration=0.2, record_period=0.1))
    fine = simulate_compiled(scene(duration=0.2, record_period=1e-4))
    assert coarse.onsets == fine.onsets
    assert coarse[FORCE][-1] == fine[FORCE][-1]
