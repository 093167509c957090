"""How fast is the program beside others, and how wrong is each for what it costs? About three minutes.

Every ratio is one of times taken in turns in this very run; none is asserted anywhere. All has a share of a
time that is fixed: on a slow machine turns are left out, what takes too long is ended, and the table says so.
What is not installed is left out with a word. The outcome of the last run that was kept stands in
`studies/benchmarking/RESULTS.md`.
"""

import math
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

from studies.benchmarking import process
from studies.benchmarking.command_rows import COMMANDS, command_line, importing, memory_line, tutorial
from studies.benchmarking.contest import ENTRANTS, OURS, Standing, cheapest_within, standings
from studies.benchmarking.contest_figure import figure
from studies.benchmarking.lines import BenchmarkLine, left_out, sheet
from studies.benchmarking.row import OurWay, Row, TimedTurn
from studies.benchmarking.rows import BOTH, ROWS, TURNS, there, timed_row
from studies.benchmarking.stopwatch import Heard, Stopwatch, stopwatch
from studies.common.study import print_table, work_in_folder
from support_exudyn.commands.command_line import Parser, folder, say, warn
from support_exudyn.files.toml.text import load_toml
from support_exudyn.files.whole_file import whole_file
from support_exudyn.formulations.registry import FORMULATIONS
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.page.pieces import Sheet
from support_exudyn.sweeps.precompile import precompile

HERE = Path(__file__).parent
MISSES = HERE / "misses.toml"
BUDGET = 210.0  # of all measurements [s]
# at most [s]: to compile, an entrant, memory, import
COMPILING, STANDING, GROWTH, IMPORTING = 60.0, 9.0, 8.0, 4.0
TOO_LITTLE = 0.3  # of time left to begin anything [s]
SMALL_ERROR = 1e-6  # of the slider [m], by which programs are compared in the table
WIDTH = 190  # of printed tables
NO_TIME = "no time was left"


class Budget:
    """Time that is left for what waits; what takes less than its share leaves the rest to the others.

    waiting: what all that is to come may take at most, together [s].
    """

    def __init__(self, seconds: float, waiting: float) -> None:
        self._until = time.monotonic() + seconds
        self._waiting = waiting

    def share(self, most: float) -> float:
        """Time for the next measurement, which would take so long at most [s]; 0 if there is too little."""
        left = self._until - time.monotonic()
        share = min(most, left * most / max(self._waiting, most))
        self._waiting -= most
        return share if share > TOO_LITTLE else 0.0


def compiled_first() -> Iterator[str]:
    """Compile what runs need, so that no time is that of compiling."""
    precompile()
    yield ""


# --- the parts of the table ---


def row_line(row: Row, watch: Stopwatch, most: float) -> BenchmarkLine:
    """Measure a row."""
    against = row.against.scene if isinstance(row.against, OurWay) else row.against
    if not most:
        return left_out(row.what, NO_TIME, "", against, row.asked)
    return line_of(row, against, watch.measure(timed_row, (row, most), most), most)


def line_of(row: Row, against: str, heard: Heard, most: float) -> BenchmarkLine:
    """The line of a row, from what was measured of it within a time [s]."""
    found: Sequence[TimedTurn] = heard.said
    ours = [one.seconds for one in found if one.is_ours]
    theirs = [one.seconds for one in found if not one.is_ours]
    how = next((one.label for one in found if one.is_ours), "")
    against = next((one.label for one in found if not one.is_ours), against)
    if not ours:
        was_ended = heard.reason.startswith("ended")
        if isinstance(row.ours, OurWay):
            how = row.ours.settings[0].words if len(row.ours.settings) == 1 else ""
            was_ended = was_ended and len(row.ours.settings) == 1  # else settings are tried first
        nothing = most if was_ended else math.nan
        return BenchmarkLine(row.what, how, nothing, against, math.nan, row.asked, was_ended, heard.reason)
    cut = f"{len(ours)} of {TURNS} turns" if len(ours) < TURNS and not heard.reason else heard.reason
    return BenchmarkLine(row.what, how, min(ours), against, min(theirs, default=math.nan), row.asked, note=cut)


def contest(watch: Stopwatch, budget: Budget) -> tuple[list[Standing], list[str]]:
    """All entrants by all their settings; and what is to be said of those that lack some."""
    found: list[Standing] = []
    said: list[str] = []
    for name, entrant in ENTRANTS.items():
        most = 0.0 if entrant.missing else budget.share(STANDING)
        if not most:
            said.append(f"{name}: left out, {entrant.missing or NO_TIME}.")
            continue
        warn(f"slider-crank: {name}")
        heard = watch.measure(standings, (name,), most)
        found += heard.said
        if heard.reason:
            of = f"after {len(heard.said)} of {len(entrant.settings)} settings"
            said.append(f"{name}: {heard.reason}, {of}.")
    return found, said


