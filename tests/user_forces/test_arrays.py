"""Laws over whole time series give what they give instant by instant."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.cases.law_cases import BEARING, FRICTION_LAWS, NORMAL_LAWS, kind_of
from user_forces import FrictionLaw, JournalContact, NormalLaw
from user_forces.contact import SlipHistory
from user_forces.expressions import scalar
from user_forces.expressions.arrays import Array, as_number, values_of

# numpy's powers, exponentials and logarithms may differ from the machine's in the last digits
CLOSE = 1e-13
numbers = st.floats(-1e3, 1e3)
some = st.lists(numbers, min_size=1, max_size=6)
# depths from rounding to where the shortest range of a law ends, rates of impacts; zero is a case of its own
depths = st.floats(-12.0, -3.7).map(lambda power: 10.0**power)
speeds = st.floats(-1.0, 1.0) | st.sampled_from([0.0, 1e-4, -1e-4, 1e-2, -1e-2])
impacts = st.floats(0.0, 1.0) | st.just(0.0)
masses = st.floats(0.0, 5.0).map(lambda power: 10.0**power)
columns = st.lists(st.tuples(depths, speeds, speeds, impacts, masses), min_size=1, max_size=8)


def assert_same(result: float, expected: list[float], scale: float = 0.0) -> None:
    """An array is what the floats are; scale: below CLOSE of which differences are rounding."""
    got = values_of(result, len(expected))
    np.testing.assert_allclose(got, expected, rtol=CLOSE, atol=CLOSE * scale)


# --- arithmetic ---

OPERATIONS: dict[str, Callable[[Any, Any], Any]] = {
    "sum": lambda a, b: a + b,
    "difference": lambda a, b: a - b,
    "product": lambda a, b: a * b,
    "quotient": lambda a, b: a / (b * b + 1.0),
    "quotient of a number": lambda a, b: 3.0 / (b * b + 1.0),
    "rest of a number": lambda a, b: 3.0 - a,
    "multiple": lambda a, b: 3.0 * a + b * 2.0,
    "sum with a number": lambda a, b: 1.0 + a,
    "opposite": lambda a, b: -a,
    "power": lambda a, b: (a * a) ** 1.5,
    "hypotenuse": scalar.hypot,
    "larger": scalar.maximum,
    "smaller": scalar.minimum,
    "larger than a number": lambda a, b: scalar.maximum(a, 1.0),
    "number larger than": lambda a, b: scalar.maximum(1.0, a),
    "number smaller than": lambda a, b: scalar.minimum(1.0, a),
    "hypotenuse with a number": lambda a, b: scalar.hypot(3.0, a),
    "less": lambda a, b: scalar.where(a < b, a, 7.0),
    "at most": lambda a, b: scalar.where(a <= b, a, b),
    "more": lambda a, b: scalar.where(a > b, 7.0, b),
    "at least": lambda a, b: scalar.where(a >= 1.0, a, b),
    "number less": lambda a, b: scalar.where(a > 1.0, a, b),
    "root": lambda a, b: scalar.sqrt(a * a),
    "exponential": lambda a, b: scalar.exp(a / 1e3),
    "logarithm": lambda a, b: scalar.log(a * a + 1.0),
    "tangent": lambda a, b: scalar.tanh(a),
    "cosine": lambda a, b: scalar.cos(a),
    "sine": lambda a, b: scalar.sin(a),
    "sign": lambda a, b: scalar.sign(a),
    "magnitude": lambda a, b: scalar.magnitude(a),
    "step": lambda a, b: scalar.step(a),
}


@pytest.mark.parametrize("name", OPERATIONS)
@given(pairs=st.lists(st.tuples(numbers, numbers), min_size=1, max_size=6))
def test_every_operation_goes_element_by_element(name: str, pairs: list[tuple[float, float]]) -> None:
    first, second = np.array(pairs).T
    result = OPERATIONS[name](as_number(first), as_number(second))
    assert isinstance(result, Array)
    # a difference of numbers up to 1e3
    assert_same(result, [OPERATIONS[name](a, b) for a, b in pairs], 1e3)


def test_a_result_that_depends_on_nothing_is_spread() -> None:
    np.testing.assert_array_equal(values_of(2.5, 3), [2.5, 2.5, 2.5])
    np.testing.assert_array_equal(values_of(as_number([1.0, 2.0]), 2), [1.0, 2.0])


def test_an_array_is_no_number() -> None:
    assert not scalar.is_number(as_number([1.0]))


@given(values=some)
def test_nothing_is_written_into_what_was_given(values: list[float]) -> None:
    given_array = np.array(values)
    number = as_number(given_array)
    _ = scalar.maximum(number * 2.0 + 1.0, 0.0)
    np.testing.assert_array_equal(given_array, values)


# --- laws ---


@pytest.mark.parametrize("law", NORMAL_LAWS, ids=kind_of)
@given(rows=columns)
def test_normal_laws(law: NormalLaw, rows: list[tuple[float, ...]]) -> None:
    depth, _, rate, speed, _ = (as_number(column) for column in np.array(rows).T)
    forces = [law(d, r, v) for d, _, r, v, _ in rows]
    # a dashpot's force is a difference of larger ones
    scale = max(law.elastic_force(d) + abs(f) for (d, *_), f in zip(rows, forces, strict=True))
    assert_same(law(depth, rate, speed), forces, scale)
    assert_same(law.elastic_force(depth), [law.elastic_force(d) for d, *_ in rows])
    assert_same(law.elastic_energy(depth), [law.elastic_energy(d) for d, *_ in rows])


@pytest.mark.parametrize("law", FRICTION_LAWS, ids=kind_of)
@given(rows=columns)
def test_friction_laws(law: FrictionLaw, rows: list[tuple[float, ...]]) -> None:
    run_of_steps, slip, _, _, normal = (as_number(column) for column in np.array(rows).T)
    expected = [law(s, n, d) for d, s, _, _, n in rows]
    assert_same(law(slip, normal, run_of_steps), expected, max(n for *_, n in rows))


@pytest.mark.parametrize("friction", FRICTION_LAWS, ids=kind_of)
@given(
    rows=st.lists(
        st.tuples(st.floats(0.0, 7.0), st.floats(-2e-5, 1.5e-4), speeds, speeds, speeds, speeds, impacts),
        min_size=1,
        max_size=8,
    )
)
def test_a_whole_contact(friction: FrictionLaw, rows: list[tuple[float, ...]]) -> None:
    contact = JournalContact(bearing=BEARING, normal=NORMAL_LAWS[0], friction=friction)
    angle, beyond, vx, vy, spin, other, speed = np.array(rows).T
    far = BEARING.clearance + beyond
    x, y = far * np.cos(angle), far * np.sin(angle)
    given_motion = np.array([x, y, vx, vy, spin, other])
    still = SlipHistory(1e-6, 1e-3, 0.0)  # no time passes between records
    result = contact.force(
        *(as_number(values) for values in given_motion),
        as_number(speed),
        SlipHistory(as_number(np.full(len(rows), 1e-6)), as_number(np.full(len(rows), 1e-3)), 0.0),
    )
    # places are known to their last digit, and a damped force that jumps at the impact hangs on it
    expected = [
        [contact.force(near * x, near * y, *others, v, still) for near in (1.0 - 2.0**-51, 1.0, 1.0 + 2.0**-51)]
        for (x, y, *others), v in zip(given_motion.T.tolist(), speed.tolist(), strict=True)
    ]
    names = ["depth", "rate", "slip", "normal_force", "friction_force", "force_x", "force_y", "journal_arm"]
    for name in names:
        want = np.array([[getattr(force, name) for force in near] for near in expected])
        # depths are differences of numbers 1e-3, so that forces are right to 1e-16/1e-5 and less of 1e5 N
        scale = max([1.0, *(near[1].normal_force for near in expected)]) if "force" in name else 1.0
        off = 1e-9 * np.abs(want[:, 1]) + 1e-10 * scale
        got = values_of(getattr(result, name), len(rows))
        assert (got >= want.min(axis=1) - off).all(), name
        assert (got <= want.max(axis=1) + off).all(), name


def test_beyond_its_range_a_law_is_a_number_on_arrays() -> None:
    # records come of runs that have stayed within it; what arrays give must only not be an error
    law = next(law for law in NORMAL_LAWS if law.largest_depth < math.inf)
    depth = as_number([0.5 * law.largest_depth, law.largest_depth])
    assert np.isfinite(values_of(law.elastic_force(depth), 2)).all()
