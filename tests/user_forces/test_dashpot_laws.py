"""Laws with a dashpot beside the spring, and how long an impact takes with any law."""

from __future__ import annotations

import math
import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.analytic import adams_step, contact_time, greatest_depth
from tests.cases.law_cases import NORMAL_LAWS, kind_of, law_rebound
from tests.often import often
from tests.ranges import from_zero
from user_forces import AdamsImpact, Anagnostopoulos, Hertz, InputError, KelvinVoigt, NormalLaw
from user_forces.normal.dashpots import cut_dashpot_restitution

stiffnesses = st.floats(1e6, 1e10)
masses = st.floats(0.5, 5e3)
speeds = st.floats(0.02, 2.0)
depths = st.floats(1e-7, 1e-3)
rates = st.floats(-2.0, 2.0)


def damps(zeta: float) -> bool:
    """Whether a damping ratio is zero, or makes a damping that values take."""
    return zeta == 0.0 or zeta > 1e-20


# From the table in notes.md: restitution asked for, damping ratio, what is delivered with the tension cut
ANAGNOSTOPOULOS = [
    (0.1, 0.591155, 0.252729),
    (0.2, 0.455950, 0.324863),
    (0.3, 0.357857, 0.397140),
    (0.5, 0.215454, 0.550283),
    (0.7, 0.112808, 0.718201),
    (0.8, 0.070850, 0.808099),
    (0.9, 0.033518, 0.902026),
    (0.95, 0.016325, 0.950507),
]

# The common steel-on-steel set: 1e5 N/mm^1.5, 50 N s/mm and 0.1 mm, in SI
COMMON = AdamsImpact(stiffness=1e5 * 1000.0**1.5, full_damping=50.0 * 1000.0, full_damping_depth=0.1 / 1000.0)


# --- Kelvin and Voigt ---


@given(stiffness=stiffnesses, damping=from_zero(1e6), depth=depths, rate=rates)
def test_spring_and_dashpot_add_up(stiffness: float, damping: float, depth: float, rate: float) -> None:
    law = KelvinVoigt(stiffness=stiffness, damping=damping)
    assert law(depth, rate, 0.2) == stiffness * depth + damping * rate
    assert law.elastic_force(depth) == stiffness * depth


def test_kelvin_voigt_by_hand() -> None:
    law = KelvinVoigt(stiffness=2e8, damping=3e4)
    # 2e4 N and 3e3 N: rounding
    assert law(1e-4, 0.1, 0.2) == pytest.approx(2.3e4, rel=1e-15)
    assert law(1e-4, -1.0, 0.2) == pytest.approx(-1e4, rel=1e-14)  # tension, for the caller to cut
    # 2e8 1e-8 / 2
    assert law.elastic_energy(1e-4) == pytest.approx(1.0, rel=1e-14)


def cut(zeta: float) -> float:
    """Restitution of a dashpot that parts where it would pull: the time till then, and the decay."""
    if zeta < 1.0:
        return math.exp(-2.0 * zeta * math.acos(zeta) / math.sqrt(1.0 - zeta**2))
    return math.exp(-2.0 * zeta * math.acosh(zeta) / math.sqrt(zeta**2 - 1.0))


# From notes.md, where these were integrated
@pytest.mark.parametrize(
    ("zeta", "e"), [(0.05, 0.858758), (0.2155, 0.550221), (0.5, 0.298436), (0.9, 0.155283), (1.5, 0.075588)]
)
def test_delivered_restitution_is_that_of_the_table(zeta: float, e: float) -> None:
    law = KelvinVoigt(stiffness=4e8, damping=2.0 * zeta * 2e4)
    # half of the last printed digit; c = 2 zeta sqrt(K m) with sqrt(K m) = 2e4 kg/s
    assert law.delivered_restitution(1.0) == pytest.approx(e, abs=5.1e-7)


