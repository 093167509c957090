"""What the settings of the time integration do in the Exudyn formulation."""

from __future__ import annotations

import pytest

from support_exudyn import Held, Result, SolverSettings, simulate
from tests.cases.run_cases import (
    PIN,
    loose_support,
)
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
        ("growth", 1.0, 8.0),
    ],
)
def test_settings_of_earlier_versions_are_read_with_a_note(key: str, usual: object, other: object) -> None:
    written = SolverSettings(spectral_radius=0.25).to_data()
    assert Value.from_data(written | {key: usual}) == SolverSettings(spectral_radius=0.25)
    with pytest.warns(UserWarning, match=rf"solver\.{key} = {other!r} has no effect any more"):
        assert Value.from_data(written | {key: other}) == SolverSettings(spectral_radius=0.25)


# --- Newton's method ---


def test_full_newton_gives_the_same() -> None:
    modified, full = drop(impact_steps=64), drop(impact_steps=64, newton="full")
    assert full.counts.jacobians == full.counts.newton_iterations
    assert full.counts.newton_iterations < modified.counts.newton_iterations
    # Newton's tolerance of 1e-8 and what the impacts make of it
    for one, other in zip(modified.onsets[PIN], full.onsets[PIN], strict=True):
        assert one.speed == pytest.approx(other.speed, rel=1e-4)
