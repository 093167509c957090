"""Friction in joints without clearance, in both formulations, against Newton and Euler and closed forms."""

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
    Failure,
    Guide,
    IdealGuide,
    IdealPin,
    Linkage,
    Machine,
    Result,
    Scenario,
    Slide,
    SolverSettings,
    Steady,
    simulate,
)
from support_exudyn.model.linkage import pinned
from tests.formulations.test_slots_and_gears import SPEED as YOKE_SPEED
from tests.formulations.test_slots_and_gears import ScotchYoke
from user_forces import Ambrosio, FrictionLaw, LuGre, value

G, MU = 9.81, 0.1
R, L, RADIUS, OMEGA = 0.05, 0.2, 0.01, 20.0 * math.pi  # slider-crank: lengths, pin [m], 600 rpm
ROD, ROD_INERTIA, SLIDER = 0.5, 0.002, 0.8
DRY, STICKING = Ambrosio(sliding_coefficient=MU), LuGre(static_coefficient=MU, sliding_coefficient=MU)
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
        rubs = DRY(speed, abs(SLIDER * G - fy)) * guide / MU
        moment = RADIUS * DRY(-RADIUS * spin, math.hypot(fx, fy)) * pin / MU
        fx = SLIDER * jerk - rubs
        about_a = ROD_INERTIA * bend + ROD * (x * ay - y * ax)
        fy = (2.0 * y * fx - moment - x * ROD * G - about_a) / (2.0 * x)
    return -rubs * speed + moment * spin


@both
@pytest.mark.parametrize(("pin", "guide"), [(MU, 0.0), (MU, MU)])
def test_a_slider_crank_loses_what_its_joint_forces_say(way: str, pin: float, guide: float) -> None:
    pins = {"B": IdealPin(friction=Ambrosio(sliding_coefficient=pin), radius=RADIUS)} if pin else {}
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
@pytest.mark.parametrize("weight", [0.0, G])
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
    braked = 2.0 * MU * (force * high + 0.5 * MU * weight * BLOCK[1]) / BLOCK[0]
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
    assert found["holds"]["g.friction_force"][-1] == pytest.approx(G * math.sin(SLOPE), rel=1e-5)


def test_a_pin_in_a_slot_rubs_and_rolls_alike_in_both_formulations() -> None:
    guides: dict[str, Guide] = {"slot": IdealGuide(friction=Ambrosio(sliding_coefficient=0.3), pin_radius=0.02)}
    scene = Scenario(
        machine=ScotchYoke(),
        drive=Steady(rate=YOKE_SPEED),
        duration=0.3,
        record_period=1e-3,
        guides=guides,
        step=2e-4,
    )
    fast, slow = (simulate(replace(scene, formulation=way)) for way in WAYS)
    assert fast["energy.friction_loss"][-1] == pytest.approx(slow["energy.friction_loss"][-1], rel=1e-5)
    np.testing.assert_allclose(fast["slot.friction_force"], slow["slot.friction_force"], atol=1e-3)
    assert fast.energy_error < 1e-6 * fast["energy.friction_loss"][-1]


def test_a_guide_that_jams_is_refused_with_its_name() -> None:
    guides: dict[str, Guide] = {"g": IdealGuide(friction=Ambrosio(sliding_coefficient=5.0))}
    scene = Scenario(machine=Crankshaft(), drive=Steady(rate=OMEGA), duration=0.1, guides=guides)
    failure = simulate(replace(scene, formulation="compiled"), throw=False)
    assert isinstance(failure, Failure)
    # 5 tan of the rod's angle is above 1: pushed against its guide, the slider would need infinite force
    assert "a joint jams by its friction" in failure.advice
    assert "in guides.g." in failure.advice
