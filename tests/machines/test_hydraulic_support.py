from __future__ import annotations

import math
import re
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support_exudyn import CubicStep, HydraulicSupport, Part, reference_support
from support_exudyn.machines.four_column_support import Posture
from support_exudyn.model.linkage import lumped
from tests.cases.machine_cases import PARTS, PIVOTS, support
from tests.often import often
from user_forces import InputError

SUPPORT = support()
START = SUPPORT.start()
Point = tuple[float, float]

# Start posture: canopy level, hinge 1800 mm high [mm]
START_MM = {
    "rear_shield": (-814.877, 939.136),
    "front_shield": (-523.214, 1156.571),
    "hinge": (395.903, 1800.0),
    "front_head": (1859.903, 1793.0),
    "rear_head": (875.903, 1785.0),
    "tip": (3195.903, 1950.0),
}
# Independent integrator, cubic STEP from 3 to 5 s: t [s], rear link [deg/s], [deg/s^2]
RISE = {
    3.25: (-5.752965, -20.222483),
    3.50: (-10.156832, -15.006264),
    4.00: (-14.754937, -2.718542),
    4.50: (-12.049091, 14.355602),
}


def place(posture: Posture, pivot: str) -> Point:
    """A pivot in a posture [m]."""
    found: Point = posture.ends.get(pivot) or getattr(posture, pivot)
    return found


@cache
def extended(extension: float) -> Posture:
    """Posture by stroke [m], reached in steps of at most 50 mm from the start."""
    posture = START
    for goal in np.linspace(0.0, extension, 2 + int(abs(extension) / 0.05))[1:].tolist():
        found = SUPPORT.extended(goal, posture)
        assert found is not None
        posture = found
    return posture


# --- start posture ---


@pytest.mark.parametrize("name", START_MM)
def test_start_posture_is_the_published_one(name: str) -> None:
    # half of the last printed digit
    assert place(START, name) == pytest.approx([c / 1e3 for c in START_MM[name]], abs=5e-7)


# --- posture ---


def residuals(machine: HydraulicSupport, c: Point, d: Point, i: Point) -> list[float]:
    """By how much bars are longer in a posture than in the reference posture [m]."""
    bars = [
        (machine.rear_base, c, machine.rear_base, machine.rear_shield),
        (machine.front_base, d, machine.front_base, machine.front_shield),
        (c, d, machine.rear_shield, machine.front_shield),
        (c, i, machine.rear_shield, machine.hinge),
        (d, i, machine.front_shield, machine.hinge),
    ]
    return [math.dist(a, b) - math.dist(a0, b0) for a, b, a0, b0 in bars]


@settings(max_examples=often(30))
@given(height=st.floats(1.0, 2.7))
def test_start_is_level_at_the_height_asked_for(height: float) -> None:
    machine = support(start_hinge_height=height)
    start = machine.start()
    # the root is found to 1e-15 rad, at 2 m/rad
    assert start.hinge[1] == pytest.approx(height, abs=1e-14)
    assert start.canopy == 0.0
    # rounding of lengths up to 1.5 m
    assert residuals(machine, start.rear_shield, start.front_shield, start.hinge) == pytest.approx(
        [0.0] * 5, abs=1e-14
    )


# --- extension ---


@settings(max_examples=often(30))
@given(extension=st.floats(-0.4, 0.7))
def test_columns_get_longer_by_what_is_asked_for(extension: float) -> None:
    front, rear = SUPPORT.column_lengths(extended(extension))
    start_front, start_rear = SUPPORT.column_lengths(START)
    # what the search accepts
    assert front - start_front == pytest.approx(extension, abs=2e-11)
    assert rear - start_rear == pytest.approx(extension, abs=2e-11)


def rear_link_rates(t: float) -> tuple[float, float]:
    """Angular velocity and acceleration [deg/s, deg/s^2] during the rise, from postures around time t."""
    drive, h = CubicStep(), 2e-3
    y = [math.degrees(extended(drive.extension(t) + n * h).rear_link) for n in (-2, -1, 0, 1, 2)]
    slope = (y[0] - 8.0 * y[1] + 8.0 * y[3] - y[4]) / (12.0 * h)
    curvature = (-y[0] + 16.0 * y[1] - 30.0 * y[2] + 16.0 * y[3] - y[4]) / (12.0 * h**2)
    speed, acceleration = drive.speed(t), 6.0 * 0.5 * (1.0 - 2.0 * (t - 3.0) / 2.0) / 2.0**2
    return slope * speed, curvature * speed**2 + slope * acceleration


@pytest.mark.parametrize("t", RISE)
def test_rear_link_moves_as_the_independent_integrator_says(t: float) -> None:
    rate, acceleration = rear_link_rates(t)
    # half of the last printed digit and the error of the difference, of fourth order in 2 mm
    assert rate == pytest.approx(RISE[t][0], abs=1e-6)
    # half of the last printed digit, and rounding of postures, 1e-14 rad over (2 mm)^2
    assert acceleration == pytest.approx(RISE[t][1], abs=2e-6)


