"""The law of a pin along its length: its closed form, its energy, what it delivers, its backing."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from user_forces import (
    STEEL,
    STEEL_35CRMO,
    Exact,
    Flores,
    InputError,
    JournalBearing,
    LankaraniNikravesh,
    PinInBore,
    effective_modulus,
    line_contact,
)
from user_forces.backing import bar_stiffness, in_series, pin_stiffness
from user_forces.conformal import relative_load

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
