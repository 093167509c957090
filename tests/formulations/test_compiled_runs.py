"""The compiled formulation: its own accuracy, how runs in it fail, and the same bits everywhere."""

from __future__ import annotations

import math
import multiprocessing
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from support_exudyn import (
    Body,
    ClearancePin,
    CubicStep,
    Drive,
    Held,
    Linkage,
    OilColumn,
    PlanarLinkage,
    Reciprocating,
    Result,
    Scenario,
    SimulationError,
    SolverSettings,
    bore_area,
)
from support_exudyn.model.linkage import GROUND, pinned
from support_exudyn.sweeps.warm_up import warm_up
from tests.cases.law_cases import BEARING, cylinder_law, kind_of
from tests.cases.run_cases import FORCE, PIN, loose_support, paper_contact, support
from tests.compiled_runs import simulate_compiled, simulate_on_exudyn
from user_forces import (
    BrownMcPhee,
    Flores,
    FrictionLaw,
    Johnson,
    JournalBearing,
    JournalContact,
    friction_law,
    value,
)

OIL = OilColumn(bore_area=bore_area(0.25, number=2), oil_length=0.5, bulk_modulus=1.5e9)
BOTH = ("front_column", "rear_column")


def drop(duration: float = 0.042, **laws: Any) -> Scenario:
    """The journal falls from the middle of its bore and impacts twice or three times."""
    pin = ClearancePin(contact=replace(paper_contact(1.5, 0.0), **laws))
    solver = SolverSettings(impact_steps=512)
    return replace(loose_support(drive=Held(), duration=duration, solver=solver), pins={PIN: pin})


# --- its own accuracy ---


@cache
def rise(tolerance: float) -> Result:
    """A short rise on oil, with friction, that begins in the middle of the impacts."""
    scene = loose_support(
        1.5,
        0.25,
        actuators=dict.fromkeys(BOTH, OIL),
        drive=CubicStep(start=0.03, end=0.4, stroke=0.05),
        duration=0.2,
    )
    return simulate_compiled(scene, tolerance)


def test_errors_fall_with_the_tolerance_and_energy_adds_up() -> None:
    exact = rise(1e-11)

    def off(tolerance: float) -> float:
        return float(np.abs(rise(tolerance)["rear_link.angle"] - exact["rear_link.angle"]).max())

    # impacts amplify errors a hundredfold and more, but in proportion; a kink of friction that is met elsewhere
    # in a step makes up to a factor of ten
    assert off(1e-9) < 0.05 * off(1e-6)
    assert off(1e-6) < 1e-5
    # of what its errors are see `simulate_as_fine`; measured 1.1e-6 s at 1e-5
    for one, other in zip(rise(1e-6).onsets[PIN][:2], exact.onsets[PIN][:2], strict=True):
        assert one.speed == pytest.approx(other.speed, rel=1e-3)
        assert one.time == pytest.approx(other.time, abs=1e-6)
    for tolerance, allowed in ((1e-6, 1e-4), (1e-9, 1e-5), (1e-11, 1e-8)):
        result = rise(tolerance)
        # the share of the dissipated energy falls with the tolerance; it amounts to some tens of joule
        assert result.dissipated > 10.0
        assert result.energy_error < allowed * result.dissipated


def test_the_mass_that_moves_is_that_of_the_bores_axes_where_both_bodies_turn() -> None:
    # along the normal the journal has next to no way: the mass that moves is tens of tons, and 18 times that
    # of other directions per radian. The engine's connector has axes in the middle between both bodies
    contact = JournalContact(
        bearing=JournalBearing(bore_radius=0.0655, clearance=0.243e-3),
        normal=Flores(restitution=0.426, stiffness=2.2e10, exponent=1.5),
        friction=BrownMcPhee(static_coefficient=0.178, sliding_coefficient=0.137, transition_speed=0.01),
    )
    oil = OilColumn(bore_area=0.12847, oil_length=0.698, bulk_modulus=9.81e8)
    scene = support(
        pins={"front_shield": ClearancePin(contact=contact, bore="second", eccentricity=(3.1e-5, -4.65e-5))},
        actuators=dict.fromkeys(BOTH, oil),
        drive=Reciprocating(stroke=3.013e-3, period=0.1462),
        duration=0.0245,
        step=1e-4,
        solver=SolverSettings(impact_steps=400),
    )
    right = simulate_compiled(scene).largest_force["front_shield"]
    # in the axes in the middle: 1.7e-4 off, at any step
    assert simulate_on_exudyn(scene).largest_force["front_shield"] == pytest.approx(right, rel=5e-6)


