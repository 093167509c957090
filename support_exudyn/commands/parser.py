"""The commands of `python -m support_exudyn`.

A command is a module of its name with `add_arguments(parser)` and `run(given)`, which does it with the given
arguments and raises InputError, OSError or SimulationError; or two functions `add_NAME` and `run_NAME` in a
module of several, see TOGETHER. A further one has in NAMES its name and a line of what it does. It is imported
when the command line asks for it.
"""

import argparse
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import NamedTuple

from support_exudyn.commands.command_line import CommandParser, Parser, mendable, say
from support_exudyn.scene.contract import told
from user_forces.values.texts import InputError

NAMES = {  # of commands, each with a line of what it does
    "init": "write a commented set of files to start from: machine, scenarios, sweep",
    "check": "draw a machine and tell its mobility, closure, dead centres, static forces, and what looks wrong",
    "stand": "what a support must stand, on one page: support force over the height, pins and legs at yield, "
    "buckling, eccentric load, tipping",
    "channels": "all channels of a scenario or a machine before a run: names, units, meanings",
    "run": "simulate a scenario's file and save the run",
    "sweep": "run a scenario with fields of it varied, into a store that can be continued",
    "chart": "figure of a sweep as PNG and PDF: a number over a varied field with errors, a histogram, or a "
    "tornado",
    "table": "table of a sweep's runs for a text, as Markdown, CSV or LaTeX",
    "show": "tables of what a run or a sweep was and what came out of it",
    "compare": "by how much runs, measurements and results of other programs differ from a first file, and "
    "whether that is allowed",
    "baseline": "keep what scenarios come out at, and tell what has changed since by more than the errors",
    "plot": "figures of runs as PNG and PDF: channels over time, journal orbit, Poincare section, force "
    "spectrum",
    "report": "a page on runs: what was run, the machine, numbers with errors, live figures, a picture",
    "render": "ray-traced frames and a movie of a run, without a display",
    "view": "open Exudyn's solution viewer on a run",
    "export": "moving meshes for ParaView (XDMF, VTU) and tables of all channels (CSV, HDF5)",
    "measure": "what instruments on the machine read of a run: pressures, extensions, tilts; a table (CSV)",
    "scenario": "the scenario of a run as a TOML file, which `run` takes",
    "schema": "all keys of scenario files, or of machine files: as a table, or as a JSON Schema for editors",
    "docs": "build the documentation as a site: pages, reference, gallery; needs the extra [docs]",
}

TOGETHER = {  # the module of commands that share one
    **dict.fromkeys(("init", "channels", "scenario", "schema", "docs"), "inputs"),
    **dict.fromkeys(("check", "stand"), "machines"),
    **dict.fromkeys(("report", "view", "measure", "export"), "outputs"),
}
INSTALLED = "support-exudyn"
EPILOG = """\
COMMAND --help tells what a command takes. Results go to standard output, progress and warnings to
standard error; with --json the result is one JSON object in SI units. Files are written whole or not at
all.

exit codes:
  0    done
  1    not done, for a reason that is said in one line: an input, a file, a run that cannot be finished;
       of compare: something is not within its tolerance
  2    the command line cannot be read; of compare: nothing was compared, for a reason that is said in one line
  3    a sweep is done, but some of its runs failed
  130  interrupted
"""


class Command(NamedTuple):
    """A command: it tells the parser what it takes, and does it with the arguments that were given."""

    add_arguments: Callable[[argparse.ArgumentParser], None]
    run: Callable[[argparse.Namespace], None]


def command(name: str) -> Command:
    """The command of this name."""
    module = import_module(f"{__package__}.{TOGETHER.get(name, name)}")
    if name in TOGETHER:
        return Command(getattr(module, f"add_{name}"), getattr(module, f"run_{name}"))
    return Command(module.add_arguments, module.run)


def parser() -> Parser:
    """The parser of the whole command line."""
    whole = Parser(
        prog=_called(),
        description="Dynamics of linkages with clearance in their joints.",
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    whole.add_argument("--version", action=_Versions, nargs=0, help="versions of all that makes the numbers")
    add_imports(whole)
    several = whole.add_subparsers(
        dest="command", required=True, metavar="COMMAND", parser_class=CommandParser, title="commands"
    )
    for name, does in NAMES.items():
        one = several.add_parser(name, help=does, description=f"{does[:1].upper()}{does[1:]}.")
        one.arguments = partial(_add_arguments, name)
    return whole


def _add_arguments(name: str, parser: argparse.ArgumentParser) -> None:
    """Tell the parser what a command takes."""
    command(name).add_arguments(parser)
    add_imports(parser, "more_imports")


def add_imports(parser: argparse.ArgumentParser, name: str = "imports") -> None:
    """Take --import, which may stand before a command and behind it; name: of the list of files."""
    parser.add_argument(
        "--import",
        dest=name,
        action="append",
        default=[],
        metavar="FILE",
        help="import this Python file or module first, for you trust it: files may then name its laws, "
        "machines, drives, loads; without it no file runs Python; repeatable",
    )


def _called() -> str:
    """The name by which the program was started."""
    return INSTALLED if Path(sys.argv[0]).stem == INSTALLED else "python -m support_exudyn"


class _Versions(argparse.Action):
    """Print the versions, asking for them only now, and end."""

    def __call__(self, parser: argparse.ArgumentParser, *others: object) -> None:
        from support_exudyn.simulation.provenance import versions

        say("\n".join(f"{name} {number}" for name, number in versions().items()))
        parser.exit()


# --- modules of the user's own: machines, laws, drives and loads in them are known once they are imported ---


def import_modules(names: Iterable[str]) -> None:
    """Import modules by file or name. Raises InputError that names what cannot be imported."""
    from support_exudyn.files.own_modules import trusted

    try:
        trusted(*names)
    except InputError as error:
        raise InputError(f"--import {error}") from error.__cause__


@contextmanager
def at_work(names: Sequence[str]) -> Iterator[None]:
    """While a command works with modules of one's own, what they do wrong is an InputError that tells it.

    Without such modules an error that nobody expected is one of this program, and stays as it is.
    """
    try:
        yield
    except Exception as error:
        if isinstance(error, (*mendable(), MemoryError)):
            raise
        own = [f"--import {name}" for name in names] or sorted(_own_modules())
        if not own:
            raise
        raise InputError(f"{', '.join(own)}: {told(error)}") from error


def _own_modules() -> set[str]:
    """Modules that have classes of one's own."""
    from support_exudyn.files.own_modules import OURS
    from user_forces.values.value import Value, kinds_of

    modules = {kind.__module__ for kind in kinds_of(Value).values()}
    return {name for name in modules if name.partition(".")[0] not in (*OURS, "tests")}
