"""A pin pressed into its bore: Persson, Hertz, Johnson and finite elements; its law, and its materials."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from tests.analytic import sphere_stiffness
from user_forces import (
    STEEL,
    STEEL_35CRMO,
    Exact,
    Flores,
    InputError,
    Johnson,
    JournalBearing,
    LankaraniNikravesh,
    Material,
    PinInBore,
    effective_modulus,
    external_contact_stiffness,
    internal_contact_stiffness,
    line_contact,
)
from user_forces.backing import bar_stiffness, in_series, pin_stiffness
from user_forces.conformal import LINE_CONTACT, relative_depth, relative_load, relative_pressure

STEEL_206 = Material(name="steel", elastic_modulus=2.06e11, poisson_ratio=0.3, density=7850.0)
SAME_STEEL = effective_modulus(STEEL_206, STEEL_206)
PIN = JournalBearing(bore_radius=0.0655, clearance=0.0015)  # 128 mm in 131 mm
LENGTH = 0.7

# half angle [deg] and E1 dR / Q of a boundary solution that is not ours
PERSSON = {10: 82.2205788, 20: 19.5352507, 30: 7.94353968, 40: 3.90503514, 60: 1.06720244}


@pytest.mark.parametrize("degrees", PERSSON)
def test_the_load_of_a_half_angle_is_perssons(degrees: int) -> None:
    load = float(relative_load(np.array(math.radians(degrees))))
    assert 1.0 / load == pytest.approx(PERSSON[degrees], rel=5e-9)  # half of the last printed digit


# force [N], half angle [deg], peak pressure [MPa], Johnson's depth [um], depths by finite elements with rings
# of 100 and 200 mm [um], depth of a sphere in a sphere [um], depth by Eq. 5 [um]
PUBLISHED = [
    (51.4e3, 1.34, 30.8, 1.92, 1.65, 1.89, 34.6, 153.0),
    (445e3, 3.95, 90.0, 12.7, 10.4, 12.5, 146.0, 645.0),
]


@pytest.mark.parametrize("row", PUBLISHED)
def test_depth_angle_and_pressure_of_a_steel_pin(row: tuple[float, ...]) -> None:
    force, angle, pressure, johnson, small_ring, large_ring, inside, outside = row
    found = line_contact(PIN, LENGTH, SAME_STEEL, force)
    assert math.degrees(found.half_angle) == pytest.approx(angle, abs=0.006)  # the last printed digit
    assert found.peak_pressure == pytest.approx(1e6 * pressure, rel=0.01)
    assert found.depth == pytest.approx(1e-6 * johnson, rel=5e-3)
    assert 1e-6 * small_ring < found.depth < 1.03e-6 * large_ring
    assert not found.conformal
    # what is thought of as a pin in a bore elsewhere
    for stiffness, depth in ((internal_contact_stiffness, inside), (external_contact_stiffness, outside)):
        k = stiffness(PIN, STEEL_206, STEEL_206)
        assert (force / k) ** (2.0 / 3.0) == pytest.approx(1e-6 * depth, rel=6e-3)
    assert 3.0e10 < found.stiffness < 4.1e10


@given(force=st.floats(1e2, 1e6), clearance=st.floats(2e-4, 3e-3), length=st.floats(0.05, 2.0))
def test_small_angles_are_hertz_and_johnson(force: float, clearance: float, length: float) -> None:
    bearing = JournalBearing(bore_radius=0.0655, clearance=clearance)
    found = line_contact(bearing, length, SAME_STEEL, force)
    if found.conformal:
        return
    p = force / length
    half_width = math.sqrt(
        4.0 * p * bearing.bore_radius * bearing.journal_radius / (math.pi * SAME_STEEL * clearance)
    )
    assert found.peak_pressure == pytest.approx(2.0 * p / (math.pi * half_width), rel=0.015)
    radius = math.sqrt(bearing.bore_radius * bearing.journal_radius)
    assert found.half_angle == pytest.approx(half_width / radius, rel=0.015)
    law = Johnson(bearing=bearing, length=length, effective_modulus=SAME_STEEL, restitution=1.0)
    assert found.depth == pytest.approx(law.resting_depth(force), rel=5e-3)


@pytest.mark.parametrize(
    "degrees", [5.0, *(pytest.param(at, marks=pytest.mark.slow) for at in (20.0, 45.0)), 70.0]
)
def test_the_pressure_carries_the_load_and_gives_the_depth(degrees: float) -> None:
    """Fourier's sum over both bodies of the pressure as Persson prints it, integrated by a library."""
    angle = math.radians(degrees)
    b = math.tan(0.5 * angle)
    outer = math.sqrt(1.0 + b * b)

    def pressure(phi: float) -> float:
        y = math.tan(0.5 * phi)
        root = math.sqrt(max(b * b - y * y, 0.0))
        logarithm = math.log((outer + root) / (outer - root))
        return 2.0 * root / (math.pi * outer * (1.0 + y * y)) + logarithm / (2.0 * math.pi * b * b * outer**2)

    def integral(weight: Callable[[float], float]) -> float:
        return float(quad(lambda phi: pressure(phi) * weight(phi), 0.0, angle, limit=400)[0])

    assert 2.0 * integral(math.cos) == pytest.approx(1.0, rel=1e-9)
    assert float(relative_pressure(np.array(angle))) == pytest.approx(pressure(0.0), rel=1e-12)
    modes = np.arange(2, 4000)
    phi, step = np.linspace(0.0, angle, 20001, retstep=True)
    values = np.array([pressure(one) for one in phi])
    weights = np.full(phi.size, step)
    weights[0] = weights[-1] = 0.5 * step
    shares = np.array([float((weights * values * np.cos(n * phi)).sum()) for n in modes])
    summed = 8.0 / math.pi * float((shares * modes / (modes**2 - 1.0)).sum()) + 2.0 / math.pi * integral(
        lambda phi: 1.0
    )
    # what depends on where the bodies are held: such that small angles give Johnson's depth
    small = np.array([1e-4])
    held = float(relative_depth(small)[0]) - 2.0 / math.pi * (2.0 * math.log(4.0 / 1e-4) - 1.0)
    assert held == pytest.approx(0.0, abs=1e-7)
    constant = 4.0 / math.pi * (math.log(2.0) - 1.0) + 2.0 / math.pi
    assert float(relative_depth(np.array([angle]))[0]) == pytest.approx(summed + constant, abs=2e-3)


