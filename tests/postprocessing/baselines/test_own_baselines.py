"""What two scenes came out at is kept in `baseline/`; what changes of the program are seen: `tests/planted`.

If it is meant: `python -m pytest -n 0 tests/postprocessing/baselines --baseline-update 'test_own_baselines.*'`
"""

from __future__ import annotations

import json
import math
import subprocess
import sys
from pathlib import Path

import pytest

from support_exudyn.postprocessing.comparing.kept_run import kept_run
from support_exudyn.postprocessing.pytest_plugin import Baseline, SimulateCached
from tests.postprocessing.baselines.scenes import rise, rocker
from tests.processes import ROOT, environment

# sums in other orders, products added without rounding, reciprocals: what other processors and compilers do
ANOTHER_PROCESSOR = """
import json
import sys
from pathlib import Path

import numba
import numpy as np

njit = numba.njit
numba.njit = lambda *given, **more: njit(*given, **more | {"fastmath": {"contract", "reassoc", "arcp", "afn"}})

from support_exudyn import simulate
from support_exudyn.postprocessing.comparing.kept_run import kept_run, read_baseline
from support_exudyn.postprocessing.comparing.changes import changes
from tests.postprocessing.baselines import scenes

told = {}
for name in ("rocker", "rise"):
    was = read_baseline(Path(sys.argv[1]) / f"test_own_baselines.test_the_{name}_is_as_it_was.json")
    now = kept_run(simulate(getattr(scenes, name)()))
    off = max(np.abs(one.values / was.curves[key].values - 1.0).max() for key, one in now.curves.items()
              if np.abs(was.curves[key].values).min() > 0.0)
    told[name] = [float(off), len(changes(was, now))]
print(json.dumps(told))
"""


def test_the_rocker_is_as_it_was(simulate_cached: SimulateCached, baseline: Baseline) -> None:
    run = simulate_cached(rocker())
    assert math.isinf(kept_run(run).horizon)
    baseline(run)


def test_the_rise_is_as_it_was(simulate_cached: SimulateCached, baseline: Baseline) -> None:
    baseline(simulate_cached(rise()))


@pytest.mark.slow  # compiles all once more
def test_other_rounding_of_what_is_compiled_is_no_change(tmp_path: Path) -> None:
    found = subprocess.run(
        [sys.executable, "-c", ANOTHER_PROCESSOR, str(Path(__file__).parent / "baseline")],
        cwd=ROOT, env=environment() | {"NUMBA_CACHE_DIR": str(tmp_path)}, capture_output=True, text=True,
        timeout=600, check=False,
    )  # fmt: skip
    assert found.returncode == 0, found.stderr[-2000:]
    for off, changed in json.loads(found.stdout.splitlines()[-1]).values():
        assert off > 1e-12  # it was rounded otherwise, to more than the digits that are kept
        assert changed == 0
