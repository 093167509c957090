"""Line contact of cylinders, against the formulas as published; the work done by every normal law."""

from __future__ import annotations

import math
import re
from collections.abc import Callable

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.special import lambertw

from tests.cases.law_cases import (
    BEARING,
    CYLINDER_LAWS,
    LENGTH,
    LOGARITHMIC_LAWS,
    MODULUS,
    NORMAL_LAWS,
    cylinder_law,
    kind_of,
    law_rebound,
)
from tests.often import often
from user_forces import (
    CylinderLaw,
    DubowskyFreudenstein,
    Esdu78035,
    Goldsmith,
    InputError,
    Johnson,
    JournalBearing,
    Liu,
    LoadError,
    NormalLaw,
    Pereira,
    Radzimovsky,
)

R1, R2, DR = BEARING.journal_radius, BEARING.bore_radius, BEARING.clearance
H = 1.0 / (math.pi * MODULUS)  # h1 + h2, h = (1 - nu^2)/(pi E) [m^2/N]

# --- depth under a load per length, as published ---


def johnson(p: float) -> float:
    """Johnson, Contact Mechanics, section 5.6."""
    return p / (math.pi * MODULUS) * (math.log(4.0 * math.pi * MODULUS * DR / p) - 1.0)


def radzimovsky(p: float, width: float = 1.6) -> float:
    """As Pereira, Ramalho and Ambrosio print it."""
    b = width * math.sqrt(p * R1 * R2 / (MODULUS * DR))
    return p / (math.pi * MODULUS) * (2.0 / 3.0 + math.log(4.0 * R1 / b) + math.log(4.0 * R2 / b))


def goldsmith(p: float, unit: float) -> float:
    """Printed with L^m, m = 1; the unit of length [m] makes the argument of the logarithm a number."""
    force = p * LENGTH
    return force * H / LENGTH * (math.log(unit**2 * LENGTH * DR / (force * R1 * R2 * H)) + 1.0)


def dubowsky_freudenstein(p: float, length: float = LENGTH) -> float:
    """Printed with L^m, m = 3."""
    force = p * length
    return force * H / length * (math.log(length**3 * DR / (force * R1 * R2 * H)) + 1.0)


def esdu(p: float) -> float:
    """ESDU 78035."""
    return p * H * (math.log(4.0 * DR / (p * H)) + 1.0)


IMPLICIT: dict[type[CylinderLaw], Callable[[float], float]] = {
    Johnson: johnson,
    Radzimovsky: radzimovsky,
    Goldsmith: lambda p: goldsmith(p, 2.0 * math.sqrt(R1 * R2)),
    DubowskyFreudenstein: dubowsky_freudenstein,
    Esdu78035: esdu,
}
# A [N/m] and c of the common form depth = p H (ln(A/p) + c), from the table in notes.md
COMMON: dict[type[CylinderLaw], tuple[float, float]] = {
    Johnson: (4.0 * math.pi * MODULUS * DR, -1.0),
    Radzimovsky: (6.25 * MODULUS * DR, 2.0 / 3.0),
    Goldsmith: (4.0 * math.pi * MODULUS * DR, 1.0),
    DubowskyFreudenstein: (math.pi * MODULUS * DR * LENGTH**2 / (R1 * R2), 1.0),
    Esdu78035: (4.0 * math.pi * MODULUS * DR, 1.0),
}


def liu(depth: float) -> float:
    """Force [N]; Liu, Zhang and Yang."""
    return 0.5 * math.pi * depth * MODULUS * LENGTH * math.sqrt(depth / (2.0 * (DR + depth)))


def pereira(depth: float) -> float:
    """Force [N]; Pereira, Ramalho and Ambrosio, in mm and N/mm^2."""
    gap, deep, length, modulus = 1e3 * DR, 1e3 * depth, 1e3 * LENGTH, 1e-6 * MODULUS
    n = (0.0151 * gap + 1.151) * gap**-0.005
    return (0.965 * gap + 0.0965) * length * modulus / gap * deep**n


