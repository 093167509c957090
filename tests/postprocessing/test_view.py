"""What is known of the viewer without opening it."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from support_exudyn.mechanics.body_motion import rotation
from support_exudyn.postprocessing.export.solution_file import euler_parameters

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
