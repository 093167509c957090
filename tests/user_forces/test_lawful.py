"""What no contact force can be is refused, and no law of ours is taken for one."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from studies.contact_laws import catalogue
from support_exudyn.mechanics.law_masses import lacks_mass
from tests.often import often
from user_forces import (
    Ambrosio,
    Frictionless,
    JournalBearing,
    JournalContact,
    LoadError,
    LuGre,
    NormalLaw,
    value,
)
from user_forces.compilation.flat import flat_force
from user_forces.contact import SlipHistory
from user_forces.expressions.scalar import maximum, minimum, where
from user_forces.friction.law import FrictionLaw
from user_forces.lawful import AT_REST, LawError, check_laws, look

BEARING = JournalBearing(bore_radius=0.0655, clearance=0.0015)
NORMAL = {f"{name} {e}": law for e in (0.2, 0.9) for name, law in catalogue.normal_laws(1.5, e).items()}
FRICTION = catalogue.friction_laws(0.25)

depths = st.floats(-12.0, -3.5).map(lambda x: 10.0**x)
speeds = st.floats(-9.0, 0.7).map(lambda x: 10.0**x) | st.just(0.0)
rates = st.tuples(speeds, st.sampled_from([-1.0, 1.0])).map(lambda x: x[0] * x[1])


@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=pytest.mark.slow) if n.endswith("0.9") else n for n in NORMAL]
)
@settings(max_examples=often(60), deadline=None)
@given(depth=depths, rate=rates, impact=speeds)
def test_no_normal_law_of_ours_is_refused(name: str, depth: float, rate: float, impact: float) -> None:
    law: Any = NORMAL[name]
    if lacks_mass(law):  # a scenario gives it that of the joint
        law = replace(law, mass=1e3)
    contact = JournalContact(bearing=BEARING, normal=law)
    check_laws(contact, "pin")
    try:
        normal = max(0.0, law(depth, rate, impact))
        elastic = law.elastic_force(depth)
    except LoadError:
        return
    look(contact, depth, rate, 0.0, normal, 0.0, elastic)


@pytest.mark.parametrize("name", FRICTION)
@settings(max_examples=often(60), deadline=None)
@given(
    slip=rates,
    normal=st.floats(0.0, 1e7),
    history=st.builds(SlipHistory, st.floats(-1e-5, 1e-5), rates, speeds),
)
def test_no_friction_law_of_ours_is_refused(
    name: str, slip: float, normal: float, history: SlipHistory
) -> None:
    law = FRICTION[name]
    contact = JournalContact(bearing=BEARING, normal=next(iter(NORMAL.values())), friction=law)
    deflection = law.next_deflection(*history) if law.has_state else 0.0
    look(contact, 1e-5, 0.0, slip, normal, law(slip, normal, deflection), normal)


@value
class Spring(NormalLaw):
    """Linear; a law of one's own."""

    stiffness: float = 1e9

    def __call__(self, depth: float, rate: float, impact_velocity: float) -> float:
        return self.stiffness * depth

    def elastic_force(self, depth: float) -> float:
        return self.stiffness * depth

    def elastic_energy(self, depth: float) -> float:
        return 0.5 * self.stiffness * depth * depth


CONTACT = JournalContact(bearing=BEARING, normal=Spring(), friction=Ambrosio(sliding_coefficient=0.1))
STATE: dict[str, float] = {
    "depth": 1e-5, "rate": 0.1, "slip": 0.2, "normal": 1e4, "friction": -1e3, "elastic": 1e4
}  # fmt: skip


@pytest.mark.parametrize(
    ("wrong", "reason"),
    [
        ({"normal": math.nan}, "Spring gives a force of nan N at a depth of 1e-05 m and a rate of 0.1 m/s"),
        ({"normal": math.inf}, "Spring gives a force of inf N"),
        ({"elastic": math.nan}, "Spring gives a force of nan N"),
        ({"friction": math.nan}, "Ambrosio gives a force of nan N at a slip of 0.2 m/s and 10000 N"),
        ({"friction": -math.inf}, "Ambrosio gives a force of -inf N"),
        ({"friction": 1.0}, "Ambrosio pushes along the slip: 1 N at 0.2 m/s"),
        ({"elastic": -1.0}, "Spring pulls with 1 N"),
        ({"normal": 0.0}, "Spring drives the motion instead of damping it: 0 N"),
        ({"normal": 1.01e4, "rate": -0.1}, "Spring drives the motion"),
    ],
)
def test_what_is_no_force_is_told(wrong: dict[str, float], reason: str) -> None:
    look(CONTACT, **STATE)
    with pytest.raises(LawError, match=reason):
        look(CONTACT, **STATE | wrong)
    with pytest.raises(LawError, match=f"rear_base: {reason}"):
        look(CONTACT, **STATE | wrong, pin="rear_base")