def test_no_force_presses_nothing_and_too_much_is_refused() -> None:
    assert line_contact(PIN, LENGTH, SAME_STEEL, 0.0).depth == 0.0
    assert line_contact(PIN, LENGTH, SAME_STEEL, 1e-12).depth == 0.0
    with pytest.raises(InputError, match="force = 1e"):
        line_contact(PIN, LENGTH, SAME_STEEL, 1e11)


def test_the_rule_is_where_the_loads_of_hertz_and_persson_part_by_2_percent() -> None:
    hertz = math.pi * LINE_CONTACT**2 / 8.0
    assert float(relative_load(np.array(LINE_CONTACT))) / hertz == pytest.approx(1.0, abs=0.02)
    assert float(relative_load(np.array(1.1 * LINE_CONTACT))) / hertz / 1.21 > 1.0199
    near, far = (
        line_contact(
            PIN, LENGTH, SAME_STEEL, 2.0 * SAME_STEEL * PIN.clearance * LENGTH * float(relative_load(a))
        )
        for a in (np.array(0.999 * LINE_CONTACT), np.array(1.001 * LINE_CONTACT))
    )
    assert (near.conformal, far.conformal) == (False, True)


# --- the law of a pin along its length ---


MODULUS = effective_modulus(STEEL, STEEL_35CRMO)


def law(clearance: float = 1.5e-3, backing: float | None = 3e9, **given: object) -> PinInBore:
    fields = {"length": 0.7, "effective_modulus": MODULUS, "restitution": 0.9, **given}
    bearing = JournalBearing(bore_radius=0.0655, clearance=clearance)
    return PinInBore(bearing=bearing, backing_stiffness=backing, **fields)  # type: ignore[arg-type]


