"""How fast is the program, compared with others, and how large is its error? About six minutes.

A row of the table is: name, work, program, the program that it is compared with, ratio. Both sides of a row
are timed in turns in this process; the ratio is the median of the turns' ratios. Rows against the programs of
others come from the points of `trade`; programs that are not installed have none. The outcome of the last run
stands in `studies/benchmarking/RESULTS.md`.
"""

import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from studies.benchmarking import trade, yardstick
from studies.benchmarking.peers.on_exudyn import Evaluator, run_connector
from studies.benchmarking.peers.plain_support import PIN
from studies.benchmarking.trade import COMPILED, ENGINE, OURS_COMPILED, OURS_ENGINE, WORK, TradePoint
from studies.common import paper_machine
from studies.common.study import print_table, work_in_folder
from support_exudyn import CubicStep, Held, Scenario, SolverSettings, simulate
from support_exudyn.commands.command_line import say, warn
from support_exudyn.files.whole_file import whole_file
from support_exudyn.formulations.registry import FormulationName
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.page.pieces import Sheet
from support_exudyn.simulation.provenance import versions

HERE = Path(__file__).parent
SECONDS = 360.0  # that it takes
WIDTH = 190  # of printed tables
FIGURE = "error_and_time"
TURNS = 5
LONG = 10.0  # more turns are not begun after this time [s]
DROP, DROP_STEP = replace(trade.rise(friction=0.0), drive=Held(), duration=1.0), 5e-5  # [s]
C_TOLERANCE = 1e-5
OURS_TOLERANCE = 5e-5  # by which the compiled formulation is as accurate
CONNECTOR_MOST = 1.25  # the ratio that the user function may cost beside the engine's contact
Timing = Callable[[], float]  # processor time of one more run [s]


@dataclass(frozen=True)
class Row:
    """A row of the table: times in seconds; `other` and `ratio` are missing where nothing is compared."""

    name: str
    work: str
    runs: str
    seconds: float | None
    against: str = ""
    other: float | None = None
    ratio: float | None = None
    note: str = ""

    def cells(self) -> tuple[str, ...]:
        """The row as text; a ratio below one is written as 1/x."""
        times = ("" if x is None else f"{x:.3g} s" for x in (self.seconds, self.other))
        ratio = ""
        if self.ratio is not None:
            ratio = f"{self.ratio:.3g}" if self.ratio >= 1.0 else f"1/{1.0 / self.ratio:.3g}"
        ours, other = times
        return self.name, self.work, self.runs, ours, self.against, other, ratio, self.note


def beside(name: str, work: str, runs: str, ours: Timing, against: str, other: Timing) -> Row:
    """Time both sides in turns."""
    ours(), other()  # imports, compiles
    began, mine, its = time.monotonic(), list[float](), list[float]()
    while len(mine) < TURNS and (not mine or time.monotonic() - began < LONG):
        mine.append(ours())
        its.append(other())
    ratio = statistics.median(one / two for one, two in zip(mine, its, strict=True))
    return Row(name, work, runs, statistics.median(mine), against, statistics.median(its), ratio)


def timed(run: Callable[[], object]) -> Timing:
    """The processor time of a run as a function."""

    def seconds() -> float:
        began = time.process_time()
        run()
        return time.process_time() - began

    return seconds


def _simulated(scenario: Scenario, formulation: FormulationName, **settings: object) -> Timing:
    solver = SolverSettings(**settings, result_checks=False)  # type: ignore[arg-type]
    return timed(partial(simulate, replace(scenario, formulation=formulation, solver=solver)))


# --- rows that are timed in turns ---


