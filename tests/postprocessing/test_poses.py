from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from support_exudyn.postprocessing.look.poses import turned

small = st.floats(-0.5, 0.5)


# rounding: a few units of the last place of numbers about 1
@given(st.floats(-1.2, 1.2), small, small, small)
def test_rotations_are_found_from_the_angles_of_the_channels(z: float, a: float, b: float, c: float) -> None:
    asked = (Rotation.from_rotvec([a, b, c]) * Rotation.from_rotvec([0.0, 0.0, z])).as_matrix()[None]

    def context(row: int, column: int) -> np.ndarray:
        return np.arctan2(asked[:, row, column], asked[:, column, column])

    found = turned(context(1, 0), context(2, 1), context(0, 2))
    assert found == pytest.approx(asked, abs=1e-13)