EXPLICIT: dict[type[CylinderLaw], Callable[[float], float]] = {Liu: liu, Pereira: pereira}

# Depth [um] at p = 1e2, 1e3, 1e4, 1e5, 1e6 N/m, from the table in notes.md
LOADS = (1e2, 1e3, 1e4, 1e5, 1e6)
MILLIMETRE, METRE = 1e-3, 1.0
DEPTHS: dict[str, tuple[CylinderLaw, str]] = {
    "Johnson": (cylinder_law(Johnson), ".0043850 .037497 .31145 2.4793 18.441"),
    "Radzimovsky": (cylinder_law(Radzimovsky), ".0046521 .040169 .33816 2.7464 21.112"),
    "Radzimovsky, half width": (
        cylinder_law(Radzimovsky, width_factor=2.0 / math.sqrt(math.pi)),
        ".0048447 .042095 .35743 2.9391 23.039",
    ),
    "Roark": (
        cylinder_law(Radzimovsky, width_factor=4.0 / math.sqrt(math.pi)),
        ".0044623 .038271 .31919 2.5567 19.215",
    ),
    "ESDU": (cylinder_law(Esdu78035), ".0049367 .043015 .36663 3.0311 23.959"),
    "Goldsmith": (cylinder_law(Goldsmith), ".0049367 .043015 .36663 3.0311 23.959"),
    "Dubowsky, mean diameter": (
        cylinder_law(DubowskyFreudenstein, length=2.0 * math.sqrt(R1 * R2)),
        ".0049367 .043015 .36663 3.0311 23.959",
    ),
    "Dubowsky, 50 mm": (
        cylinder_law(DubowskyFreudenstein, length=0.05),
        ".0044117 .037765 .31412 2.5060 18.708",
    ),
    "Dubowsky, 1 m": (cylinder_law(DubowskyFreudenstein, length=1.0), ".0060645 .054293 .47941 4.1589 35.237"),
    "Goldsmith in m": (
        cylinder_law(Goldsmith, reference_length=METRE),
        ".0060645 .054293 .47941 4.1589 35.237",
    ),
    # at 1e6 N/m the formula gives a negative depth: no load is that large, see below
    "Goldsmith in mm": (
        cylinder_law(Goldsmith, reference_length=MILLIMETRE),
        ".0022533 .016180 .098284 .34763",
    ),
    # the table has .0065102, where its search for the root stopped early
    "Pereira": (cylinder_law(Pereira), ".0065101 .046490 .33200 2.3709 16.931"),
    "Liu": (cylinder_law(Liu), ".097022 .45037 2.0912 9.7229 45.483"),
}

powers = st.floats(-12.0, -0.1).map(lambda power: 10.0**power)  # shares of a range
cylinder_laws = pytest.mark.parametrize("law", [cylinder_law(kind) for kind in CYLINDER_LAWS], ids=kind_of)
logarithmic = pytest.mark.parametrize("kind", LOGARITHMIC_LAWS, ids=kind_of)


def saying(*parts: str) -> str:
    """A pattern for a message that has these parts one after the other."""
    return ".*".join(re.escape(part) for part in parts)


def force_limit(kind: type[CylinderLaw]) -> float:
    """Load per length [N/m] at which a logarithmic law ends, A exp(c - 1)."""
    scale, offset = COMMON[kind]
    return scale * math.exp(offset - 1.0)


# --- formulas ---


@logarithmic
@given(share=powers)
def test_load_at_the_published_depth_is_that_load(kind: type[CylinderLaw], share: float) -> None:
    p = share * force_limit(kind)
    # at 0.8 of the largest load the force is 5 times as sensitive as the depth, which is rounded, and y is
    # found within 1e-13
    assert cylinder_law(kind).elastic_force(IMPLICIT[kind](p)) == pytest.approx(p * LENGTH, rel=1e-12)