@given(
    clearance=st.floats(1e-5, 3e-3),
    backing=st.none() | st.floats(1e8, 1e12),
    angle=st.floats(1e-3, math.radians(59.9)),
    length=st.floats(0.05, 2.0),
)
def test_the_inverted_law_is_the_closed_form(
    clearance: float, backing: float | None, angle: float, length: float
) -> None:
    one = law(clearance, backing, length=length)
    force = 2.0 * MODULUS * clearance * length * float(relative_load(np.array(angle)))
    contact = line_contact(one.bearing, length, MODULUS, force)
    depth = contact.depth + (force / backing if backing else 0.0)
    if depth < 1e-6 * clearance:
        return
    assert one.elastic_force(depth) == pytest.approx(force, rel=1.2e-4)


@given(backing=st.none() | st.floats(1e8, 1e12), clearance=st.floats(1e-5, 3e-3))
def test_the_force_rises_and_joins_at_a_millionth_of_the_clearance(
    backing: float | None, clearance: float
) -> None:
    one = law(clearance, backing)
    depths = np.geomspace(1e-9 * clearance, 0.999 * one.largest_depth, 300)
    forces = np.array([one.elastic_force(depth) for depth in depths])
    assert (np.diff(forces) > 0.0).all()
    edge = 1e-6 * clearance
    for part in (one.elastic_force, one.elastic_energy):
        assert part(edge * (1.0 + 1e-12)) == pytest.approx(part(edge * (1.0 - 1e-12)), rel=1e-9)


def test_its_damping_can_be_that_of_another_law() -> None:
    assert law(damping="Flores").damping_factor == Flores(stiffness=1.0, restitution=0.9).damping_factor
    given = LankaraniNikravesh(stiffness=1.0, restitution=0.9)
    assert law(damping="LankaraniNikravesh").delivered_restitution == given.delivered_restitution
    assert law().damping_factor == Exact(stiffness=1.0, restitution=0.9).damping_factor
    with pytest.raises(InputError, match=r"damping = 'Hertz': allowed: .*Exact.*Flores"):
        law(damping="Hertz")


# --- what pin and link give ---


def test_the_reference_supports_rear_pin_gives_as_an_engineer_reckons() -> None:
    """By hand: pin 4 to 6e9 in bending, 1.5e10 in shear, link 1.2e10; the joint 3 to 5e9 N/m."""
    pin, link = pin_stiffness(0.064, 0.7, STEEL_35CRMO), bar_stiffness(500.0, 1.034, STEEL)
    assert 1.1e10 < link < 1.3e10
    assert 3.0e9 < in_series((pin, link)) < 5.0e9
    assert in_series(()) == math.inf


@pytest.mark.parametrize("slenderness", [0.5, 2.0, 20.0])
def test_a_pin_bends_as_a_clamped_beam(slenderness: float) -> None:
    """The mean deflection of Timoshenko's beam under an even load, from its equations."""
    radius = 0.05
    length = 2.0 * radius * slenderness
    nu, modulus = STEEL.poisson_ratio, STEEL.elastic_modulus
    area, moment = math.pi * radius**2, math.pi * radius**4 / 4.0
    shear = 6.0 * (1.0 + nu) / (7.0 + 6.0 * nu) * modulus / (2.0 * (1.0 + nu)) * area
    q = 1.0 / length

    def deflection(x: float) -> float:
        bending = q * x**2 * (length - x) ** 2 / (24.0 * modulus * moment)
        return bending + q * x * (length - x) / (2.0 * shear)

    mean = quad(deflection, 0.0, length)[0] / length
    assert pin_stiffness(radius, length, STEEL) == pytest.approx(1.0 / mean, rel=1e-12)


# --- stiffness of spheres, and elastic data ---


moduli = st.floats(1e9, 1e12)
ratios = st.floats(0.0, 0.5)
BOTH = (external_contact_stiffness, internal_contact_stiffness)


