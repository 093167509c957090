"""Compiled functions as they were written: on numbers and on arrays."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from support_exudyn import ClearancePin, Scenario, UniformSpeed
from support_exudyn.formulations.compilation import compiled, on_arrays, plain
from support_exudyn.formulations.compiled.closed_forms import layout, support_model
from support_exudyn.formulations.compiled.closed_forms.equations import law_at
from support_exudyn.formulations.compiled.closed_forms.layout import DriveValues, driven
from support_exudyn.formulations.compiled.closed_forms.setup import parameters
from support_exudyn.formulations.compiled.closed_forms.support_posture import meeting_point
from tests.cases.machine_cases import contact, support

PIN = support_model.PIN


def scene(**changes: Any) -> Scenario:
    """A fall through the clearance with a jump of the actuators' speed, or what changes say."""
    fields: dict[str, Any] = {
        "machine": support(),
        "duration": 0.04,
        "pins": {PIN: ClearancePin(contact=contact())},
        "drive": UniformSpeed(stroke=0.01, start=0.02, end=0.05),
    }
    return Scenario(**fields | changes)


# --- functions as they stand ---


@compiled
def half(x: float) -> float:
    return 0.5 * math.sqrt(x)


@compiled
def whole(x: float) -> float:
    return half(x) + half(x)


def test_a_plain_function_calls_plain_functions() -> None:
    assert plain(whole)(9.0) == 3.0
    assert plain(whole, half=lambda x: x)(9.0) == 18.0
    np.testing.assert_array_equal(on_arrays(whole)(np.array([4.0, 9.0])), [2.0, 3.0])


def test_what_stands_for_a_name_does_so_nowhere_else() -> None:
    plain(whole, half=lambda x: x)
    assert plain(whole)(9.0) == 3.0


def test_named_tuples_keep_their_fields() -> None:
    segment = [0.0] * layout.SEGMENT
    segment[layout.WIDTH], segment[layout.A1] = 2.0, 3.0
    found = plain(driven)(segment, 1.0)
    assert [getattr(found, name) for name in DriveValues._fields] == [1.5, 1.5, 0.0]


def test_circles_that_do_not_meet() -> None:
    # compiled code gives nan, plain Python an error; the runs expect both
    with pytest.raises(ValueError, match=r"math domain error|nonnegative"):
        plain(meeting_point)(0.0, 0.0, 1.0, 5.0, 0.0, 1.0, 1.0)


@pytest.mark.parametrize("bore", ["first", "second"])
def test_equations_of_motion_on_arrays_are_those_of_every_instant(bore: str) -> None:
    pin = ClearancePin(contact=contact(), bore=bore)
    p = parameters(scene(pins={PIN: pin}), support_model.parameters(support()), pin).tolist()
    rng = np.random.default_rng(2)
    count, start = 7, np.array(support_model.start(support()))
    y = np.zeros((layout.STATES, count))
    y[:2] = start[:, None] + 0.01 * rng.normal(size=(2, count))
    y[2:4] = rng.normal(size=(2, count))
    drive = DriveValues(*0.1 * rng.normal(size=(3, count)))
    pins, laws = on_arrays(law_at)(p, drive, y, 1.0)
    for n in range(count):
        at = DriveValues(*(item[n] for item in drive))
        pin_then, law_then = plain(law_at)(p, at, y[:, n].tolist(), 1.0)
        for many, one in ((pins, pin_then), (laws, law_then)):
            for name in one._fields:
                got = np.broadcast_to(getattr(many, name), (count,))[n]
                # numpy's sines may differ in the last digit; sums of terms up to 1e5
                assert got == pytest.approx(getattr(one, name), rel=1e-10, abs=1e-9), name
