"""Laws F = F_el (1 + chi rate / w): chi from the restitution, and the restitution from chi."""

from __future__ import annotations

import json
import math
import pickle
import re
from collections.abc import Callable

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from tests import analytic
from tests.cases.law_cases import (
    APPROXIMATIONS,
    CYLINDER_LAWS,
    NORMAL_LAWS,
    POWER_LAWS,
    cylinder_law,
    kind_of,
    law_rebound,
    power_law,
    rebound,
)
from tests.often import often
from user_forces import (
    CarvalhoMartins,
    Exact,
    Flores,
    GharibHurmuzlu,
    Gonthier,
    HerbertMcWhannell,
    Hertz,
    HuGuo,
    HuntCrossley,
    InputError,
    LankaraniNikravesh,
    LeeWang,
    NormalLaw,
    PowerLaw,
    SafaeifarFarshidianfar,
    Value,
    ZhiyingQishao,
    delivered_restitution,
    exact_damping_factor,
)

# chi(e) as published, from the table of contact_laws.md
FORMULAS: dict[type[PowerLaw], Callable[[float], float]] = {
    HuntCrossley: lambda e: 3 * (1 - e) / 2,
    HerbertMcWhannell: lambda e: 6 * (1 - e) / ((2 * e - 1) ** 2 + 3),
    LeeWang: lambda e: 3 * (1 - e) / 4,
    LankaraniNikravesh: lambda e: 3 * (1 - e**2) / 4,
    Gonthier: lambda e: (1 - e**2) / e,
    ZhiyingQishao: lambda e: 3 / 4 * (1 - e**2) * math.exp(2 * (1 - e)),
    Flores: lambda e: 8 * (1 - e) / (5 * e),
    GharibHurmuzlu: lambda e: 1 / e,
    HuGuo: lambda e: 3 * (1 - e) / (2 * e),
    SafaeifarFarshidianfar: lambda e: 5 * (1 - e) / (4 * e),
    CarvalhoMartins: lambda e: 3 * (1 - e) * (11 - e) / (2 * (1 + 9 * e)),
}
# from the same file: restitution asked for, and chi that delivers it
EXACT_FACTORS = {
    0.1: 9.998159,
    0.2: 4.919167,
    0.3: 3.087082,
    0.5: 1.432751,
    0.7: 0.634828,
    0.8: 0.373146,
    0.9: 0.166482,
    0.95: 0.078927,
}
ASKED = (0.1, 0.3, 0.5, 0.7, 0.9)
DELIVERED: dict[type[PowerLaw], tuple[float, ...]] = {
    HuntCrossley: (0.516, 0.581, 0.663, 0.768, 0.909),
    LankaraniNikravesh: (0.665, 0.684, 0.725, 0.796, 0.913),
    Gonthier: (0.101, 0.304, 0.488, 0.670, 0.876),
    Flores: (0.069, 0.256, 0.470, 0.683, 0.894),
    HuGuo: (0.074, 0.271, 0.488, 0.697, 0.900),
    CarvalhoMartins: (0.129, 0.304, 0.500, 0.700, 0.900),
}
# chi has 1/e in it, so nothing parts for e = 0
DIVIDES_BY_E = (Exact, Gonthier, Flores, GharibHurmuzlu, HuGuo, SafaeifarFarshidianfar)

factors = st.floats(-5.0, 3.0).map(lambda power: 10.0**power)


# --- what chi delivers ---


@given(chi=factors)
def test_delivered_restitution_is_the_closed_form(chi: float) -> None:
    # Lambert's function loses half of its digits where its branches meet: its argument is rounded to 1e-16,
    # which is (chi de)^2 there, so the closed form itself is right within some 1e-16/chi^2
    assert delivered_restitution(chi) == pytest.approx(
        analytic.delivered_restitution(chi), abs=1e-12 + 2e-15 / chi**2
    )