@logarithmic
@given(share=powers)
def test_published_depth_is_kept_as_a_function(kind: type[CylinderLaw], share: float) -> None:
    p = share * force_limit(kind)
    # the same in another order: rounding of a logarithm up to 30
    assert cylinder_law(kind).depth_of(p * LENGTH) == pytest.approx(IMPLICIT[kind](p), rel=1e-13)  # type: ignore[attr-defined]


@logarithmic
@given(share=st.floats(-250.0, -0.05).map(lambda power: 10.0**power))
def test_load_at_a_depth_is_the_branch_of_lambert(kind: type[CylinderLaw], share: float) -> None:
    scale, offset = COMMON[kind]
    depth = share * H * scale * math.exp(offset - 1.0)
    y = -float(lambertw(-share / math.e, -1).real)
    # as above; at 0.9 of the largest depth the argument, rounded, is as far from its branching as 0.1
    assert cylinder_law(kind).elastic_force(depth) == pytest.approx(LENGTH * depth / (H * y), rel=1e-12)


@logarithmic
@given(share=powers)
def test_load_at_a_depth_is_the_root_of_the_published_formula(kind: type[CylinderLaw], share: float) -> None:
    limit = force_limit(kind)
    depth = share * IMPLICIT[kind](limit)
    root = brentq(lambda p: IMPLICIT[kind](p) / depth - 1.0, 1e-20 * limit, limit, xtol=1e-300, rtol=1e-14)
    assert cylinder_law(kind).elastic_force(depth) == pytest.approx(root * LENGTH, rel=1e-11)  # of the search


@pytest.mark.parametrize("kind", EXPLICIT, ids=kind_of)
@given(share=powers)
def test_explicit_law_is_the_published_formula(kind: type[CylinderLaw], share: float) -> None:
    depth = share * cylinder_law(kind).largest_depth
    # the same in another order: rounding, in Pereira's law of a power of numbers down to 1e-12
    assert cylinder_law(kind).elastic_force(depth) == pytest.approx(EXPLICIT[kind](depth), rel=1e-13)


@pytest.mark.parametrize("name", DEPTHS)
def test_depth_is_that_of_the_table(name: str) -> None:
    law, printed = DEPTHS[name]
    for p, text in zip(LOADS, printed.split(), strict=False):  # Goldsmith's in mm ends early
        half_a_digit = 0.5 * 10.0 ** -len(text.split(".")[1])
        assert 1e6 * law.resting_depth(p * law.length) == pytest.approx(float(text), abs=1.001 * half_a_digit)


def test_width_factor_of_radzimovsky() -> None:
    law = cylinder_law(Radzimovsky, width_factor=2.0)
    # the published formula the other way round: rounding
    assert law.elastic_force(radzimovsky(1e5, width=2.0)) == pytest.approx(1e5 * LENGTH, rel=1e-12)
    with pytest.raises(InputError, match=r"Radzimovsky\.width_factor = 0\.9: .*allowed: >= 1 and <= 2\.5"):
        cylinder_law(Radzimovsky, width_factor=0.9)


@given(depth=st.floats(1e-9, 1e-3))
def test_goldsmith_agrees_with_esdu_unless_told_a_unit(depth: float) -> None:
    # the same numbers in another order: rounding
    assert cylinder_law(Goldsmith).elastic_force(depth) == pytest.approx(
        cylinder_law(Esdu78035).elastic_force(depth), rel=1e-12
    )


@given(depth=st.floats(1e-9, 1e-3), length=st.floats(0.08, 1.0))
def test_goldsmith_agrees_with_dubowsky_if_the_unit_is_the_length(depth: float, length: float) -> None:
    one = cylinder_law(Goldsmith, length=length, reference_length=length)
    other = cylinder_law(DubowskyFreudenstein, length=length)
    # the same numbers in another order: rounding
    assert one.elastic_force(depth) == pytest.approx(other.elastic_force(depth), rel=1e-12)


