"""`chart STORE [X] Y`: a number of a sweep over what was varied, its histogram or tornado."""

import argparse
from collections.abc import Sequence

from support_exudyn.commands.command_line import add_out, folder, say
from support_exudyn.commands.runs import file_name
from user_forces.values.value import InputError


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The sweep's store, and what is drawn."""
    add = parser.add_argument
    add("store", type=folder, metavar="STORE", help="folder of a sweep, or the table.parquet in it")
    add(
        "names",
        nargs="*",
        default=[],
        metavar="[X] Y",
        help="what was varied, such as pins.rear_base.clearance_mm, and a number of the table, such as "
        "pin.rear_base.force.mean; a number alone is drawn over what was varied, or as histogram if the runs "
        "were drawn from distributions; without, the only number that was recorded",
    )
    add("--by", metavar="Z", help="something else that was varied, a curve for each of its values")
    kind = parser.add_mutually_exclusive_group()
    kind.add_argument("--histogram", action="store_true", help="how Y is distributed, with percentiles")
    kind.add_argument("--tornado", action="store_true", help="by how much each varied field moves Y")
    add_out(parser, "folder of the figure (figures in the store)")


def run(given: argparse.Namespace) -> None:
    """Draw, write, and print the names of the files."""
    from support_exudyn.postprocessing.figures import style
    from support_exudyn.postprocessing.figures.sweep_chart import sweep_chart
    from support_exudyn.postprocessing.figures.sweep_distribution import histogram, tornado
    from support_exudyn.postprocessing.sweep_runs import SweepRuns
    from support_exudyn.sweeps.table import is_sampled, read_table

    if len(given.names) > 2:
        raise InputError(f"{' '.join(given.names)}: allowed: what was varied and a number, or a number alone")
    table = read_table(given.store)
    *before, y = given.names or [_only_number(list(SweepRuns(table).numbers))]
    store = given.store if given.store.is_dir() else given.store.parent
    if before and (given.histogram or given.tornado):
        raise InputError(f"{before[0]}: allowed with --histogram and --tornado: a number alone")
    with style.look():
        if given.tornado:
            drawing, name = tornado(table, y), file_name(y, "tornado")
        elif given.histogram or (not before and is_sampled(table)):
            drawing, name = histogram(table, y), file_name(y, "histogram")
        elif (x := before[0] if before else SweepRuns(table).usual_input) is None:
            raise InputError(
                f"{y}: over which field? allowed: chart STORE X Y with X one of "
                f"{', '.join(SweepRuns(table).varied)}; or --histogram, --tornado"
            )
        else:
            drawing = sweep_chart(table, x, y, given.by)
            name = file_name(y, "over", x, f"by_{given.by}" if given.by else "")
        style.named(drawing, store.resolve().name)
        for path in style.save(drawing, given.out or store / "figures", name):
            say(str(path))


def _only_number(known: Sequence[str]) -> str:
    """The number that is drawn where none is named."""
    if len(known) != 1:
        raise InputError(f"Y: which number? allowed: {', '.join(known) or 'none was recorded'}")
    return known[0]
