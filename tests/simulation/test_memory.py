"""What a run takes does not grow with what it does not record, and nothing of it stays behind."""

from __future__ import annotations

import gc
import tracemalloc
from collections.abc import Iterator
from dataclasses import replace

import pytest

from support_exudyn import Held, Scenario, SolverSettings, simulate
from support_exudyn.formulations.exudyn.scene.engine_scene import EngineScene
from support_exudyn.formulations.exudyn.scene.load_item import LoadItem
from support_exudyn.model.loads.load import AnyLoad
from tests.cases.run_cases import loose_support
from tests.roof_cases import over_the_canopy
from user_forces.connector.clearance_joint import ClearanceJoint


def held(formulation: str, duration: float) -> Scenario:
    """A support whose pin rattles and swings for long; few records."""
    return loose_support(
        drive=Held(),
        duration=duration,
        record_period=duration / 4,
        step=2e-3,
        formulation=formulation,
        solver=SolverSettings(impact_steps=64, tolerance=1e-4),
    )


def peak(scenario: Scenario) -> int:
    """Most memory that Python held during a run [bytes]."""
    tracemalloc.start()
    try:
        simulate(scenario)
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize(
    ("formulation", "duration"), [pytest.param("exudyn", 0.4, marks=pytest.mark.slow), ("compiled", 10.0)]
)
def test_memory_is_flat_in_simulated_time(formulation: str, duration: float) -> None:
    simulate(held(formulation, 0.2))  # what is made once
    # of which the short one has more steps than become statistics at once, in as many intervals
    short, long = peak(held(formulation, duration)), peak(held(formulation, 4.0 * duration))
    # four times the time; impacts are recorded, a hundred bytes each
    assert long - short < 60_000


@pytest.fixture(scope="module")
def only_ours() -> Iterator[None]:
    """The collector looks at nothing that was there before."""
    gc.collect()
    gc.freeze()
    yield
    gc.unfreeze()


@pytest.mark.usefixtures("only_ours")
@pytest.mark.parametrize("loads", [{}, {"roof": over_the_canopy(0.1)}], ids=["free", "under a roof"])
def test_nothing_of_a_run_stays_behind(loads: dict[str, AnyLoad]) -> None:
    simulate(replace(held("exudyn", 0.1), loads=loads))
    # the engine would keep its user functions alive, and they all that they know
    gc.collect()
    assert not [item for item in gc.get_objects() if isinstance(item, (EngineScene, ClearanceJoint, LoadItem))]
