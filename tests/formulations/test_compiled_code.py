"""Compiled code where no file may be written to keep it."""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import numba
import pytest

from support_exudyn.formulations import compiled


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
    dispatcher = compiled._kept(twice)
    assert dispatcher(21.0) == 42.0
    assert asked[:2] == [True, False]  # then numba compiles helpers of its own


def test_a_law_that_cannot_be_kept_is_compiled_all_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[bool] = []
    cfunc = numba.cfunc

    def without_a_place(*args: Any, cache: bool = False, **options: Any) -> Any:
        asked.append(cache)
        if cache:
            raise RuntimeError("cannot cache function 'law': no locator available for file 'a.py'")
        return cfunc(*args, **options)

    monkeypatch.setattr(numba, "cfunc", without_a_place)
    source = "def law(depth, rate, slip, speed, mass, constants, out):\n    return constants[0] * depth"
    assert compiled.compiled_law(source).address > 0
    assert asked == [True, False]


def test_what_an_older_program_has_kept_is_not_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It may name classes that are no longer there."""
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(tmp_path))
    dispatcher = compiled._kept(twice)
    index = Path(dispatcher._cache._cache_file._index_path)
    index.parent.mkdir(parents=True, exist_ok=True)
    index.write_bytes(pickle.dumps(numba.__version__) + b"\x80\x04cno.module\nNoClass\n.")
    assert dispatcher(21.0) == 42.0
    assert compiled.STAMP[0].encode() in index.read_bytes()