@given(chi=st.floats(-7.0, 0.7).map(lambda power: 10.0**power))
def test_delivered_restitution_balances_the_impulse(chi: float) -> None:
    e = delivered_restitution(chi)
    left_over = quad(lambda u: u / (1.0 + chi * u), -e, 1.0, epsabs=1e-13, epsrel=0.0)[0]
    error = left_over * (1.0 - chi * e) / e  # by how much e would have to change
    # the series below chi = 1e-5 leaves out 4/9 chi^2 = 4.4e-11; above it cancellation leaves 1e-16/chi, of
    # which a few are allowed, and the quadrature 1e-13
    allowed = 0.5 * chi**2 if chi < 1e-5 else 1e-15 / chi
    assert error == pytest.approx(0.0, abs=1e-12 + allowed)


@given(chi=st.floats(1.0, 1e4))
def test_delivered_restitution_is_a_root_at_large_damping(chi: float) -> None:
    e = delivered_restitution(chi)
    # the equation solved for 1 - chi e, which the logarithm hides; rounding of numbers up to 1
    assert 1.0 - chi * e == pytest.approx((1.0 + chi) * math.exp(-chi * (1.0 + e)), abs=1e-15)


@settings(max_examples=often(30))
@given(
    chi=st.floats(0.0, 20.0),
    n=st.floats(1.0, 3.0),
    stiffness=st.floats(1e7, 1e11),
    mass=st.floats(0.5, 5e3),
    speed=st.floats(0.02, 2.0),
)
def test_delivered_restitution_is_that_of_an_integrated_impact(
    chi: float, n: float, stiffness: float, mass: float, speed: float
) -> None:
    depth = analytic.greatest_depth(stiffness, n, mass, speed)
    got = rebound(lambda x, rate: stiffness * x**n * (1.0 + chi * rate / speed), mass, speed, depth)
    # the integrator's tolerance of 1e-10 a step, over some hundred steps
    assert got == pytest.approx(delivered_restitution(chi), abs=1e-8)


def test_no_damping_delivers_everything_and_much_damping_nothing() -> None:
    assert delivered_restitution(0.0) == 1.0
    # chi e -> 1: the other term, exp(-chi), is 0 in floats
    assert delivered_restitution(1e6) == pytest.approx(1e-6, rel=1e-12)


@given(chi=st.floats(0.0, 100.0), more=st.floats(1e-3, 1.0))
def test_more_damping_delivers_less(chi: float, more: float) -> None:
    assert delivered_restitution(chi + more) < delivered_restitution(chi)


def test_delivered_restitution_does_not_jump_where_its_series_ends() -> None:
    below, above = delivered_restitution(1e-5 * (1.0 - 1e-9)), delivered_restitution(1e-5 * (1.0 + 1e-9))
    # the series leaves out 4/9 chi^2 = 4.4e-11, above it cancellation leaves some 1e-16/chi = 1e-11
    assert below == pytest.approx(above, abs=1e-10)


# --- chi for a restitution ---


@pytest.mark.parametrize(("e", "chi"), EXACT_FACTORS.items())
def test_exact_factor_is_that_of_the_table(e: float, chi: float) -> None:
    # half of the last printed digit, and a little for rounding there
    assert exact_damping_factor(e) == pytest.approx(chi, abs=5.1e-7)


@given(e=st.floats(1e-6, 1.0))
def test_exact_factor_delivers_what_is_asked_for(e: float) -> None:
    # both ways cancellation near e = 1 costs most: 1e-16/(1 - e) where the series end, at 1e-6 and 1e-5
    assert delivered_restitution(exact_damping_factor(e)) == pytest.approx(e, abs=4e-10)


@pytest.mark.parametrize("e", [0.021, 0.013, 1e-5])
def test_exact_factor_is_one_over_e_for_small_restitution(e: float) -> None:
    # 1/e less 1/e^2 exp(-1/e), which is below 1e-17: rounding
    assert exact_damping_factor(e) == pytest.approx(1.0 / e, rel=1e-14)