def material(modulus: float = 2.07e11, ratio: float = 0.3) -> Material:
    return Material(name="test", elastic_modulus=modulus, poisson_ratio=ratio, density=7800.0)


def place_of(bore_mm: float, clearance_mm: float) -> JournalBearing:
    return JournalBearing(bore_radius=bore_mm / 1e3, clearance=clearance_mm / 1e3)


# clearance [mm], K [N/mm^1.5] of external contact from Table 2 of "Dynamic Analysis of Hydraulic Support with
# Single Clearance", and of internal contact by hand, with half of its last printed digit
TABLE = [
    (0.5, 861300.557, 1.391e7, 5e3),
    (1.0, 859629.849, 9.801e6, 5e2),
    (1.5, 857942.947, 7.972e6, 5e2),
    (2.0, 856239.607, 6.877e6, 5e2),
]


@pytest.mark.parametrize(("clearance_mm", "external", "internal", "half"), TABLE)
def test_stiffness_of_the_supports_pins(
    clearance_mm: float, external: float, internal: float, half: float
) -> None:
    place = place_of(65.5, clearance_mm)
    found = [stiffness(place, STEEL, STEEL_35CRMO) / 1000.0**1.5 for stiffness in BOTH]
    assert found[0] == pytest.approx(external, abs=5e-4)  # to every printed digit
    assert found[1] == pytest.approx(internal, abs=half)


def test_internal_stiffness_of_the_slider_crank() -> None:
    # radii 10 and 9.5 mm, E = 207 GPa, nu = 0.3: half of the last printed digit
    found = internal_contact_stiffness(place_of(10.0, 0.5), material(), material())
    assert found == pytest.approx(6.610198e10, abs=5e3)


@given(e1=moduli, nu1=ratios, e2=moduli, nu2=ratios, bore=st.floats(1e-3, 1.0), share=st.floats(1e-3, 0.9))
def test_stiffness_and_modulus_are_those_of_hertzian_spheres(
    e1: float, nu1: float, e2: float, nu2: float, bore: float, share: float
) -> None:
    place = JournalBearing(bore_radius=bore, clearance=share * bore)
    journal, one, two = bore - share * bore, material(e1, nu1), material(e2, nu2)
    for stiffness, curvature in zip(
        BOTH, (1.0 / journal + 1.0 / bore, 1.0 / journal - 1.0 / bore), strict=True
    ):
        got = stiffness(place, one, two)
        # the same in another form: a difference of curvatures loses three digits at a clearance of R/1000
        assert got == pytest.approx(sphere_stiffness(e1, nu1, e2, nu2, 1.0 / curvature), rel=1e-12)
        assert stiffness(place, two, one) == pytest.approx(got, rel=1e-15)
    # springs in series; rounding
    expected = 1.0 / ((1.0 - nu1**2) / e1 + (1.0 - nu2**2) / e2)
    assert effective_modulus(one, two) == pytest.approx(expected, rel=1e-14)


def test_elastic_data_by_hand() -> None:
    # 210/(2 0.91) GPa: half of the last printed digit
    assert effective_modulus(*2 * (material(2.1e11),)) == pytest.approx(1.153846e11, abs=5e4)
    # Eq. 6 of the paper: (1 - 1/4)/(pi E); rounding
    assert material(1e9, 0.5).compliance == pytest.approx(0.75 / (math.pi * 1e9), rel=1e-15)


@pytest.mark.parametrize(
    ("field", "wrong", "allowed"),
    [
        ("poisson_ratio", -0.1, ">= 0 and <= 0.5"),
        ("poisson_ratio", 0.51, ">= 0 and <= 0.5"),
        ("elastic_modulus", 0.0, "> 0"),
    ],
)
def test_impossible_elastic_data_are_refused(field: str, wrong: float, allowed: str) -> None:
    fields = {"name": "test", "elastic_modulus": 2e11, "poisson_ratio": 0.3, "density": 7800.0}
    with pytest.raises(InputError, match=rf"Material\.{field} = {wrong}: .*allowed: {allowed}"):
        Material(**fields | {field: wrong})  # type: ignore[arg-type]
