"""What all command lines share: kinds of options, printed lines, errors as a sentence and an exit code."""

import os
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from difflib import get_close_matches
from pathlib import Path
from typing import Annotated, Any

from cyclopts import App, CycloptsError, Parameter
from cyclopts.validators import Number

from support_exudyn.scene.contract import Progress, SimulationError, error_text
from support_exudyn.simulation.at_start import EXIT_CODE, INTERRUPTED, be_readable
from user_forces.values.names import InputError, cleaned

LONGEST_LINE = 400  # characters of what is wrong with a command line
WRONG_USAGE = 2  # exit code

# --- options ---

Json = Annotated[bool, Parameter(help="Print one JSON object instead of text, in SI units.")]
After = Annotated[float, Parameter(help="First time [s] (the start).")]
Until = Annotated[float, Parameter(help="Last time [s] (the end).")]
Rate = Annotated[float, Parameter(validator=Number(gt=0.0))]
Imports = Annotated[
    tuple[str, ...],
    Parameter(
        name="--import",
        help="Import this Python file or module first, for you trust it: files may then name its laws, "
        "machines, drives, loads. Without it no file runs Python. Repeatable.",
    ),
]


def at_most(most: int) -> Parameter:
    """A number of things, from 1 on."""
    return Parameter(validator=Number(gte=1, lte=most))


def among(names: Iterable[str], what: str) -> Parameter:
    """A word that is one of the names; what: the help of the argument."""
    known = list(names)

    def check(type_: object, word: str) -> None:
        del type_
        if word not in known:
            near = get_close_matches(word[:80], known, 2, 0.6)
            guess = f"did you mean {' or '.join(near)}? " if near else ""
            raise ValueError(f"{guess}allowed: {', '.join(known)}")

    return Parameter(validator=check, help=what)


def output(*endings: str, folder: bool = True) -> Parameter:
    """A file with such an ending, or a folder: a name without an ending, or of a folder that is there.

    folder: whether a folder is allowed; otherwise a name without an ending is that of a file.
    """

    def check(type_: object, out: Path | None) -> None:
        del type_
        if out is not None and is_file(out) and out.suffix.lower() not in endings:
            where = " or a folder, without an ending" if folder else ""
            raise ValueError(f"allowed: a file that ends in {', '.join(endings)}{where}")

    return Parameter(validator=check)


def is_file(out: Path | None) -> bool:
    """Whether an output is a file, with an ending as "x.csv", no folder; "clearance_1.5mm" has no ending."""
    return out is not None and not out.is_dir() and out.suffix[1:2].isalpha()


PICTURES = (".png", ".pdf", ".svg")
FIGURES = output(*PICTURES)


def new_app(name: str, about: str, **settings: Any) -> App:
    """A command line that `carry_out` takes; about: its help. settings: more of them, see cyclopts."""
    given: dict[str, Any] = {"help_format": "markdown", **settings}
    return App(
        name=name,
        help=about,
        default_parameter=Parameter(negative=(), show_default=False),
        print_error=False,
        exit_on_error=False,
        result_action="return_value",
        suppress_keyboard_interrupt=False,
        **given,
    )


def carry_out(app: App, argv: Sequence[str] | None) -> int:
    """Do what a command line asks for, by default that of this process. Returns the exit code."""
    return answered(lambda: app(sys.argv[1:] if argv is None else list(argv)))


def import_modules(names: Sequence[str]) -> None:
    """Import modules by file or name. Raises InputError that names what cannot be imported."""
    from support_exudyn.files.own_modules import trusted

    try:
        trusted(*names)
    except InputError as error:
        raise InputError(f"--import {error}") from error.__cause__


# --- what is printed ---


def answer(data: Mapping[str, Any]) -> None:
    """Print a JSON object; numbers that are none (not known, without end) as null."""
    from pydantic_core import to_json  # which `--help` has no use for

    say(to_json(data, indent=1, inf_nan_mode="null", fallback=dict).decode("utf-8"))


def put(json: bool, data: Mapping[str, Any], *lines: object) -> None:
    """Print a JSON object, see `answer`, or in place of it lines of text."""
    if json:
        answer(data)
    else:
        say("\n".join(map(str, lines)))


def say(text: object) -> None:
    """Print a line; if nobody reads on (`| head`, a closed terminal), the work goes on without a word.

    Names, units and titles may be of somebody else's file: what they would do to a terminal is not done.
    """
    try:
        print(cleaned(str(text)), flush=True)
    except BrokenPipeError:  # at its end Python would try once more, and complain
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)


def show_table(title: str, header: Sequence[str], rows: Sequence[Sequence[str]], note: str = "") -> None:
    """Print a table if it has rows, see `ResultTable`."""
    if rows:
        from support_exudyn.postprocessing.result_table import ResultTable

        say(ResultTable(title, tuple(header), [tuple(row) for row in rows], note).text())


def write_or_say(text: str, out: Path | None) -> None:
    """Write a text into a file and print its name; without a file print the text."""
    if out is None:
        say(text.rstrip("\n"))
        return
    from support_exudyn.files.whole_file import whole_file

    with whole_file(out) as temporary:
        temporary.write_text(text, encoding="utf-8", newline="\n")
    say(out)


def warn(text: str) -> None:
    """Print a line on standard error; what it would do to a terminal is not done."""
    print(cleaned(text), file=sys.stderr, flush=True)


@contextmanager
def shown_progress(what: str) -> Iterator[Progress]:
    """A progress bar on standard error: gives what takes the share done. None where it is no terminal."""
    from rich.console import Console  # which most refusals have no use for
    from rich.progress import BarColumn, TextColumn, TimeRemainingColumn
    from rich.progress import Progress as Bar

    console = Console(stderr=True)
    columns = TextColumn("{task.description}"), BarColumn(), TextColumn("{task.percentage:3.0f} %")
    with Bar(
        *columns, TimeRemainingColumn(), console=console, transient=True, disable=not console.is_terminal
    ) as bar:
        task = bar.add_task(what, total=1.0)
        yield lambda share: bar.update(task, completed=share)


# --- errors ---


def mendable() -> tuple[type[Exception], ...]:
    """The errors that say what the user can mend."""
    from support_exudyn.sweeps.workers import NoProcessError, ProcessEndedError  # and all that processes need

    return SimulationError, InputError, OSError, ProcessEndedError, NoProcessError


def answered(work: Callable[[], int | None], refused: int = 1) -> int:
    """Do the work; what the user can mend is printed as a sentence on standard error.

    refused: the exit code of an input that cannot be used.

    Returns the exit code: that of the work, 0 if it has none, 2 of a command line that cannot be read.
    """
    be_readable()
    try:
        return work() or 0
    except KeyboardInterrupt:
        print(INTERRUPTED, file=sys.stderr)
        return EXIT_CODE
    except CycloptsError as error:
        line = " ".join(str(error).split())
        warn(f"error: {line if len(line) <= LONGEST_LINE else line[: LONGEST_LINE - 3] + '...'}")
        return WRONG_USAGE
    except MemoryError as error:
        warn(f"error: {error_text(error)}; allowed: fewer records or channels, a smaller file")
    except mendable() as error:
        sentence = str(error)
        if isinstance(error, OSError) and error.filename is not None and error.strerror:
            sentence = f"{os.fsdecode(error.filename)}: {error.strerror}"
        warn(f"error: {sentence}")
    return refused
