"""What `show` says of a sweep: what varied, how many ran, what came out, what it follows, what to type next."""

import argparse
from pathlib import Path

from rich.console import Console

from support_exudyn.commands.command_line import answer, say
from support_exudyn.commands.tables import printed, show_table

ENDING = ".parquet"
BOUNDING = 72  # runs that bound the percentiles of 5 and 95 %: 0.95^72 < 0.025
MOST = 8  # numbers that are shown unless all or some are asked for


def is_store(path: Path) -> bool:
    """Whether a path is that of a sweep: its folder, or its table."""
    return path.is_dir() or path.suffix == ENDING


def show_sweep(given: argparse.Namespace) -> None:
    """Print it; for scripts as one JSON object."""
    from support_exudyn.postprocessing import sweep_summary  # and pyarrow
    from support_exudyn.postprocessing.figures.selection import matching
    from support_exudyn.postprocessing.sweep_runs import SweepRuns
    from support_exudyn.sweeps.table import is_sampled, read_table

    runs = SweepRuns(read_table(given.run))
    names = runs.numbers
    most = len(names) if given.all or given.json else MOST
    chosen = [names[name] for name in matching(names, given.channels, "number")]
    chosen = chosen or [one for one in names.values() if runs.number(one).rows.size][:most]
    if given.json:
        answer(sweep_summary.data_of(runs, chosen))
        return
    say(sweep_summary.counts(runs) + "\n")

    def tell(console: Console) -> None:
        show_table(console, "what varied", ("input", ">values", "remark"), sweep_summary.what_varied(runs))
        if rows := sweep_summary.reasons(runs):
            show_table(console, "what went wrong", (">runs", "remark"), rows)
        more = len(names) - len(chosen)
        rest = f" ({more} more: --all)" if more > 0 and not given.channels else ""
        band = ", percentiles with their 95 % confidence intervals" if is_sampled(runs.table) else ""
        header, rows = sweep_summary.what_came_out(runs, chosen)
        if any("- to" in cell or "to -" in cell for row in rows for cell in row):
            band += f" (-: not bounded by so few runs; {BOUNDING} do)"
        show_table(console, f"what came out{rest}{band}", header, rows)
        if rows := sweep_summary.what_it_follows(runs, chosen):
            title = "what it follows: Spearman's rank correlation, -1 to 1, with its 95 % confidence interval"
            header = ("number", "input", ">correlation", ">interval", "remark")
            if not any(row[-1] for row in rows):  # nothing is remarked
                header, rows = header[:-1], [row[:-1] for row in rows]
            show_table(console, title, header, rows)

    printed(tell)
    if chosen:
        number = next(name for name, column in names.items() if column == chosen[0])
        field = runs.varied[0] if runs.varied else "INPUT"
        store = given.run if given.run.is_dir() else given.run.parent
        say("next:")
        say(f"  support-exudyn chart {store} {field} {number}")
        if len(runs.varied) > 1:  # which of them matters most
            say(f"  support-exudyn chart {store} {number} --tornado")
        say(f"  support-exudyn table {store} --format md")
        files = (store / "named" / f"{name}.h5" for name in runs.column("run"))
        if kept := next((path for path in files if path.exists()), None):
            say(f"  support-exudyn show {kept}")