def measured() -> Iterator[Row]:
    """All rows but those against the programs of others."""
    rise = trade.rise()
    yield _beside_c(rise)
    yield connector("function")
    yield connector("joint")
    ideal = replace(rise, pins={})
    for formulation in (COMPILED, ENGINE):
        both = (_simulated(one, formulation) for one in (rise, ideal))
        yield beside(f"clearance, {formulation}", WORK, "with clearance", next(both), "ideal pin", next(both))
    for friction in (0.0, paper_machine.SLIDING_COEFFICIENT):
        space, plane = (_simulated(quick_rise(friction, dimensions), ENGINE) for dimensions in (3, 2))
        work = f"rise of 0.4 s, 1.5 mm, friction {friction:g}"
        yield beside(f"space, friction {friction:g}", work, "in space", space, "in the plane", plane)
    yield first_run()


def connector(contact: Evaluator) -> Row:
    """Our connector beside the engine's own contact, by the same steps: its user function alone, or a joint."""

    def timing(contact: Evaluator) -> Timing:
        return lambda: run_connector(DROP, DROP_STEP, contact)[0]

    work = f"drop of {DROP.duration:g} s, equal steps of {1e6 * DROP_STEP:g} us"
    runs = {"function": "user function of the connector", "joint": "`ClearanceJoint`"}[contact]
    ours, engine = timing(contact), timing("built_in")
    row = beside(f"connector, {contact}", work, runs, ours, "engine's own contact", engine)
    if contact == "joint":
        return row
    verdict = "met" if row.ratio is not None and row.ratio <= CONNECTOR_MOST else "missed"
    return replace(row, note=f"asked at most {CONNECTOR_MOST:g}: {verdict}")


def quick_rise(friction: float, dimensions: int) -> Scenario:
    """The first 0.4 s of a rise of 100 mm in a second with 1.5 mm of clearance, in the plane or in space."""
    scene = paper_machine.clearance_rise(1.5, friction, 5e-4, law=paper_machine.PAPERS_LAW)
    drive = CubicStep(stroke=0.1, start=0.0, end=1.0)
    return replace(scene, drive=drive, duration=0.4, dimensions=dimensions)  # type: ignore[arg-type]


def _beside_c(rise: Scenario) -> Row:
    """The compiled formulation beside the same by hand in C."""
    name, runs = "program in C", f"compiled, tolerance {OURS_TOLERANCE:.0e}"
    with ExitStack() as held:
        try:
            program = held.enter_context(yardstick.compiled())
        except yardstick.YardstickError as error:
            return Row(name, WORK, runs, None, note=str(error).splitlines()[0])
        by_hand = partial(yardstick.run_yardstick, rise, C_TOLERANCE, program=program)
        force_alone = replace(rise, channels=(f"pin.{PIN}.force",))  # all that the program writes
        ours = _simulated(force_alone, COMPILED, tolerance=OURS_TOLERANCE)
        return beside(name, WORK, runs, ours, f"C, tolerance {C_TOLERANCE:.0e}", lambda: by_hand().seconds)


def first_run() -> Row:
    """The first run of a fresh installation, which has no compiled code: a process from start to end."""
    program = (
        "from studies.common import paper_machine as paper; from support_exudyn import simulate; "
        f"rise = paper.clearance_rise({trade.CLEARANCE_MM}, {paper_machine.SLIDING_COEFFICIENT}, 5e-4, "
        "law=paper.PAPERS_LAW); simulate(rise, accuracy='draft')"
    )
    with tempfile.TemporaryDirectory() as empty:
        known = {"NUMBA_CACHE_DIR": empty, "PYTHONPATH": str(Path(__file__).parents[2])}
        began = time.monotonic()
        subprocess.run([sys.executable, "-c", program], env=os.environ | known, capture_output=True, check=True)
    return Row("first run", WORK, 'compiled, "draft", nothing compiled yet', time.monotonic() - began)


# --- rows from the points ---


