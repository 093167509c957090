"""Moving on by a time that is not worth a step."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from support_exudyn import CubicStep
from support_exudyn.formulations.redundant.scene.engine_scene import slide
from support_exudyn.formulations.redundant.scene.scene_builder import build
from tests.cases.run_cases import PIN, loose_support

REST = 1e-4  # [s], far longer than any, so that all terms show


def test_positions_velocities_and_memory_move_on() -> None:
    scene: Any = build(loose_support(0.5, 0.25, drive=CubicStep(), duration=0.01))
    data = scene.mbs.systemData
    size = data.GetODE2Coordinates().size
    q, v, a = (np.linspace(low, high, size) for low, high in ((0.0, 1e-5), (0.1, 0.3), (-5.0, 20.0)))
    data.SetODE2Coordinates(q)
    data.SetODE2Coordinates_t(v)
    data.SetODE2Coordinates_tt(a)
    scene.refresh_memory()
    before = scene.clearance_joints[PIN].kept
    slide(scene, REST)
    # by hand; rounding
    assert data.GetODE2Coordinates() == pytest.approx(q + REST * v + 0.5 * REST**2 * a, rel=1e-13, abs=1e-18)
    assert data.GetODE2Coordinates_t() == pytest.approx(v + REST * a, rel=1e-13)
    after = scene.clearance_joints[PIN].kept
    # the depth moves on with its rate, to first order
    assert after.depth - before.depth == pytest.approx(REST * before.rate, rel=0.2)
    assert after.rate != before.rate
    scene.release()
