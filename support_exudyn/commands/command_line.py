"""What all command lines share: options that are refused in a line, and errors that are said in a sentence."""

import argparse
import json
import math
import os
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from difflib import get_close_matches
from functools import partial
from pathlib import Path
from typing import Any, NoReturn

from support_exudyn.scene.contract import Progress, SimulationError, told
from support_exudyn.simulation.at_start import EXIT_CODE, INTERRUPTED, be_readable
from user_forces.values.texts import InputError, cleaned, short

LONGEST_REFUSAL = 400  # characters


class Parser(argparse.ArgumentParser):
    """A command line; what is wrong with it is said in one line, whatever words it was given."""

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        """Refuse a word that is none of the choices, with those that look like it."""
        if action.choices is not None and value not in action.choices:
            known = [str(one) for one in action.choices]
            option = f"{action.option_strings[-1]} " if action.option_strings else ""
            said = f"{option}{short(value)}: no such {str(action.metavar or action.dest).lower()}"
            raise argparse.ArgumentError(None, f"{said}; {meant(str(value), known)}")

    def error(self, message: str) -> NoReturn:
        """End the program with exit code 2, a usage and a line."""
        line = cleaned(" ".join(message.split()))
        super().error(line if len(line) <= LONGEST_REFUSAL else line[: LONGEST_REFUSAL - 3] + "...")


class CommandParser(Parser):
    """The line of one command: its options may stand before, between and behind its names.

    What the command takes is told by `arguments` when its line is read: the others are not imported for that.
    """

    arguments: Callable[[argparse.ArgumentParser], None] | None = None
    _is_mixing = False

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """The arguments, and nothing that is left: what the command does not know is refused here."""
        if self.arguments is not None:
            arguments, self.arguments = self.arguments, None
            arguments(self)
        if self._is_mixing:  # argparse comes back here, first for the options and then for the names
            return super().parse_known_args(args, namespace)
        self._is_mixing = True
        try:
            given, rest = self.parse_known_intermixed_args(args, namespace)
        finally:
            self._is_mixing = False
        if rest:
            self.error(self._unknown(rest))
        return given, rest

    def _unknown(self, rest: Sequence[str]) -> str:
        word = next((one for one in rest if one.startswith("-")), rest[0])
        if not word.startswith("-"):
            return f"{short(word)}: is one name too many"
        options = [
            option
            for action in self._actions
            if action.help != argparse.SUPPRESS
            for option in action.option_strings
            if option.startswith("--")
        ]
        return f"{short(word.partition('=')[0])}: no such option; {meant(word.partition('=')[0], options)}"


def meant(word: str, known: Iterable[str]) -> str:
    """The way out of a word that is not known: those that look like it, and all that are allowed."""
    names = list(known)
    near = get_close_matches(word[:80], names, 2, 0.6)
    guess = f"did you mean {' or '.join(near)}? " if near else ""
    return f"{guess}allowed: {', '.join(names)}"


def count(text: str, most: int = sys.maxsize) -> int:
    """A number of things from the command line."""
    try:
        number = int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{short(text)}: allowed: a whole number from 1 on") from None
    if number < 1:
        raise argparse.ArgumentTypeError(f"{short(number)}: allowed: from 1 on")
    if number > most:
        raise argparse.ArgumentTypeError(f"{short(number)}: allowed: from 1 to {most}")
    return number


