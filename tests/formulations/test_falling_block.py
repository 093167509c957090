"""A block that falls on a machine: closed forms of bounces, an independent integrator, the support."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

from studies.common import paper_machine
from support_exudyn import (
    Body,
    FallingBlock,
    LinearActuator,
    Linkage,
    Machine,
    OilColumn,
    Result,
    Scenario,
    Slide,
    SolverSettings,
    SpringDamper,
    bore_area,
    reference_support,
    simulate,
)
from tests.roof_cases import MASS, OVER_THE_COLUMNS, TOP, Ram
from user_forces import value

G = 9.81
HEIGHT = 0.5
SPEED = math.sqrt(2.0 * G * HEIGHT)
LANDING = math.sqrt(2.0 * HEIGHT / G)
FORMULATIONS = ("exudyn", "compiled")
EXACT = SolverSettings(tolerance=1e-9)  # of the compiled formulation
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


def weightless(rock: FallingBlock, **changes: object) -> Scenario:
    known: dict[str, object] = {"gravity": (0.0, 0.0), "duration": 0.05}
    return on_the_held(replace(rock, height=0.01, speed=3.0), **known | changes)


# --- on what stands still ---


@pytest.mark.parametrize(("exponent", "stiffness"), [(1.0, 1e8), (1.5, 1e9), (2.2, 3e10)])
@pytest.mark.parametrize("restitution", [0.1, 0.5, 1.0])
@pytest.mark.parametrize(("formulation", "share"), [("exudyn", 2e-5), ("compiled", 1e-9)])
def test_a_blow_gives_back_what_was_asked(
    formulation: str, share: float, restitution: float, exponent: float, stiffness: float
) -> None:
    rock = block(restitution=restitution, exponent=exponent, stiffness=stiffness)
    result = simulate(weightless(rock, formulation=formulation, solver=EXACT))
    # of the Exudyn formulation: second order in 512 steps an impact
    (onset,) = result.onsets["rock"]
    assert onset.time == pytest.approx(0.01 / 3.0, rel=1e-9)
    assert onset.speed == pytest.approx(3.0, rel=1e-9)
    assert onset.separation_velocity == pytest.approx(3.0 * restitution, rel=share)
    assert result["rock.velocity_y"][-1] == pytest.approx(3.0 * restitution, rel=share)
    lost = 0.5 * MASS * 9.0 * (1.0 - restitution**2)
    assert result["energy.damping_loss"][-1] == pytest.approx(lost, rel=1e-4, abs=1e-9 * MASS)
    assert result.energy_error < 1e-4 * 0.5 * MASS * 9.0


def test_a_sloping_face_is_struck_along_its_normal() -> None:
    # the guide carries what is forward; along the normal the block has the speed v cos and the mass m/cos^2
    slope = 0.6
    rock = block(slope=slope)
    for formulation, share in (("exudyn", 2e-5), ("compiled", 1e-9)):
        result = simulate(weightless(rock, formulation=formulation, solver=EXACT))
        (onset,) = result.onsets["rock"]
        assert onset.time == pytest.approx(0.01 / 3.0, rel=1e-9)
        assert onset.speed == pytest.approx(3.0 * math.cos(slope), rel=1e-9)
        assert result["rock.velocity_y"][-1] == pytest.approx(1.5, rel=share)
        deepest = (2.5 * 0.5 * MASS * 9.0 / 1e9) ** 0.4  # undamped
        assert 0.5 * deepest < -result["rock.gap"].min() < deepest
        push, carried = result["rock.force"], result["rock_guide.force"]
        np.testing.assert_allclose(carried, push * math.sin(slope), atol=1e-6 * push.max())


def test_the_weight_takes_part_of_what_is_given_back_as_in_scipy() -> None:
    mass, stiffness, e, g = 1500.0, 1e10, 0.5, 9.81
    rock = block(mass=mass, height=0.3, stiffness=stiffness, restitution=e)
    speeds = [one.speed for one in simulate(on_the_held(rock, duration=0.9, solver=EXACT)).onsets["rock"]]
    damped = brentq(lambda c: c * (1.0 + e) - math.log((1.0 + c) / (1.0 - c * e)), 1e-3, (1.0 - 1e-12) / e)

    def lift_off(speed: float) -> float:
        """Speed [m/s] at which the block leaves a face that stands still, its weight acting."""

        def rates(t: float, y: np.ndarray) -> list[float]:
            force = stiffness * max(y[0], 0.0) ** 1.5 * max(0.0, 1.0 + damped * y[1] / speed)
            return [y[1], g - force / mass]

        def apart(t: float, y: np.ndarray) -> float:
            return float(y[0]) if t > 0.0 else 1.0

        apart.terminal, apart.direction = True, -1.0  # type: ignore[attr-defined]
        # at the start it touches, and moves in
        run = solve_ivp(rates, (0.0, 1.0), [1e-15, speed], "DOP853", events=apart, rtol=1e-12, atol=1e-15)
        return -float(run.y[1, -1])

    assert [two / one for one, two in pairwise(speeds[:5])] == pytest.approx(
        [0.493, 0.483, 0.458, 0.381], abs=5e-4
    )
    assert speeds[0] == pytest.approx(math.sqrt(2.0 * g * 0.3), rel=1e-9)
    assert speeds[1:4] == pytest.approx([lift_off(speed) for speed in speeds[:3]], rel=1e-5)


def test_impulse_and_duration_are_those_of_the_formulas() -> None:
    rock = block(restitution=1.0)
    scene = replace(weightless(rock), record_period=2e-5, step=2e-5)
    result = simulate(scene)
    force, time = result["rock.force"], result.time
    # m v (1 + e); the rule of trapezoids over 500 records
    assert np.trapezoid(force, time) == pytest.approx(2.0 * MASS * 3.0, rel=1e-5)
    deepest = (2.5 * 0.5 * MASS * 9.0 / 1e9) ** 0.4
    assert -result["rock.gap"].min() == pytest.approx(deepest, rel=1e-5)
    assert result.largest_force["rock"] == pytest.approx(1e9 * deepest**1.5, rel=1e-5)
    # twice the integral of dx / sqrt(1 - x^2.5) times deepest over speed, with x = 1 - u^2
    whole = 2.0 * deepest / 3.0 * quad(lambda u: 2.0 * u / math.sqrt(1.0 - (1.0 - u * u) ** 2.5), 0.0, 1.0)[0]
    (onset,) = result.onsets["rock"]
    assert onset.separation_time - onset.time == pytest.approx(whole, rel=1e-5)


def test_an_elastic_block_comes_up_as_high_again_and_again() -> None:
    result = simulate(
        on_the_held(block(restitution=1.0), duration=2.5, solver=SolverSettings(impact_steps=1024))
    )
    height = result["rock.y"] - result["rock.y"][0]
    tops = [n for n in range(1, height.size - 1) if height[n - 1] < height[n] > height[n + 1]]
    assert len(tops) == 3
    # records beside the top: g (1 ms / 2)^2 / 2; an impact loses less than 1e-6 of 4.9 kJ
    np.testing.assert_allclose(height[tops], 0.0, atol=1e-5)


def bounced(rock: FallingBlock, duration: float) -> list[tuple[float, float, float]]:
    """Time, speed and speed of separation of each blow [s], [m/s], by an explicit method of eighth order.

    The law is told the speed of the blow that is under way.
    """
    law, found = rock.contact.normal, []
    t, y, v = 0.0, rock.height, -rock.speed
    while True:
        land = t + (v + math.sqrt(v * v + 2.0 * G * y)) / G
        if land > duration:
            return found
        struck = math.sqrt(v * v + 2.0 * G * y)

        told = struck

        def rates(_: float, state: np.ndarray, told: float = told) -> list[float]:
            depth = max(-state[0], 1e-30)
            return [state[1], max(0.0, law(depth, -state[1], told)) / rock.mass - G]

        def parts(_: float, state: np.ndarray) -> float:
            return float(state[0])

        parts.terminal, parts.direction = True, 1.0  # type: ignore[attr-defined]
        ran = solve_ivp(
            rates, (land, land + 0.2), [0.0, -struck], "DOP853", rtol=1e-12, atol=1e-13, events=parts,
            max_step=1e-3,
        )  # fmt: skip
        t, (y, v) = float(ran.t[-1]), (0.0, float(ran.y[1, -1]))
        found.append((land, struck, v))


@pytest.mark.parametrize("restitution", [pytest.param(0.3, marks=pytest.mark.slow), 0.7])
def test_weight_and_all_bounces_are_as_in_an_independent_solution(restitution: float) -> None:
    rock = block(restitution=restitution)
    # without what rounding makes of a block that rests
    told = [one for one in bounced(rock, 0.95) if one[1] > 1e-3]
    assert len(told) >= 2
    for formulation, share in (("exudyn", 3e-5), ("compiled", 1e-7)):
        scene = on_the_held(rock, duration=0.95, formulation=formulation, solver=EXACT)
        onsets = simulate(scene).onsets["rock"]
        assert len(onsets) == len(told)
        for onset, (time, speed, parting) in zip(onsets, told, strict=True):
            assert onset.time == pytest.approx(time, rel=share)
            assert onset.speed == pytest.approx(speed, rel=share)
            if math.isfinite(onset.separation_time):
                assert onset.separation_velocity == pytest.approx(parting, rel=2.0 * share)


def test_every_blow_gives_back_the_same() -> None:
    rock = block(restitution=0.5, stiffness=1e13)
    onsets = simulate(on_the_held(rock, duration=1.2, formulation="compiled")).onsets["rock"]
    ratios = [one.separation_velocity / one.speed for one in onsets if math.isfinite(one.separation_time)]
    assert len(ratios) >= 4
    # the weight takes a little, of slow blows more
    np.testing.assert_allclose(ratios[:4], 0.5, atol=5e-3)


def test_it_comes_to_rest_with_its_weight() -> None:
    result = simulate(on_the_held(block(restitution=0.1), duration=1.5))
    depth = (MASS * G / 1e9) ** (1.0 / 1.5)
    assert result["rock.force"][-1] == pytest.approx(MASS * G, rel=2e-3)  # what is left of swings
    assert result["rock.gap"][-1] == pytest.approx(-depth, rel=2e-3)
    actuators = result["front_column.force"][-1] + result["rear_column.force"][-1]
    before = result["front_column.force"][100] + result["rear_column.force"][100]
    assert actuators - before == pytest.approx(MASS * G, rel=0.02)  # actuators lean by some degrees


@pytest.mark.parametrize("formulation", FORMULATIONS)
def test_a_block_that_lies_on_its_point_stays(formulation: str) -> None:
    # overdamped at rest: the depth settles with a time constant of 0.3 s
    scene = on_the_held(block(height=0.0, restitution=0.1), duration=3.0, formulation=formulation)
    result = simulate(scene)
    depth = (MASS * G / 1e9) ** (1.0 / 1.5)
    assert result["rock.gap"][-1] == pytest.approx(-depth, rel=2e-3)
    assert result["rock.gap"].max() <= 1e-9  # it never leaves: damped so well


# --- on what gives ---


SPRING = 2e7  # [N/m]


def on_a_spring(steps: int, step: float = 1e-3, **changes: object) -> Scenario:
    rock = block(body="ram", point=TOP, mass=400.0, height=0.2, restitution=1.0, stiffness=2e8)
    hold = SpringDamper(
        body="ram", point=TOP, other_point=(TOP[0], TOP[1] - 1.0), stiffness=SPRING, free_length=1.0
    )
    scene = Scenario(
        machine=Ram(),
        loads={"rock": rock, "spring": hold},
        duration=0.3,
        step=step,
        record_period=0.01,
        solver=SolverSettings(impact_steps=steps, tolerance=1e-9),
    )
    return replace(scene, **changes)


@cache
def both() -> np.ndarray:
    """Places of ram and block since the start and their speeds at the end of `on_a_spring`."""

    def rates(t: float, state: np.ndarray) -> list[float]:
        ram, at, up, fall = state
        push = 2e8 * max(0.0, ram - at - 0.2) ** 1.5
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
    np.testing.assert_allclose(ends(simulate(on_a_spring(64, formulation="compiled"))), both(), atol=1e-6)


@value
class Leg(Machine):
    """A mass of 10 t on a column of oil, on an upright guide."""

    def linkage(self) -> Linkage:
        mass = Body(mass=1e4, inertia=1e3, centre=(0.0, 1.0))
        column = LinearActuator(foot="ground", foot_point=(0.0, 0.0), head="mass", head_point=(0.0, 1.0))
        guide = Slide(body="mass", point=(0.0, 1.0), direction=0.5 * math.pi)
        return Linkage(bodies={"mass": mass}, slides={"guide": guide}, actuators={"leg": column})


@cache
def struck_leg() -> tuple[float, float]:
    """Largest pressure in the oil [Pa] and force of the block [N], from the equations alone."""
    area, mass = bore_area(0.4), 1e4

    def rates(t: float, state: np.ndarray) -> list[float]:
        down, at, speed, fall = state
        push = max(0.0, 1e8 * (at - 0.5 - down))
        return [speed, fall, (push - 1.96e9 * area * down) / mass, G - push / 2000.0]

    found = solve_ivp(
        rates, (0.0, 0.36), [0.0] * 4, "DOP853", rtol=1e-12, atol=1e-14, max_step=2e-5, dense_output=True
    )

    def largest(of: Callable[[np.ndarray], np.ndarray]) -> float:
        near = found.t[of(found.y).argmax()]  # the end of a step, beside the top
        return float(of(found.sol(np.linspace(near - 2e-5, near + 2e-5, 401))).max())

    pressure = largest(lambda state: mass * G / area + 1.96e9 * state[0])
    return pressure, largest(lambda state: 1e8 * (state[1] - 0.5 - state[0]))


@pytest.mark.parametrize("formulation", FORMULATIONS)
@pytest.mark.parametrize("start", ["concentric", "settled"])
def test_a_leg_that_is_struck_through_a_straight_spring(formulation: str, start: str) -> None:
    rock = FallingBlock(
        body="mass", point=(0.0, 1.0), mass=2000.0, height=0.5, stiffness=1e8, exponent=1.0, restitution=1.0
    )
    oil = OilColumn(bore_area=bore_area(0.4), oil_length=1.0, bulk_modulus=1.96e9)
    scene = Scenario(
        machine=Leg(), actuators={"leg": oil}, loads={"rock": rock}, duration=0.36, record_period=2e-5,
        formulation=formulation, start=start, solver=EXACT,
    )  # fmt: skip
    result = simulate(scene)
    onset = result.onsets["rock"][0]
    assert onset.time == pytest.approx(0.319275428, abs=1e-9)
    assert onset.speed == pytest.approx(3.13209195, abs=1e-8)
    depth = np.maximum(0.0, -result["rock.gap"])
    np.testing.assert_allclose(result["rock.force"], 1e8 * depth, rtol=1e-12)
    share = 1e-5 if formulation == "exudyn" else 2e-6  # records beside the top of a peak
    pressure, force = struck_leg()
    assert result["leg.force"].max() / bore_area(0.4) == pytest.approx(pressure, rel=share)
    assert pressure == pytest.approx(13153284.1, abs=1.0)  # by an independent program
    assert result.largest_force["rock"] == pytest.approx(force, rel=share)


@pytest.mark.parametrize("formulation", FORMULATIONS)
def test_momentum_and_energy_balance_where_two_move(formulation: str) -> None:
    # a ram of 1 t that nothing holds up, without weight: restitution of both masses, momentum of both
    rock = block(body="ram", point=TOP, mass=400.0, height=0.01, speed=3.0, restitution=0.4, stiffness=2e8)
    result = simulate(
        Scenario(
            machine=Ram(), loads={"rock": rock}, duration=0.05, gravity=(0.0, 0.0), formulation=formulation,
            solver=EXACT,
        )
    )  # fmt: skip
    (onset,) = result.onsets["rock"]
    momentum = 400.0 * result["rock.velocity_y"] + MASS * result["ram.velocity_y"]
    np.testing.assert_allclose(momentum, -1200.0, rtol=1e-9)
    assert onset.separation_velocity == pytest.approx(1.2, rel=3e-5)
    reduced = 400.0 * MASS / (400.0 + MASS)
    lost = 0.5 * reduced * 9.0 * (1.0 - 0.16)
    assert result["energy.damping_loss"][-1] == pytest.approx(lost, rel=1e-4)
    assert result.energy_error < 1e-4 * lost


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


# --- as data, and at rest ---


def test_it_can_be_saved_and_read(tmp_path: object) -> None:
    scene = on_the_held(block(), duration=0.33)
    result = simulate(scene)
    path = result.save(f"{tmp_path}/run.h5")
    assert Result.load(path).scenario == scene


@pytest.mark.parametrize("formulation", FORMULATIONS)
@pytest.mark.parametrize("rock", [block(), block(height=0.1, speed=1.0, slope=-0.3)], ids=["dropped", "thrown"])
def test_it_hangs_while_the_support_settles(rock: FallingBlock, formulation: str) -> None:
    with_clearance = {paper_machine.CLEARANCE_PIN: paper_machine.clearance_joint(1.5, 0.0)}
    scene = on_the_held(
        rock, actuators=ON_OIL, pins=with_clearance, start="settled", duration=0.06, formulation=formulation
    )
    result, alone = simulate(scene), simulate(replace(scene, loads={}))
    # before it strikes the support stands as without it; Newton's tolerance of the static solution
    assert result["tip.y"] == pytest.approx(alone["tip.y"], abs=1e-9)
    assert result["front_column.force"] == pytest.approx(alone["front_column.force"], rel=1e-5)
    # and it falls from where it hung: the canopy gives by less than a millimetre, and it went along
    assert result["rock.gap"][0] == pytest.approx(-rock.start_depth, abs=1e-9)
    fallen = (result["rock.gap"][0] - result["rock.gap"]) / math.cos(rock.slope)
    expected = rock.speed * result.time + 0.5 * G * result.time**2
    np.testing.assert_allclose(fallen, expected, atol=1e-7)
    assert result.energy_error < 1e-3
