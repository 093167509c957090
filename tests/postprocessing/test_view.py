"""What is known of the viewer without opening it."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from support_exudyn.mechanics.body_motion import rotation
from support_exudyn.postprocessing.export.solution_file import euler_parameters
from support_exudyn.postprocessing.look.poses import strut_axes as along

small = st.floats(-1.0, 1.0)


# rounding: a few units of the last place of numbers about 1
@given(st.lists(st.tuples(small, small, small), min_size=1, max_size=9))
def test_euler_parameters_are_of_the_rotation_and_do_not_jump(
    vectors: list[tuple[float, float, float]],
) -> None:
    turns = Rotation.from_rotvec(np.cumsum(vectors, axis=0)).as_matrix()  # several turns in all
    found = euler_parameters(turns)
    assert rotation(found) == pytest.approx(turns, abs=1e-14)
    assert found[0, 0] >= 0.0
    assert np.all(np.sum(found[1:] * found[:-1], axis=1) >= -1e-14)


@given(small, small, small)
def test_a_column_reaches_along_its_line(x: float, y: float, z: float) -> None:
    direction = np.array([x, y, z])
    if np.linalg.norm(direction) < 1e-3:
        return
    turn = along(direction)
    assert turn @ turn.T == pytest.approx(np.eye(3), abs=1e-14)
    assert np.linalg.det(turn) == pytest.approx(1.0)
    assert turn[:, 0] * np.linalg.norm(direction) == pytest.approx(direction, abs=1e-14)
