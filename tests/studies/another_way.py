"""The same scene by another formulation, to an accuracy, to compare what studies print with."""

from __future__ import annotations

from dataclasses import replace

from support_exudyn import Result, Scenario, SolverSettings, simulate


def another_way(scenario: Scenario) -> Result:
    """By the free coordinates alone, with the same data of the machine and the laws, to an accuracy."""
    return simulate(replace(scenario, formulation="reduced", solver=SolverSettings()), accuracy=1e-6)
