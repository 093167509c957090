"""The commands of `python -m support_exudyn`, one per file.

A command is a module with HELP, a line of what it does; `add_arguments(parser)`; and `run(given)`, which does
it with the arguments that were given and raises InputError, OSError or SimulationError. Its name is the
module's. A further one is a file here and its name in NAMES.
"""

import argparse
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from typing import Protocol, cast

from support_exudyn.commands.command_line import CommandParser, Parser, say
from support_exudyn.files.own_modules import OURS
from support_exudyn.formulations.contract import SimulationError, told
from support_exudyn.simulation.provenance import versions
from support_exudyn.sweeps.workers import NoProcessError, ProcessEndedError
from user_forces.values.value import InputError, Value, kinds_of, short

NAMES: tuple[str, ...] = (
    "init",
    "check",
    "channels",
    "run",
    "sweep",
    "chart",
    "table",
    "show",
    "compare",
    "plot",
    "report",
    "render",
    "view",
    "export",
    "scenario",
    "schema",
    "docs",
)

INSTALLED = "support-exudyn"
EPILOG = """\
COMMAND --help tells what a command takes. Results go to standard output, progress and warnings to
standard error; with --json the result is one JSON object in SI units. Files are written whole or not at
all.

exit codes:
  0    done
  1    not done, for a reason that is said in one line: an input, a file, a run that cannot be finished
  2    the command line cannot be read
  3    a sweep is done, but some of its runs failed
  130  interrupted
"""


class Command(Protocol):
    """What a module of a command offers."""

    HELP: str

    def add_arguments(self, parser: argparse.ArgumentParser) -> None:
        """Tell the parser what the command takes."""

    def run(self, given: argparse.Namespace) -> None:
        """Do it."""


def command(name: str) -> Command:
    """The command of this name."""
    return cast(Command, import_module(f"{__package__}.{name}"))


def parser() -> Parser:
    """The parser of the whole command line."""
    whole = Parser(
        prog=_called(),
        description="Dynamics of linkages with clearance in their joints.",
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    whole.add_argument("--version", action=_Versions, nargs=0, help="versions of all that makes the numbers")
    whole.add_argument(
        "--import",
        dest="imports",
        action="append",
        default=[],
        metavar="MODULE",
        help="import this module first: files may then hold its machines, laws, drives, loads; repeatable",
    )
    several = whole.add_subparsers(
        dest="command", required=True, metavar="COMMAND", parser_class=CommandParser, title="commands"
    )
    for name in NAMES:
        one = command(name)
        one.add_arguments(
            several.add_parser(name, help=one.HELP, description=f"{one.HELP[:1].upper()}{one.HELP[1:]}.")
        )
    return whole


def _called() -> str:
    """The name by which the program was started."""
    return INSTALLED if Path(sys.argv[0]).stem == INSTALLED else "python -m support_exudyn"


class _Versions(argparse.Action):
    """Print the versions, asking for them only now, and end."""

    def __call__(self, parser: argparse.ArgumentParser, *others: object) -> None:
        say("\n".join(f"{name} {number}" for name, number in versions().items()))
        parser.exit()


# --- modules of the user's own: machines, laws, drives and loads in them are known once they are imported ---


def import_modules(names: Iterable[str]) -> None:
    """Import modules by name, from the working directory too.

    Raises InputError that names the module if there is none of this name, or if it cannot be imported.
    """
    for name in names:
        if "" not in sys.path:  # a program that is installed does not look there
            sys.path.insert(0, "")
        try:
            import_module(name)
        except ModuleNotFoundError as error:
            missing = "no such module" if error.name in (name, name.partition(".")[0]) else str(error)
            raise InputError(
                f"--import {short(name)}: {missing}; allowed: a module in the working directory, or one that "
                "is installed"
            ) from None
        except Exception as error:  # whatever a user's module does wrong
            raise InputError(f"--import {name}: {type(error).__name__}: {error}") from error


@contextmanager
def at_work(names: Sequence[str]) -> Iterator[None]:
    """While a command works with modules of one's own, what they do wrong is an InputError that tells it.

    Modules are imported by --import, or because a file names their classes. Without such modules an error that
    nobody expected is one of this program, and stays as it is.
    """
    try:
        yield
    except (InputError, SimulationError, OSError, ProcessEndedError, NoProcessError, MemoryError):
        raise
    except Exception as error:
        own = [f"--import {name}" for name in names] or sorted(_own_modules())
        if not own:
            raise
        raise InputError(f"{', '.join(own)}: {told(error)}") from error


def _own_modules() -> set[str]:
    """Modules that have classes of one's own."""
    modules = {kind.__module__ for kind in kinds_of(Value).values()}
    return {name for name in modules if name.partition(".")[0] not in (*OURS, "tests")}
