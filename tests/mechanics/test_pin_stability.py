"""Small motions of a loaded journal that slides, against closed forms."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from support_exudyn.mechanics.pin_stability import (
    LoadedJournal,
    NoEquilibriumError,
    critical_friction,
    painleve_friction,
    sliding_pin,
)
from user_forces import (
    Ambrosio,
    Frictionless,
    Hertz,
    JournalBearing,
    JournalContact,
    KelvinVoigt,
    PinInBore,
)

BEARING = JournalBearing(bore_radius=0.0655, clearance=1.5e-3)
LOAD = 5e4  # [N]
STIFFNESS = 8e8  # [N/m^1.5]
SPRING = Hertz(stiffness=STIFFNESS)
NO_TURN = np.zeros(2)


def journal(inverse_mass: np.ndarray, load: np.ndarray, spin: float = -1.0) -> LoadedJournal:
    """One whose bodies do not turn as it moves in its bore; they turn by `spin` against each other."""
    return LoadedJournal(inverse_mass, load, NO_TURN, NO_TURN, spin, 0.0)


def contact(mu: float, normal: object = SPRING) -> JournalContact:
    friction = Ambrosio(sliding_coefficient=mu) if mu else Frictionless()
    return JournalContact(bearing=BEARING, normal=normal, friction=friction)  # type: ignore[arg-type]


def tangent(force: float) -> tuple[float, float]:
    """Depth and stiffness of the contact under a force, K depth^1.5."""
    depth = (force / STIFFNESS) ** (2.0 / 3.0)
    return depth, 1.5 * STIFFNESS * depth**0.5


def coupled(inverse_mass: np.ndarray, mu: float) -> tuple[np.ndarray, np.ndarray]:
    """Squares of the angular frequencies of a journal with its load along -y, and where it lies, by hand.

    With n outwards, t across and friction mu N along t: normal force and friction balance the load at the angle
    atan(mu), and dQ = -k (n - mu t) dn - N/e (t + mu n) dt.
    """
    force = LOAD / math.hypot(1.0, mu)
    depth, k = tangent(force)
    place = BEARING.clearance + depth
    up = np.array([0.0, 1.0])
    n = -(up + mu * np.array([-1.0, 0.0])) / math.hypot(1.0, mu)  # so that -N n + mu N t = LOAD up
    t = np.array([-n[1], n[0]])
    assert np.allclose(-force * n + mu * force * t, LOAD * up)
    held = k * np.outer(n - mu * t, n) + force / place * np.outer(t + mu * n, t)
    return np.linalg.eigvals(inverse_mass @ held), place * n


def test_a_mass_on_a_spring_swings_as_one() -> None:
    mass = 2500.0
    found = sliding_pin(journal(np.eye(2) / mass, np.array([0.0, LOAD])), contact(0.0))
    depth, k = tangent(LOAD)
    across = LOAD / (BEARING.clearance + depth)  # the bore's slope: a pendulum as long as the eccentricity
    swings = np.sort(np.abs(found.roots.imag))[::2]
    assert swings == pytest.approx(np.sqrt(np.array([across, k]) / mass), rel=1e-6)
    assert found.place == pytest.approx(np.array([0.0, -(BEARING.clearance + depth)]), rel=1e-9, abs=1e-12)
    assert found.stable
    assert abs(found.growth) < 1e-6


INVERSE_MASS = np.array([[3.3e-3, 1.5e-3], [1.5e-3, 0.9e-3]])


@pytest.mark.parametrize("mu", [0.05, 0.2, 0.45])
@pytest.mark.parametrize("coupling", [-1.0, 1.0])
def test_two_vibrations_couple_as_by_hand(mu: float, coupling: float) -> None:
    inverse_mass = INVERSE_MASS * np.array([[1.0, coupling], [coupling, 1.0]])
    found = sliding_pin(journal(inverse_mass, np.array([0.0, LOAD])), contact(mu))
    squares, place = coupled(inverse_mass, mu)
    roots = np.sqrt(-squares.astype(complex))
    expected = np.concatenate([roots, -roots])
    assert found.place == pytest.approx(place, rel=1e-8)
    for root in expected:
        assert np.abs(found.roots - root).min() < 1e-5 * abs(root)


def test_the_critical_friction_is_where_both_frequencies_meet() -> None:
    inverse_mass = INVERSE_MASS * np.array([[1.0, 1.0], [1.0, 1.0]])
    given = journal(inverse_mass, np.array([0.0, LOAD]))
    other = journal(INVERSE_MASS * np.array([[1.0, -1.0], [-1.0, 1.0]]), np.array([0.0, LOAD]))

    def flutters(one: LoadedJournal, mu: float) -> bool:
        squares = coupled(one.inverse_mass, mu)[0].astype(complex)
        return bool(np.abs(np.sqrt(-squares).real).max() > 1e-3)

    for one in (given, other):
        by_hand = next((mu for mu in np.linspace(0.0, 1.0, 4001) if flutters(one, mu)), math.inf)
        assert critical_friction(one, contact(0.1)) == pytest.approx(by_hand, abs=1e-3)
    assert {math.isinf(critical_friction(one, contact(0.1))) for one in (given, other)} == {True, False}


@pytest.mark.parametrize("angle", [50.0, math.degrees(math.atan(2.0)), 75.0])
def test_painleves_rod(angle: float) -> None:
    """A uniform rod that slides on its lower end, inclined to the floor: Painleve's example.

    Its lower end answers a normal force with 1 + 3 cos a (cos a - mu sin a), over its mass; that is negative
    beyond mu = (1 + 3 cos^2 a) / (3 sin a cos a), 4/3 at least.
    """
    mass, c, s = 40.0, math.cos(math.radians(angle)), math.sin(math.radians(angle))
    arm = np.array([-c, -s])  # of the end, from the centre, in half lengths; inertia m/3
    turning = np.array([-arm[1], arm[0]])
    inverse_mass = (np.eye(2) + 3.0 * np.outer(turning, turning)) / mass
    threshold = (1.0 + 3.0 * c * c) / (3.0 * s * c)
    for mu in (0.9 * threshold, 1.1 * threshold):
        # a load under which the normal is straight down, and friction pushes the end forward
        load = LOAD * np.array([mu, 1.0])
        found = sliding_pin(journal(inverse_mass, load), contact(mu))
        assert found.place[0] == pytest.approx(0.0, abs=1e-9)
        assert found.normal_mobility == pytest.approx((1.0 + 3.0 * c * (c - mu * s)) / mass, rel=1e-6)
        assert (found.normal_mobility < 0.0) is (mu > threshold)


def test_painleves_threshold_is_the_friction_with_no_normal_mobility() -> None:
    given = journal(INVERSE_MASS * np.array([[1.0, -1.0], [-1.0, 1.0]]), np.array([0.0, LOAD]))
    other = replace(given, journal_spin=1.0)
    thresholds = [painleve_friction(one, contact(0.1)) for one in (given, other)]
    assert sorted(map(math.isinf, thresholds)) == [False, True]
    for one, found in zip((given, other), thresholds, strict=True):
        if math.isfinite(found):
            assert abs(sliding_pin(one, contact(found)).normal_mobility) < 1e-4 * INVERSE_MASS[1, 1]


def test_moments_of_friction_turn_the_bodies_and_move_the_journal() -> None:
    """A journal fixed to a link of length l that turns about a pivot beside: one degree of freedom is left."""
    length, inertia = 1.2, 300.0
    across, along = np.array([1.0, 0.0]), np.array([0.0, 1.0])
    mass_along = 1e9  # the pivot can hardly give along the link
    inverse_mass = length**2 / inertia * np.outer(across, across) + np.outer(along, along) / mass_along
    mu, load = 0.2, np.array([LOAD, 0.0])
    free = journal(inverse_mass, load)
    turning = replace(free, journal_turn=-across / length)
    moments = [sliding_pin(one, contact(mu)) for one in (free, turning)]
    shares = [float(one.friction_along[1] / one.normal_force) for one in moments]
    assert shares[0] == pytest.approx(shares[1], rel=0.2)
    n = moments[1].place / np.linalg.norm(moments[1].place)
    arm = BEARING.contact_arms(moments[1].depth)[1]
    friction = float(moments[1].friction_along @ np.array([-n[1], n[0]]))
    q = -moments[1].normal_force * n + moments[1].friction_along + turning.journal_turn * arm * friction
    assert q == pytest.approx(load, rel=1e-8, abs=1e-4)


def test_friction_that_rises_with_the_slip_damps() -> None:
    """Inside the ramp of Ambrosio's law it is a dashpot of mu N over the ramp's width."""
    ramp = Ambrosio(sliding_coefficient=0.2, static_speed=0.0, dynamic_speed=0.1)
    slow = journal(np.eye(2) / 2500.0, np.array([0.0, LOAD]), spin=-0.1)
    found = sliding_pin(slow, replace(contact(0.0), friction=ramp))
    n = found.place / np.linalg.norm(found.place)
    t = np.array([-n[1], n[0]])
    assert t @ found.damping @ t == pytest.approx(0.2 * found.normal_force / 0.1, rel=1e-6)
    assert found.stable
    assert found.roots.real.min() == pytest.approx(-0.5 * 0.2 * found.normal_force / 0.1 / 2500.0, rel=1e-3)


def test_without_a_load_nothing_slides() -> None:
    with pytest.raises(NoEquilibriumError, match="load = 0 N"):
        sliding_pin(journal(np.eye(2), np.zeros(2)), contact(0.1))


def test_a_light_load_has_an_equilibrium_though_its_place_is_known_less_well_than_its_depth() -> None:
    """A depth of some nanometres beyond a clearance of 1.5 mm, with the friction by hand."""
    line = PinInBore(bearing=BEARING, length=0.02, effective_modulus=1.1e11, restitution=0.9)
    for mu in np.linspace(0.01, 0.5, 50):
        found = sliding_pin(journal(INVERSE_MASS * np.eye(2), np.array([0.0, 1.0])), contact(mu, line))
        assert found.normal_force == pytest.approx(1.0 / math.hypot(1.0, mu), rel=1e-6)


def test_a_dashpot_damps_as_one() -> None:
    stiffness, damping, mass = 5e8, 1e5, 2500.0
    law = KelvinVoigt(stiffness=stiffness, damping=damping)
    found = sliding_pin(journal(np.eye(2) / mass, np.array([LOAD, 0.0])), contact(0.0, law))
    normal = found.roots[np.abs(found.roots.imag).argmax()]
    half = 0.5 * damping / mass
    assert abs(normal.imag) == pytest.approx(math.sqrt(stiffness / mass - half**2), rel=1e-6)
    assert normal.real == pytest.approx(-half, rel=1e-6)
