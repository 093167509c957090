"""A block that falls on a machine: closed forms of bounces, an independent integrator, the support."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from studies.common import paper_machine
from support_exudyn import (
    FallingBlock,
    Load,
    LoadedPoint,
    Result,
    Scenario,
    SolverSettings,
    reference_support,
    simulate,
)
from support_exudyn.model.loads.load import Powers
from tests.roof_cases import MASS, OVER_THE_COLUMNS, TOP, Ram
from user_forces import value
from user_forces.values.value import InputError, Vector2

G = 9.81
HEIGHT = 0.5
SPEED = math.sqrt(2.0 * G * HEIGHT)
LANDING = math.sqrt(2.0 * HEIGHT / G)
# support on oil: what the paper's machine has, and a soft rock
ON_OIL = paper_machine.oil_columns()
PLACES = {
    "tip": reference_support().start().tip,
    "middle": OVER_THE_COLUMNS,
    "rear": reference_support().start().hinge,
}


def block(**changes: object) -> FallingBlock:
    fields: dict[str, object] = {
        "body": "canopy", "point": OVER_THE_COLUMNS, "mass": MASS, "height": HEIGHT, "stiffness": 1e9,
        "restitution": 0.5,
    }  # fmt: skip
    return FallingBlock(**fields | changes)


def on_the_held(rock: FallingBlock, **changes: object) -> Scenario:
    """The block over the reference support on rigid actuators and ideal pins, which nothing moves."""
    fields: dict[str, object] = {"machine": reference_support(), "loads": {"rock": rock}, "duration": 0.5}
    return Scenario(**fields | changes)


def weightless(rock: FallingBlock) -> Scenario:
    return on_the_held(replace(rock, gravity=0.0, height=0.01, speed=3.0), gravity=(0.0, 0.0), duration=0.05)


# --- on what stands still ---


@pytest.mark.parametrize(("exponent", "stiffness"), [(1.0, 1e8), (1.5, 1e9), (2.2, 3e10)])
@pytest.mark.parametrize("restitution", [0.1, 0.5, 0.9, 1.0])
def test_first_impact_gives_back_what_was_asked(restitution: float, exponent: float, stiffness: float) -> None:
    rock = block(restitution=restitution, exponent=exponent, stiffness=stiffness)
    result = simulate(weightless(rock))
    # second order in 512 steps an impact
    assert result["rock.velocity_y"][-1] == pytest.approx(3.0 * restitution, abs=3.0 * 2e-5)
    lost = 0.5 * MASS * 9.0 * (1.0 - restitution**2)
    assert result["energy.damping_loss"][-1] == pytest.approx(lost, rel=1e-4, abs=1e-9 * MASS)
    assert result.energy_error < 1e-4 * 0.5 * MASS * 9.0


def test_impulse_and_duration_are_those_of_the_closed_forms() -> None:
    rock = block(restitution=1.0)
    scene = replace(weightless(rock), record_period=2e-5, step=2e-5)
    result = simulate(scene)
    force, time = result["rock.force"], result.time
    # m v (1 + e); the rule of trapezoids over 500 records
    assert np.trapezoid(force, time) == pytest.approx(2.0 * MASS * 3.0, rel=1e-5)
    deepest = (2.5 * 0.5 * MASS * 9.0 / 1e9) ** 0.4
    assert -result["rock.gap"].min() == pytest.approx(deepest, rel=1e-5)
    assert force.max() == pytest.approx(1e9 * deepest**1.5, rel=1e-5)
    # twice the integral of dx / sqrt(1 - x^2.5) times deepest over speed, with x = 1 - u^2
    whole = 2.0 * deepest / 3.0 * quad(lambda u: 2.0 * u / math.sqrt(1.0 - (1.0 - u * u) ** 2.5), 0.0, 1.0)[0]
    assert np.count_nonzero(force > 0.0) * 2e-5 == pytest.approx(whole, abs=4e-5)  # two records
    assert replace(rock, gravity=0.0, height=0.01, speed=3.0).impact_time == pytest.approx(whole, rel=2e-3)


def test_an_elastic_block_comes_up_as_high_again_and_again() -> None:
    result = simulate(
        on_the_held(block(restitution=1.0), duration=2.5, solver=SolverSettings(impact_steps=1024))
    )
    height = result["rock.y"] - result["rock.y"][0]
    tops = [n for n in range(1, height.size - 1) if height[n - 1] < height[n] > height[n + 1]]
    assert len(tops) == 3
    # records beside the top: g (1 ms / 2)^2 / 2; an impact loses less than 1e-6 of 4.9 kJ
    np.testing.assert_allclose(height[tops], 0.0, atol=1e-5)


def bounced(rock: FallingBlock, duration: float) -> np.ndarray:
    """Height over where it starts, and speed up, at the end, by an explicit method of eighth order."""
    chi = rock.damping

    def rates(t: float, state: np.ndarray) -> list[float]:
        depth = max(0.0, -state[0] - rock.height)
        push = rock.stiffness * depth**rock.exponent * max(0.0, 1.0 - chi * state[1])
        return [state[1], push / rock.mass - G]

    found = solve_ivp(
        rates, (0.0, duration), [0.0, 0.0], method="DOP853", rtol=1e-11, atol=1e-12, max_step=1e-3
    )
    return found.y[:, -1]


@pytest.mark.parametrize("restitution", [pytest.param(0.3, marks=pytest.mark.slow), 0.7])
def test_weight_and_all_bounces_are_as_in_an_independent_solution(restitution: float) -> None:
    rock = block(restitution=restitution)
    for duration in (0.5, 0.95):
        result = simulate(on_the_held(rock, duration=duration))
        height, speed = bounced(rock, duration)
        # second order, some impacts one after the other
        assert result["rock.y"][-1] - result["rock.y"][0] == pytest.approx(height, abs=2e-5)
        assert result["rock.velocity_y"][-1] == pytest.approx(speed, abs=2e-4)


def test_later_impacts_give_back_more() -> None:
    rock = block(restitution=0.3, stiffness=1e10)
    result = simulate(on_the_held(rock, duration=0.7))
    closed = result["rock.gap"] <= 0.0
    begins = np.flatnonzero(closed[1:] & ~closed[:-1]) + 1
    energy = 0.5 * result["rock.velocity_y"] ** 2 + G * (result["rock.y"] - result["rock.y"][0] + HEIGHT)
    speeds = np.sqrt(2.0 * energy[begins - 1])
    assert speeds[0] == pytest.approx(SPEED, rel=1e-6)
    ratios = speeds[1:3] / speeds[:2]
    assert ratios[0] == pytest.approx(0.3, abs=0.02)  # the weight takes a little
    assert ratios[1] > 0.5


def test_it_comes_to_rest_with_its_weight() -> None:
    result = simulate(on_the_held(block(restitution=0.1), duration=1.5))
    depth = (MASS * G / 1e9) ** (1.0 / 1.5)
    assert result["rock.force"][-1] == pytest.approx(MASS * G, rel=2e-3)  # what is left of swings
    assert result["rock.gap"][-1] == pytest.approx(-depth, rel=2e-3)
    actuators = result["front_column.force"][-1] + result["rear_column.force"][-1]
    before = result["front_column.force"][100] + result["rear_column.force"][100]
    assert actuators - before == pytest.approx(MASS * G, rel=0.02)  # actuators lean by some degrees


# --- on what gives ---


@value
class Spring(Load):
    """A spring that carries the ram."""

    stiffness: float

    def force(self, at: LoadedPoint) -> Vector2:
        return 0.0, -self.stiffness * at.y

    def stored(self, at: LoadedPoint) -> float:
        return 0.5 * self.stiffness * at.y * at.y

    def powers(self, at: LoadedPoint) -> Powers:
        return Powers(0.0, 0.0)


SPRING = 2e7  # [N/m]


def on_a_spring(steps: int, step: float = 1e-3) -> Scenario:
    rock = block(body="ram", point=TOP, mass=400.0, height=0.2, restitution=0.4, stiffness=2e8)
    loads = {"rock": rock, "spring": Spring(body="ram", point=TOP, stiffness=SPRING)}
    return Scenario(
        machine=Ram(),
        loads=loads,
        duration=0.3,
        step=step,
        record_period=0.01,
        solver=SolverSettings(impact_steps=steps),
    )


@cache
def both() -> np.ndarray:
    """Places of ram and block since the start and their speeds at the end of `on_a_spring`."""
    rock = on_a_spring(64).loads["rock"]
    assert isinstance(rock, FallingBlock)

    def rates(t: float, state: np.ndarray) -> list[float]:
        ram, at, up, fall = state
        depth, rate = ram - at - 0.2, up - fall
        push = 2e8 * max(0.0, depth) ** 1.5 * max(0.0, 1.0 + rock.damping * rate)
        return [up, fall, -SPRING * ram / MASS - G - push / MASS, push / 400.0 - G]

    found = solve_ivp(rates, (0.0, 0.3), [0.0] * 4, method="DOP853", rtol=1e-12, atol=1e-13, max_step=1e-4)
    return found.y[:, -1]


def ends(result: Result) -> np.ndarray:
    return np.array(
        [
            result["ram.y"][-1] - result["ram.y"][0],
            result["rock.y"][-1] - result["rock.y"][0],
            result["ram.velocity_y"][-1],
            result["rock.velocity_y"][-1],
        ]
    )


def test_on_a_spring_it_converges_to_an_independent_solution_with_second_order() -> None:
    errors = [
        float(np.abs(ends(simulate(on_a_spring(steps, step))) - both()).max())
        for steps, step in ((64, 1e-3), (256, 2.5e-4))
    ]
    # 16 with second order
    assert errors[0] / errors[1] > 10.0
    assert errors[1] < 2e-3  # of 2 m/s


@pytest.mark.parametrize(
    ("place", "pins"),
    [
        *((place, "ideal") for place in PLACES),
        *(pytest.param(place, "with_clearance", marks=pytest.mark.slow) for place in PLACES),
    ],
)
def test_on_the_support_energies_add_up_and_half_the_steps_give_the_same(place: str, pins: str) -> None:
    with_clearance = (
        {paper_machine.CLEARANCE_PIN: paper_machine.clearance_joint(1.5, 0.25)}
        if pins == "with_clearance"
        else {}
    )
    scene = on_the_held(
        block(point=PLACES[place]), actuators=ON_OIL, pins=with_clearance, duration=0.4,
        solver=SolverSettings(impact_steps=128),
    )  # fmt: skip
    coarse, fine = simulate(scene), simulate(scene.refined())
    assert fine.energy_error < 2e-3 * MASS * G * HEIGHT  # second order
    for channel in ("rock.force", "front_column.force", "pin.rear_base.force"):
        # records every millisecond beside a peak of ten; loose, the rattling before the block lands decides
        largest = [np.abs(run[channel]).max() for run in (coarse, fine)]
        assert largest[0] == pytest.approx(largest[1], rel=5e-3 if pins == "ideal" else 0.05)
    assert fine["rock.force"].max() > 1e5


def test_touch_needs_no_grid() -> None:
    # steps are halved on the way to the impact, so that long ones lose nothing
    results = [simulate(on_the_held(block(), step=step, duration=0.45)) for step in (1e-3, 1e-4)]
    speeds = [result["rock.velocity_y"][-1] for result in results]
    assert speeds[0] == pytest.approx(speeds[1], abs=2e-4)  # second order of 512 steps an impact
    assert results[0].counts.steps < 3000


# --- what is refused ---


def test_gravity_must_be_that_of_the_law() -> None:
    with pytest.raises(InputError, match=r"loads\.rock\.gravity = 9\.81 m/s\^2: allowed: that of the scenario"):
        on_the_held(block(), gravity=(0.0, -3.7))
    with pytest.raises(
        InputError, match=r"loads\.rock\.height = 0\.0 m, speed = 0\.0 m/s: allowed: one of them > 0"
    ):
        on_the_held(block(height=0.0))


def test_it_can_be_saved_and_read(tmp_path: object) -> None:
    scene = on_the_held(block(), duration=0.33)
    result = simulate(scene)
    path = result.save(f"{tmp_path}/run.h5")
    assert Result.load(path).scenario == scene


@pytest.mark.parametrize("rock", [block(), block(height=0.1, speed=1.0)], ids=["dropped", "thrown"])
def test_it_hangs_while_the_support_settles(rock: FallingBlock) -> None:
    with_clearance = {paper_machine.CLEARANCE_PIN: paper_machine.clearance_joint(1.5, 0.0)}
    scene = on_the_held(rock, actuators=ON_OIL, pins=with_clearance, start="settled", duration=0.06)
    result, alone = simulate(scene), simulate(replace(scene, loads={}))
    # before it strikes the support stands as without it; Newton's tolerance of the static solution
    assert result["tip.y"] == pytest.approx(alone["tip.y"], abs=1e-9)
    assert result["front_column.force"] == pytest.approx(alone["front_column.force"], rel=1e-5)
    # and it falls from where it hung: the canopy gives by less than a millimetre, and it went along
    assert result["rock.gap"][0] == pytest.approx(rock.height, abs=1e-9)
    fallen = result["rock.gap"][0] - result["rock.gap"]
    expected = rock.speed * result.time + 0.5 * G * result.time**2
    np.testing.assert_allclose(fallen, expected, atol=1e-7)
    assert result.energy_error < 1e-3
