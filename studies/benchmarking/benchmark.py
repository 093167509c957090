"""How fast is the program beside others, on the same work in one run on one core?

Every figure is a ratio of times taken in turns in this very run; none is asserted anywhere. The table of the
last run that was kept stands in `studies/benchmarking/RESULTS.md`. Needs a C compiler for one row, and numba.
"""

import math
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from itertools import chain
from pathlib import Path

import numpy as np

from studies.benchmarking import process, yardstick
from studies.benchmarking.lsoda import loosest, run_lsoda
from studies.benchmarking.peers.built_in import Evaluator, run_built_in
from studies.benchmarking.peers.stock import run_stock
from studies.benchmarking.peers.tree import run_tree
from studies.benchmarking.process import timed
from studies.benchmarking.references import errors, references, thinned, times_the_goal
from studies.benchmarking.scenes import SCENES
from studies.benchmarking.variants import Way, peer, redundant, with_tolerance
from studies.common import paper_machine
from studies.common.study import folder_of, show_table, work_in_folder
from studies.slider_crank import run as slider_crank
from support_exudyn import Scenario, SimulationError, SolverSettings, simulate
from support_exudyn.files.whole_file import whole_file
from support_exudyn.postprocessing.page.pieces import Sheet
from user_forces import Hertz
from user_forces.normal.power_law import PowerLaw

STUDY = "benchmark"
SHORT_RUN = 0.05  # [s]; shorter ones are timed more often before one is chosen
TURNS = 3  # in which ways are timed one after the other; the fastest of each counts
SMALL_ERROR = 1e-6  # of the slider over the first half revolution [m]
STOCK_STEPS = (2e-4, 1e-4, 5e-5, 2e-5)  # [s]
RISE, OIL = "rise", "rise, oil"
# [s]; a pressed elastic pin vibrates for ever, and steps that do not follow it damp that out: ones of 2 ms take
# 93 J of it in 20 s, half of all that there is, these 5 J
RESTLESS_STEP = 2e-4


@dataclass(frozen=True)
class BenchmarkLine:
    """A line of the table: what against what, how, seconds of both, their ratio, and what was asked for.

    refused: why there is no ratio, if a run was not finished; seconds are then not a number.
    """

    what: str
    how: str
    seconds: float
    against: str
    other: float
    asked: str
    refused: str = ""

    @property
    def ratio(self) -> str:
        """Time of the other over ours if that is slower, else ours over the other's."""
        if self.refused:
            return "refused"
        if self.seconds <= self.other:
            return f"1/{_brief(self.other / self.seconds)}"
        return _brief(self.seconds / self.other)

    @property
    def is_missed(self) -> bool:
        """Whether a ratio was asked for and is larger."""
        return bool(self.asked) and self.seconds / self.other > float(Fraction(self.asked))


def _brief(ratio: float) -> str:
    return f"{ratio:.3g}" if ratio < 100.0 else f"{ratio:.0f}"


def refused_line(what: str, how: str, against: str, asked: str, reason: str) -> BenchmarkLine:
    """A line of runs one of which was not finished."""
    return BenchmarkLine(what, how, math.nan, against, math.nan, asked, f"refused: {reason}")


def versus(what: str, how: str, ours: Scenario, against: str, other: Scenario, asked: str) -> BenchmarkLine:
    """A line of two runs of ours, timed in turns."""
    try:
        seconds = in_turns(partial(simulate, ours), partial(simulate, other), turns=2)
    except SimulationError as error:
        return refused_line(what, how, against, asked, error.failure.reason)
    return BenchmarkLine(what, how, seconds[0], against, seconds[1], asked)


def in_turns(*runs: Callable[[], object], turns: int = TURNS) -> list[float]:
    """The fastest of several turns, for each of the runs [s]."""
    return [min(times) for times in zip(*([timed(run) for run in runs] for _ in range(turns)), strict=True)]


# --- the rise, to the goal ---


def cheapest_way(scene: str, tried: Sequence[Way]) -> Way | None:
    """The fastest of some ways that meet the goal; None if none does."""
    known = references()[scene]
    good: list[tuple[float, Way]] = []
    for way in tried:
        try:
            off = times_the_goal(errors(way.run().sample, known))
        except SimulationError:  # too coarse to be finished
            continue
        if off <= 1.0:
            seconds = timed(way.bare)
            for _ in range(30 if seconds < SHORT_RUN else 2 if seconds < 1.0 else 0):
                seconds = min(seconds, timed(way.bare))
            good.append((seconds, way))
    return min(good, key=lambda item: item[0])[1] if good else None


