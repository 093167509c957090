"""What the settings of the time integration do in the Exudyn formulation."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from support_exudyn import ClearancePin, CubicStep, Held, Result, SolverSettings, simulate
from support_exudyn.formulations.exudyn.solver.step_growth import SMOOTH
from tests.cases.run_cases import (
    FORCE,
    PIN,
    loose_support,
    paper_contact,
    support,
)
from user_forces import Exact
from user_forces.values.value import Value


def drop(step: float = 5e-4, duration: float = 0.08, **solver: object) -> Result:
    settings = SolverSettings(**solver)
    return simulate(loose_support(drive=Held(), duration=duration, step=step, solver=settings))


# --- settings of earlier versions ---


@pytest.mark.parametrize(
    ("key", "usual", "other"),
    [
        ("backend", "auto", "python"),
        ("integrator", "generalised_alpha", "trapezoidal"),
        ("constraint_index", 3, 2),
        ("locate", True, False),
    ],
)
def test_settings_of_earlier_versions_are_read_with_a_note(key: str, usual: object, other: object) -> None:
    written = SolverSettings(growth=2.0).to_data()
    assert Value.from_data(written | {key: usual}) == SolverSettings(growth=2.0)
    with pytest.warns(UserWarning, match=rf"solver\.{key} = {other!r} has no effect any more"):
        assert Value.from_data(written | {key: other}) == SolverSettings(growth=2.0)


# --- Newton's method ---


def test_full_newton_gives_the_same() -> None:
    modified, full = drop(impact_steps=64), drop(impact_steps=64, newton="full")
    assert full.counts.jacobians == full.counts.newton_iterations
    assert full.counts.newton_iterations < modified.counts.newton_iterations
    # Newton's tolerance of 1e-8 and what the impacts make of it
    for one, other in zip(modified.onsets[PIN], full.onsets[PIN], strict=True):
        assert one.speed == pytest.approx(other.speed, rel=1e-4)


# --- steps that grow ---


def rise(growth: float) -> Result:
    """A rise that begins when the pin has come to rest, which a restitution of 0.1 lets it do soon."""
    contact = paper_contact(1.5, 0.0)
    normal = Exact(stiffness=contact.normal.stiffness, restitution=0.1)
    pin = ClearancePin(contact=replace(contact, normal=normal))
    solver = SolverSettings(growth=growth, impact_steps=128)
    drive = CubicStep(start=0.5, end=2.5)
    return simulate(support(pins={PIN: pin}, drive=drive, duration=1.1, solver=solver))


def test_steps_that_grow_save_steps_and_cost_no_accuracy() -> None:
    plain, grown = rise(1.0), rise(16.0)
    assert grown.counts.steps < plain.counts.steps - 400  # measured 524
    assert grown.onsets == plain.onsets
    np.testing.assert_allclose(grown.time, plain.time, rtol=0.0, atol=1e-15)
    late = plain.time > 0.3
    # of 60 kN; vibrations of SMOOTH of the load may be lost
    np.testing.assert_allclose(grown[FORCE][late], plain[FORCE][late], atol=SMOOTH * plain[FORCE].max())
    np.testing.assert_allclose(grown["tip.y"], plain["tip.y"], atol=SMOOTH * 1.5e-4)  # of the depth
    assert grown.energy_error < 1.5 * plain.energy_error


def test_records_inside_a_step_lie_on_the_motion() -> None:
    drive = CubicStep(start=0.0, end=2.0)
    runs = [
        simulate(support(drive=drive, duration=1.0, step=1e-3, solver=SolverSettings(growth=growth)))
        for growth in (1.0, 8.0)
    ]
    plain, grown = runs
    assert grown.counts.steps < 0.6 * plain.counts.steps
    for channel in ("tip.y", "rear_link.angular_velocity"):
        largest = np.abs(plain[channel]).max()
        # second order at steps up to 8 ms of a motion of 1 s
        np.testing.assert_allclose(grown[channel], plain[channel], atol=1e-5 * largest)
    # a change of the step disturbs accelerations by less than what it takes to let steps shrink
    channel = "rear_link.angular_acceleration"
    np.testing.assert_allclose(grown[channel], plain[channel], atol=SMOOTH * 9.81)
