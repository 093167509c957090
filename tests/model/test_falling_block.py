"""Falling blocks and applied forces as data: the contract of loads, steps of an impact, their look."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import AppliedForce, FallingBlock, Load, LoadedPoint, Scenario, reference_support
from support_exudyn.formulations.redundant.scene.load_item import _pull
from support_exudyn.postprocessing.look import looks
from support_exudyn.postprocessing.look.plain import blocks, look
from support_exudyn.postprocessing.look.solid import Role
from tests.roof_cases import TOP, Ram
from user_forces import InputError, delivered_restitution
from user_forces.values.value import Value

ROCK = FallingBlock(body="ram", point=TOP, mass=400.0, height=0.2, stiffness=2e8, restitution=0.4)
FORCE = AppliedForce(body="ram", point=TOP, full_force=(2e3, -5e4), start=0.1, end=0.3)
STRIKING = math.sqrt(2.0 * 9.81 * 0.2)  # [m/s]


@given(
    load=st.sampled_from([ROCK, FORCE]),
    depth=st.floats(-0.05, 0.05),
    vx=st.floats(-2.0, 2.0),
    vy=st.floats(-3.0, 3.0),
    t=st.floats(0.0, 0.5),
)
def test_energy_stored_changes_by_the_powers(load: Load, depth: float, vx: float, vy: float, t: float) -> None:
    small = 1e-7
    y = 0.2 + depth

    def stored(at: float) -> float:
        return load.stored(LoadedPoint(t + at, at * vx, y + at * vy, vx, vy))

    at = LoadedPoint(t, 0.0, y, vx, vy)
    rate = (stored(small) - stored(-small)) / (2.0 * small)
    (fx, fy), powers = load.force(at), load.powers(at)
    size = abs(fx * vx) + abs(fy * vy) + abs(powers.loss)
    # central differences of 1e-7 s, and of what begins or ends between both
    assert rate == pytest.approx(powers.work - powers.loss - fx * vx - fy * vy, rel=1e-4, abs=1e-4 * size + 1.0)
    assert powers.loss >= 0.0


@given(depth=st.floats(-0.1, 0.1), rate=st.floats(-20.0, 20.0))
def test_a_block_never_pulls(depth: float, rate: float) -> None:
    along, up = ROCK.force(LoadedPoint(0.0, 0.0, 0.2 + depth, 0.0, rate))
    assert along == 0.0
    assert up <= 0.0
    assert up == 0.0 or depth > 0.0


@pytest.mark.parametrize("restitution", [0.1, 0.5, 0.9])
def test_damping_is_that_of_the_exact_law_at_the_first_speed(restitution: float) -> None:
    rock = FallingBlock(
        body="ram", point=TOP, mass=1.0, height=0.2, stiffness=1e6, restitution=restitution, speed=3.0
    )
    assert rock.first_speed == pytest.approx(math.hypot(3.0, STRIKING))  # rounding
    # the root of an equation, and back
    assert delivered_restitution(rock.damping * rock.first_speed) == pytest.approx(restitution, rel=1e-9)


def test_steps_halve_on_the_way_and_are_short_in_an_impact() -> None:
    def longest(gap: float, closing: float) -> float:
        return ROCK.longest_step(LoadedPoint(0.0, 0.0, 0.2 - gap, 0.0, closing), 100)

    short = ROCK.impact_time / 100
    assert longest(0.1, 2.0) == pytest.approx(0.025)
    assert longest(1e-9, 2.0) == short
    assert longest(-0.01, 0.0) == short
    assert longest(short, -1.0) == short  # just separated
    assert longest(0.1, -1.0) == math.inf
    resting = (400.0 * 9.81 / 2e8) ** (1.0 / 1.5)
    assert longest(-resting, 0.0) == math.inf


def test_a_block_and_its_guide_join_the_machine() -> None:
    scene = Scenario(machine=Ram(), loads={"rock": ROCK}, duration=0.1)
    body = scene.linkage.bodies["rock"]
    assert body.centre == pytest.approx((TOP[0], TOP[1] + 0.2 + 0.5 * ROCK.side))
    assert scene.linkage.slides["rock_guide"].body == "rock"
    assert {"rock.force", "rock.gap", "rock.y", "rock.velocity_y"} <= set(scene.channel_definitions)
    assert look(scene).solids  # a machine that says no more of it


def test_pictures_have_a_cube_of_its_mass() -> None:
    tip = reference_support().start().tip
    rock = FallingBlock(body="canopy", point=tip, mass=2600.0, height=0.5, stiffness=1e9, restitution=0.5)
    scene = Scenario(machine=reference_support(), loads={"rock": rock}, duration=0.1)
    (cube,) = blocks(scene)
    assert (cube.role, cube.body) == (Role.ROCK, "rock")
    assert cube.mesh.volume == pytest.approx(1.0)
    assert cube.mesh.bounds[0][1] == pytest.approx(tip[1] + 0.5)
    assert cube.name in {solid.name for solid in looks.look(scene).solids}


@pytest.mark.parametrize("load", [ROCK, FORCE])
def test_loads_come_back_from_data(load: Load) -> None:
    assert Value.from_data(load.to_data()) == load


@pytest.mark.parametrize(
    ("field", "number"),
    [("mass", 0.0), ("height", -0.1), ("stiffness", 0.0), ("restitution", 1.1), ("exponent", 0.5)],
)
def test_what_no_block_can_have_is_refused(field: str, number: float) -> None:
    with pytest.raises(InputError, match=rf"FallingBlock\.{field} = {number}"):
        replace(ROCK, **{field: number})


def test_a_block_is_a_cube_and_its_guide_stands_upright() -> None:
    scene = Scenario(machine=Ram(), loads={"rock": ROCK}, duration=0.1)
    body = scene.linkage.bodies["rock"]
    assert ROCK.side**3 * 2600.0 == pytest.approx(400.0)  # of broken rock, if nothing else is said
    assert body.inertia == pytest.approx(400.0 * ROCK.side**2 / 6.0)  # of a cube about its centre
    assert scene.linkage.slides["rock_guide"].direction == pytest.approx(0.5 * math.pi)


def test_a_block_needs_a_speed_and_gravity_straight_down() -> None:
    replace(ROCK, height=0.0, speed=1.0).check((0.0, -9.81))
    with pytest.raises(InputError, match="one of them > 0"):
        replace(ROCK, gravity=0.0).check((0.0, 0.0))
    for gravity in ((1.0, -9.81), (0.0, 9.81)):
        with pytest.raises(InputError, match="straight down"):
            ROCK.check(gravity)
    for exponent in (1.0, 3.0):
        assert replace(ROCK, exponent=exponent).exponent == exponent
    with pytest.raises(InputError, match=r"FallingBlock\.exponent = 3\.1"):
        replace(ROCK, exponent=3.1)


def test_steepness_is_that_of_the_first_impact_at_its_deepest() -> None:
    rock = replace(ROCK, gravity=0.0, speed=STRIKING)
    # all of m v0^2/2 in K depth^(n+1)/(n+1)
    deepest = (2.5 * 0.5 * 400.0 * STRIKING**2 / 2e8) ** 0.4
    along, against = rock.steepness
    small = 1e-6 * deepest
    forces = [-rock.force(LoadedPoint(0.0, 0.0, 0.2 + deepest + s, 0.0, 0.0))[1] for s in (small, -small)]
    assert along == 0.0
    assert against == pytest.approx((forces[0] - forces[1]) / (2.0 * small), rel=1e-6)  # central difference


def test_an_applied_force_has_come_on_when_it_says() -> None:
    assert FORCE.breaks == (0.1, 0.3)
    assert FORCE.largest(0.2) == pytest.approx((1e3, -2.5e4))  # half of it
    assert FORCE.largest(9.0) == FORCE.full_force
    always = replace(FORCE, start=0.0, end=0.0)
    assert (always.breaks, always.largest(0.0)) == ((), FORCE.full_force)
    point = LoadedPoint(0.2, 0.0, 0.0, 0.0, 0.0)
    assert FORCE.observed(point) == pytest.approx({"force_x": 1e3, "force_y": -2.5e4})
    for end in (0.0, 0.1):
        with pytest.raises(InputError, match=r"allowed: > start = 0\.1 s, or both 0"):
            replace(FORCE, end=end)


def test_the_connector_pulls_its_ends_together_with_what_the_load_pushes_them_apart() -> None:
    found = _pull(FORCE)(None, 0.3, 0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    assert found == pytest.approx([-2e3, 5e4, 0.0])