def of_points(points: Sequence[TradePoint]) -> Iterator[Row]:
    """What an accuracy costs; our fastest way to a good largest force beside that of other programs."""
    for program in (OURS_COMPILED, OURS_ENGINE):
        for one in (one for one in points if one.program == program):
            yield Row("accuracy", WORK, f'{program}, "{one.setting}"', one.seconds)
    ran = dict.fromkeys(one.program for one in points)
    names = [name for name in ran if not name.startswith((OURS_COMPILED, OURS_ENGINE))]
    for ours in (OURS_COMPILED + trade.ONCE, OURS_ENGINE + trade.ONCE):
        mine = trade.cheapest(points, ours)
        if mine is None:
            continue
        for name in names if ours.startswith(OURS_COMPILED) else names[:1]:
            its = trade.cheapest(points, name)
            what = f"{mine.program}, {mine.setting}"
            goal = f"{WORK}, largest force right to {trade.GOOD:g}"
            if its is None:
                yield Row(name, goal, what, mine.seconds, name, note="no setting of theirs is as close")
            else:
                against, ratio = f"{name}, {its.setting}", mine.ratio / its.ratio
                yield Row(name, goal, what, mine.seconds, against, its.seconds, ratio)


def sheet(rows: Sequence[Row]) -> Sheet:
    """All rows as a table."""
    return Sheet(
        title="Ours, and what it is compared with",
        header=("name", "work", "what runs", "time", "compared with", "its time", "ratio", ""),
        rows=tuple(row.cells() for row in rows),
        caption=(
            "Processor times on one core, medians of up to five turns in which both sides run one after the "
            "other; the first run is timed from start to end. Compilation is not counted but there. Rows "
            "against other programs take the cheapest setting from which on the largest force is right to "
            f"{trade.GOOD:g}."
        ),
        left=3,
    )


# --- the command ---


def study(out: Path) -> None:
    """Measure, print and write table and figure."""
    began = time.monotonic()
    points = list(trade.measured(with_slow=True))
    found = list(of_points(points))
    for row in measured():
        warn(" ".join(filter(None, row.cells())))
        found.append(row)
    write(out, found, points, time.monotonic() - began)
    say(f"\nlook at {out / 'RESULTS.md'}")


def write(out: Path, found: Sequence[Row], points: Sequence[TradePoint], took: float) -> None:
    """Print the tables, and write them and the figure."""
    tables = [sheet(found), points_sheet(points)]
    packages = ", ".join(f"{name} {number}" for name, number in versions().items())
    words = ["# Benchmark", f"{trade.machine_name()}. {packages}."]
    words += [f"Made in {took:.0f} s by `python -m studies benchmark`.", markdown(tables[0])]
    words += [f"![Error of the largest pin force over processor time, a line a program]({FIGURE}.png)"]
    words += [f"*{trade.CAPTION}*", markdown(tables[1])]
    with style.look():
        style.save(trade.figure(points), out, FIGURE, pdf=False)
    for table in tables:
        print_table(table, WIDTH)
    with whole_file(out / "RESULTS.md") as temporary:
        temporary.write_text("\n\n".join(words) + "\n", encoding="utf-8")


def points_sheet(points: Sequence[TradePoint]) -> Sheet:
    """All settings of all programs as a table."""
    return Sheet(
        title="What accuracy costs: error of the largest pin force and time",
        header=("program", "setting", "processor [s]", "times common row", "error"),
        rows=tuple(
            (one.program, one.setting, f"{one.seconds:.3g}", f"{one.ratio:.3g}", f"{one.error:.1e}")
            for one in points
        ),
        caption=f'Common row: {trade.COMMON[0]}, "{trade.COMMON[1]}", timed beside each program.',
        left=2,
    )


def markdown(sheet: Sheet) -> str:
    """A table with pipes between its cells."""
    lines = [
        f"| {' | '.join(cell.replace('|', '/') for cell in row)} |"
        for row in (sheet.header, ["---"] * len(sheet.header), *sheet.rows)
    ]
    return "\n".join([f"**{sheet.title}**", "", *lines, "", sheet.caption]).rstrip()


def benchmark(*, out: Path = HERE) -> int:
    """How fast is the program among others? The command `python -m studies benchmark`.

    Args:
        out: Folder for RESULTS.md and its figure (here).
    """
    return work_in_folder(study, out)
