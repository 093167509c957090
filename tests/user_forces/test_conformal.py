"""A pin pressed into its bore, against the forms of Persson, Hertz and Johnson, and finite elements."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from user_forces import (
    InputError,
    Johnson,
    JournalBearing,
    Material,
    effective_modulus,
    external_contact_stiffness,
    internal_contact_stiffness,
    line_contact,
)
from user_forces.conformal import LINE_CONTACT, relative_depth, relative_load, relative_pressure

STEEL_206 = Material(name="steel", elastic_modulus=2.06e11, poisson_ratio=0.3, density=7850.0)
MODULUS = effective_modulus(STEEL_206, STEEL_206)
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
    found = line_contact(PIN, LENGTH, MODULUS, force)
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
    found = line_contact(bearing, length, MODULUS, force)
    if found.conformal:
        return
    p = force / length
    half_width = math.sqrt(
        4.0 * p * bearing.bore_radius * bearing.journal_radius / (math.pi * MODULUS * clearance)
    )
    assert found.peak_pressure == pytest.approx(2.0 * p / (math.pi * half_width), rel=0.015)
    radius = math.sqrt(bearing.bore_radius * bearing.journal_radius)
    assert found.half_angle == pytest.approx(half_width / radius, rel=0.015)
    law = Johnson(bearing=bearing, length=length, effective_modulus=MODULUS, restitution=1.0)
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
    assert line_contact(PIN, LENGTH, MODULUS, 0.0).depth == 0.0
    assert line_contact(PIN, LENGTH, MODULUS, 1e-12).depth == 0.0
    with pytest.raises(InputError, match="force = 1e"):
        line_contact(PIN, LENGTH, MODULUS, 1e11)


def test_the_rule_is_where_the_loads_of_hertz_and_persson_part_by_2_percent() -> None:
    hertz = math.pi * LINE_CONTACT**2 / 8.0
    assert float(relative_load(np.array(LINE_CONTACT))) / hertz == pytest.approx(1.0, abs=0.02)
    assert float(relative_load(np.array(1.1 * LINE_CONTACT))) / hertz / 1.21 > 1.0199
    near, far = (
        line_contact(PIN, LENGTH, MODULUS, 2.0 * MODULUS * PIN.clearance * LENGTH * float(relative_load(a)))
        for a in (np.array(0.999 * LINE_CONTACT), np.array(1.001 * LINE_CONTACT))
    )
    assert (near.conformal, far.conformal) == (False, True)
