"""Columns of oil against closed forms, rigid actuators, and the energy balance."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from support_exudyn import (
    Body,
    CubicStep,
    Drive,
    Held,
    LinearActuator,
    Linkage,
    Machine,
    OilColumn,
    Result,
    RigidActuator,
    Scenario,
    Slide,
    UniformSpeed,
    bore_area,
    simulate,
)
from support_exudyn.model.linkage import GROUND
from tests.cases.run_cases import FORCE, loose_support, support
from user_forces import InputError, value

MASS, GRAVITY = 3000.0, 9.81
AREA = bore_area(0.25, number=2)
OIL = OilColumn(bore_area=AREA, oil_length=0.5, bulk_modulus=1.5e9)
BOTH = {"front_column": OIL, "rear_column": OIL}
ONE_OF_OIL = {"front_column": OIL, "rear_column": RigidActuator()}


@value
class Ram(Machine):
    """A ram of 3 t lifted by one upright actuator."""

    def linkage(self) -> Linkage:
        return Linkage(
            bodies={"ram": Body(mass=MASS, inertia=1.0, centre=(0.0, 1.0))},
            actuators={
                "jack": LinearActuator(foot=GROUND, head="ram", foot_point=(0.0, 0.0), head_point=(0.0, 1.0))
            },
            slides={"guide": Slide(body="ram", point=(0.0, 1.0), direction=0.5 * math.pi)},
        )


def lift(oil: OilColumn, drive: Drive, step: float = 1e-4, duration: float = 0.3) -> Result:
    return simulate(
        Scenario(
            machine=Ram(),
            actuators={"jack": oil},
            drive=drive,
            duration=duration,
            step=step,
            record_period=1e-3,
        )
    )


def test_a_machine_on_oil_stays_where_it_is() -> None:
    result = lift(OIL, Held())
    assert (result.counts.steps, result.counts.failed_newton) == (3000, 0)  # there is nothing to fail on
    # rounding of a length of 1 m; the load of 29 kN compresses the oil by 0.1 mm
    np.testing.assert_allclose(result["ram.y"], 1.0, atol=1e-12)
    np.testing.assert_allclose(result["jack.force"], MASS * GRAVITY, rtol=1e-9)
    # the whole support too, with ideal pins: its static forces are a linear solve
    still = simulate(support(actuators=BOTH, drive=Held(), duration=0.2))
    np.testing.assert_allclose(still[FORCE], 58778.944, rtol=1e-6)  # as printed in the reference


@pytest.mark.parametrize(
    ("bore", "length", "published"), [(0.4, 3.0, 16.8), (0.5, 3.0, 26.2), (0.5, 3.55, 22.2), (0.6, 4.5, 25.1)]
)
def test_the_published_stiffness_of_four_shields_follows_from_one_bulk_modulus(
    bore: float, length: float, published: float
) -> None:
    legs = OilColumn(bore_area=bore_area(bore, number=2), oil_length=length, bulk_modulus=1.96e9)
    assert legs.stiffness(0.0) / (1e3 * 9.81 / 1e-3) == pytest.approx(published, rel=5e-3)  # t/mm


def test_a_sudden_start_follows_the_closed_form_of_an_oscillator() -> None:
    # so long a cushion that its stiffness stays 1e8 N/m while 2.5 mm are let in
    oil = OilColumn(bore_area=1.0, oil_length=2000.0, bulk_modulus=2e11)
    w = math.sqrt(1e8 / MASS)
    speed = 0.01
    result = lift(oil, UniformSpeed(stroke=speed, start=0.05, end=1.05), step=5e-5)
    t = result.time - 0.05
    # u'' + w^2 u = 0, u(0) = 0, u'(0) = speed
    expected = MASS * GRAVITY + np.where(t > 1e-9, 1e8 * speed / w * np.sin(w * t), 0.0)
    # second order: 180 rad/s and 5e-5 s leave 4e-4, most of it as phase after 0.25 s
    largest = np.abs(expected - MASS * GRAVITY).max()
    np.testing.assert_allclose(result["jack.force"], expected, atol=1e-3 * largest)
    assert result.impulses == ()


def test_stiffer_oil_tends_to_rigid_actuators_with_order_one() -> None:
    drive = CubicStep(start=0.05, end=0.55, stroke=0.1)
    rigid = simulate(support(drive=drive, duration=0.3))

    def off(stiffer: float) -> float:
        oil = replace(OIL, bulk_modulus=stiffer * OIL.bulk_modulus)
        soft = simulate(support(actuators=dict.fromkeys(BOTH, oil), drive=drive, duration=0.3, step=2.5e-4))
        late = rigid.time > 0.2  # over some vibrations of the start, which nothing damps
        return abs(float((soft["tip.y"] - rigid["tip.y"])[late].mean()))

    # compliance is what moves: ten times stiffer, ten times nearer; 5 % for what vibrates
    assert off(10.0) / off(100.0) == pytest.approx(10.0, rel=0.05)


def test_energy_adds_up_where_one_column_is_of_oil() -> None:
    drive = UniformSpeed(start=0.1, end=2.1)
    result = simulate(loose_support(drive=drive, actuators=ONE_OF_OIL, duration=0.3, step=6.25e-5))
    # the journal's fall and the sudden start make the oil vibrate at 40 Hz, which generalised alpha damps a
    # little between impacts: 6e-4 at this step
    assert result.energy_error < 1e-3 * result.dissipated
    # the rigid one alone is struck
    assert [sorted(impulse.actuators) for impulse in result.impulses] == [["rear_column"]]


def test_energy_adds_up_over_a_stroke_that_halves_the_stiffness() -> None:
    coarse, fine = (
        lift(OIL, CubicStep(stroke=0.5, start=0.0, end=0.25), step=step) for step in (1.25e-4, 6.25e-5)
    )
    # second order, of 15 kJ of work; what the oil gives back as there is more of it is 3 J
    assert fine.energy_error < 1e-5 * fine["energy.work"][-1]
    assert fine.energy_error < 0.35 * coarse.energy_error
    assert fine["jack.length"][-1] == pytest.approx(1.5, abs=1e-3)


def test_wrong_oil_is_refused() -> None:
    with pytest.raises(InputError, match=r"actuators\.middle.*allowed: front_column, rear_column"):
        support(actuators={"middle": OIL})
    oil = replace(OIL, oil_length=0.05)
    with pytest.raises(InputError, match=r"oil_length = 0\.05 m.*no oil is left"):
        support(actuators={"front_column": oil}, drive=CubicStep(stroke=-0.1))
    with pytest.raises(InputError, match="bulk_modulus"):
        OilColumn(bore_area=1.0, oil_length=1.0, bulk_modulus=0.0)
    with pytest.raises(InputError, match="diameter"):
        bore_area(0.0)


def test_who_asks_for_the_damping_time_is_told_of_the_line() -> None:
    with pytest.raises(InputError, match=r"OilColumn\.damping_time = 0\.001.*allowed: a line"):
        OilColumn(bore_area=0.1, oil_length=0.5, bulk_modulus=1.5e9, damping_time=1e-3)
