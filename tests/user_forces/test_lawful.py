"""What no contact force can be is refused, and no law of ours is taken for one."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from studies.contact_laws import catalogue
from support_exudyn.mechanics.contact_places import lacks_mass
from tests.often import often
from user_forces import (
    Ambrosio,
    JournalBearing,
    JournalContact,
    LoadError,
    NormalLaw,
    friction_law,
    normal_law,
    value,
)
from user_forces.connector.item import Attachment, compiled_kernel
from user_forces.contact import ContactForce, SlipHistory
from user_forces.kernel import kernel, limited, sign
from user_forces.lawful import LawError, check_laws, look

BEARING = JournalBearing(bore_radius=0.0655, clearance=0.0015)
NORMAL = catalogue.normal_laws(1.5, 0.2)
FRICTION = catalogue.friction_laws(0.25)

depths = st.floats(-12.0, -3.5).map(lambda x: 10.0**x)
speeds = st.floats(-9.0, 0.7).map(lambda x: 10.0**x) | st.just(0.0)
rates = st.tuples(speeds, st.sampled_from([-1.0, 1.0])).map(lambda x: x[0] * x[1])


@pytest.mark.parametrize("name", NORMAL)
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
    deflection = law.next_deflection(*history)
    look(contact, 1e-5, 0.0, slip, normal, law(slip, normal, deflection), normal)


@normal_law
def spring(depth: float, rate: float, impact_velocity: float, stiffness: float = 1e9) -> float:
    return stiffness * depth


CONTACT = JournalContact(bearing=BEARING, normal=spring(), friction=Ambrosio(sliding_coefficient=0.1))
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


# --- before a run ---


@value
class Richer(NormalLaw):
    """Its energy is 2.2 times the integral of its force."""

    @staticmethod
    @kernel
    def force(depth: float, rate: float, impact_velocity: float) -> float:
        return 1e9 * depth

    @staticmethod
    @kernel
    def energy(depth: float) -> float:
        return 1.1e9 * depth * depth


def raising(depth: float, rate: float, impact_velocity: float) -> float:
    raise KeyError("stiffness")


def gripping(slip: float, normal_force: float) -> float:
    return -50.0 * normal_force * math.tanh(slip / 1e-3)


def silent(slip: float, normal_force: float) -> Any:
    return None


@pytest.mark.parametrize(
    ("laws", "said"),
    [
        (
            {"normal": normal_law(raising)()},
            "Raising.elastic_force fails at a depth of 1e-09 m: KeyError: 'stiffness'",
        ),
        (
            {"normal": Richer()},
            "Richer.elastic_energy is 1.1e-09 J at a depth of 1e-09 m, and the integral of elastic_force",
        ),
        (
            {"friction": friction_law(gripping)()},
            "Gripping has a coefficient of 38.0797 at a slip of 0.001 m/s",
        ),
        ({"friction": friction_law(silent)()}, "Silent fails at a slip of 0 m/s and 1000 N: TypeError"),
    ],
)
def test_a_law_that_cannot_be_is_refused_before_a_run(laws: dict[str, Any], said: str) -> None:
    check_laws(CONTACT, "pin")
    with pytest.raises(LawError, match=f"pin: {said}"):
        check_laws(replace(CONTACT, **laws), "pin")


# --- what is no number is not cut away ---


@normal_law
def deep(depth: float, rate: float, impact_velocity: float) -> float:
    return math.nan if depth > 1e-5 else 1e9 * depth


@friction_law
def slipping(slip: float, normal_force: float) -> float:
    return -math.inf if slip > 0.1 else -0.1 * normal_force * sign(slip)


@pytest.mark.parametrize(
    ("contact", "depth", "slip"),
    [
        (JournalContact(bearing=BEARING, normal=deep()), 2e-5, 0.0),
        (JournalContact(bearing=BEARING, normal=spring(), friction=slipping()), 1e-6, 0.2),
    ],
)
def test_a_contact_of_such_laws_has_such_a_force(contact: JournalContact, depth: float, slip: float) -> None:
    place = BEARING.clearance + depth, 0.0, 0.1, slip, 0.0, 0.0
    compiled = compiled_kernel(contact.force_kernel, Attachment.JOURNAL, False)
    numbers = *place[:2], 0.0, *place[2:4], 0.0, 0.0, 0.0, 0.0, True, 0.1, 0.0, 0.0, 0.0
    for found in (
        contact.force(*place, 0.1),
        ContactForce(*compiled(*numbers, np.array(contact.constants))[4:14]),
    ):
        with pytest.raises(LawError, match=r"gives a force of (nan|-inf) N"):
            look(contact, *found[:5])


@pytest.mark.parametrize(
    "ends", [(math.nan, 0.0, 1.0), (0.5, 0.0, 1.0), (-1.0, 0.0, 1.0), (math.inf, 0.0, 1.0)]
)
def test_limits_keep_what_is_no_number(ends: tuple[float, float, float]) -> None:
    x, low, high = ends
    found = limited(x, low, high)
    assert math.isnan(found) if math.isnan(x) else found == min(max(x, low), high)