@pytest.mark.parametrize("zeta", [0.0, 0.01, 0.3, 0.99, 1.01, 2.0, 30.0])
def test_delivered_restitution_is_the_closed_form(zeta: float) -> None:
    # the same formula: rounding, times two or three hundred near zeta = 1 where the fraction is 0/0
    assert cut_dashpot_restitution(zeta) == pytest.approx(cut(zeta), rel=1e-13)


def test_delivered_restitution_at_critical_damping() -> None:
    assert cut_dashpot_restitution(1.0) == math.exp(-2.0)
    # the slope there is 2/3 exp(-2) or less; near it acos loses half of its digits, but the fraction keeps them
    for zeta in (1.0 - 1e-7, 1.0 + 1e-7, 1.0 - 2e-9, 1.0 + 2e-9):
        assert cut_dashpot_restitution(zeta) == pytest.approx(math.exp(-2.0), rel=3e-7)


@given(zeta=st.floats(0.0, 5.0), more=st.floats(1e-3, 1.0))
def test_stronger_dashpot_delivers_less(zeta: float, more: float) -> None:
    assert cut_dashpot_restitution(zeta + more) < cut_dashpot_restitution(zeta)


@settings(max_examples=often(30))
@given(zeta=from_zero(3.0).filter(damps), stiffness=stiffnesses, mass=masses, speed=speeds)
def test_kelvin_voigt_delivers_in_an_impact_what_it_says(
    zeta: float, stiffness: float, mass: float, speed: float
) -> None:
    law = KelvinVoigt(stiffness=stiffness, damping=2.0 * zeta * math.sqrt(stiffness * mass))
    # the integrator's tolerance of 1e-10 a step, over some hundred steps, and the kink where tension is cut
    assert law_rebound(law, mass, speed) == pytest.approx(law.delivered_restitution(mass), abs=1e-7)


def test_a_hard_dashpot_still_lets_go() -> None:
    law = KelvinVoigt(stiffness=1e6, damping=2e4)  # zeta = 10 with 1 kg
    # 1/(4 zeta^2) as zeta grows; the next term is about ln(zeta)/zeta^2 of it
    assert law.delivered_restitution(1.0) == pytest.approx(1.0 / 400.0, rel=0.05)
    # as above
    assert law_rebound(law, 1.0, 0.3) == pytest.approx(law.delivered_restitution(1.0), abs=1e-7)


@pytest.mark.parametrize(
    ("field", "wrong", "allowed"),
    [("stiffness", 0.0, "> 0"), ("damping", -1.0, ">= 0"), ("exponent", 1.5, ">= 1 and <= 1")],
)
def test_impossible_spring_or_dashpot_is_refused(field: str, wrong: float, allowed: str) -> None:
    fields = {"stiffness": 1e8, "damping": 1e3} | {field: wrong}
    with pytest.raises(InputError, match=rf"KelvinVoigt\.{field} = {wrong}: .*allowed: {allowed}$"):
        KelvinVoigt(**fields)


# --- Anagnostopoulos ---


@pytest.mark.parametrize(("e", "zeta", "delivered"), ANAGNOSTOPOULOS)
def test_damping_ratio_and_what_it_delivers(e: float, zeta: float, delivered: float) -> None:
    law = Anagnostopoulos(stiffness=1e9, restitution=e)
    # half of the last printed digit
    assert law.damping_ratio == pytest.approx(zeta, abs=5.1e-7)
    assert law.delivered_restitution == pytest.approx(delivered, abs=5.1e-7)


@given(e=st.floats(0.01, 1.0))
def test_with_its_tension_it_would_deliver_what_is_asked_for(e: float) -> None:
    zeta = Anagnostopoulos(stiffness=1e9, restitution=e).damping_ratio
    # the decay over half a swing; rounding
    assert math.exp(-math.pi * zeta / math.sqrt(1.0 - zeta**2)) == pytest.approx(e, rel=1e-13)