def test_what_is_right_but_for_rounding_passes() -> None:
    look(CONTACT, **STATE | {"normal": 1e4 * (1.0 - 1e-12)})
    with pytest.raises(LawError, match="Spring drives the motion"):
        look(CONTACT, **STATE | {"normal": 1e4 * (1.0 - 1e-3)})


def test_a_bristle_may_give_back_what_it_has_stored() -> None:
    bristles = JournalContact(
        bearing=BEARING, normal=Spring(), friction=LuGre(static_coefficient=0.3, sliding_coefficient=0.2)
    )
    look(bristles, **STATE | {"friction": 1e3})
    with pytest.raises(LawError, match="pushes along the slip"):
        look(CONTACT, **STATE | {"friction": 1e3})


@pytest.mark.parametrize("sign", [-1.0, math.nan])
def test_an_elastic_part_that_pulls_is_told_before_a_run(sign: float) -> None:
    class Pull(Spring):
        def elastic_force(self, depth: float) -> float:
            return sign * 1e9 * depth

    check_laws(CONTACT, "pin")
    with pytest.raises(LawError, match=f"has an elastic force of {sign * 1e9 * AT_REST[0]:g} N"):
        check_laws(JournalContact(bearing=BEARING, normal=Pull()), "pin")


# --- what is no number is not cut away ---


@pytest.mark.parametrize("cut", [maximum, minimum])
def test_cutting_keeps_what_is_no_number(cut: Callable[[float, float], float]) -> None:
    assert math.isnan(cut(math.nan, 0.0))
    assert math.isnan(cut(0.0, math.nan))
    assert cut(math.inf, 0.0) == (math.inf if cut is maximum else 0.0)


class Deep(Spring):
    """No number beyond a depth."""

    def __call__(self, depth: float, rate: float, impact_velocity: float) -> float:
        return where(depth > 1e-5, math.nan, 1e9 * depth)


class Branching(Spring):
    """The same, for numbers only."""

    def __call__(self, depth: float, rate: float, impact_velocity: float) -> float:
        return math.nan if depth > 1e-5 else 1e9 * depth


@value
class Slipping(FrictionLaw):
    """Infinite beyond a slip."""

    def __call__(self, slip: float, normal_force: float, deflection: float = 0.0) -> float:
        return where(slip > 0.1, -math.inf, -0.1 * normal_force * where(slip > 0.0, 1.0, -1.0))


@pytest.mark.parametrize(
    ("contact", "depth", "slip"),
    [
        (JournalContact(bearing=BEARING, normal=Deep()), 2e-5, 0.0),
        (JournalContact(bearing=BEARING, normal=Branching()), 2e-5, 0.0),
        (JournalContact(bearing=BEARING, normal=Spring(), friction=Slipping()), 1e-6, 0.2),
    ],
)
def test_the_flat_force_says_so(contact: JournalContact, depth: float, slip: float) -> None:
    force: Any = flat_force(contact)
    others = (0.0, 0.0, 1.0, 0.1, 0.0, 0.0, 0.0)
    force(BEARING.clearance + 5e-7, 0.0, 0.1, 0.05, *others)
    with pytest.raises(LawError):
        force(BEARING.clearance + depth, 0.0, 0.1, slip, *others)


def test_frictionless_is_a_friction_law_that_passes() -> None:
    smooth = JournalContact(bearing=BEARING, normal=Spring(), friction=Frictionless())
    look(smooth, **STATE | {"friction": 0.0})
    with pytest.raises(LawError, match="Frictionless pushes along the slip"):
        look(smooth, **STATE | {"friction": 1.0})
