"""Friction of ideal pins against closed forms, and the energy balance."""

from __future__ import annotations

import math

import numpy as np
import pytest

from support_exudyn import (
    Body,
    CubicStep,
    IdealPin,
    Linkage,
    Machine,
    Pin,
    Result,
    Scenario,
    SolverSettings,
    simulate,
)
from support_exudyn.model.linkage import pinned
from support_exudyn.postprocessing.pytest_plugin import AssertClose, SimulateCached
from tests.cases.run_cases import support
from user_forces import Ambrosio, InputError, value

MASS, INERTIA, G, RADIUS, MU = 50.0, 2.0, 9.81, 0.05, 0.3
RUBBING = IdealPin(friction=Ambrosio(sliding_coefficient=MU), radius=RADIUS)
SUPPORT_PIN = IdealPin(friction=Ambrosio(sliding_coefficient=0.25), radius=0.0655)
RISE = CubicStep(start=0.05, end=0.45, stroke=0.1)


@value
class Wheel(Machine):
    """A heavy wheel that turns about its centre of mass."""

    spin: float = 8.0
    ground_first: bool = True

    def linkage(self) -> Linkage:
        ends = ("ground", "wheel") if self.ground_first else ("wheel", "ground")
        body = Body(mass=MASS, inertia=INERTIA, centre=(0.3, 0.4), spin=self.spin)
        return Linkage(bodies={"wheel": body}, pins={"pivot": pinned(*ends, (0.3, 0.4))})


FORMULATIONS = pytest.mark.parametrize("formulation", ["exudyn", "compiled"])


def spun_down(pin: IdealPin, formulation: str, tolerance: float, **changes: object) -> Result:
    """A second of a wheel on a pin."""
    solver = SolverSettings(tolerance=tolerance)
    return simulate(
        Scenario(
            machine=Wheel(**changes), pins={"pivot": pin}, duration=1.0, formulation=formulation, solver=solver
        )
    )


@FORMULATIONS
@pytest.mark.parametrize(("spin", "ground_first"), [(8.0, True), (-8.0, True), (8.0, False)])
def test_a_wheel_is_slowed_down_by_mu_n_r(spin: float, ground_first: bool, formulation: str) -> None:
    result = spun_down(RUBBING, formulation, 1e-9, spin=spin, ground_first=ground_first)
    moment = MU * MASS * G * RADIUS
    expected = spin - math.copysign(moment / INERTIA, spin) * result.time
    # constant deceleration, which both integrators take exactly but for rounding; some 1e-9 where steps are few
    close = 1e-10 if formulation == "exudyn" else 1e-9
    np.testing.assert_allclose(result["wheel.angular_velocity"], expected, atol=close)
    on_second = -1.0 if ground_first else 1.0  # against the wheel's spin if that is the second body
    np.testing.assert_allclose(
        result["pin.pivot.friction_moment"], on_second * math.copysign(moment, spin), rtol=1e-9
    )
    lost = 0.5 * INERTIA * (spin**2 - expected**2)
    np.testing.assert_allclose(result["energy.friction_loss"], lost, atol=100.0 * close)
    assert result.energy_error < 100.0 * close


@FORMULATIONS
def test_a_wheel_that_creeps_is_slowed_down_by_the_ramp_of_the_law(formulation: str) -> None:
    law = Ambrosio(sliding_coefficient=MU, static_speed=0.0, dynamic_speed=1.0)
    result = spun_down(IdealPin(friction=law, radius=RADIUS), formulation, 1e-11)
    # below 1 m/s a dashpot of mu N r^2
    expected = 8.0 * np.exp(-MU * MASS * G * RADIUS**2 / INERTIA * result.time)
    # second order of a step of 0.5 ms, against a decay within 5 s: 1e-9
    close = 1e-8 if formulation == "exudyn" else 1e-9
    np.testing.assert_allclose(result["wheel.angular_velocity"], expected, rtol=close)


PINS = tuple(support().linkage.pins)


def test_energy_adds_up_with_friction_in_all_pins(
    simulate_cached: SimulateCached, assert_close: AssertClose
) -> None:
    pins: dict[str, Pin] = dict.fromkeys(PINS, SUPPORT_PIN)
    coarse, fine = (simulate(support(drive=RISE, duration=0.5, pins=pins, step=h)) for h in (1e-3, 5e-4))
    assert fine["energy.friction_loss"][-1] > 100.0
    # second order, of a work of 5 kJ; measured 2e-7
    assert fine.energy_error < 2e-6 * fine["energy.work"].max()
    assert fine.energy_error < 0.35 * coarse.energy_error
    # what the drive does more is what friction takes: the support ends where it would without
    plain = simulate_cached(support(drive=RISE, duration=0.5))
    more = fine["energy.work"][-1] - plain["energy.work"][-1]
    assert more == pytest.approx(fine["energy.friction_loss"][-1], rel=1e-4)
    assert_close(fine, plain, "1e-7 mm", channels=["tip.y"])  # the actuators' lengths say where


def test_friction_and_radius_go_together() -> None:
    assert IdealPin() == IdealPin(friction=None, radius=None)
    for given in ({"radius": 0.1}, {"friction": Ambrosio(sliding_coefficient=0.1)}):
        with pytest.raises(InputError, match=r"IdealPin: friction = .*allowed: both, or None for both"):
            IdealPin(**given)
    with pytest.raises(InputError, match=r"IdealPin\.radius = -1\.0: allowed: > 0"):
        IdealPin(friction=Ambrosio(sliding_coefficient=0.1), radius=-1.0)
