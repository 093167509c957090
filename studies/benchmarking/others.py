"""What rows of the benchmark need beside ways of ours, by name.

The stock recipe and a program in C compute the rise. The engine's own contact, and our connector in its place,
run in the same bare solver by equal steps.
"""

from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager
from dataclasses import replace
from functools import partial

from studies.benchmarking import yardstick
from studies.benchmarking.peers.built_in import Evaluator, run_built_in
from studies.benchmarking.peers.stock import run_stock
from studies.benchmarking.row import LeftOutError
from studies.benchmarking.scenes import SCENES
from studies.benchmarking.stopwatch import fastest
from studies.slider_crank.run import REVOLUTION
from support_exudyn import Scenario

Timing = Callable[[], float]  # processor time of one more run [s]
Other = Callable[[], AbstractContextManager[Timing]]
STOCK_STEP = 5e-5  # [s], the longest by which the stock recipe meets the goal
C_TOLERANCE, C_RUNS = 1e-5, 20
RISE = SCENES["rise"].scenario
BARE: Mapping[str, tuple[Scenario, float]] = {  # scenes of the bare solver, and their steps [s]
    "drop of 1 s": (replace(SCENES["drop"].scenario, duration=1.0), 5e-5),
    "slider-crank": (replace(SCENES["slider-crank"].scenario, duration=REVOLUTION), 1e-6),
}


@contextmanager
def _stock() -> Iterator[Timing]:
    yield partial(fastest, partial(run_stock, RISE, STOCK_STEP))


@contextmanager
def _in_c() -> Iterator[Timing]:
    try:
        with yardstick.compiled() as program:
            run = partial(yardstick.run_yardstick, RISE, C_TOLERANCE, program=program, runs=C_RUNS)
            yield lambda: run().seconds
    except yardstick.YardstickError as error:
        raise LeftOutError(str(error).splitlines()[0]) from None


@contextmanager
def _connector(scene: str, contact: Evaluator) -> Iterator[Timing]:
    scenario, step = BARE[scene]
    run = partial(run_built_in, scenario, step, contact=contact, step_callbacks=False)
    yield lambda: run().solve_time


def connector(scene: str, contact: Evaluator) -> str:
    """The name of a run by the bare solver."""
    said = "built-in contact" if contact == "built_in" else f"connector, {contact}"
    return f"{said}, {scene}, step {BARE[scene][1]:g} s"


CONTACTS: tuple[Evaluator, ...] = ("built_in", "symbolic", "python")
STOCK, IN_C = f"stock recipe, step {STOCK_STEP:g} s", f"program in C, {C_TOLERANCE:.0e}"
OTHERS: Mapping[str, Other] = {
    STOCK: _stock,
    IN_C: _in_c,
    **{
        connector(scene, contact): partial(_connector, scene, contact) for scene in BARE for contact in CONTACTS
    },
}