def rise_lines() -> Iterator[BenchmarkLine]:
    """The stock recipe's time to the goal against ours; compiled against the yardstick in C."""
    smooth, oil = SCENES[RISE], SCENES[OIL]
    stock_ways = [peer("stock recipe", f"step {h:g} s", smooth, run_stock, h) for h in STOCK_STEPS]
    stock = cheapest_way(RISE, stock_ways) or stock_ways[-1]
    tolerances = (1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 1e-5, 1e-6)
    coarse = [
        redundant(smooth, "redundant", "", share, impact_steps=steps, growth=8.0, backend="symbolic")
        for share in (2.0, 1.0)
        for steps in (64, 96, 128, 192, 256)
    ]
    wanted = {
        "redundant": (RISE, coarse, "1/8"),
        "tree, on oil columns": (OIL, [with_tolerance(oil, "compiled", t) for t in tolerances], "1/40"),
        "compiled": (RISE, [with_tolerance(smooth, "compiled", t) for t in tolerances], ""),
    }
    for name, (scene, tried, asked) in wanted.items():
        what = f"rise to the goal: {name}"
        way = cheapest_way(scene, tried)
        if way is None:
            yield refused_line(what, "", "", asked, "no setting meets the goal")
            continue
        ours, others, finest = in_turns(way.bare, stock.bare, stock_ways[-1].bare, turns=2)
        yield BenchmarkLine(what, way.label, ours, f"stock recipe, {stock.label}", others, asked)
        yield BenchmarkLine(what, way.label, ours, f"stock recipe, {stock_ways[-1].label}", finest, "")
        if name == "compiled":
            yield from _against_the_yardstick(what, way)


def _against_the_yardstick(what: str, way: Way) -> Iterator[BenchmarkLine]:
    scenario = SCENES[RISE].scenario
    try:
        with yardstick.compiled() as program:
            ours = min(timed(way.bare) for _ in range(20))
            found = yardstick.run_yardstick(scenario, 1e-5, program=program, runs=20)
            yield BenchmarkLine(what, way.label, ours, "C yardstick, 1e-5", found.seconds, "5")
    except yardstick.YardstickError as error:
        print(f"no yardstick: {error}", file=sys.stderr)


# --- the connector ---


def connector_lines() -> Iterator[BenchmarkLine]:
    """Our connector against the engine's own contact in the same bare solver, fixed steps."""
    crank = SCENES["slider-crank"].scenario
    cases = {
        "drop of 1 s, 5e-5 s": (replace(SCENES["drop"].scenario, duration=1.0), 5e-5),
        "slider-crank, 1e-6 s": (replace(crank, duration=slider_crank.REVOLUTION), 1e-6),
    }
    kinds: tuple[Evaluator, ...] = ("built_in", "symbolic", "python")
    for case, (scenario, step) in cases.items():
        run = partial(run_built_in, scenario, step, step_callbacks=False)
        turns = [[run(contact=kind).solve_time for kind in kinds] for _ in range(5)]
        built_in, *ours = (min(times) for times in zip(*turns, strict=True))
        for name, seconds, asked in zip(("symbolic", "Python"), ours, ("1.1", "1.6"), strict=True):
            what = f"connector, {name}: {case}"
            yield BenchmarkLine(what, "generalised alpha", seconds, "built-in", built_in, asked)


# --- the slider-crank ---


def slider_crank_lines() -> Iterator[BenchmarkLine]:
    """Two revolutions, each as coarse as keeps the slider within 1e-6 m over the first half."""
    half = SCENES["slider-crank"].scenario
    two = replace(half, duration=2.0 * slider_crank.REVOLUTION)
    times = np.linspace(0.0, half.duration, round(half.duration / half.record_period) + 1)
    exact = references()["slider-crank"].path[0]
    tolerance = loosest(half, SMALL_ERROR, times)
    lsoda = partial(run_lsoda, two, tolerance)

    def off(x: np.ndarray) -> float:
        return float(np.abs(thinned(x) - exact).max())

    tree_tolerance = next(t for t in (1e-6, 1e-7, 1e-8) if off(run_tree(half, t).x) <= SMALL_ERROR)
    tree = partial(run_tree, two, tree_tolerance)
    for t in (1e-4, 1e-5, 1e-6, 1e-7):
        solver = SolverSettings(tolerance=t, result_checks=False)  # how wrong it is is measured
        run = replace(half, formulation="compiled", solver=solver)
        if off(simulate(run)["slider.x"]) <= SMALL_ERROR:
            break
    ours = partial(simulate, replace(run, duration=two.duration, solver=replace(solver, result_checks=True)))
    mine, theirs, engine = in_turns(ours, lsoda, tree)
    what, how = "slider-crank, two revolutions: reduced", f"tolerance {t:.0e}"
    yield BenchmarkLine(what, how, mine, f"LSODA, {tolerance:.0e}", theirs, "1")
    yield BenchmarkLine(what, how, mine, f"built-in contact, DOPRI5, {tree_tolerance:.0e}", engine, "1.5")


