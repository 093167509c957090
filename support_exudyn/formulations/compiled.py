"""How functions of numbers are compiled, where numba is installed; the same numbers in every process.

Without it they run as they stand, in plain Python. With it `plain` gives them back as they stand.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import make_dataclass
from functools import cache
from pathlib import Path
from types import FunctionType
from typing import Any, TypeVar, cast

import numpy as np

from support_exudyn.formulations import contact_events
from user_forces import contact

try:
    import numba
except ImportError:
    numba = None

CONSTANTS_OF = (contact_events, contact)  # modules of which compiled functions use constants
Function = TypeVar("Function", bound=Callable[..., Any])
_written: dict[Any, FunctionType] = {}  # what was decorated, by what it became


def is_compiling() -> bool:
    """Whether numba is there; the extra [fast] brings it."""
    return numba is not None


def compiled(function: Function) -> Function:
    """Decorator: compile a function that is called from compiled functions only.

    Divisions by zero give inf or nan, which the integrator looks for. No fast-math: results are the same
    bit for bit from run to run.
    """
    # without the wrappers for calls from Python and C, which take a third of the time of compiling
    return _kept(function, no_cpython_wrapper=True, no_cfunc_wrapper=True)


def inlined(function: Function) -> Function:
    """The same for formulas that are evaluated many times: their code is put where they are called.

    That makes the right-hand side twice as fast. Of larger functions it would only make compiling slower.
    """
    return _kept(function, no_cpython_wrapper=True, no_cfunc_wrapper=True, forceinline=True)


def entry(function: Function) -> Function:
    """Decorator: compile a function that Python calls, at its first call, or load it from disk."""
    return _kept(function)


def plain(function: Callable[..., Any], **instead: Any) -> Callable[..., Any]:
    """A decorated function as it was written, and so all decorated ones that it calls.

    Named tuples that they make become objects with the same attributes.

    Arguments:
        function: that was decorated.
        instead: what is to stand for global names in all of them, such as `math=numpy` for arrays.
    """
    made: dict[FunctionType, FunctionType] = {}

    def bound(item: Any) -> FunctionType:
        written = _written[item]
        if written not in made:
            names: dict[str, Any] = dict(written.__globals__)
            made[written] = FunctionType(
                written.__code__, names, written.__name__, written.__defaults__, written.__closure__
            )
            for name in written.__code__.co_names:
                item = names.get(name)
                if name in instead:
                    names[name] = instead[name]
                elif _is_decorated(item):
                    names[name] = bound(item)
                elif isinstance(item, type) and issubclass(item, tuple) and hasattr(item, "_fields"):
                    names[name] = _slotted(item)
        return made[written]

    return bound(function)


@cache
def _slotted(item: Any) -> type:
    """A class with the fields of a named tuple, which Python reads several times faster."""
    return make_dataclass(item.__name__, item._fields, slots=True)


def on_arrays(function: Callable[..., Any]) -> Callable[..., Any]:
    """A decorated function without branches, for many instants at once: arrays in place of numbers."""
    return plain(function, math=np)


def _is_decorated(item: Any) -> bool:
    return callable(item) and not isinstance(item, type) and item in _written


def _kept(function: Function, **options: bool) -> Function:
    dispatcher: Any = function
    if numba is not None:
        try:
            dispatcher = numba.njit(cache=True, error_model="numpy", **options)(function)
            kept = _is_kept_only_while_unchanged(dispatcher)
        except (
            RuntimeError
        ):  # neither beside the program nor in a home may files be written: compiled each time
            kept = False
        if not kept:
            dispatcher = numba.njit(error_model="numpy", **options)(function)
    _written[dispatcher] = cast(FunctionType, function)
    return dispatcher  # type: ignore[no-any-return]


def _source_stamp() -> tuple[str, int]:
    """What identifies the compiled code: a hash of all files that it comes from, and their length."""
    here = Path(__file__).parent
    files = [file for folder in ("reduced", "tree") for file in sorted((here / folder).glob("*.py"))]
    files += [Path(__file__), *(Path(str(module.__file__)) for module in CONSTANTS_OF)]
    text = b"".join(file.read_bytes() for file in files)
    return hashlib.sha256(text).hexdigest(), len(text)


STAMP = _source_stamp()


def _is_kept_only_while_unchanged(dispatcher: Any) -> bool:
    """Let compiled code on disk be used only as long as no file that it may come from has changed.

    By itself numba looks at the file of the function alone, and would go on using old code of functions that it
    calls from other files. It has no public way to tell it; without this nothing is kept on disk.
    """
    kept: Any = getattr(getattr(dispatcher, "_cache", None), "_cache_file", None)
    if not hasattr(kept, "_source_stamp"):
        return False
    kept._source_stamp = STAMP
    return True
