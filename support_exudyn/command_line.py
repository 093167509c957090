"""What all command lines share: options that are refused in a line, and errors that are said in a sentence."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import NoReturn

from support_exudyn.errors import SimulationError
from support_exudyn.workers import NoProcessError, ProcessEndedError
from user_forces.values import InputError, short

LONGEST_REFUSAL = 400  # characters


class Parser(argparse.ArgumentParser):
    """Of a command line; what is wrong with it is said in one line, whatever words it was given."""

    def error(self, message: str) -> NoReturn:
        """End the program with exit code 2, a usage and a line."""
        line = " ".join(message.split())
        super().error(line if len(line) <= LONGEST_REFUSAL else line[: LONGEST_REFUSAL - 3] + "...")


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


def folder(text: str) -> Path:
    """A folder or file from the command line, there or not."""
    try:
        if b"\0" in os.fsencode(text):
            raise ValueError
    except ValueError:  # also of letters that no file's name can have
        raise argparse.ArgumentTypeError(f"{short(text)}: allowed: a name that a folder can have") from None
    return Path(text)


def answered(work: Callable[[], None]) -> int:
    """Do it; what the user can mend is said in a sentence. Returns the exit code."""
    try:
        work()
    except (SimulationError, InputError, OSError, ProcessEndedError, NoProcessError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("interrupted; nothing half-written is left", file=sys.stderr)
        return 130
    return 0