# --- long runs and the import ---


def long_lines() -> Iterator[BenchmarkLine]:
    """Wall time of a run four times as long."""
    for name in ("redundant", "compiled"):
        short = restless(name, 5.0)
        long = replace(short, duration=20.0)
        yield versus(f"four times the time: {name}", "20 s", long, "5 s", short, "4")


def restless(name: str, duration: float) -> Scenario:
    """A support whose pin bounces all the time: held columns, elastic contact, no friction."""
    scenario = SCENES["drop"].scenario
    ((pin, with_clearance),) = scenario.clearance_pins.items()
    law = with_clearance.contact.normal
    assert isinstance(law, PowerLaw)
    elastic = replace(with_clearance.contact, normal=Hertz(stiffness=law.stiffness, exponent=law.exponent))
    return replace(
        scenario,
        pins={pin: replace(with_clearance, contact=elastic)},
        duration=duration,
        record_period=0.01,
        step=RESTLESS_STEP,
        formulation=name,  # type: ignore[arg-type]
        solver=SolverSettings(impact_steps=64, tolerance=1e-5),
    )


# --- space ---


def space_lines() -> Iterator[BenchmarkLine]:
    """The rise of 5 s in space against the same in the plane, both in redundant coordinates."""
    cases = {
        "1.5 mm, no friction": paper_machine.clearance_rise(1.5, 0.0, 5e-4),
        "1.5 mm, friction": paper_machine.clearance_rise(1.5, 0.25, 5e-4),
        "1.5 mm, friction, oil columns": replace(
            paper_machine.clearance_rise(1.5, 0.25, 5e-4), actuators=paper_machine.oil_columns()
        ),
        "ideal pins": paper_machine.ideal_rise(1e-3),
    }
    for case, plane in cases.items():
        space = replace(plane, dimensions=3)
        how = f"{space.solver.sections} sections" if space.clearance_pins else "1e-3 s"
        yield versus(f"rise in space: {case}", how, space, "the same in the plane", plane, "4")


# --- main ---

PARTS = (rise_lines, connector_lines, slider_crank_lines, long_lines, space_lines)


def whole(part: Callable[[], Iterator[BenchmarkLine]]) -> Iterator[BenchmarkLine]:
    """The lines of a part of the table; one that says why, if a run ends the part before its end."""
    try:
        yield from part()
    except SimulationError as error:
        words = (part.__doc__ or part.__name__).splitlines()[0]
        yield refused_line(words, "", "", "", error.failure.reason)


def sheet(lines: Sequence[BenchmarkLine]) -> Sheet:
    """All lines as a table."""
    return Sheet(
        title="Benchmark: ratios of times taken in turns in one run on one core",
        header=("what", "setting", "time [s]", "against", "its time [s]", "ratio", "asked at most", ""),
        rows=tuple(
            (
                *(n.what, n.how, f"{n.seconds:.4g}", n.against, f"{n.other:.4g}", n.ratio),
                *(n.asked, n.refused or ("missed" if n.is_missed else "")),
            )
            for n in lines
        ),
        caption=(
            "Goal of the rise (1.5 mm, no friction, 5 s): mean 1e-4, spread and peak 1e-3, speeds of the first "
            "three impacts 1e-3, 1e-3, 1e-2 of a tight reference of the same model, with the fastest setting "
            "tried that meets it. Compilation is not counted."
        ),
        left=2,
    )


def study(out: Path) -> None:
    """Measure, print and write the table."""
    lines = []
    for line in chain.from_iterable(map(whole, PARTS)):
        print(f"{line.what} ({line.how}): {line.ratio} of {line.against}", file=sys.stderr)
        lines.append(line)
    table = sheet(lines)
    show_table(out / "benchmark", table, width=170)
    words = "\n\n".join(
        ["# Benchmark", process.machine(), process.markdown(table), process.memory(), process.importing()]
    )
    with whole_file(out / "benchmark.md") as temporary:
        temporary.write_text(words + "\n", encoding="utf-8")


def main(argv: Sequence[str] | None = None) -> int:
    """Entry of `python -m studies.benchmarking.benchmark`."""
    return work_in_folder(study, folder_of(f"benchmarking.{STUDY}", __doc__, argv))


if __name__ == "__main__":
    sys.exit(main())
