"""The force as one flat function: bit for bit that of the contact."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from tests.cases.law_cases import BEARING, FRICTION_LAWS, NORMAL_LAWS, kind_of, power_law
from tests.often import often
from user_forces import (
    Exact,
    FrictionLaw,
    Frictionless,
    JournalContact,
    LankaraniNikravesh,
    LoadError,
    LuGre,
    NormalLaw,
    SlipHistory,
    value,
)
from user_forces.compilation.flat import FlatForce, flat_force, flat_function, nested

CLEARANCE = BEARING.clearance
EXACT = power_law(Exact)
# x, y, vx, vy, bore_spin, journal_spin; in_contact, speed, deflection, slip, step
Arguments = tuple[float, ...]
MIDDLE: Arguments = (0.0, 0.0, 0.1, 0.2, 1.0, 2.0, 1.0, 0.3, 1e-7, 0.1, 1e-5)


@cache
def flat(contact: JournalContact) -> FlatForce:
    return flat_force(contact)


@st.composite
def states(draw: st.DrawFn) -> Arguments:
    depth = draw(st.one_of(st.floats(-CLEARANCE, 0.0), st.floats(0.0, 1e-4), st.floats(-1e-9, 1e-9)))
    angle = draw(st.floats(-math.pi, math.pi))
    eccentricity = CLEARANCE + depth
    return (
        eccentricity * math.cos(angle),
        eccentricity * math.sin(angle),
        *(draw(st.floats(-1.0, 1.0)) for _ in range(2)),  # velocity
        *(draw(st.floats(-10.0, 10.0)) for _ in range(2)),  # spins
        draw(st.sampled_from([0.0, 1.0])),
        draw(st.one_of(st.just(0.0), st.floats(1e-6, 1.0))),  # impact velocity
        draw(st.floats(-2e-6, 2e-6)),  # deflection
        draw(st.floats(-1.0, 1.0)),  # slip
        draw(st.floats(1e-7, 1e-3)),  # step
    )


def assert_same(contact: JournalContact, state: Arguments) -> None:
    *motion, in_contact, speed, deflection, slip, step = state
    impact = speed if in_contact else None
    expected = contact.force(*motion, impact, SlipHistory(deflection, slip, step))
    assert flat(contact)(*state) == expected


@pytest.mark.parametrize("normal", NORMAL_LAWS, ids=kind_of)
@settings(max_examples=often(60), deadline=None)
@given(state=states())
@example(state=MIDDLE)
def test_every_normal_law(normal: NormalLaw, state: Arguments) -> None:
    assert_same(JournalContact(bearing=BEARING, normal=normal), state)


@pytest.mark.parametrize("friction", FRICTION_LAWS, ids=kind_of)
@settings(max_examples=often(60), deadline=None)
@given(state=states())
@example(state=MIDDLE)
def test_every_friction_law(friction: FrictionLaw, state: Arguments) -> None:
    assert_same(JournalContact(bearing=BEARING, normal=EXACT, friction=friction), state)


@settings(max_examples=often(100), deadline=None)
@given(states=st.lists(states(), min_size=2, max_size=5))
def test_nothing_is_kept_from_call_to_call(states: list[Arguments]) -> None:
    friction = LuGre(static_coefficient=0.3, sliding_coefficient=0.2)
    contact = JournalContact(bearing=BEARING, normal=EXACT, friction=friction)
    alone = [flat_force(contact)(*state) for state in states]
    assert [flat(contact)(*state) for state in states] == alone


@pytest.mark.parametrize("normal", [law for law in NORMAL_LAWS if law.largest_depth < math.inf], ids=kind_of)
def test_a_load_outside_the_range_of_a_law_is_refused(normal: NormalLaw) -> None:
    contact = JournalContact(bearing=BEARING, normal=normal)
    deep = CLEARANCE + 1.01 * normal.largest_depth
    state = (deep, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.1, 0.0, 0.0, 1e-5)
    with pytest.raises(LoadError) as flatly:
        flat(contact)(*state)
    with pytest.raises(LoadError) as plainly:
        contact.force(*state[:6], 0.1)
    assert type(normal).__name__ in str(flatly.value)
    assert str(flatly.value).split(":")[0] == str(plainly.value).split(":")[0]
    # apart nothing is asked of the law
    assert flat(contact)(*state[:6], 0.0, *state[7:]).normal_force == 0.0


@value
class Branching(LankaraniNikravesh):
    """A law of a user who knows nothing of expressions."""

    def __call__(self, depth: float, rate: float, impact_velocity: float) -> float:
        if depth > 1e-4:
            raise LoadError("Branching: too deep")
        return self.stiffness * depth**1.5 if rate > 0.0 else 0.5 * self.stiffness * depth**1.5


@value
class BranchingFriction(FrictionLaw):
    """Likewise, with a state."""

    def __call__(self, slip: float, normal_force: float, deflection: float = 0.0) -> float:
        if abs(slip) < 1e-3:
            return 0.0
        return -math.copysign(0.1, slip) * normal_force - 1e3 * deflection * normal_force

    @property
    def has_state(self) -> bool:
        return True

    def next_deflection(self, deflection: float, slip: float, step: float) -> float:
        return min(1e-6, max(-1e-6, deflection + slip * step))


BRANCHING = Branching(stiffness=1e9, restitution=0.7)


@settings(max_examples=often(60), deadline=None)
@given(state=states())
@example(state=MIDDLE)
def test_a_law_that_branches_is_called(state: Arguments) -> None:
    assert_same(JournalContact(bearing=BEARING, normal=EXACT, friction=BranchingFriction()), state)
    if math.hypot(*state[:2]) < CLEARANCE + 1e-4:
        assert_same(JournalContact(bearing=BEARING, normal=BRANCHING, friction=BranchingFriction()), state)


def test_what_a_branching_law_raises_is_raised() -> None:
    contact = JournalContact(bearing=BEARING, normal=BRANCHING)
    with pytest.raises(LoadError, match="too deep"):
        flat(contact)(CLEARANCE + 2e-4, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.1, 0.0, 0.0, 1e-5)


def test_frictionless_has_no_friction() -> None:
    contact = JournalContact(bearing=BEARING, normal=EXACT, friction=Frictionless())
    found = flat(contact)(1.01 * CLEARANCE, 0.0, 0.1, 0.5, 1.0, 2.0, 1.0, 0.1, 0.0, 0.0, 1e-5)
    assert found.normal_force > 0.0
    assert found.friction_force == 0.0


@pytest.mark.parametrize("normal", [*NORMAL_LAWS, BRANCHING], ids=kind_of)
@given(depth=st.floats(1e-9, 1e-4))
def test_elastic_force_and_energy_are_those_of_the_law(normal: NormalLaw, depth: float) -> None:
    for function in (normal.elastic_force, normal.elastic_energy):
        assert flat_function(function)(depth) == function(depth)


def test_a_formula_that_is_used_once_stands_where_it_is_used() -> None:
    source = [
        "def f(x):",
        "    _0 = x + (1.0)",
        "    _1 = _0 * _0",
        "    _2 = -_1",
        "    return _2 if _2 > x else x",
    ]
    assert nested(source) == [
        "def f(x):",
        "    _0 = x + (1.0)",
        "    _2 = -(_0 * _0)",
        "    return _2 if _2 > x else x",
    ]
    # Python takes no more brackets in each other than a few hundred
    chain = [
        "def f(x):",
        "    _0 = x",
        *(f"    _{n} = {n}.0 - _{n - 1}" for n in range(1, 500)),
        "    return _499",
    ]
    space: dict[str, Callable[[float], float]] = {}
    exec("\n".join(nested(chain)), space)
    assert space["f"](0.0) == 250.0
