"""The same numbers by two formulations that share nothing but the machine's data and the laws' constants."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from studies.common.numbers import Number, cell, measured
from studies.common.options import Options
from studies.common.runs import run_cases, run_with_errors
from studies.common.words import TextTable
from support_exudyn import Result, SolverSettings

SIZE_MM = 0.5
STEP, IMPACT_STEPS = 1e-3, 128  # of the longest of the Exudyn formulation's runs [s]


@dataclass(frozen=True)
class Compared:
    """A number of a case by the cheapest formulation and by the Exudyn one."""

    chosen: Number
    exudyn: Number

    @property
    def off(self) -> float:
        """How far apart both are, in the number's unit."""
        return self.exudyn.value - self.chosen.value

    @property
    def error(self) -> float:
        """Both errors together, in the number's unit."""
        return self.exudyn.numerical_error + self.chosen.numerical_error


def compared(options: Options) -> list[Compared]:
    """Statistics of the pin's force over the rise, ideal and with a small clearance and friction."""
    subject = options.subject
    cases = {
        "ideal, friction": subject.ideal(subject.friction),
        f"{SIZE_MM:g} mm, friction": subject.with_clearance(SIZE_MM, subject.friction),
    }
    solver = SolverSettings(impact_steps=IMPACT_STEPS)
    engine = {
        name: replace(case, accuracy=None, formulation="exudyn", step=STEP, solver=solver)
        for name, case in cases.items()
    }
    chosen, exudyn = run_cases(cases, options), run_with_errors(engine, options)
    watched = subject.watched

    measures: dict[str, Callable[[Result], float]] = {
        "mean force": lambda run: watched.mean(run, watched.force),
        "spread": lambda run: watched.spread(run, watched.force),
        "RMS fluctuation": lambda run: watched.rms_fluctuation(run, run[watched.force]),
    }
    return [
        Compared(*(measured(what, name, "N", runs[name], function) for runs in (chosen, exudyn)))
        for name in cases
        for what, function in measures.items()
    ]


def agree(found: Sequence[Compared]) -> bool:
    """Whether all numbers are the same within their errors."""
    return all(abs(one.off) <= one.error for one in found)


def numbers(found: Sequence[Compared]) -> list[Number]:
    """What the summary says of them."""
    return [
        replace(one, name=f"{one.name}, {formulation}")
        for both in found
        for formulation, one in (("cheapest formulation", both.chosen), ("exudyn", both.exudyn))
    ]


def table(found: Sequence[Compared]) -> TextTable:
    """All of them side by side."""
    header = (
        "case",
        "pin force [N]",
        "compiled",
        "rigid bodies, constraints",
        "difference",
        "errors",
    )
    rows = tuple(
        (
            one.chosen.case,
            one.chosen.name,
            cell(one.chosen),
            cell(one.exudyn),
            f"{one.off:.2g}",
            f"{one.error:.2g}",
        )
        for one in found
    )
    return TextTable(header, rows, left=2, width=130)