@given(e=st.floats(0.03, 1.0 - 1e-5))
def test_exact_factor_lies_between_the_asymptotes(e: float) -> None:
    # rounding, and cancellation near e = 1 as above
    assert 1.5 * (1.0 - e) - 1e-10 < exact_damping_factor(e) < 1.0 / e + 1e-12


@pytest.mark.parametrize("loss", [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7])
def test_exact_factor_near_no_loss(loss: float) -> None:
    # the series of the root is 3/2 d (1 + d + ...), d = 1 - e, with a next factor of about 1, of which twice is
    # allowed; cancellation leaves up to some 1e-16/d, 2e-10 at the end of the series
    assert exact_damping_factor(1.0 - loss) == pytest.approx(
        1.5 * loss * (1.0 + loss), rel=2 * loss**2, abs=4e-10
    )


def test_exact_factor_at_both_ends() -> None:
    assert exact_damping_factor(1.0) == 0.0
    # 1/e less 1/e^2 exp(-1/e), which is 0 in floats: rounding
    assert exact_damping_factor(1e-3) == pytest.approx(1e3, rel=1e-14)


# what is allowed: the slope there over 2e-12, and at 1 - 1e-6 the cancellation of the test above
@pytest.mark.parametrize(("e", "allowed"), [(0.5, 1.2e-11), (1.0 - 1e-6, 4e-10)])
def test_exact_factor_does_not_jump_where_its_method_changes(e: float, allowed: float) -> None:
    below, above = exact_damping_factor(e - 1e-12), exact_damping_factor(e + 1e-12)
    assert below == pytest.approx(above, abs=allowed)


# --- the laws ---


def test_all_eleven_approximations_have_a_formula_here() -> None:
    assert set(FORMULAS) == set(APPROXIMATIONS)
    assert len(FORMULAS) == 11


@pytest.mark.parametrize("kind", APPROXIMATIONS, ids=kind_of)
@given(e=st.floats(1e-3, 1.0))
def test_factor_is_the_published_one(kind: type[PowerLaw], e: float) -> None:
    law = power_law(kind, restitution=e)
    # the same formula in another order: rounding, of 1 - e^2 too, which is 2 (1 - e) near 1
    assert law.damping_factor == pytest.approx(FORMULAS[kind](e), rel=1e-14, abs=1e-15)


@pytest.mark.parametrize("kind", POWER_LAWS, ids=kind_of)
def test_law_is_elastic_force_times_damping_by_hand(kind: type[PowerLaw]) -> None:
    law = power_law(kind, stiffness=4e10, restitution=0.6)
    chi = FORMULAS[kind](0.6) if kind in FORMULAS else exact_damping_factor(0.6)
    # 4e10 (1e-4)^1.5 (1 + chi/4) at a quarter of the initial impact velocity; the impact goes deeper: rounding
    assert law(1e-4, 0.05, 0.2) == pytest.approx(4e4 * (1.0 + chi / 4.0), rel=1e-13)


@pytest.mark.parametrize("kind", DELIVERED, ids=kind_of)
def test_delivered_restitution_is_that_of_the_table(kind: type[PowerLaw]) -> None:
    got = [power_law(kind, restitution=e).delivered_restitution for e in ASKED]
    # half of the last printed digit
    assert got == pytest.approx(DELIVERED[kind], abs=5e-4)


@pytest.mark.parametrize("kind", POWER_LAWS, ids=kind_of)
def test_law_delivers_in_an_impact_what_it_says(kind: type[PowerLaw]) -> None:
    law = power_law(kind, restitution=0.4)
    # the integrator's tolerance of 1e-10 a step, over some hundred steps
    assert law_rebound(law, 700.0, 0.2) == pytest.approx(law.delivered_restitution, abs=1e-8)


