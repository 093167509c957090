"""`chart STORE X Y`: a number of a sweep's runs over what was varied, as PNG and PDF."""

import argparse
import re

from support_exudyn.commands.command_line import add_out, folder, say

HELP = "figure of a sweep: one number over one varied field, with errors, as PNG and PDF"
NO_NAME = re.compile(r"[^\w.-]+")  # what is left out of a file's name


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The sweep's store, and what is drawn."""
    add = parser.add_argument
    add("store", type=folder, metavar="STORE", help="folder of a sweep, or the table.parquet in it")
    add("x", metavar="X", help="what was varied, such as pins.rear_base.clearance_mm")
    add("y", metavar="Y", help="a number of the table, such as pin.rear_base.force.mean")
    add("--by", metavar="Z", help="something else that was varied, a curve for each of its values")
    add_out(parser, "folder of the figure (figures in the store)")


def run(given: argparse.Namespace) -> None:
    """Draw, write, and print the names of the files."""
    from support_exudyn.postprocessing.figures import style
    from support_exudyn.postprocessing.figures.sweep_chart import sweep_chart
    from support_exudyn.sweeps.table import read_table

    table = read_table(given.store)
    store = given.store if given.store.is_dir() else given.store.parent
    name = NO_NAME.sub("_", "_".join(filter(None, (given.y, "over", given.x, given.by and f"by_{given.by}"))))
    with style.look():
        drawing = sweep_chart(table, given.x, given.y, given.by)
        for path in style.save(drawing, given.out or store / "figures", name):
            say(str(path))