@given(e=st.floats(0.01, 1.0), stiffness=stiffnesses, mass=masses, depth=depths, rate=rates)
def test_anagnostopoulos_is_a_dashpot_for_the_mass_that_moves(
    e: float, stiffness: float, mass: float, depth: float, rate: float
) -> None:
    law = Anagnostopoulos(stiffness=stiffness, restitution=e, mass=mass)
    zeta = -math.log(e) / math.sqrt(math.pi**2 + math.log(e) ** 2)
    damping = 2.0 * zeta * math.sqrt(stiffness * mass)
    # the same in another order: rounding, of the larger part where both nearly cancel
    assert law(depth, rate, 0.2) == pytest.approx(
        stiffness * depth + damping * rate, abs=1e-14 * (stiffness * depth + damping * abs(rate))
    )


@settings(max_examples=often(20))
@given(e=st.floats(0.01, 1.0), stiffness=stiffnesses, mass=masses, speed=speeds)
def test_anagnostopoulos_delivers_in_an_impact_what_it_says(
    e: float, stiffness: float, mass: float, speed: float
) -> None:
    law = Anagnostopoulos(stiffness=stiffness, restitution=e, mass=mass)
    # as for Kelvin and Voigt
    assert law_rebound(law, mass, speed) == pytest.approx(law.delivered_restitution, abs=1e-7)


def test_docstring_states_what_anagnostopoulos_delivers() -> None:
    found = re.search(r"Delivers ([\d., ]+)\s+for e = ([\d., ]+)\.\s", Anagnostopoulos.__doc__ or "")
    assert found
    stated, asked = ([float(number) for number in part.split(",")] for part in found.groups())
    zetas = [-math.log(e) / math.hypot(math.pi, math.log(e)) for e in asked]
    # what the closed form gives, printed with three digits
    assert stated == [round(cut(zeta), 3) for zeta in zetas]


def test_restitution_of_zero_is_refused() -> None:
    with pytest.raises(InputError, match=r"Anagnostopoulos\.restitution = 0\.0: .*allowed: > 0 and <= 1"):
        Anagnostopoulos(stiffness=1e9, restitution=0.0)


# --- the IMPACT function ---


def test_impact_function_by_hand() -> None:
    law = AdamsImpact(stiffness=4e10, full_damping=5e4, full_damping_depth=2e-4)
    # 4e10 (1e-4)^1.5 = 4e4 N, and half of the full damping in the middle of the STEP: rounding
    assert law(1e-4, 0.1, 0.2) == pytest.approx(4e4 + 2.5e3, rel=1e-14)


@given(depth=st.floats(1e-9, 3e-4), rate=rates, speed=speeds, mass=masses)
def test_impact_function_is_the_published_one(depth: float, rate: float, speed: float, mass: float) -> None:
    # MSC Adams: k (x1 - x)^e - STEP(x, x1 - d, cmax, x1, 0) x', for a distance x below x1
    x1 = 1.0
    damping = adams_step(-depth, -1e-4, 5e4, 0.0, 0.0)
    published = 1e5 * 1000.0**1.5 * (x1 - (x1 - depth)) ** 1.5 - damping * -rate
    # the difference of lengths of 1 m is rounded to 1e-16 m; sum of parts that may nearly cancel
    size = COMMON.elastic_force(depth) + 5e4 * abs(rate)
    assert COMMON(depth, rate, speed) == pytest.approx(published, abs=(1e-12 + 2e-16 / depth) * size)


def test_damping_rises_from_nothing_to_its_full_size() -> None:
    def damping(depth: float) -> float:
        return (COMMON(depth, 1.0, 1.0) - COMMON.elastic_force(depth)) / 1.0

    # 3 (depth/d)^2 of the full damping at first, the next term is smaller by depth/d
    assert damping(1e-8) == pytest.approx(3e-8 * 5e4, rel=1e-3)
    # rounding of the difference of forces of some 1e4 N
    assert damping(1e-4) == pytest.approx(5e4, rel=1e-12)
    assert damping(5e-4) == pytest.approx(5e4, rel=1e-12)


@given(depth=depths, rate=rates, speed=speeds)
def test_impact_function_only_takes_energy(depth: float, rate: float, speed: float) -> None:
    assert (COMMON(depth, rate, speed) - COMMON.elastic_force(depth)) * rate >= 0.0


