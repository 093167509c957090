"""Drive mode 1: the columns' speed jumps, and so do all velocities, consistently."""

from __future__ import annotations

import numpy as np
import pytest

from support_exudyn import Result, UniformSpeed, reference_support, simulate
from tests.reference.cases import FORCE, loose_support, support


def rise(step: float, **changes: object) -> Result:
    return simulate(support(drive=UniformSpeed(), duration=3.5, step=step, **changes))


def test_velocities_after_the_jump_are_the_closed_form_ones() -> None:
    machine, speed, small = reference_support(), 0.25, 1e-5
    result = rise(5e-4)
    n = 3001  # 1 ms after the jump
    at = 0.25e-3
    lower, upper = machine.extended(at - small), machine.extended(at + small)
    assert lower is not None
    assert upper is not None
    slope = (upper.rear_link - lower.rear_link) / (2 * small)
    # central difference over 0.02 mm: 1e-9; generalised alpha at this step: 1e-6
    assert result["rear_link.angular_velocity"][n] == pytest.approx(slope * speed, rel=3e-6)


def test_the_impulse_gives_the_kinetic_energy() -> None:
    result = rise(5e-4)
    (impulse,) = result.impulses
    assert impulse.time == 3.0
    # the bodies were at rest: an impulse through columns that move at v does work of impulse times v/2
    work = sum(impulse.columns.values()) * 0.25 / 2
    assert impulse.energy == pytest.approx(work, rel=1e-9)  # rounding
    # the support has moved by 0.25 mm of its stroke of 500 mm since
    assert result["energy.kinetic"][3001] == pytest.approx(impulse.energy, rel=1e-3)
    assert all(value > 0.0 for value in impulse.columns.values())


def test_force_just_after_the_jump_does_not_grow_as_the_step_shrinks() -> None:
    forces = [rise(step)[FORCE][3001] for step in (5e-4, 2.5e-4)]
    # without consistent velocities it grows as 1/step; what is left is the engine's rounding
    assert forces[1] == pytest.approx(forces[0], rel=1e-5)


def test_energy_adds_up_over_the_jump() -> None:
    ideal = rise(5e-4)
    assert ideal.energy_error < 1e-6 * ideal["energy.work"][-1]  # second order in the step
    loose = simulate(loose_support(drive=UniformSpeed(), duration=3.5))
    assert loose.energy_error < 1e-4 * loose.dissipated  # asked of every run
    assert len(loose.impulses) == 1


def test_a_stroke_can_begin_and_end_within_the_run() -> None:
    drive = UniformSpeed(stroke=0.1, start=0.0, end=0.4)
    result = simulate(support(drive=drive, duration=0.8, step=5e-4))
    assert [impulse.time for impulse in result.impulses] == [0.0, 0.4]
    # it stands still again; 1e-6 is the error of the velocities before the second jump
    np.testing.assert_allclose(result["rear_link.angular_velocity"][401:], 0.0, atol=1e-6)
    assert result.energy_error < 1e-6 * result["energy.work"][-1]
