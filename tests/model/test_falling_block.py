"""Falling blocks and applied forces as data: contact, work, their look."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import FallingBlock, Scenario
from support_exudyn.postprocessing.look.plain import look
from tests.roof_cases import TOP, Ram

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
    assert look(scene).shapes  # a machine that says no more of it
