"""What rows of the benchmark are set against, by name: the stock recipe, and a program in C."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager
from functools import partial

from studies.benchmarking import yardstick
from studies.benchmarking.peers.stock import run_stock
from studies.benchmarking.row import LeftOutError
from studies.benchmarking.scenes import SCENES
from studies.benchmarking.stopwatch import fastest
from support_exudyn import Scenario

Timing = Callable[[], float]  # processor time of one more run [s]
STOCK_STEP = 5e-5  # [s], the longest by which the stock recipe meets the goal
C_TOLERANCE, C_RUNS = 1e-5, 20
RISE = "rise"


@contextmanager
def _stock(scenario: Scenario) -> Iterator[Timing]:
    yield partial(fastest, partial(run_stock, scenario, STOCK_STEP))


@contextmanager
def _in_c(scenario: Scenario) -> Iterator[Timing]:
    try:
        with yardstick.compiled() as program:
            yield lambda: yardstick.run_yardstick(scenario, C_TOLERANCE, program=program, runs=C_RUNS).seconds
    except yardstick.YardstickError as error:
        raise LeftOutError(str(error).splitlines()[0]) from None


Other = Callable[[Scenario], AbstractContextManager[Timing]]
STOCK, IN_C = f"stock recipe, step {STOCK_STEP:g} s", f"program in C, {C_TOLERANCE:.0e}"
OTHERS: Mapping[str, Other] = {STOCK: _stock, IN_C: _in_c}


def other(name: str) -> AbstractContextManager[Timing]:
    """The rise by another program, ready to be timed. Raises LeftOutError if it cannot be had here."""
    return OTHERS[name](SCENES[RISE].scenario)
