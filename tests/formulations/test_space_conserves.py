"""Bodies in space joined only by a clearance bearing: momenta stay, and energy goes where the channels say."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Literal

import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from support_exudyn import ClearancePin, Scenario, SolverSettings, simulate
from support_exudyn.model.spatial_linkage import Bearing, SpatialBody, SpatialLinkage
from tests.cases.spatial_cases import (
    CLEARANCE,
    LENGTH,
    InSpace,
    Vector,
    contact,
    momenta,
    observed,
    placements,
    vectors,
)

Bore = Literal["first", "second"]
few = settings(
    max_examples=6,
    deadline=None,
    derandomize=True,
    phases=[Phase.explicit, Phase.generate],  # each is a run: shrinking would take minutes
    suppress_health_check=[HealthCheck.too_slow],
)
bores = st.sampled_from(["first", "second"])


def scenario(
    space: SpatialLinkage, bore: Bore, friction: float, by_depth: bool, impact_steps: int = 64
) -> Scenario:
    pin = ClearancePin(contact=contact(friction, by_depth), bore=bore)
    return Scenario(
        machine=InSpace(space=space),
        pins={"pin": pin},
        dimensions=3,
        duration=0.01,
        step=5e-5,
        gravity=(0.0, 0.0),
        solver=SolverSettings(impact_steps=impact_steps, sections=3),
    )


@pytest.mark.parametrize(
    ("friction", "by_depth"),
    [(0.0, True), (0.3, False)],
)
@few
@given(space=placements(), bore=bores, about=vectors(1.0))
def test_two_free_bodies_keep_their_momenta(
    friction: float, by_depth: bool, space: SpatialLinkage, bore: Bore, about: Vector
) -> None:
    context, outcome = observed(scenario(space, bore, friction, by_depth))
    linear, angular = momenta(context, about)
    size = sum(
        b.mass * np.linalg.norm(b.velocity) + 0.02 * np.linalg.norm(b.spin) for b in space.bodies.values()
    )
    # rounding of some thousand steps
    np.testing.assert_allclose(linear, np.broadcast_to(linear[0], linear.shape), atol=1e-12 * (1.0 + size))
    # 64 steps in an impact; the error is of second order, measured 1e-8. A force that is 1 mm beside itself
    # would give 1e-3 of the momentum; with friction the engine's connector loses tilt^2/24, here up to 2e-5 of
    # what goes through the bearing times the eccentricity of 1 mm
    np.testing.assert_allclose(angular, np.broadcast_to(angular[0], angular.shape), atol=1e-6 * (1.0 + size))
    start = context.kinetic[0] + context.stored[0]
    # integrals over 64 steps an impact; measured 2e-4 of the energy and less, which falls with the steps
    assert np.abs(context.balance).max() < 2e-3 * start + 1e-12
    lost = context.damping_loss[-1] + context.friction_loss[-1]
    assert lost >= (-1e-6 * start if by_depth else 0.0) or not outcome.onsets["pin"]


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_a_shift_along_the_bore_does_not_press_the_journal(friction: float) -> None:
    # a journal that slides along its bore by five clearances, in the middle of it
    still = SpatialBody(mass=2.0, inertia=(0.02, 0.02, 0.02, 0.0, 0.0, 0.0), centre=(0.0, 0.0, 0.0))
    bearing = Bearing(
        first="one",
        second="two",
        first_point=(0.0, 0.0, 0.0),
        second_point=(0.0, 0.0, 0.0),
        length=LENGTH,
        holds=frozenset(),
        pin="pin",
    )
    space = SpatialLinkage(
        bodies={"one": still, "two": replace(still, velocity=(0.0, 0.0, 0.5))}, bearings={"pin": bearing}
    )
    result = simulate(replace(scenario(space, "first", friction, by_depth=False), duration=0.02))
    assert result["two.z"][-1] == pytest.approx(0.01, rel=1e-9)  # rounding: nothing holds it
    assert result["two.z"][-1] > 5 * CLEARANCE
    assert not result.onsets["pin"]
    np.testing.assert_allclose(result["pin.pin.depth"], -CLEARANCE, rtol=1e-9)  # rounding


def test_an_impact_after_a_tilted_separation_is_seen() -> None:
    # what the engine makes of a tilted section's depth differs from its true depth by tilt^2/24: a step that
    # began at the one and ended at the other would have no impact between
    one = SpatialBody(
        mass=2.0,
        inertia=(0.04323, 0.03314, 0.03137, -0.00458, 0.00424, -0.00161),
        centre=(0.0175, 0.0849, 0.0),
        velocity=(0.00231, 0.18081, 0.09934),
        spin=(-0.5591, -3.08494, 3.1194),
    )
    two = SpatialBody(
        mass=1.5,
        inertia=(0.02768, 0.02703, 0.02707, -0.00282, 0.00126, 0.00239),
        centre=(-0.08421, 0.19384, -0.12651),
        velocity=(-0.1566, -0.18827, 0.2),
        spin=(1.61737, 3.64034, 0.0),
    )
    pin = Bearing(
        first="one",
        second="two",
        first_point=(-0.14965, 0.19955, -0.15346),
        second_point=(-0.14961, 0.19959, -0.15291),
        first_axis=(math.sqrt(1.0 - 0.71417**2), -0.71417, 0.0),
        second_axis=(math.sqrt(1.0 - 0.71874**2 - 0.0006**2), -0.71874, 0.0006),
        length=LENGTH,
        holds=frozenset(),
        pin="pin",
    )
    space = SpatialLinkage(bodies={"one": one, "two": two}, bearings={"pin": pin})
    scene = scenario(space, "first", friction=0.3, by_depth=False, impact_steps=32)
    impacts = simulate(replace(scene, duration=5e-3)).onsets["pin"]
    # by 80 steps an impact
    assert [impact.time for impact in impacts] == pytest.approx([3.1562e-4, 1.94384e-3, 3.50604e-3], rel=2e-4)
    assert [impact.speed for impact in impacts] == pytest.approx([1.16599, 0.53749, 1.11403], rel=2e-4)
