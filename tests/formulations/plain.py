"""Compiled functions as they were written, with stand-ins for those that they call."""

from __future__ import annotations

from collections.abc import Callable
from types import FunctionType
from typing import Any


def plain(function: Callable[..., Any], **instead: Any) -> Callable[..., Any]:
    """A decorated function as it was written, and so all decorated ones that it calls.

    Arguments:
        function: that was decorated.
        instead: what is to stand for global names in all of them, such as `math=numpy` for arrays.
    """
    made: dict[FunctionType, FunctionType] = {}

    def bound(item: Any) -> FunctionType:
        written: FunctionType = item.py_func
        if written not in made:
            names: dict[str, Any] = dict(written.__globals__)
            made[written] = FunctionType(
                written.__code__, names, written.__name__, written.__defaults__, written.__closure__
            )
            for name in written.__code__.co_names:
                if name in instead:
                    names[name] = instead[name]
                elif hasattr(names.get(name), "py_func"):
                    names[name] = bound(names[name])
        return made[written]

    return bound(function)