def number(text: str, low: float = -math.inf, high: float = math.inf) -> float:
    """A finite number from the command line, from low to high."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not (math.isfinite(value) and low <= value <= high):
        bounds = [f"from {low:g}" if low > -math.inf else "", f"to {high:g}" if high < math.inf else ""]
        said = " ".join(filter(None, ["a number", *bounds]))
        raise argparse.ArgumentTypeError(f"{short(text)}: allowed: {said}")
    return value


def add_times(parser: argparse.ArgumentParser, after: float | None = None, until: float | None = None) -> None:
    """Take --after and --until, times of a run [s], with what they are if not given."""
    add, time = parser.add_argument, partial(number, low=0.0)
    add("--after", type=time, default=after, metavar="T", help="first time [s] (the start)")
    # the option's earlier name
    add("--from", dest="after", type=time, default=after, help=argparse.SUPPRESS)
    add("--until", type=time, default=until, metavar="T", help="last time [s] (the end)")


def folder(text: str) -> Path:
    """A folder or file from the command line, there or not."""
    try:
        if b"\0" in os.fsencode(text):
            raise ValueError
    except ValueError:  # also of letters that no file's name can have
        raise argparse.ArgumentTypeError(f"{short(text)}: allowed: a name that a folder can have") from None
    return Path(text)


def add_run(parser: argparse.ArgumentParser) -> None:
    """Take RUN, the file of a run."""
    parser.add_argument("run", type=folder, metavar="RUN", help="file of a run, as Result.save writes it")


def add_out(parser: argparse.ArgumentParser, what: str, metavar: str = "DIR") -> None:
    """Take --out, a folder or file to write; what: its help."""
    parser.add_argument("--out", type=folder, metavar=metavar, help=what)


def add_json(parser: argparse.ArgumentParser) -> None:
    """Take --json: what came out as one JSON object on standard output, for scripts."""
    parser.add_argument("--json", action="store_true", help="one JSON object instead of text, in SI units")


def answer(data: Mapping[str, Any]) -> None:
    """Print a JSON object; numbers that are none (not known, without end) as null."""
    plain = _finite(data)
    text = json.dumps(plain, indent=1, ensure_ascii=False, allow_nan=False)
    say(text if cleaned(text) == text else json.dumps(plain, indent=1, allow_nan=False))


def _finite(item: Any) -> Any:
    if isinstance(item, Mapping):
        return {str(key): _finite(value) for key, value in item.items()}
    if isinstance(item, (list, tuple)):
        return [_finite(value) for value in item]
    if isinstance(item, Path):
        return str(item)
    return None if isinstance(item, float) and not math.isfinite(item) else item


def say(text: str) -> None:
    """Print a line; if nobody reads on (`| head`, a closed terminal), the work goes on without a word.

    Names, units and titles may be of somebody else's file: what they would do to a terminal is not done.
    """
    try:
        print(cleaned(text), flush=True)
    except BrokenPipeError:
        silence_output()


def warn(text: str) -> None:
    """Print a line on standard error; what it would do to a terminal is not done."""
    print(cleaned(text), file=sys.stderr, flush=True)


def silence_output() -> None:
    """Let what is printed from now on go nowhere: at its end Python would try once more, and complain."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, sys.stdout.fileno())
    os.close(nowhere)


@contextmanager
def shown_progress(what: str) -> Iterator[Progress]:
    """A progress bar on standard error: gives what is told the share done. None where it is no terminal."""
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


def _sentence(error: Exception) -> str:
    """What went wrong; with files of the system, which one and why."""
    if isinstance(error, OSError) and error.filename is not None and error.strerror:
        return f"{os.fsdecode(error.filename)}: {error.strerror}"
    return str(error)


def _too_large(error: MemoryError) -> str:
    return f"error: {told(error)}; allowed: fewer records or channels, a smaller file"


def mendable() -> tuple[type[Exception], ...]:
    """The errors that tell what the user can mend."""
    from support_exudyn.sweeps.workers import NoProcessError, ProcessEndedError  # and all that processes need

    return SimulationError, InputError, OSError, ProcessEndedError, NoProcessError


@contextmanager
def refusing(code: int) -> Iterator[None]:
    """Let what the user can mend end the program with this exit code, said in a sentence."""
    try:
        yield
    except MemoryError as error:
        warn(_too_large(error))
        raise SystemExit(code) from None
    except mendable() as error:
        warn(f"error: {_sentence(error)}")
        raise SystemExit(code) from None


def answered(work: Callable[[], None]) -> int:
    """Do it; what the user can mend is said in a sentence. Returns the exit code."""
    be_readable()
    try:
        work()
    except KeyboardInterrupt:
        print(INTERRUPTED, file=sys.stderr)
        return EXIT_CODE
    except MemoryError as error:
        warn(_too_large(error))
        return 1
    except mendable() as error:
        warn(f"error: {_sentence(error)}")
        return 1
    return 0
