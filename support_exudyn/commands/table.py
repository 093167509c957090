"""`table STORE [NUMBER...]`: the runs of a sweep as a table for a text: Markdown, CSV or LaTeX."""

import argparse

from support_exudyn.commands.command_line import add_out, folder, say

FORMATS = ("md", "csv", "latex")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The sweep's store, which numbers, and the form."""
    add = parser.add_argument
    add("store", type=folder, metavar="STORE", help="folder of a sweep, or the table.parquet in it")
    add(
        "numbers",
        nargs="*",
        default=[],
        metavar="NUMBER",
        help="only these: names or patterns, such as 'tip.*.mean' (all)",
    )
    add("--format", choices=FORMATS, default="md", help="Markdown (md), CSV with errors, or LaTeX (booktabs)")
    add_out(parser, "write it there, not to standard output", "FILE")


def run(given: argparse.Namespace) -> None:
    """Print it, or write it."""
    from support_exudyn.files.whole_file import whole_file
    from support_exudyn.postprocessing.figures.selection import matching
    from support_exudyn.postprocessing.sweep_runs import SweepRuns
    from support_exudyn.postprocessing.sweep_table import as_csv, as_latex, as_markdown
    from support_exudyn.sweeps.table import read_table

    runs = SweepRuns(read_table(given.store))
    names = runs.numbers
    chosen = [names[name] for name in matching(names, given.numbers, "number")] or list(names.values())
    text = {"md": as_markdown, "csv": as_csv, "latex": as_latex}[given.format](runs, chosen)
    if given.out is None:
        say(text.rstrip("\n"))
        return
    with whole_file(given.out) as temporary:
        temporary.write_text(text, encoding="utf-8")
    say(str(given.out))