# --- beyond the range of a law, and laws that break ---


def pressed(length: float) -> Scenario:
    """A line contact so short that it hardly bears, or does not."""
    return drop(duration=0.08, normal=cylinder_law(Johnson, length=length, bearing=BEARING))


@pytest.mark.parametrize("tolerance", [1e-2, 1e-7])
def test_a_contact_beyond_the_range_of_its_law_stops_the_run(tolerance: float) -> None:
    scenario = pressed(1e-3)
    with pytest.raises(SimulationError) as caught:
        simulate_compiled(scenario, tolerance)
    failure = caught.value.failure
    assert failure.reason == "a contact is overloaded"
    assert "Johnson: depth = 0.000812" in failure.advice
    assert "allowed: up to 0.000812" in failure.advice
    with pytest.raises(SimulationError) as engines:
        simulate_on_exudyn(scenario)
    assert engines.value.failure.reason == failure.reason
    # the engine stops at the start of a step of 4e-5 s; the depth of a coarse run is right to 1e-3 of the way
    assert failure.time == pytest.approx(engines.value.failure.time, abs=1e-4)


@friction_law
def overflowing(slip: float, normal_force: float) -> float:
    """Infinite under more than 10 kN."""
    return -slip * math.exp(0.071 * normal_force) * 1e-300


@friction_law
def raising(slip: float, normal_force: float) -> float:
    """Nothing at all there."""
    if normal_force > 1e4:
        raise LookupError("a bug in the law")
    return 0.0


@pytest.mark.parametrize(
    ("law", "reason"),
    [
        (overflowing(), "the linkage cannot close, or a value is no longer a finite number"),
        (raising(), f"{PIN}: a law of the contact fails: LookupError: a bug in the law"),
    ],
    ids=kind_of,
)
def test_a_law_that_breaks_stops_the_run(law: FrictionLaw, reason: str) -> None:
    with pytest.raises(SimulationError) as caught:
        simulate_compiled(drop(friction=law))
    assert 0.01 < caught.value.failure.time < 0.04
    assert caught.value.failure.reason.startswith(reason)


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
        simulate_compiled(loose_support(drive=Untold(), duration=0.05))


@pytest.mark.parametrize("simulated", [simulate_compiled, simulate_on_exudyn])
def test_velocities_that_tear_a_pin_are_refused(simulated: Any) -> None:
    bar = Body(mass=10.0, inertia=1.0, centre=(0.0, -0.5), velocity=(1.0, 0.0))
    torn = Linkage(bodies={"bar": bar}, pins={"top": pinned(GROUND, "bar", (0.0, 0.0))})
    with pytest.raises(SimulationError, match="energy does not add up: it is open by 1"):
        simulated(Scenario(machine=PlanarLinkage(drawing=torn), duration=0.1))


# --- the same numbers everywhere ---


def _bytes() -> bytes:
    result = simulate_compiled(loose_support(1.5, 0.25, drive=Held(), duration=0.2))
    return b"".join(channel.values.tobytes() for channel in result.channels.values())


def test_runs_are_the_same_bit_for_bit_also_in_another_process() -> None:
    warm_up()
    here = _bytes()
    assert _bytes() == here
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        assert pool.submit(_bytes).result() == here


def test_records_do_not_change_the_run() -> None:
    coarse, fine = (
        simulate_compiled(loose_support(1.5, 0.25, duration=0.2, record_period=period))
        for period in (0.1, 1e-4)
    )
    assert coarse.onsets == fine.onsets
    assert coarse[FORCE][-1] == fine[FORCE][-1]