# but for Dubowsky and Freudenstein's, whose logarithm has the length in it
@pytest.mark.parametrize("kind", [k for k in CYLINDER_LAWS if k is not DubowskyFreudenstein], ids=kind_of)
@given(share=powers, times=st.floats(0.1, 10.0))
def test_force_is_proportional_to_the_length(kind: type[CylinderLaw], share: float, times: float) -> None:
    law, longer = cylinder_law(kind), cylinder_law(kind, length=times * LENGTH)
    depth = share * law.largest_depth
    # rounding
    assert longer.elastic_force(depth) == pytest.approx(times * law.elastic_force(depth), rel=1e-13)


# --- range ---


# e is Euler's number; from the table in notes.md
@pytest.mark.parametrize(
    ("kind", "limit"),
    [
        (Johnson, 4.0 * DR / math.e**2),
        (Radzimovsky, 1.4255 * DR),
        (Goldsmith, 4.0 * DR),
        (DubowskyFreudenstein, DR * LENGTH**2 / (R1 * R2)),
        (Esdu78035, 4.0 * DR),
        (Liu, R1),
        (Pereira, 4.0 * DR / math.e**2),
    ],
    ids=kind_of,
)
def test_largest_depth(kind: type[CylinderLaw], limit: float) -> None:
    # half of the last printed digit of 1.4255
    assert cylinder_law(kind).largest_depth == pytest.approx(limit, rel=4e-5 if kind is Radzimovsky else 1e-14)


@cylinder_laws
def test_deeper_than_the_range_is_refused(law: CylinderLaw) -> None:
    depth = 1.01 * law.largest_depth
    said = saying(f"{kind_of(law)}: depth = {depth:.6g} m ", f"allowed: up to {law.largest_depth:.6g} m")
    for ask in (law.elastic_force, law.elastic_energy, lambda x: law(x, 0.1, 0.2)):
        with pytest.raises(LoadError, match=said):
            ask(depth)


@cylinder_laws
def test_largest_depth_itself_is_allowed(law: CylinderLaw) -> None:
    assert law.elastic_force(law.largest_depth) > 0.0
    assert law.elastic_energy(law.largest_depth) > 0.0


@cylinder_laws
@given(one=st.floats(1e-12, 1.0), other=st.floats(1e-12, 1.0))
def test_force_rises_with_depth_over_the_whole_range(law: CylinderLaw, one: float, other: float) -> None:
    low, high = sorted((one, other))
    limit = law.largest_depth
    rise = law.elastic_force(high * limit) - law.elastic_force(low * limit)
    # close to the largest depth, where the force has an infinite slope, y is found within 1e-7 only
    assert rise > 0.0 if high - low > 1e-9 else rise > -1e-6 * law.elastic_force(high * limit)


@pytest.mark.parametrize("law", NORMAL_LAWS, ids=kind_of)
@given(share=powers)
def test_resting_depth_inverts_the_elastic_force(law: NormalLaw, share: float) -> None:
    depth = share * min(law.largest_depth, 1e-2)
    # the search is exact to rounding; at 0.8 of the range the depth is less sensitive than the force
    assert law.resting_depth(law.elastic_force(depth)) == pytest.approx(depth, rel=1e-12)


@pytest.mark.parametrize("law", NORMAL_LAWS, ids=kind_of)
@given(share=powers)
def test_turning_depth_inverts_the_elastic_energy(law: NormalLaw, share: float) -> None:
    depth = share * min(law.largest_depth, 1e-2)
    # as above; Liu's energy is right within 1e-11 where its series ends
    assert law.turning_depth(law.elastic_energy(depth)) == pytest.approx(depth, rel=1e-11)


@pytest.mark.parametrize("law", NORMAL_LAWS, ids=kind_of)
def test_nothing_rests_and_turns_at_no_depth(law: NormalLaw) -> None:
    assert law.resting_depth(0.0) == 0.0
    assert law.turning_depth(0.0) == 0.0


@cylinder_laws
def test_load_beyond_the_range_cannot_rest(law: CylinderLaw) -> None:
    largest = law.elastic_force(law.largest_depth)
    said = saying(f"{kind_of(law)}: force = {1.01 * largest:.6g} N ", f"allowed: up to {largest:.6g} N")
    with pytest.raises(LoadError, match=said):
        law.resting_depth(1.01 * largest)


