from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.ranges import from_zero
from user_forces import Ambrosio, Frictionless, InputError

LAW = Ambrosio(sliding_coefficient=0.25, static_speed=1e-4, dynamic_speed=1e-2)
slips = st.floats(-1.0, 1.0)
forces = st.floats(0.0, 1e6)
coefficients = from_zero(2.0)


@pytest.mark.parametrize("slip", [0.0, 5e-5, -5e-5, 1e-4, -1e-4])
def test_no_force_up_to_the_static_speed(slip: float) -> None:
    assert LAW(slip, 1000.0) == 0.0


@pytest.mark.parametrize("slip", [1e-2, 0.02, 3.0])
def test_full_coulomb_force_from_the_dynamic_speed_on(slip: float) -> None:
    assert LAW(slip, 1000.0) == -250.0


def test_half_the_force_in_the_middle_of_the_ramp() -> None:
    middle = (1e-4 + 1e-2) / 2.0
    # rounding of the ramp's ends
    assert LAW(middle, 1000.0) == pytest.approx(-125.0, rel=1e-13)


@given(slip=slips, force=forces, coefficient=coefficients, static=from_zero(0.1), width=st.floats(1e-3, 0.1))
def test_all_three_branches_are_one_clipped_ramp(
    slip: float, force: float, coefficient: float, static: float, width: float
) -> None:
    law = Ambrosio(sliding_coefficient=coefficient, static_speed=static, dynamic_speed=static + width)
    ramp = np.interp(abs(slip), [static, static + width], [0.0, 1.0])
    expected = -np.sign(slip) * coefficient * ramp * force
    # rounding of the speeds, magnified by speed over width of the ramp, at most 1e3
    assert law(slip, force) == pytest.approx(expected, abs=1e-12 * coefficient * force + 1e-300)


@given(slip=slips, force=forces, coefficient=coefficients)
def test_friction_never_gives_energy(slip: float, force: float, coefficient: float) -> None:
    assert Ambrosio(sliding_coefficient=coefficient)(slip, force) * slip <= 0.0


@given(slip=slips, force=forces)
def test_force_turns_round_with_the_slip(slip: float, force: float) -> None:
    assert LAW(-slip, force) == -LAW(slip, force)


@given(slip=st.floats(2e-4, 1.0), force=st.floats(1.0, 1e6))
def test_force_is_proportional_to_the_normal_force(slip: float, force: float) -> None:
    # a power of two: exact
    assert LAW(slip, 2.0 * force) == 2.0 * LAW(slip, force)


def test_force_is_proportional_to_the_sliding_coefficient() -> None:
    assert Ambrosio(sliding_coefficient=0.5)(0.003, 1000.0) == 2.0 * Ambrosio(sliding_coefficient=0.25)(
        0.003, 1000.0
    )


@pytest.mark.parametrize("speed", [1e-4, 1e-2])
def test_force_does_not_jump_at_the_ends_of_the_ramp(speed: float) -> None:
    below, above = LAW(speed * (1.0 - 1e-9), 1000.0), LAW(speed * (1.0 + 1e-9), 1000.0)
    # the ramp's slope, 250 N per 10 mm/s, over 2e-11 m/s
    assert above == pytest.approx(below, abs=1e-6)


def test_ramp_damps_like_the_dashpot_it_says() -> None:
    slope = (LAW(0.006, 1000.0) - LAW(0.005, 1000.0)) / 0.001
    # mu_d F_n / (v_d - v_s); rounding of the difference
    assert -slope == pytest.approx(0.25 * 1000.0 / (1e-2 - 1e-4), rel=1e-12)


def test_without_a_coefficient_there_is_no_force() -> None:
    assert Ambrosio(sliding_coefficient=0.0)(0.5, 1000.0) == 0.0


@given(slip=slips, force=forces)
def test_frictionless_is_without_force(slip: float, force: float) -> None:
    assert Frictionless()(slip, force) == 0.0


@pytest.mark.parametrize("dynamic_speed", [1e-4, 5e-5])
def test_ramp_without_width_is_refused(dynamic_speed: float) -> None:
    with pytest.raises(
        InputError, match=rf"dynamic_speed = {dynamic_speed} m/s: allowed: > static_speed = 0\.0001"
    ):
        Ambrosio(sliding_coefficient=0.1, static_speed=1e-4, dynamic_speed=dynamic_speed)


def test_negative_coefficient_is_refused() -> None:
    with pytest.raises(InputError, match=r"Ambrosio\.sliding_coefficient = -0\.1: .*allowed: >= 0"):
        Ambrosio(sliding_coefficient=-0.1)
