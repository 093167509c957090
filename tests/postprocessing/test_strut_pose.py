"""Axes of struts and their rates."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from support_exudyn.postprocessing.look.poses import ALONG_Z, axes_along

number = st.floats(-2.0, 2.0)
vector = st.tuples(number, number, number).map(np.array)


@given(vector, vector)
def test_axes_are_right_handed_and_their_rates_are_those_of_the_way(way: np.ndarray, rate: np.ndarray) -> None:
    length = np.linalg.norm(way)
    # near the cone where the neighbour changes axes jump, and short ways turn fast
    assume(length > 0.3 and abs(abs(way[2]) / length - ALONG_Z) > 0.005)
    axes, turning = axes_along(way, rate)
    # rounding of unit vectors whose neighbour may be as near as 8 degrees
    assert axes.T @ axes == pytest.approx(np.eye(3), abs=1e-13)
    assert np.linalg.det(axes) == pytest.approx(1.0, abs=1e-13)
    assert length * axes[:, 0] == pytest.approx(way, abs=1e-13)
    step = 1e-5
    differences = (axes_along(way + step * rate, rate)[0] - axes_along(way - step * rate, rate)[0]) / (2 * step)
    # third derivatives of axes: up to (speed / (0.3 m sin 8 degrees))^3 about 6e5 per s^3 times step^2 / 6
    assert turning == pytest.approx(differences, abs=2e-5)


def test_in_the_plane_z_stays() -> None:
    axes, turning = axes_along(np.array([0.3, 0.4, 0.0]), np.array([-0.4, 0.3, 0.0]))
    assert axes == pytest.approx(np.array([[0.6, -0.8, 0.0], [0.8, 0.6, 0.0], [0.0, 0.0, 1.0]]))
    # it turns at 1 rad/s
    assert turning == pytest.approx(np.array([[-0.8, -0.6, 0.0], [0.6, -0.8, 0.0], [0.0, 0.0, 0.0]]))