def contest_lines(found: Sequence[Standing]) -> Iterator[BenchmarkLine]:
    """Our fastest way to a small error of the slider against that of every other program."""
    ours = [one for one in found if one.program.startswith(OURS)]
    mine = cheapest_within(ours, SMALL_ERROR)
    what = f"slider-crank, slider right to {SMALL_ERROR:g} m"
    for name in dict.fromkeys(one.program for one in found if not one.program.startswith(OURS)):
        theirs = cheapest_within([one for one in found if one.program == name], SMALL_ERROR)
        how = f"{mine.program.removeprefix(OURS)}, {mine.setting}" if mine else ""
        yield BenchmarkLine(
            what,
            how,
            mine.seconds if mine else math.nan,
            f"{name}, {theirs.setting}" if theirs else name,
            theirs.seconds if theirs else math.nan,
            note="" if theirs else "no setting of theirs is as right",
        )


def contest_sheet(found: Sequence[Standing]) -> Sheet:
    """All settings of all programs as a table."""
    rows = tuple(
        (
            *(one.program, one.setting, f"{one.seconds:.3g}", _error(one.slider)),
            *(_error(1e6 * one.times), _error(100.0 * one.speeds)),
        )
        for one in found
    )
    return Sheet(
        title="The slider-crank by every program: errors beside times",
        header=("program", "setting", "processor [s]", "slider [m]", "impact times [us]", "their speeds [%]"),
        rows=rows,
        caption=(
            "Half a revolution at 5000 rpm, 0.5 mm of clearance at the slider. Largest errors: of the slider "
            "at all records, of times and speeds of the first five impacts, which are known to 0.0005 us and "
            "1e-5 %. Empty: fewer than five impacts. MuJoCo's limit of a tendon is a linear spring, so it "
            "tends to another motion."
        ),
        left=2,
    )


def _error(x: float) -> str:
    return f"{x:.1e}" if math.isfinite(x) else ""


def measured(budget: Budget, watch: Stopwatch) -> Iterator[BenchmarkLine]:
    """All lines but those of the contest."""
    watch.measure(compiled_first, (), COMPILING)  # not cut: what is left to compile later is timed with a row
    with tutorial() as files:
        for command in COMMANDS:
            share = budget.share(command.most)
            most = command.most if command.is_first else share  # a first run cut short tells nothing
            how = " ".join(command.words)
            yield (
                command_line(command, files, most)
                if most
                else left_out(command.what, NO_TIME, how, asked=command.asked)
            )
    yield importing(budget.share(IMPORTING))
    for row in filter(there, ROWS):
        yield row_line(row, watch, budget.share(row.most))
    for name in filter(FORMULATIONS.__contains__, BOTH):
        yield memory_line(name, budget.share(GROWTH))


# --- the command ---


def waiting() -> float:
    """What all measurements may take at most, together [s]."""
    rows = sum(command.most for command in COMMANDS) + sum(row.most for row in filter(there, ROWS))
    memory = GROWTH * sum(name in FORMULATIONS for name in BOTH)
    return rows + IMPORTING + memory + STANDING * sum(not one.missing for one in ENTRANTS.values())


def study(out: Path) -> None:
    """Measure, print and write table and figure."""
    began = time.monotonic()
    budget = Budget(BUDGET, waiting())
    lines: list[BenchmarkLine] = []
    with stopwatch() as watch:
        for line in measured(budget, watch):
            warn(f"{line.what}: {' '.join(filter(None, line.cells()[2:]))}")
            lines.append(line)
        found, said = contest(watch, budget)
    lines += contest_lines(found)
    took = time.monotonic() - began
    write(out, lines, found, said, took)
    say(f"\n{took:.0f} s in all; look at {out / 'RESULTS.md'}")


def write(
    out: Path, lines: Sequence[BenchmarkLine], found: Sequence[Standing], said: Sequence[str], took: float
) -> None:
    """Print the tables, and write them and the figure."""
    tables = [sheet(lines), contest_sheet(found)]
    words = ["# Benchmark", process.machine(), f"Made in {took:.0f} s by `python -m studies benchmark`."]
    words += [process.markdown(tables[0]), *misses(lines), process.markdown(tables[1])]
    words += ["\n".join(f"- {line}" for line in said)] if said else []
    if found:
        with style.look():
            style.save(figure(found), out, "work_precision", pdf=False)
        words.append("![Errors over processor time, a line a program](work_precision.png)")
    for table in tables:
        print_table(table, WIDTH)
    with whole_file(out / "RESULTS.md") as temporary:
        temporary.write_text("\n\n".join(words) + "\n", encoding="utf-8")


def misses(lines: Sequence[BenchmarkLine]) -> list[str]:
    """Why lines miss what was asked, as a list in Markdown; nothing if none does."""
    reasons = load_toml(MISSES)
    told = [f"- {line.what}: {reasons[line.what]}" for line in lines if line.is_missed and line.what in reasons]
    return ["Why it is missed:", "\n".join(told)] if told else []


def main(argv: Sequence[str] | None = None) -> int:
    """Entry of `python -m studies benchmark`."""
    parser = Parser(prog="python -m studies benchmark", description=(__doc__ or "").splitlines()[0])
    parser.add_argument(
        "--out", type=folder, default=HERE, metavar="DIR", help="folder for RESULTS.md and its figure (here)"
    )
    return work_in_folder(study, parser.parse_args(argv).out)