@cylinder_laws
def test_largest_load_itself_can_rest(law: CylinderLaw) -> None:
    assert law.resting_depth(law.elastic_force(law.largest_depth)) == law.largest_depth


@cylinder_laws
def test_energy_beyond_the_range_turns_at_its_end(law: CylinderLaw) -> None:
    assert law.turning_depth(2.0 * law.elastic_energy(law.largest_depth)) == law.largest_depth


@pytest.mark.parametrize("wrong", [-1.0, math.nan])
def test_impossible_force_is_refused(wrong: float) -> None:
    for law in NORMAL_LAWS:
        with pytest.raises(InputError, match=saying(f"{kind_of(law)}: ", f"{wrong}", "allowed: >= 0")):
            law.resting_depth(wrong)


@pytest.mark.parametrize("wrong", [-1.0, math.nan])
def test_impossible_energy_is_refused(wrong: float) -> None:
    for law in NORMAL_LAWS:
        with pytest.raises(InputError, match=saying(f"{kind_of(law)}: ", f"{wrong}", "allowed: >= 0")):
            law.turning_depth(wrong)


def test_goldsmith_in_millimetres_has_no_solution_for_a_heavy_load() -> None:
    law = cylinder_law(Goldsmith, reference_length=MILLIMETRE)
    assert goldsmith(1e6, MILLIMETRE) == pytest.approx(-2.8758e-6, abs=5e-11)  # half of the last printed digit
    with pytest.raises(LoadError, match="Goldsmith: force = 100000 N"):
        law.resting_depth(1e6 * LENGTH)


# --- energy ---


@pytest.mark.parametrize("law", NORMAL_LAWS, ids=kind_of)
@given(share=powers)
def test_elastic_energy_is_the_work_of_the_elastic_force(law: NormalLaw, share: float) -> None:
    depth = share * min(law.largest_depth, 1e-2)
    # over the square root of the depth, so that the quadrature meets no infinite slope
    work = quad(lambda s: law.elastic_force(s * s * depth) * 2.0 * s * depth, 0.0, 1.0, epsabs=0, epsrel=1e-11)[
        0
    ]
    # the quadrature's tolerance and what Liu's series leaves out
    assert law.elastic_energy(depth) == pytest.approx(work, rel=3e-11)


@cylinder_laws
def test_elastic_energy_of_the_whole_range(law: CylinderLaw) -> None:
    limit = law.largest_depth
    # over the square root of what is missing, since the slope is infinite at the end
    work = quad(
        lambda s: law.elastic_force((1.0 - s * s) * limit) * 2.0 * s * limit,
        0.0,
        1.0,
        epsabs=0,
        epsrel=1e-10,
    )[0]
    # near the end y is found within 1e-7, in a 1e-7 part of the range
    assert law.elastic_energy(limit) == pytest.approx(work, rel=1e-9)


@pytest.mark.parametrize("x", [0.0199, 0.02, 0.0201])
def test_energy_of_liu_where_its_series_ends(x: float) -> None:
    law = cylinder_law(Liu)
    below, above = (law.elastic_energy(x * DR * (1.0 + change)) for change in (-1e-9, 1e-9))
    # the slope of the energy is the force
    rise = law.elastic_force(x * DR) * 2e-9 * x * DR
    # both forms are right within 1e-11 there
    assert above - below == pytest.approx(rise, abs=1e-11 * above)


def test_energy_of_liu_at_a_tiny_depth_is_that_of_its_power() -> None:
    law, depth = cylinder_law(Liu), 1e-15
    power = 0.5 * math.pi * MODULUS * LENGTH * math.sqrt(0.5 / DR)
    # K depth^2.5 / 2.5; the next term is depth/dR smaller
    assert law.elastic_energy(depth) == pytest.approx(power * depth**2.5 / 2.5, rel=1e-11)


# --- Pereira ---


