"""Jumps of a drive's speed: velocities after them, impulses of what is held, and forces without limit."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from support_exudyn import (
    Body,
    Crank,
    LinearActuator,
    Linkage,
    Machine,
    Result,
    Scenario,
    Slide,
    UniformSpeed,
    ravn_slider_crank,
    reference_support,
    simulate,
)
from support_exudyn.files.machines.read import read_machine
from support_exudyn.model.linkage import GROUND, pinned
from support_exudyn.postprocessing import summary
from support_exudyn.simulation import impulses
from support_exudyn.sweeps.measures import numbers as noted
from support_exudyn.sweeps.plan import Record
from tests.cases.run_cases import (
    loose_support,
    slider_crank,
    support,
)
from user_forces import value

FORMULATIONS = pytest.mark.parametrize("formulation", ["exudyn", "compiled"])


@cache
def sudden_rise(formulation: str) -> Result:
    return simulate(support(drive=UniformSpeed(), duration=3.5, step=5e-4, formulation=formulation))


@FORMULATIONS
def test_velocities_after_the_jump_are_the_closed_form_ones(formulation: str) -> None:
    machine, speed, small = reference_support(), 0.25, 1e-5
    at = 0.25e-3  # extension 1 ms after the jump [m]
    lower, upper = machine.extended(at - small), machine.extended(at + small)
    assert lower is not None
    assert upper is not None
    result = sudden_rise(formulation)
    # central difference over 0.02 mm: 1e-9; generalised alpha at this step: 1e-6
    close = 3e-6 if formulation == "exudyn" else 1e-7
    for body in ("rear_link", "canopy"):
        slope = (getattr(upper, body) - getattr(lower, body)) / (2 * small)
        assert result[f"{body}.angular_velocity"][3001] == pytest.approx(slope * speed, rel=close)


@FORMULATIONS
def test_the_impulse_gives_the_kinetic_energy(formulation: str) -> None:
    result = sudden_rise(formulation)
    (impulse,) = result.impulses
    assert impulse.time == 3.0
    # the bodies were at rest: an impulse through actuators that move at v does work of impulse times v/2
    work = sum(impulse.actuators.values()) * 0.25 / 2
    assert impulse.energy == pytest.approx(work, rel=1e-9)  # rounding
    # the support has moved by 0.25 mm of its stroke of 500 mm since
    assert result["energy.kinetic"][3001] == pytest.approx(impulse.energy, rel=1e-3)
    assert all(value > 0.0 for value in impulse.actuators.values())
    assert result.energy_error < 1e-6 * result["energy.work"][-1]  # second order in the step


@FORMULATIONS
def test_a_loose_pin_transmits_no_impulse(formulation: str) -> None:
    drive = UniformSpeed(stroke=0.5, start=0.0, end=2.0)
    (closed,), (free,) = (
        simulate(scene(drive=drive, duration=0.01, formulation=formulation)).impulses
        for scene in (support, loose_support)
    )
    # Bertrand's theorem: with fewer constraints the same speeds of the actuators take less energy
    assert free.energy < closed.energy
    assert free.energy == pytest.approx(0.5 * 0.25 * sum(free.actuators.values()), rel=1e-9)  # from rest


def test_a_crank_that_jumps_to_speed_gets_an_angular_impulse() -> None:
    # Ravn's crank, upright after a quarter turn backwards: the rod does not turn then
    machine = replace(ravn_slider_crank(), start_angle=-0.5 * math.pi)
    drive = UniformSpeed(stroke=1.0, start=0.0, end=0.1)
    result = simulate(slider_crank(1e-4, machine=machine, drive=drive))
    (impulse,) = result.impulses
    speed = 10.0  # [rad/s]
    # rod and slider move along x as fast as the crank pin
    inertia = 1e-4 + 0.3 * 0.025**2 + (0.21 + 0.14) * 0.05**2
    # rounding
    assert impulse.cranks == pytest.approx({"crank": inertia * speed}, rel=1e-12)
    assert impulse.energy == pytest.approx(0.5 * inertia * speed**2, rel=1e-12)
    assert impulse.actuators == {}
    # pins pass on the momentum of what they move; across it the guide keeps the rod from turning
    across = 0.5 * (0.35 + 0.14) * speed * 0.05 * 0.05 / math.sqrt(0.12**2 - 0.05**2)
    along = {"pin.slider_pin": 0.14 * 0.5, "pin.crank_pin": 0.35 * 0.5, "pin.main": 0.35 * 0.5 + 0.3 * 0.25}
    expected = {name: math.hypot(one, across) for name, one in along.items()}
    assert impulse.joints == pytest.approx(expected | {"guide": across}, rel=1e-9)
    # the crank has turned by a thousandth of a radian since, and the slider is faster by as much
    assert result["energy.kinetic"][-1] == pytest.approx(impulse.energy, rel=1e-3)
    # the work of the drive counts it
    assert result["energy.work"][-1] == pytest.approx(result["energy.kinetic"][-1], rel=1e-6)


@value
class RamAndWheel(Machine):
    """A ram of 3 kg lifted by an actuator, and beside it a wheel of 0.2 kg m^2 turned by a crank."""

    def linkage(self) -> Linkage:
        return Linkage(
            bodies={
                "ram": Body(mass=3.0, inertia=1.0, centre=(0.0, 1.0)),
                "wheel": Body(mass=5.0, inertia=0.2, centre=(2.0, 0.0)),
            },
            pins={"axle": pinned(GROUND, "wheel", (2.0, 0.0))},
            actuators={
                "jack": LinearActuator(foot=GROUND, head="ram", foot_point=(0.0, 0.0), head_point=(0.0, 1.0))
            },
            cranks={"motor": Crank(body="wheel")},
            slides={"guide": Slide(body="ram", point=(0.0, 1.0), direction=0.5 * math.pi)},
        )


def test_actuators_and_cranks_get_impulses_of_their_own() -> None:
    drive = UniformSpeed(stroke=0.4, start=0.0, end=0.1)  # 4 m/s and 4 rad/s
    result = simulate(Scenario(machine=RamAndWheel(), drive=drive, duration=0.01))
    (impulse,) = result.impulses
    # mass and inertia times speed, and half of that times the speed again; rounding
    assert impulse.actuators == pytest.approx({"jack": 12.0}, rel=1e-12)
    assert impulse.cranks == pytest.approx({"motor": 0.8}, rel=1e-12)
    assert impulse.energy == pytest.approx(24.0 + 1.6, rel=1e-12)
    # neither the wheel's axle nor the ram's guide is struck: their forces keep their peaks, the jack's has none
    assert impulse.joints == pytest.approx({"pin.axle": 0.0, "guide": 0.0}, abs=1e-12)
    assert list(impulses.struck(result, 0.0, math.inf)) == ["jack.force"]
    assert not list(impulses.struck(result, 1e-3, math.inf))  # after it
    # after it the actuator carries the weight of 3 kg, and nothing turns the wheel, or the ram in its guide
    np.testing.assert_allclose(result["jack.force"][1:], 3.0 * 9.81, rtol=1e-6)
    for name in ("motor.moment", "guide.moment", "guide.force"):
        np.testing.assert_allclose(result[name][1:], 0.0, atol=1e-6)
    np.testing.assert_allclose(result["pin.axle.force_y"][1:], 5.0 * 9.81, rtol=1e-6)


@pytest.mark.parametrize(("dimensions", "formulation"), [(2, "compiled"), (2, "exudyn"), (3, "exudyn")])
def test_a_force_without_limit_is_refused_and_its_impulse_printed(dimensions: int, formulation: str) -> None:
    # two-leg shield on rigid legs, ideal pins: a sudden start within the run, none after 0.2 s
    drive = UniformSpeed(stroke=0.1, start=0.1, end=1.0)
    scene = Scenario(machine=read_machine("two_leg_shield").machine, drive=drive, duration=0.3, step=1e-3)
    result = simulate(replace(scene, dimensions=dimensions, formulation=formulation), errors=True)
    numbers, later = result.numbers(), result.numbers(after=0.2)
    for force in ("pin.rear_base.force", "leg.force"):
        for word in ("largest", "std"):
            assert f"{force}.{word}" not in numbers
            with pytest.raises(KeyError, match=r"impulse, no finite peak; allowed: .*\.impulse_1"):
                _ = numbers[f"{force}.{word}"]
            assert f"{force}.{word}" in later  # nothing jumps there
        assert f"{force}.mean" in numbers
    # of the three ways to compute them, in N s
    for force, expected in (("pin.rear_base.force", 169.784), ("leg.force", 1031.087)):
        number = numbers[f"{force}.impulse_1"]
        assert (number.value, number.unit) == (pytest.approx(expected, rel=1e-5), "N s")
        assert number.error <= 1e-6 * expected
        (row,) = summary.channels_table(result, [force]).rows
        assert row[2::2][:2] == ("impulse", "impulse")
    asked = Record(numbers=("pin.rear_base.force.max_time", "pin.*.largest", "leg.force.largest"), after=0.0)
    assert all(name.endswith(".impulse_1") for name in noted(result, asked))
    assert noted(replace(result), replace(asked, after=0.2))["leg.force.largest"].value > 0.0
