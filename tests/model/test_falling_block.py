"""Falling blocks and applied forces as data: contact, work, their look."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import FallingBlock, Scenario, reference_support
from support_exudyn.postprocessing.look import looks
from support_exudyn.postprocessing.look.plain import blocks, look
from support_exudyn.postprocessing.look.solid import Role
from tests.roof_cases import TOP, Ram
from user_forces import InputError

ROCK = FallingBlock(body="ram", point=TOP, mass=400.0, height=0.2, stiffness=2e8, restitution=0.4)


@given(depth=st.floats(-0.1, 0.1), rate=st.floats(-20.0, 20.0))
def test_a_block_never_pulls(depth: float, rate: float) -> None:
    contact = ROCK.contact
    found = contact.force(0.0, contact.bearing.clearance + depth, 0.0, rate, 0.0, 0.0, 2.0)
    assert (found.depth, found.rate) == (pytest.approx(depth, abs=1e-12), rate)
    assert found.normal_force >= 0.0
    assert found.normal_force == 0.0 or found.depth > 0.0
    assert (found.force_x, found.force_y) == (0.0, -found.normal_force)


def test_the_first_depth_is_that_of_all_its_energy() -> None:
    rock = replace(ROCK, speed=1.5)
    # all of m (v^2/2 + g height) in K depth^(n+1)/(n+1)
    energy = 400.0 * (0.5 * 1.5**2 + 9.81 * 0.2)
    assert rock.first_depth((0.0, -9.81)) == pytest.approx((2.5 * energy / 2e8) ** 0.4)
    assert replace(rock, speed=0.0).first_depth((0.0, 9.81)) == 0.0  # it flies away


def test_a_block_and_its_guide_join_the_machine() -> None:
    scene = Scenario(machine=Ram(), loads={"rock": ROCK}, duration=0.1)
    body = scene.linkage.bodies["rock"]
    assert body.centre == pytest.approx((TOP[0], TOP[1] + 0.2 + 0.5 * ROCK.side))
    assert scene.linkage.slides["rock_guide"].body == "rock"
    assert {"rock.force", "rock.gap", "rock.y", "rock.velocity_y", "rock.impact_velocity"} <= set(
        scene.channel_definitions
    )
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


@pytest.mark.parametrize(
    ("field", "number"),
    [
        ("mass", 0.0),
        ("height", -0.1),
        ("stiffness", 0.0),
        ("restitution", 1.1),
        ("exponent", 0.5),
        ("slope", 1.5),
    ],
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
