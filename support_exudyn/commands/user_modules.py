"""Modules of the user's own: machines, laws, drives and loads in them are known once they are imported."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from importlib import import_module

from support_exudyn.formulations.contract import SimulationError, told
from support_exudyn.sweeps.workers import NoProcessError, ProcessEndedError
from user_forces.values.value import InputError, short


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
    """While a command works with imported modules, what they do wrong is an InputError that tells it.

    Without such modules an error that nobody expected is one of this program, and stays as it is.
    """
    try:
        yield
    except (InputError, SimulationError, OSError, ProcessEndedError, NoProcessError, MemoryError):
        raise
    except Exception as error:
        if not names:
            raise
        raise InputError(f"--import {', '.join(names)}: {told(error)}") from error
