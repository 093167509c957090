"""What two scenes came out at is kept in `baseline/`; what changes of the program are seen: `tests/planted`.

If it is meant: `python -m pytest -n 0 tests/postprocessing/baselines --baseline-update 'test_own_baselines.*'`
"""

from __future__ import annotations

import math

from support_exudyn.postprocessing.comparing.baselines import kept_run
from support_exudyn.postprocessing.pytest_plugin import Baseline, SimulateCached
from tests.postprocessing.baselines.scenes import rise, rocker


def test_the_rocker_is_as_it_was(simulate_cached: SimulateCached, baseline: Baseline) -> None:
    run = simulate_cached(rocker())
    assert math.isinf(kept_run(run).horizon)
    baseline(run)


def test_the_rise_is_as_it_was(simulate_cached: SimulateCached, baseline: Baseline) -> None:
    baseline(simulate_cached(rise()))
