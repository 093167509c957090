"""What is known of the viewer without opening it."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from support_exudyn.mechanics.body_motion import rotation
from support_exudyn.postprocessing.export.solution_file import euler_parameters
from support_exudyn.postprocessing.look.poses import strut_axes as along
from support_exudyn.postprocessing.viewer.view import checked_every, differing_versions
from support_exudyn.simulation.provenance import provenance
from user_forces import InputError

small = st.floats(-1.0, 1.0)


def made_with(**versions: str) -> Any:
    return SimpleNamespace(provenance=provenance() | versions)


def test_a_run_of_the_installed_versions_is_not_warned_of() -> None:
    assert differing_versions(made_with()) == []


@pytest.mark.parametrize("package", ["exudyn", "support-exudyn"])
def test_other_versions_are_named(package: str) -> None:
    (sentence,) = differing_versions(made_with(**{package: "0.0.1"}))
    assert f"made with {package} 0.0.1" in sentence


@pytest.mark.parametrize("every", [0, -1, 201, True, 1.5, "2", None])
def test_rows_from_frame_to_frame_are_a_number_of_the_viewers_slider(every: Any) -> None:
    with pytest.raises(InputError, match="allowed: a whole number from 1 to 200"):
        checked_every(every, 1000)


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