# --- refusals ---


@pytest.mark.parametrize("height", [0.5, 3.5])
def test_an_unreachable_height_is_refused(height: float) -> None:
    with pytest.raises(
        InputError, match=rf"start_hinge_height = {height} m: .*allowed: [\d.]+ to [\d.]+ m"
    ) as caught:
        support(start_hinge_height=height)
    lowest, highest = (float(n) for n in re.findall(r"allowed: ([\d.]+) to ([\d.]+)", str(caught.value))[0])
    # what is said to be allowed is: to the rounding of the message
    support(start_hinge_height=lowest + 1e-4)
    support(start_hinge_height=highest - 1e-4)


def test_a_body_without_its_parts_is_refused() -> None:
    parts = {name: items for name, items in PARTS.items() if name != "canopy"}
    with pytest.raises(InputError, match=r"parts = .*allowed: exactly rear_link, front_link, shield, canopy"):
        support(parts=parts)


# --- masses and layout ---


@pytest.mark.parametrize(
    ("body", "mass", "inertia"),
    [
        ("rear_link", 500.0, 44.688),
        ("front_link", 400.0, 51.313),
        ("shield", 2580.0, 1531.985),
        ("canopy", 3400.0, 2820.816),
    ],
)
def test_bodies_have_the_published_masses(body: str, mass: float, inertia: float) -> None:
    got = SUPPORT.linkage().bodies[body]
    # rounding
    assert got.mass == pytest.approx(mass, rel=1e-15)
    # half of the last printed digit
    assert got.inertia == pytest.approx(inertia, abs=5e-4)


@pytest.mark.parametrize(("body", "centre"), [("shield", (-489.2, 1322.9)), ("canopy", (1371.6, 2309.8))])
def test_lumped_centres_are_the_published_ones(body: str, centre: Point) -> None:
    # half of the last printed digit
    assert [1e3 * c for c in lumped(SUPPORT.parts[body]).centre] == pytest.approx(centre, abs=0.05)


# --- in more detail ---


def test_parts_that_stand_for_columns_leave_the_canopy() -> None:
    machine = reference_support()
    plain, detailed = machine.linkage(), machine.detailed(("front_column",), ())
    assert plain.bodies["canopy"].mass - detailed.bodies["canopy"].mass == 200.0
    assert {name: plain.bodies[name] == body for name, body in detailed.bodies.items()} == {
        "rear_link": True, "front_link": True, "shield": True, "canopy": False,
    }  # fmt: skip
    assert machine.detailed((), ()) == plain


def test_the_tail_beam_leaves_the_shield_beam() -> None:
    machine = reference_support()
    plain, detailed = machine.linkage(), machine.detailed((), ("tail_beam",))
    shield, tail = detailed.bodies["shield"], detailed.bodies["tail_beam"]
    whole = plain.bodies["shield"]
    assert (shield.mass, tail.mass) == (1500.0, 1080.0)
    together = lumped([Part(mass=b.mass, centre=b.centre, inertia=b.inertia) for b in (shield, tail)])
    # rounding
    assert together.centre == pytest.approx(whole.centre, abs=1e-14)
    assert together.inertia == pytest.approx(whole.inertia, rel=1e-13)
    assert not detailed.actuators["tail_jack"].driven
    assert detailed.driven == plain.driven
    # the hinge is on the beam, a bar of 1050 mm: half of that from its centre, to 1 mm of the data
    hinge = detailed.pins["shield_tail"].first_point
    assert math.dist(hinge, tail.centre) == pytest.approx(0.525, abs=2e-3)


def test_a_support_without_data_of_the_tail_beam_says_what_it_lacks() -> None:
    lacks = "tail_hinge, tail_jack_foot, tail_jack_head, a part of parts.shield named tail_beam"
    with pytest.raises(InputError, match=rf"parts\.tail_beam: the machine lacks {lacks}; allowed: Lumped"):
        SUPPORT.detailed((), ("tail_beam",))


@pytest.mark.parametrize("places", [-3, -1, 0, 1, 4])
@pytest.mark.parametrize("extension", [-3e-3, 1e-5, 5e-4, 0.2])
def test_columns_extend_from_a_start_that_is_the_reference_posture_but_for_rounding(
    places: int, extension: float
) -> None:
    height = PIVOTS["hinge"][1]
    machine = support(start_hinge_height=height + places * math.ulp(height))
    start, posture = machine.start(), machine.extended(extension)
    assert abs(start.rear_link) < 1e-14
    assert posture is not None
    grown = np.subtract(machine.column_lengths(posture), machine.column_lengths(start))
    np.testing.assert_allclose(grown, extension, rtol=0.0, atol=1e-11)
