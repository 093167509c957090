"""Studies of the paper: every case on Exudyn, and the witness, the same case by the compiled formulation.

A case is run on Exudyn at one setting, and once more at twice its steps. From the distance of both runs the
error of a number follows as for every run of two settings, see `support_exudyn.simulation.estimate`. Two runs
agree in some numbers by chance, and friction of ideal joints, which follows the force a step late, converges
slower than the rest. So an error is

- `SAFETY` times that estimate,
- at least `ALIKE` times the middle one of them among numbers of the same case and unit; of an extreme, which is
  of a single time, that middle one itself,
- at least `LEAST` of the number, a unit of its sixth digit.

The witness shares data and laws with these runs, but neither equations nor integrator. It says whether the
errors are true: the difference of a number from that of the witness has to lie within the printed error.
"""

import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from statistics import median

from studies.common.numbers import NUMBERS, Number
from studies.common.options import WITNESSES, Options
from studies.common.runs import run_with_errors
from support_exudyn import Result, Scenario, SolverSettings
from support_exudyn.formulations.registry import formulation
from support_exudyn.simulation.automatic_settings import settings_for
from support_exudyn.simulation.provenance import installed
from user_forces import Frictionless

LONGER = 0.0256  # goal whose settings the longer steps have: for the paper's machine 1 ms and 32 an impact
HALVED = 1  # times
LOOSE = 256  # longer steps an impact without friction, where each of many impacts multiplies earlier errors
SAFETY, ALIKE, LEAST = 3.0, 0.1, 1e-5
EXTREMES = ("largest", "least", "max", "min", "peak")  # how names of extremes begin
TOLERANCE = 1e-9  # of the witness; one more run has 8e-9, from which its own errors follow


def run_and_measure(
    cases: Mapping[str, Scenario], measure: Callable[[Mapping[str, Result]], Sequence[Number]], chosen: Options
) -> tuple[dict[str, Result], list[Number]]:
    """Runs on Exudyn, and all numbers with errors and with those of the witness, where that covers the cases.

    Arguments:
        cases: by name.
        measure: all numbers of the study from the runs of these cases.
        chosen: how they are run.
    """
    results = run_with_errors({name: on_exudyn(case) for name, case in cases.items()}, chosen, HALVED)
    numbers = with_errors(measure(results))
    solver = SolverSettings(tolerance=8.0 * TOLERANCE)
    witnesses = {
        name: replace(case, accuracy=None, formulation="compiled", solver=solver)
        for name, case in cases.items()
    }
    if not all(formulation("compiled").covers(case) for case in witnesses.values()):
        return results, numbers
    folder = chosen.kept and chosen.kept.with_name(WITNESSES)
    again = measure(run_with_errors(witnesses, replace(chosen, kept=folder), HALVED))
    known = {(one.name, one.case): one.value for one in again}
    return results, [replace(one, witness=known.get((one.name, one.case))) for one in numbers]


def on_exudyn(case: Scenario) -> Scenario:
    """A case on Exudyn, at the longer of both steps."""
    chosen = settings_for(replace(case, accuracy=None, formulation="exudyn", solver=SolverSettings()), LONGER)
    if any(isinstance(pin.contact.friction, Frictionless) for pin in case.clearance_pins.values()):
        return replace(chosen, solver=replace(chosen.solver, impact_steps=LOOSE))
    return chosen


@contextmanager
def compiling() -> Iterator[None]:
    """Compile the witness meanwhile, in a process of low priority; what is compiled is kept on disk."""
    code = (
        "import os; getattr(os, 'nice', int)(19); from support_exudyn.sweeps.warm_up import warm_up; warm_up()"
    )
    process = subprocess.Popen([sys.executable, "-c", code], stderr=subprocess.DEVNULL)
    try:
        yield
    finally:
        process.terminate()
        process.wait()


def with_errors(numbers: Sequence[Number]) -> list[Number]:
    """Numbers of Exudyn with the errors that the top of this module defines; closed forms stay without."""
    alike: dict[tuple[str, str], list[Number]] = {}
    for one in numbers:
        alike.setdefault((one.case, one.unit), []).append(one)

    def error(one: Number) -> float:
        others = alike[one.case, one.unit]
        errors = [SAFETY * other.numerical_error for other in others if other.numerical_error > 0.0]
        share = 1.0 if one.name.startswith(EXTREMES) else ALIKE
        return max(SAFETY * one.numerical_error, share * median(errors), LEAST * abs(one.value))

    return [replace(one, numerical_error=error(one)) if one.numerical_error > 0.0 else one for one in numbers]


# --- sentences ---


def computed_by() -> str:
    """Engine and method of the numbers, and those of the witness."""
    return (
        f"Computed by Exudyn {installed('exudyn')}: rigid bodies in redundant coordinates, generalised-alpha "
        "time integration, Python user-function connector; witness: own Runge-Kutta method with error "
        f"control, tolerance {TOLERANCE:.0e}.".replace("e-0", "e-")
    )


def is_within(number: Number) -> bool:
    """Whether the witness differs by no more than the printed error; only of a number that has one."""
    assert number.witness is not None
    return abs(number.value - number.witness) <= number.numerical_error


def verdict(numbers: Sequence[Number]) -> str:
    """How many numbers the witness confirms, and which it does not, in a sentence or two."""
    judged = [one for one in numbers if one.witness is not None]
    beyond = [f"{one.name.replace('_', ' ')} ({one.case})" for one in judged if not is_within(one)]
    sentence = (
        f"The witness has {len(judged)} of the {len(numbers)} numbers, and differs from Exudyn by no more than "
        f"the printed error in {len(judged) - len(beyond)} of them ([@{NUMBERS}])."
    )
    return f"{sentence} Beyond it: {'; '.join(beyond)}." if beyond else sentence
