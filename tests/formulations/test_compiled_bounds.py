"""Compiled code stays within its arrays: scenes of every kind with all indices looked at."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from tests.formulations.test_compiled_agrees import SCENES
from tests.processes import environment

RUN = """
from dataclasses import replace
from support_exudyn import SolverSettings, simulate
from tests.formulations.test_compiled_agrees import SCENES
for name, made in SCENES.items():
    scene = replace(made(), formulation="compiled", solver=SolverSettings(tolerance=1e-6))
    simulate(replace(scene, duration=0.5 * scene.duration, record_period=scene.duration / 20.0))
    print(name)
"""


@pytest.mark.slow  # all is compiled anew
def test_no_index_is_out_of_bounds(tmp_path: Path) -> None:
    # nothing else would tell: what is written elsewhere ends the process later, or changes numbers
    looked_at = {"NUMBA_BOUNDSCHECK": "1", "NUMBA_CACHE_DIR": str(tmp_path)}
    found = subprocess.run(
        [sys.executable, "-c", RUN],
        env=environment() | looked_at,
        cwd=Path(__file__).parents[2],
        capture_output=True,
        text=True,
    )
    assert found.returncode == 0, found.stderr
    assert found.stdout.splitlines() == list(SCENES)
