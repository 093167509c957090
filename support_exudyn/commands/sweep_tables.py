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
    from support_exudyn.postprocessing.figures.sweep_chart import numbers_by_name, varied_in
    from support_exudyn.sweeps.table import is_sampled, read_table

    table = read_table(given.run)
    names = numbers_by_name(table)
    most = len(names) if given.all or given.json else MOST
    chosen = [names[name] for name in matching(names, given.channels, "number")]
    chosen = chosen or sweep_summary.shown_numbers(table, most)
    if given.json:
        answer(sweep_summary.data_of(table, chosen))
        return
    say(sweep_summary.counts(table) + "\n")

    def tell(console: Console) -> None:
        show_table(console, "what varied", ("input", ">values", "remark"), sweep_summary.what_varied(table))
        if rows := sweep_summary.reasons(table):
            show_table(console, "what went wrong", (">runs", "remark"), rows)
        more = len(names) - len(chosen)
        rest = f" ({more} more: --all)" if more > 0 and not given.channels else ""
        band = ", percentiles with their 95 % confidence intervals" if is_sampled(table) else ""
        header, rows = sweep_summary.what_came_out(table, chosen)
        if any("- to" in cell or "to -" in cell for row in rows for cell in row):
            band += f" (-: not bounded by so few runs; {BOUNDING} do)"
        show_table(console, f"what came out{rest}{band}", header, rows)
        if rows := sweep_summary.what_it_follows(table, chosen):
            title = "what it follows: Spearman's rank correlation, -1 to 1, with its 95 % confidence interval"
            header = ("number", "input", ">correlation", ">interval", "remark")
            if not any(row[-1] for row in rows):  # nothing is remarked
                header, rows = header[:-1], [row[:-1] for row in rows]
            show_table(console, title, header, rows)

    printed(tell)
    if chosen:
        number = next(name for name, column in names.items() if column == chosen[0])
        field = varied_in(table)[0] if varied_in(table) else "INPUT"
        store = given.run if given.run.is_dir() else given.run.parent
        say("next:")
        say(f"  support-exudyn chart {store} {field} {number}")
        if len(varied_in(table)) > 1:  # which of them matters most
            say(f"  support-exudyn chart {store} {number} --tornado")
        say(f"  support-exudyn table {store} --format md")
        runs = (store / "named" / f"{name}.h5" for name in table.column("run").to_pylist())
        if kept := next((path for path in runs if path.exists()), None):
            say(f"  support-exudyn show {kept}")
