"""The compiled formulation at a tolerance, in closed forms or in general, and the engine for comparison."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

import numpy as np
import pytest

from support_exudyn import Result, Scenario, simulate
from support_exudyn.formulations.compiled import closed_forms
from support_exudyn.formulations.compiled.closed_forms import setup
from support_exudyn.formulations.contract import Progress, silent
from support_exudyn.scenario.solver_settings import MOST_STEPS


def simulate_compiled(
    scenario: Scenario,
    tolerance: float = 1e-7,
    backend: str = "auto",
    progress: Progress = silent,
    most_steps: int = MOST_STEPS,
) -> Result:
    """Run a scenario by the compiled formulation, in closed forms where these cover it."""
    solver = replace(scenario.solver, tolerance=tolerance, backend=backend, most_steps=most_steps)
    return simulate(replace(scenario, formulation="compiled", solver=solver), progress=progress)


@contextmanager
def general_equations() -> Iterator[None]:
    """Runs of the compiled formulation take the equations of any linkage, whatever the closed forms cover."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(closed_forms, "covers", lambda scenario: False)
        yield


def simulate_general(scenario: Scenario, tolerance: float = 1e-7) -> Result:
    """Run a scenario by the equations of any linkage."""
    with general_equations():
        return simulate_compiled(scenario, tolerance)


def simulate_as_fine(scenario: Scenario, tolerance: float = 1e-7) -> Result:
    """Run by the equations of any linkage to what the closed forms reach at a tolerance: a tenth of it.

    It is of the root mean square over all components of the state, of which there are four times as many.
    """
    return simulate_general(scenario, 0.1 * tolerance)


FORMS = {"closed forms": simulate_compiled, "general": simulate_as_fine}
EVERY_FORM = pytest.mark.parametrize("form", FORMS.values(), ids=FORMS)


def from_its_source(monkeypatch: pytest.MonkeyPatch) -> None:
    """From now on a law of the family K depth^n is compiled from its source, as any other law is."""
    monkeypatch.setattr(setup, "has_family_form", lambda contact: False)


def simulate_redundant(scenario: Scenario) -> Result:
    """Run a scenario with the engine's bodies and constraints."""
    return simulate(replace(scenario, formulation="redundant"))


def same_channels(ours: Result, theirs: Result) -> dict[str, np.ndarray]:
    """Differences of all channels as a share of the largest value; names, units and times agree.

    Left out is what is nothing but rounding, in both below 1e-5 of the largest value in the same unit, and the
    energy balance, which is nothing but errors.
    """
    assert list(ours.channels) == list(theirs.channels)
    assert [c.unit for c in ours.channels.values()] == [c.unit for c in theirs.channels.values()]
    np.testing.assert_array_equal(ours.time, theirs.time)
    size = {name: max(np.abs(run[name]).max() for run in (ours, theirs)) for name in ours.channels}
    size["energy.balance"] = 0.0
    scale = {ours.unit(name): 0.0 for name in size}
    for name, largest in size.items():
        scale[ours.unit(name)] = max(scale[ours.unit(name)], largest)
    return {
        name: np.abs(ours[name] - theirs[name]) / largest
        for name, largest in size.items()
        if largest > 1e-5 * scale[ours.unit(name)]
    }
