"""How fast is the program beside others, and how wrong is each for what it costs? About three minutes.

Both sides of every ratio run in turns in this very process. What is not installed comes from `kept.json`, and
the table says so. The outcome of the last run that was kept stands in `studies/benchmarking/RESULTS.md`.
"""

import time
from collections.abc import Sequence
from pathlib import Path

from studies.benchmarking import rows, trade
from studies.benchmarking.rows import Row
from studies.benchmarking.trade import TradePoint, machine_name
from studies.benchmarking.trade_figure import figure
from studies.common.study import print_table, work_in_folder
from support_exudyn.commands.command_line import Parser, folder, say, warn
from support_exudyn.files.whole_file import whole_file
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.page.pieces import Sheet
from support_exudyn.simulation.provenance import versions

HERE = Path(__file__).parent
SECONDS = 180.0  # that it takes
WIDTH = 190  # of printed tables
FIGURE = "error_and_time"


def study(out: Path) -> None:
    """Measure, print and write table and figure."""
    began = time.monotonic()
    points = trade.with_kept(list(trade.measured()))
    found = list(rows.of_points(points))
    for row in rows.measured():
        warn(" ".join(filter(None, row.cells())))
        found.append(row)
    write(out, found, points, time.monotonic() - began)
    say(f"\nlook at {out / 'RESULTS.md'}")


def write(out: Path, found: Sequence[Row], points: Sequence[TradePoint], took: float) -> None:
    """Print the tables, and write them and the figure."""
    tables = [rows.sheet(found), points_sheet(points)]
    packages = ", ".join(f"{name} {number}" for name, number in versions().items())
    words = ["# Benchmark", f"{machine_name()}. {packages}."]
    words += [f"Made in {took:.0f} s by `python -m studies benchmark`.", markdown(tables[0])]
    words += [f"![Error of the largest pin force over processor time, a line a program]({FIGURE}.png)"]
    words += [f"*{trade.caption(points)}*", markdown(tables[1])]
    with style.look():
        style.save(figure(points), out, FIGURE, pdf=False)
    for table in tables:
        print_table(table, WIDTH)
    with whole_file(out / "RESULTS.md") as temporary:
        temporary.write_text("\n\n".join(words) + "\n", encoding="utf-8")


def points_sheet(points: Sequence[TradePoint]) -> Sheet:
    """All settings of all programs as a table."""
    return Sheet(
        title="What accuracy costs: error of the largest pin force and time",
        header=("program", "setting", "processor [s]", "times common row", "error", "measured"),
        rows=tuple(
            (
                *(one.program, one.setting, f"{one.seconds:.3g}", f"{one.ratio:.3g}", f"{one.error:.1e}"),
                "kept" if one.is_kept else "here",
            )
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


def main(argv: Sequence[str] | None = None) -> int:
    """Entry of `python -m studies benchmark`."""
    parser = Parser(prog="python -m studies benchmark", description=(__doc__ or "").splitlines()[0])
    parser.add_argument(
        "--out", type=folder, default=HERE, metavar="DIR", help="folder for RESULTS.md and its figure (here)"
    )
    return work_in_folder(study, parser.parse_args(argv).out)
