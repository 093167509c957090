"""Compiled functions as they were written: on numbers and on arrays."""

from __future__ import annotations

import math

import numpy as np

from support_exudyn.formulations.compilation import compiled, plain


@compiled
def half(x: float) -> float:
    return 0.5 * math.sqrt(x)


@compiled
def whole(x: float) -> float:
    return half(x) + half(x)


def test_a_plain_function_calls_plain_functions() -> None:
    assert plain(whole)(9.0) == 3.0
    assert plain(whole, half=lambda x: x)(9.0) == 18.0
    np.testing.assert_array_equal(plain(whole, math=np)(np.array([4.0, 9.0])), [2.0, 3.0])


def test_what_stands_for_a_name_does_so_nowhere_else() -> None:
    plain(whole, half=lambda x: x)
    assert plain(whole)(9.0) == 3.0
