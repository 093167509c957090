"""A block on an inclined guide, as in every textbook."""

from __future__ import annotations

import math

import numpy as np
import pytest

from support_exudyn import Body, Linkage, Machine, Scenario, Slide, TracePoint, simulate
from tests.cases.run_cases import slider_crank
from user_forces import value

MASS, G = 2.0, 9.81
POINT = (0.3, 0.4)  # on the guide [m]
ASIDE = 0.1  # of the centre of mass from it, along x [m]


@value
class Block(Machine):
    """A block that slides on a line through a point of it, its centre of mass beside."""

    direction: float
    angle: float

    def linkage(self) -> Linkage:
        centre = (POINT[0] + ASIDE, POINT[1])
        return Linkage(
            bodies={"block": Body(mass=MASS, inertia=0.05, centre=centre, angle=self.angle)},
            points={"edge": TracePoint(body="block", point=POINT)},
            slides={"guide": Slide(body="block", point=POINT, direction=self.direction)},
        )


@pytest.mark.parametrize("angle", [0.0, 0.7])
@pytest.mark.parametrize("direction", [0.0, 0.4, -1.2, 2.5])
def test_a_block_slides_down_an_incline_that_carries_it(direction: float, angle: float) -> None:
    slid = simulate(Scenario(machine=Block(direction=direction, angle=angle), duration=0.2))
    path = -0.5 * G * math.sin(direction) * slid.time**2
    expected = np.array(POINT) + path[:, None] * np.array([math.cos(direction), math.sin(direction)])
    # constant acceleration, which the integrator takes exactly; Newton's tolerance of 1e-8
    np.testing.assert_allclose(slid["edge.x"], expected[:, 0], atol=1e-9)
    np.testing.assert_allclose(slid["edge.y"], expected[:, 1], atol=1e-9)
    np.testing.assert_allclose(slid["block.angle"], angle, atol=1e-12)
    assert slid.energy_error < 1e-9
    # across the guide acts the weight's part, at the centre of mass: its moment is about the point on the guide
    force = MASS * G * abs(math.cos(direction))
    np.testing.assert_allclose(slid["guide.force"][1:], force, rtol=1e-7)
    np.testing.assert_allclose(slid["guide.moment"][1:], force * abs(ASIDE * math.cos(direction)), rtol=1e-7)


def test_the_slider_of_a_slider_crank_does_not_tilt() -> None:
    result = simulate(slider_crank(2e-3, record_period=1e-4))
    # its pin is in its centre of mass and on the guide; of forces of 1 kN on lengths of 0.1 m
    assert result["guide.force"].max() > 500.0
    np.testing.assert_allclose(result["guide.moment"][1:], 0.0, atol=1e-6)
