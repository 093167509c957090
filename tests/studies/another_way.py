"""The same scene in another way, to compare what studies print with."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from studies.common.numbers import Number
from studies.common.options import Options
from studies.common.runs import run_with_errors
from support_exudyn import Result, Scenario, SolverSettings


def by_a_tight_run(scenario: Scenario) -> Result:
    """By the same method at a tolerance far below that of any study."""
    solver = SolverSettings(tolerance=1e-10)
    chosen = replace(scenario, accuracy=None, formulation="compiled", solver=solver)
    return run_with_errors({"": chosen}, Options(Path()))[""]


def by_the_engine(scenario: Scenario) -> Result:
    """By rigid bodies, constraints and generalised alpha; nothing but data and laws is shared."""
    solver = SolverSettings(impact_steps=512)
    chosen = replace(scenario, accuracy=None, formulation="exudyn", solver=solver, step=5e-4)
    return run_with_errors({"": chosen}, Options(Path()))[""]


def off(printed: dict[tuple[str, str], dict[str, Any]], others: Sequence[Number]) -> dict[str, float]:
    """How far printed numbers are from others, as a share of both errors together, by name and case.

    1e-8 of a number counts as error: where the drive's acceleration jumps the engine's force is off by 6e-9 of
    it at any step, which its errors cannot tell; printed ones are met by extrapolation from the records behind.
    """
    found = {}
    for its in others:
        ours = printed[its.name, its.case]
        both = ours["numerical_error"] + its.numerical_error
        if its.unit != "1" and not its.name.endswith("_error") and both > 0.0:
            found[f"{its.name}, {its.case}"] = abs(ours["value"] - its.value) / (both + 1e-8 * abs(its.value))
    return found
