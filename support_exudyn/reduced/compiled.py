"""How functions of this package are compiled: by numba, kept on disk, the same numbers in every process."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import numba

from support_exudyn import onset
from user_forces import contact

CONSTANTS_OF = (onset, contact)  # modules of which compiled functions use constants
Function = TypeVar("Function", bound=Callable[..., Any])


def compiled(function: Function) -> Function:
    """Decorator: compile a function that is called from compiled functions only.

    Divisions by zero give inf or nan, which the integrator looks for. No fast-math: results are the same
    bit for bit from run to run.
    """
    # without the wrappers for calls from Python and C, which take a third of the time of compiling
    return _kept(function, no_cpython_wrapper=True, no_cfunc_wrapper=True)


def entry(function: Function) -> Function:
    """Decorator: compile a function that Python calls, at its first call, or load it from disk."""
    return _kept(function)


def _kept(function: Function, **options: bool) -> Function:
    dispatcher: Any = numba.njit(cache=True, error_model="numpy", **options)(function)
    if not _is_kept_only_while_unchanged(dispatcher):
        dispatcher = numba.njit(error_model="numpy", **options)(function)
    return dispatcher  # type: ignore[no-any-return]


def _source_stamp() -> tuple[str, int]:
    """What identifies the compiled code: a hash of all files that it comes from, and their length."""
    files = [*sorted(Path(__file__).parent.glob("*.py")), *(Path(str(m.__file__)) for m in CONSTANTS_OF)]
    text = b"".join(file.read_bytes() for file in files)
    return hashlib.sha256(text).hexdigest(), len(text)


STAMP = _source_stamp()


def _is_kept_only_while_unchanged(dispatcher: Any) -> bool:
    """Let compiled code on disk be used only as long as no file of this package has changed; whether it worked.

    By itself numba looks at the file of the function alone, and would go on using old code of functions that it
    calls from other files. It has no public way to tell it; without this nothing is kept on disk.
    """
    kept: Any = getattr(getattr(dispatcher, "_cache", None), "_cache_file", None)
    if not hasattr(kept, "_source_stamp"):
        return False
    kept._source_stamp = STAMP
    return True
