"""Compiled code: where it may not be kept, when it is kept, and who compiles it."""

from __future__ import annotations

import inspect
from pathlib import Path
from typing import Any

import numba
import pytest

from support_exudyn.formulations.compiled.integrate import integrate
from support_exudyn.scene import compilation
from support_exudyn.scene.hydraulics.leg import evaluate_legs


def twice(value: float) -> float:
    return 2.0 * value


def test_what_cannot_be_kept_is_compiled_all_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[bool] = []
    njit = numba.njit

    def without_a_place(*args: Any, cache: bool = False, **options: Any) -> Any:
        asked.append(cache)
        if cache:  # as numba says it beside a read-only program of a user without a home
            raise RuntimeError("cannot cache function 'twice': no locator available for file 'a.py'")
        return njit(*args, **options)

    monkeypatch.setattr(numba, "njit", without_a_place)
    dispatcher = compilation.entry(twice)
    assert dispatcher(21.0) == 42.0
    assert asked[:2] == [True, False]  # then numba compiles helpers of its own


def test_every_compiled_function_is_in_the_stamp() -> None:
    # else old code would go on running after the file has changed
    files = {path.resolve() for path in compilation.source_files()}
    seen: set[object] = set()
    waiting = [integrate.py_func, evaluate_legs.py_func]  # type: ignore[attr-defined]
    while waiting:
        function = waiting.pop()
        if function in seen:
            continue
        seen.add(function)
        assert Path(inspect.getfile(function)).resolve() in files, function
        named = (function.__globals__.get(name) for name in function.__code__.co_names)
        waiting += [one.py_func for one in named if hasattr(one, "py_func")]
    assert len(seen) > 60