def test_exponent_of_pereira() -> None:
    # from notes.md: half of the last printed digit
    assert cylinder_law(Pereira).exponent == pytest.approx(1.17127, abs=5e-6)  # type: ignore[attr-defined]


def gap(millimetres: float) -> Pereira:
    bearing = JournalBearing(bore_radius=0.0655, clearance=1e-3 * millimetres)
    return cylinder_law(Pereira, bearing=bearing)  # type: ignore[return-value]


@given(mm=st.floats(0.005, 0.3495))
def test_exponent_of_pereira_at_small_clearances(mm: float) -> None:
    y = 1.51 * math.log(1000.0 * mm) ** -0.151
    # the same formula: rounding, of the clearance in m too
    assert gap(mm).exponent == pytest.approx(y * mm**-0.005, rel=1e-14)


def test_both_branches_of_pereira_meet() -> None:
    below, above = gap(0.34954 * (1.0 - 1e-12)).exponent, gap(0.34954 * (1.0 + 1e-12)).exponent
    # 1.156278008 and 1.156278054 in notes.md, times 0.34954^-0.005 = 1.005
    assert above - below == pytest.approx(1.005 * 4.6e-8, abs=1e-9)


@pytest.mark.parametrize("mm", [0.005, 10.0])
def test_clearance_at_the_ends_of_pereiras_range_is_allowed(mm: float) -> None:
    assert gap(mm).elastic_force(1e-7) > 0.0


@pytest.mark.parametrize("mm", [0.00499, 10.01])
def test_clearance_outside_pereiras_range_is_refused(mm: float) -> None:
    with pytest.raises(InputError, match=r"Pereira: bearing\.clearance = .* m: allowed .*5e-06 to 0\.01 m"):
        gap(mm)


@pytest.mark.parametrize("mm", [0.35, 0.5, 1.0, 1.5, 2.0])
@pytest.mark.parametrize("share", [1e-3, 3e-3, 1e-2, 3e-2, 1e-1])
def test_pereira_fits_johnson_as_its_docstring_says(mm: float, share: float) -> None:
    law = gap(mm)
    model = cylinder_law(Johnson, bearing=law.bearing)
    depth = share * law.bearing.clearance
    assert law.elastic_force(depth) == pytest.approx(model.elastic_force(depth), rel=0.12)  # as it says


def test_pereira_delivers_what_lankarani_and_nikravesh_do() -> None:
    law = cylinder_law(Pereira, restitution=0.9)
    # 3/4 (1 - 0.81) by hand: rounding; and half of the last digit of the docstring
    assert law.damping_factor == pytest.approx(0.1425, rel=1e-14)
    assert law.delivered_restitution == pytest.approx(0.913, abs=5e-4)


# --- impact ---


@pytest.mark.parametrize("kind", [Johnson, Liu], ids=kind_of)
@settings(max_examples=often(15))
@given(e=st.floats(0.05, 1.0), mass=st.floats(1.0, 1e4), speed=st.floats(0.01, 1.0))
def test_free_impact_delivers_what_was_asked_for(
    kind: type[CylinderLaw], e: float, mass: float, speed: float
) -> None:
    law = cylinder_law(kind, restitution=e)
    # the integrator's tolerance of 1e-10 a step, over some hundred steps
    assert law_rebound(law, mass, speed) == pytest.approx(e, abs=1e-7)


@pytest.mark.parametrize("kind", [k for k in CYLINDER_LAWS if k is not Pereira], ids=kind_of)
def test_factor_is_the_exact_one(kind: type[CylinderLaw]) -> None:
    # from contact_laws.md: half of the last printed digit
    assert cylinder_law(kind, restitution=0.5).damping_factor == pytest.approx(1.432751, abs=5e-7)


def test_liu_is_soft_at_light_loads_as_its_docstring_says() -> None:
    share = cylinder_law(Liu).elastic_force(0.01 * DR) / cylinder_law(Johnson).elastic_force(0.01 * DR)
    assert share == pytest.approx(0.24, abs=5e-3)  # half of the last printed digit
