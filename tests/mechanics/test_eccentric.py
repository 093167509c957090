"""Linkages laid out with journals out of the middle of their bores."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support_exudyn import ClearancePin, Held, Scenario, ravn_slider_crank, reference_support
from support_exudyn.mechanics.kinetics import kinetics_of
from support_exudyn.mechanics.postures import eccentric
from support_exudyn.model.linkage import Linkage
from tests.cases.run_cases import PIN, SLIDER_PIN, paper_contact, slider_crank_contact
from tests.often import often
from user_forces import InputError

CLOSE = 1e-12  # [m]: iterated to 1e-13, some roundings of metres
SUPPORT = reference_support().linkage()
PINS = tuple(SUPPORT.pins)
Offsets = Mapping[str, tuple[float, float]]
inside = st.floats(-1e-3, 1e-3)


def apart(linkage: Linkage, pin: str) -> np.ndarray:
    """Centre of a pin on its second body minus that on the first [m]."""
    place = linkage.pins[pin]
    return np.subtract(place.second_point, place.first_point)


def assert_laid_out(linkage: Linkage, of: Linkage, offsets: Offsets) -> None:
    """Pins are as far apart as asked, all else is held together, and bodies have kept their shapes."""
    for pin in linkage.pins:
        np.testing.assert_allclose(apart(linkage, pin), offsets.get(pin, (0.0, 0.0)), rtol=0, atol=CLOSE)
    for name, actuator in linkage.actuators.items():
        assert math.dist(actuator.foot_point, actuator.head_point) == pytest.approx(
            of.actuators[name].start_length, abs=CLOSE
        )
    for name, body in linkage.bodies.items():
        ends = [
            (place.first_point if place.first == name else place.second_point, pin)
            for pin, place in linkage.pins.items()
            if name in (place.first, place.second)
        ]
        before = {
            pin: place.first_point if place.first == name else place.second_point
            for pin, place in of.pins.items()
        }
        for point, pin in ends:
            was = math.dist(before[pin], of.bodies[name].centre)
            assert math.dist(point, body.centre) == pytest.approx(was, abs=CLOSE)
        assert body.mass == of.bodies[name].mass


@settings(max_examples=often(30), deadline=None)
@given(offsets=st.dictionaries(st.sampled_from(PINS), st.tuples(inside, inside), max_size=len(PINS)))
def test_any_pins_of_the_support_are_as_eccentric_as_asked(offsets: Offsets) -> None:
    assert_laid_out(eccentric(SUPPORT, offsets), SUPPORT, offsets)


def test_no_posture_nearby_is_moved_less() -> None:
    # no free direction makes mass times distance squared smaller at first order; steps that are each the least
    # add up to the least to second order in the eccentricity
    offsets = {PIN: (1e-3, -5e-4)}
    moved = eccentric(SUPPORT, offsets)
    way = np.concatenate(
        [
            [*np.subtract(body.centre, SUPPORT.bodies[name].centre), body.angle - SUPPORT.bodies[name].angle]
            for name, body in moved.bodies.items()
        ]
    )
    closed = kinetics_of(SUPPORT)
    rows = closed.rows(np.zeros_like(way))
    _, size, basis = np.linalg.svd(rows)
    free = basis[np.sum(size > 1e-9) :]
    mass = closed.mass()
    along = [abs(direction @ (mass * way)) / math.sqrt(direction @ (mass * direction)) for direction in free]
    assert max(along, default=0.0) < 1e-2 * math.sqrt(way @ (mass * way))


def test_the_bore_of_the_second_body_turns_the_offset_around() -> None:
    contact = paper_contact(1.5, 0.0)
    for bore, sign in (("first", 1.0), ("second", -1.0)):
        pin = ClearancePin(contact=contact, bore=bore, eccentricity=(1e-3, -5e-4))
        pins = {PIN: pin, "rear_shield": pin}
        scenario = Scenario(machine=reference_support(), pins=pins, duration=0.01, drive=Held())
        assert_laid_out(scenario.linkage, SUPPORT, dict.fromkeys(pins, (sign * 1e-3, -sign * 5e-4)))


# --- guides and cranks ---


@pytest.mark.parametrize("bore", ["first", "second"])
@pytest.mark.parametrize("pin", ["crank_pin", SLIDER_PIN])
def test_a_slider_stays_in_its_guide_and_a_crank_where_it_was(pin: str, bore: str) -> None:
    machine = ravn_slider_crank()
    was = machine.linkage()
    with_clearance = ClearancePin(contact=slider_crank_contact(), bore=bore, eccentricity=(2e-4, 3e-4))
    linkage = Scenario(machine=machine, pins={pin: with_clearance}, duration=0.01).linkage
    sign = 1.0 if bore == "first" else -1.0
    assert_laid_out(linkage, was, {pin: (sign * 2e-4, sign * 3e-4)})
    for name, slide in linkage.slides.items():
        x, y = np.subtract(slide.point, was.slides[name].point)
        off = math.cos(slide.direction) * y - math.sin(slide.direction) * x
        assert abs(off) < CLOSE
        assert linkage.bodies[slide.body].angle == pytest.approx(was.bodies[slide.body].angle, abs=CLOSE)
        assert abs(x) + abs(y) > 1e-6  # it has moved along it
    for crank in linkage.cranks.values():
        assert linkage.bodies[crank.body].angle == pytest.approx(was.bodies[crank.body].angle, abs=CLOSE)


# --- impossible ones ---


def test_an_eccentricity_that_the_linkage_cannot_reach_is_refused() -> None:
    # the crank keeps its angle and the slider its guide: the rod is too short for 10 m
    with_clearance = ClearancePin(contact=slider_crank_contact(), eccentricity=(0.0, 10.0))
    with pytest.raises(InputError, match=r"eccentricity of slider_pin = \(0\.0, 10\.0\) m: the linkage cannot"):
        Scenario(machine=ravn_slider_crank(), pins={SLIDER_PIN: with_clearance}, duration=0.01)