# From notes.md, with the common set; the tension is cut and may come back as pressure
@pytest.mark.parametrize(
    ("mass", "speed", "e"),
    [
        (1.0, 0.01, 0.952),
        (1.0, 0.1, 0.483),
        (1.0, 1.0, 0.057),
        (500.0, 0.01, 0.880),
        (500.0, 0.1, 0.653),
        (500.0, 1.0, 0.736),
    ],
)
def test_restitution_of_the_common_set(mass: float, speed: float, e: float) -> None:
    # half of the last printed digit
    assert law_rebound(COMMON, mass, speed) == pytest.approx(e, abs=5.1e-4)


@settings(max_examples=often(20))
@given(mass=masses, speed=speeds)
def test_impact_function_never_returns_more_than_came(mass: float, speed: float) -> None:
    # the integrator's tolerance
    assert 0.0 <= law_rebound(COMMON, mass, speed) <= 1.0 + 1e-8


@pytest.mark.parametrize(
    ("field", "wrong", "allowed"), [("full_damping", -1.0, ">= 0"), ("full_damping_depth", 0.0, "> 0")]
)
def test_impossible_damping_is_refused(field: str, wrong: float, allowed: str) -> None:
    fields = {"stiffness": 1e9, "full_damping": 1e4, "full_damping_depth": 1e-4} | {field: wrong}
    with pytest.raises(InputError, match=rf"AdamsImpact\.{field} = {wrong}: .*allowed: {allowed}"):
        AdamsImpact(**fields)


# --- how long an impact takes ---


# Johnson prints 2.94 for n = 1.5; for n = 1 the factor is pi, for n = 3 it is 2.62, 12.2 % less
@pytest.mark.parametrize(("n", "within"), [(1.0, 0.123), (1.5, 2e-3), (2.0, 0.123), (2.5, 0.123), (3.0, 0.123)])
def test_impact_time_is_about_that_of_an_elastic_impact(n: float, within: float) -> None:
    law = Hertz(stiffness=2.7e10, exponent=n)
    depth = greatest_depth(2.7e10, n, 5.0, 0.3)
    assert law.impact_time(0.3, 5.0) == pytest.approx(contact_time(depth, n, 0.3), rel=within)


@pytest.mark.parametrize("law", NORMAL_LAWS, ids=kind_of)
def test_impact_without_speed_takes_for_ever(law: NormalLaw) -> None:
    assert law.impact_time(0.0, 5.0) == math.inf


@pytest.mark.parametrize("law", NORMAL_LAWS, ids=kind_of)
@given(speed=st.floats(1e-3, 2.0), mass=masses)
def test_impact_time_is_that_of_the_turning_depth_or_shorter(law: NormalLaw, speed: float, mass: float) -> None:
    time = law.impact_time(speed, mass)
    elastic = 2.94 * law.turning_depth(0.5 * mass * speed**2) / speed
    assert 0.0 < time <= elastic * (1.0 + 1e-15)  # rounding


def test_strong_dashpot_makes_an_impact_shorter() -> None:
    strong, weak = (KelvinVoigt(stiffness=1e6, damping=c) for c in (1e5, 10.0))
    # alone it stops a mass m as exp(-c t/m), three of which are taken: the spring adds 1e-9 of its own
    assert strong.impact_time(0.3, 1.0) == pytest.approx(3.0 * 1.0 / 1e5, rel=1e-9)
    # sqrt(m/K) = 1 ms by hand: rounding
    assert weak.impact_time(0.3, 1.0) == pytest.approx(2.94e-3, rel=1e-13)


@pytest.mark.parametrize(("e", "shorter"), [(0.01, True), (0.7, False)])
def test_dashpot_made_from_a_restitution_may_be_strong_too(e: float, shorter: bool) -> None:
    law = Anagnostopoulos(stiffness=1e6, restitution=e, mass=1.0)
    # rounding
    assert (law.impact_time(0.3, 1.0) < 2.94e-3 * (1.0 - 1e-12)) is shorter
