"""Friction in joints without clearance, against Newton and Euler and closed forms."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from support_exudyn import (
    AppliedForce,
    Body,
    Crank,
    CubicStep,
    Failure,
    Guide,
    IdealGuide,
    IdealPin,
    Linkage,
    Machine,
    Pin,
    Result,
    Scenario,
    Slide,
    SolverSettings,
    Steady,
    simulate,
)
from support_exudyn.model.linkage import pinned
from support_exudyn.postprocessing.pytest_plugin import AssertClose, SimulateCached
from tests.cases.run_cases import support
from user_forces import Ambrosio, FrictionLaw, LuGre, value

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


# --- slider-crank, sled and slot ---


GRAVITY, COEFFICIENT = 9.81, 0.1
R, L, PIN_RADIUS, OMEGA = 0.05, 0.2, 0.01, 20.0 * math.pi  # slider-crank: lengths, pin [m], 600 rpm
ROD, ROD_INERTIA, SLIDER = 0.5, 0.002, 0.8
DRY, STICKING = (
    Ambrosio(sliding_coefficient=COEFFICIENT),
    LuGre(static_coefficient=COEFFICIENT, sliding_coefficient=COEFFICIENT),
)
WAYS: dict[str, Callable[[Scenario], Result]] = {
    "compiled": lambda s: simulate(replace(s, formulation="compiled", solver=SolverSettings(tolerance=1e-9))),
    "exudyn": lambda s: simulate(replace(s, formulation="exudyn", step=2e-5)),
}
both = pytest.mark.parametrize("way", WAYS)


@value
class Crankshaft(Machine):
    """A slider-crank in one line at the start."""

    def linkage(self) -> Linkage:
        bodies = {
            "crank": Body(mass=1.0, inertia=0.001, centre=(0.5 * R, 0.0)),
            "rod": Body(mass=ROD, inertia=ROD_INERTIA, centre=(R + 0.5 * L, 0.0)),
            "slider": Body(mass=SLIDER, inertia=0.001, centre=(R + L, 0.0)),
        }
        pins = {"O": pinned("ground", "crank", (0.0, 0.0)), "A": pinned("crank", "rod", (R, 0.0))}
        pins["B"] = pinned("rod", "slider", (R + L, 0.0))
        slides = {"g": Slide(body="slider", point=(R + L, 0.0))}
        return Linkage(bodies=bodies, pins=pins, cranks={"motor": Crank(body="crank")}, slides=slides)


def lost_power(t: float, pin: float, guide: float) -> float:
    """Friction power [W] of pin B and guide at constant speed: forces of rod and slider by Newton and Euler."""
    a = OMEGA * t
    s, c = math.sin(a), math.cos(a)
    b = math.asin(-R * s / L)  # angle of the rod
    spin = -R * c * OMEGA / (L * math.cos(b))
    bend = (R * s * OMEGA**2 + L * math.sin(b) * spin**2) / (L * math.cos(b))
    speed = -R * s * OMEGA - L * math.sin(b) * spin
    jerk = -R * c * OMEGA**2 - L * (math.cos(b) * spin**2 + math.sin(b) * bend)
    x, y = 0.5 * L * math.cos(b), 0.5 * L * math.sin(b)  # from A to the rod's centre
    ax = -R * c * OMEGA**2 - x * spin**2 - y * bend
    ay = -R * s * OMEGA**2 - y * spin**2 + x * bend

    fx = fy = rubs = moment = 0.0  # of pin B on the slider, of the guide along, of pin B on the slider
    for _ in range(40):  # friction is a small share of what it depends on
        rubs = DRY(speed, abs(SLIDER * GRAVITY - fy)) * guide / COEFFICIENT
        moment = PIN_RADIUS * DRY(-PIN_RADIUS * spin, math.hypot(fx, fy)) * pin / COEFFICIENT
        fx = SLIDER * jerk - rubs
        about_a = ROD_INERTIA * bend + ROD * (x * ay - y * ax)
        fy = (2.0 * y * fx - moment - x * ROD * GRAVITY - about_a) / (2.0 * x)
    return -rubs * speed + moment * spin


@both
@pytest.mark.parametrize(("pin", "guide"), [(COEFFICIENT, 0.0), (COEFFICIENT, COEFFICIENT)])
def test_a_slider_crank_loses_what_its_joint_forces_say(way: str, pin: float, guide: float) -> None:
    pins = {"B": IdealPin(friction=Ambrosio(sliding_coefficient=pin), radius=PIN_RADIUS)} if pin else {}
    guides: dict[str, Guide] = {"g": IdealGuide(friction=DRY)} if guide else {}
    scene = Scenario(machine=Crankshaft(), drive=Steady(rate=OMEGA), duration=0.1, pins=pins, guides=guides)
    result = WAYS[way](replace(scene, record_period=1e-3))
    edges = np.linspace(0.0, 0.1, 41)
    lost = sum(quad(lost_power, u, v, (pin, guide), epsrel=1e-9)[0] for u, v in pairwise(edges))
    assert result["energy.friction_loss"][-1] == pytest.approx(lost, rel=2e-5)
    assert result["energy.work"][-1] == pytest.approx(lost, rel=1e-3)
    assert result.energy_error < 1e-3 * lost


@value
class Sled(Machine):
    """A block of 1 kg, 100 mm by 40 mm, on a straight guide."""

    slope: float = 0.0

    def linkage(self) -> Linkage:
        body = Body(mass=1.0, inertia=0.002, centre=(0.0, 0.0))
        return Linkage(
            bodies={"sled": body}, slides={"g": Slide(body="sled", point=(0, 0), direction=self.slope)}
        )


BLOCK, SLOPE = (0.1, 0.04), math.radians(20.0)


@both
@pytest.mark.parametrize("weight", [0.0, GRAVITY])
def test_a_block_that_is_pulled_beside_its_guide_is_braked_by_the_moment(way: str, weight: float) -> None:
    force, high = 10.0, 0.2  # as a drawer that is pulled at its side
    scene = Scenario(
        machine=Sled(),
        gravity=(0.0, -weight),
        duration=0.1,
        record_period=0.01,
        guides={"g": IdealGuide(friction=DRY, block=BLOCK)},
        loads={"pull": AppliedForce(body="sled", point=(0.0, high), full_force=(force, 0.0))},
    )
    result = WAYS[way](scene)
    # both ends together press with twice the moment of pull and friction over the length, that of the weight
    # at the wall below more; after 1 ms the slip has passed the ramp of the law
    braked = 2.0 * COEFFICIENT * (force * high + 0.5 * COEFFICIENT * weight * BLOCK[1]) / BLOCK[0]
    assert result["g.friction_force"][5:] == pytest.approx(-braked, rel=1e-6)
    acceleration = (result["sled.velocity_x"][-1] - result["sled.velocity_x"][5]) / (
        result.time[-1] - result.time[5]
    )
    assert acceleration == pytest.approx(force - braked, rel=1e-5)
    left_out = WAYS[way](replace(scene, guides={"g": IdealGuide(friction=DRY)}))
    assert "friction by the moment of up to 2 N m is left out" in " ".join(left_out.warnings)


@both
def test_a_block_on_a_slope_creeps_with_a_warning_or_holds(way: str) -> None:
    laws: dict[str, FrictionLaw] = {
        "creeps": Ambrosio(sliding_coefficient=0.5),
        "holds": LuGre(static_coefficient=0.5, sliding_coefficient=0.5),
    }
    found = {}
    for name, law in laws.items():
        guides: dict[str, Guide] = {"g": IdealGuide(friction=law, block=BLOCK)}
        scene = Scenario(machine=Sled(slope=SLOPE), guides=guides, duration=1.0, record_period=0.01, step=1e-3)
        found[name] = simulate(replace(scene, formulation=way))
    # share of full friction that holds: tan(20 deg) / 0.5, on the ramp from 0.1 to 10 mm/s
    speed = 1e-4 + math.tan(SLOPE) / 0.5 * 9.9e-3
    assert np.hypot(found["creeps"]["sled.velocity_x"], found["creeps"]["sled.velocity_y"])[
        -1
    ] == pytest.approx(speed, rel=1e-6)
    assert "mm/s for 100% of the loaded time. It creeps 7.269 mm" in found["creeps"].warnings[0]
    assert "with 73% of its full friction" in found["creeps"].warnings[0]
    assert not found["holds"].warnings
    way_down = np.hypot(found["holds"]["sled.x"], found["holds"]["sled.y"])
    assert way_down[-1] < 5e-5  # while bristles swing in they slip: steady deflections are 5 micrometres
    assert abs(way_down[-1] - way_down[50]) < 1e-7
    assert found["holds"]["g.friction_force"][-1] == pytest.approx(GRAVITY * math.sin(SLOPE), rel=1e-5)


def test_a_guide_that_jams_is_refused_with_its_name() -> None:
    guides: dict[str, Guide] = {"g": IdealGuide(friction=Ambrosio(sliding_coefficient=5.0))}
    scene = Scenario(machine=Crankshaft(), drive=Steady(rate=OMEGA), duration=0.1, guides=guides)
    failure = simulate(replace(scene, formulation="compiled"), throw=False)
    assert isinstance(failure, Failure)
    # 5 tan of the rod's angle is above 1: pushed against its guide, the slider would need infinite force
    assert "a joint jams by its friction" in failure.advice
    assert "in guides.g." in failure.advice