@pytest.mark.parametrize("kind", POWER_LAWS, ids=kind_of)
def test_docstring_states_what_is_delivered(kind: type[PowerLaw]) -> None:
    found = re.search(r"Delivers ([\d., ]+)\s+for e = ([\d., ]+)\.\s", kind.__doc__ or "")
    assert found, f"{kind.__name__} does not say what it delivers"
    stated, asked = ([float(number) for number in part.split(",")] for part in found.groups())
    assert tuple(asked) == ASKED
    chi = [FORMULAS[kind](e) if kind in FORMULAS else exact_damping_factor(e) for e in asked]
    # what the closed form gives, printed with three digits
    assert stated == [round(analytic.delivered_restitution(x), 3) for x in chi]


@pytest.mark.parametrize("kind", [*POWER_LAWS, *CYLINDER_LAWS], ids=kind_of)
@pytest.mark.parametrize("restitution", [-0.1, 1.1, math.nan])
def test_impossible_restitution_is_refused(kind: type[NormalLaw], restitution: float) -> None:
    make = cylinder_law if kind in CYLINDER_LAWS else power_law
    with pytest.raises(InputError, match=rf"{kind.__name__}\.restitution = {restitution}"):
        make(kind, restitution=restitution)  # type: ignore[arg-type]


@pytest.mark.parametrize("kind", [*DIVIDES_BY_E, *CYLINDER_LAWS], ids=kind_of)
def test_restitution_of_zero_is_refused_where_no_damping_gives_it(kind: type[NormalLaw]) -> None:
    make = cylinder_law if kind in CYLINDER_LAWS else power_law
    with pytest.raises(InputError, match=rf"{kind.__name__}\.restitution = 0\.0: .*allowed: > 0 and <= 1"):
        make(kind, restitution=0.0)  # type: ignore[arg-type]


@pytest.mark.parametrize("kind", sorted(set(POWER_LAWS) - set(DIVIDES_BY_E), key=kind_of), ids=kind_of)
def test_restitution_of_zero_is_allowed_where_chi_is_finite(kind: type[PowerLaw]) -> None:
    assert power_law(kind, restitution=0.0).damping_factor == pytest.approx(FORMULAS[kind](0.0), rel=1e-15)


# --- all normal laws as values ---


@pytest.mark.parametrize("law", NORMAL_LAWS, ids=kind_of)
def test_law_survives_pickle(law: NormalLaw) -> None:
    law(1e-5, 0.1, 0.2)  # it may have computed something to keep
    copy = pickle.loads(pickle.dumps(law))
    assert copy == law
    assert copy(1e-5, 0.1, 0.2) == law(1e-5, 0.1, 0.2)


@pytest.mark.parametrize("law", NORMAL_LAWS, ids=kind_of)
def test_law_survives_plain_data(law: NormalLaw) -> None:
    copy = Value.from_data(json.loads(json.dumps(law.to_data())))
    assert copy == law
    assert type(copy) is type(law)


# --- Hertz ---


def test_hertz_by_hand() -> None:
    law = Hertz(stiffness=4e10)
    # 4e10 (1e-4)^1.5 N, and 2/5 of it times the depth: rounding
    assert law(1e-4, 0.3, 0.2) == pytest.approx(4e4, rel=1e-13)
    assert law.elastic_energy(1e-4) == pytest.approx(0.4 * 4e4 * 1e-4, rel=1e-13)


@given(depth=st.floats(1e-9, 1e-2), rate=st.floats(-2.0, 2.0), speed=st.floats(0.0, 2.0))
def test_hertz_is_elastic(depth: float, rate: float, speed: float) -> None:
    law = Hertz(stiffness=2.7e10)
    assert law(depth, rate, speed) == law.elastic_force(depth)


@pytest.mark.parametrize("n", [1.0, 1.5, 3.0])
def test_hertz_gives_all_speed_back(n: float) -> None:
    # the integrator's tolerance of 1e-10 a step, over some hundred steps
    assert law_rebound(Hertz(stiffness=1e9, exponent=n), 5.0, 0.3) == pytest.approx(1.0, abs=1e-8)
