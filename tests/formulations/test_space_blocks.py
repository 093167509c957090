"""Blocks that fall on a machine in space, beside its middle: located blows, restitution, impulses."""

from __future__ import annotations

import math

import numpy as np
import pytest

from support_exudyn import FallingBlock, Held, Scenario, simulate
from support_exudyn.model.spatial_linkage import SpatialBody, SpatialLinkage
from tests.cases.run_cases import loose_support, support
from tests.cases.spatial_cases import InSpace
from user_forces import InputError

TIP = (3.19590271431274, 1.95)  # of the reference support's canopy [m]
MASS, BLOCK = 50.0, 10.0  # of the body that is struck and of the block [kg]
INERTIA = (6.0, 8.0, 7.0, 0.0, 0.0, 0.0)
E, SPEED, ASIDE, AHEAD = 0.4, 2.0, 0.3, 0.2


def block(**changes: object) -> FallingBlock:
    fields: dict[str, object] = {
        "body": "a",
        "point": (AHEAD, 0.0),
        "lateral": ASIDE,
        "mass": BLOCK,
        "height": 0.01,
        "speed": SPEED,
        "stiffness": 1e8,
        "restitution": E,
    }
    return FallingBlock(**fields | changes)


def struck(rock: FallingBlock, **changes: object) -> Scenario:
    """A free body that a block strikes."""
    body = SpatialBody(mass=MASS, inertia=INERTIA, centre=(0.0, 0.0, 0.0))
    fields: dict[str, object] = {
        "machine": InSpace(space=SpatialLinkage(bodies={"a": body})),
        "dimensions": 3,
        "loads": {"rock": rock},
        "duration": 0.02,
        "step": 1e-3,
        "record_period": 1e-3,
        "gravity": (0.0, 0.0),
    }
    return Scenario(**fields | changes)


def test_a_blow_beside_the_middle_delivers_restitution_and_impulse() -> None:
    result = simulate(struck(block()))
    (blow,) = result.onsets["rock"]
    # it falls 0.01 m at 2 m/s; of what the body does before, nothing
    assert blow.time == pytest.approx(0.01 / SPEED, rel=1e-9)
    assert blow.speed == pytest.approx(SPEED, rel=1e-9)
    assert blow.separation_velocity == pytest.approx(E * SPEED, rel=1e-3)
    # the body shifts, rolls and pitches under the impulse: 1/m = 1/M + z^2/Jxx + x^2/Jzz + 1/block
    lightness = 1.0 / MASS + ASIDE**2 / INERTIA[0] + AHEAD**2 / INERTIA[2] + 1.0 / BLOCK
    impulse = (1.0 + E) * SPEED / lightness
    end = {name: result[name][-1] for name in result.channels}
    assert end["rock.velocity_y"] == pytest.approx(-SPEED + impulse / BLOCK, rel=1e-3)
    assert end["a.velocity_y"] == pytest.approx(-impulse / MASS, rel=1e-3)
    # down on the right turns about +x, which is a positive roll: r x F = z F along x
    assert end["a.angular_velocity_x"] == pytest.approx(ASIDE * impulse / INERTIA[0], rel=1e-3)
    assert end["a.angular_velocity"] == pytest.approx(-AHEAD * impulse / INERTIA[2], rel=1e-3)
    lost = 0.5 * (1.0 - E * E) * SPEED**2 / lightness
    assert end["energy.damping_loss"] == pytest.approx(lost, rel=2e-3)
    assert np.abs(result["energy.balance"]).max() < 1e-3 * lost


@pytest.mark.parametrize("slope", [0.0, 0.6, 1.3])
def test_a_settled_start_leaves_a_sloping_block_where_it_is(slope: float) -> None:
    height, slow = 0.1, 1.3  # of the fall [m], of the time it takes
    fall = math.sqrt(2.0 * height / 9.81)
    rock = block(body="canopy", point=TIP, mass=700.0, height=height, speed=0.0, slope=slope, stiffness=1e9)
    result = simulate(
        support(
            drive=Held(), duration=slow * fall, step=5e-4, loads={"rock": rock}, dimensions=3, start="settled"
        )
    )
    assert result["rock.y"][0] == pytest.approx(rock.centre[1], abs=1e-12)
    blow = result.onsets["rock"][0]
    assert blow.time == pytest.approx(fall, rel=1e-9)
    assert blow.speed == pytest.approx(9.81 * fall * math.cos(slope), rel=1e-6)


def test_a_block_on_one_of_two_is_refused() -> None:
    with pytest.raises(InputError, match=r"loads\.rock\.body = 'front_link': there are two of it in space"):
        loose_support(dimensions=3, loads={"rock": block(body="front_link", point=TIP)})
