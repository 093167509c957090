"""What does a number cost: the error of a pin force over processor time, by this program and by others.

The work is the paper's rise with 1.5 mm of clearance and friction in the rear-link pin. The number is the
largest force in that pin. Its error is the distance from a run of the compiled formulation at a tolerance of
1e-12. The study `speed_accuracy` leaves out settings that take minutes. The command `benchmark` has them, and
its last table is `studies/benchmarking/RESULTS.md`.
"""

import statistics
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from studies.benchmarking.peers.in_scipy import run_lsoda
from studies.benchmarking.peers.on_exudyn import run_stock
from studies.common import paper_machine
from studies.common.numbers import Number
from studies.common.study import Study, print_table, work_in_folder
from support_exudyn import Estimate, Scenario, SolverSettings, simulate
from support_exudyn.commands.command_line import say, warn
from support_exudyn.files.whole_file import whole_file
from support_exudyn.formulations.registry import FormulationName
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.page.pieces import Sheet
from support_exudyn.simulation.provenance import versions
from support_exudyn.sweeps.warm_up import warm_up

HERE = Path(__file__).parent
BENCHMARK_SECONDS = 240.0  # that the command takes
FIGURE = "error_and_time"
REST_VELOCITY = 1e-3  # of the law [m/s]
TIGHT = (1e-12, 1e-11)  # tolerances of the reference, and of the run that gives its error
WORK = "rise of 5 s, 1.5 mm, friction 0.25"
SHORT, TURNS = 1.0, 3  # a run that is shorter [s] is timed so often, and the median counts
GOOD = 1e-3  # error of the largest force by which programs are compared
COMPILED: FormulationName = "compiled"
ENGINE: FormulationName = "exudyn"
PRESETS = ("draft", "standard", "reference")


@cache
def rise() -> Scenario:
    """The paper's rise with clearance and friction in the rear-link pin, at default settings of the solver."""
    scenario = paper_machine.clearance_rise(
        paper_machine.CLEARANCE_MM, paper_machine.SLIDING_COEFFICIENT, 5e-4, law=paper_machine.PAPERS_LAW
    )
    pin: Any = scenario.pins[paper_machine.CLEARANCE_PIN]
    law = replace(pin.contact.normal, rest_velocity=REST_VELOCITY)
    pins = {paper_machine.CLEARANCE_PIN: replace(pin, contact=replace(pin.contact, normal=law))}
    return replace(scenario, pins=pins, record_period=1e-3, solver=SolverSettings())


@cache
def exact_force() -> Estimate:
    """The largest pin force of the rise [N] by the compiled formulation at a tolerance of 1e-12.

    Its error is the distance from a run at ten times the tolerance.
    """
    solvers = (SolverSettings(tolerance=tolerance) for tolerance in TIGHT)
    tight, looser = (_largest(replace(rise(), formulation=COMPILED, solver=solver)) for solver in solvers)
    return Estimate(tight, abs(looser - tight), "N")


# --- programs ---


@dataclass(frozen=True)
class PeerProgram:
    """A program or a way to use it.

    settings: labels and values from coarse to fine. run: the scenario by a setting, and the largest pin force
    [N]. look: colour and marker in the figure. slow: labels of settings that take minutes.
    """

    name: str
    settings: Mapping[str, Any]
    run: Callable[[Scenario, Any], float]
    look: tuple[str, str]
    slow: Sequence[str] = ()


class TradePoint(NamedTuple):
    """A program by a setting: processor time [s] and relative error of the force."""

    program: str
    setting: str
    seconds: float
    error: float


def _largest(scenario: Scenario) -> float:
    (force,) = simulate(scenario).largest_force.values()
    return force


def _to_accuracy(formulation: FormulationName) -> Callable[[Scenario, Any], float]:
    return lambda scenario, accuracy: _largest(replace(scenario, formulation=formulation, accuracy=accuracy))


def _compiled_once(scenario: Scenario, tolerance: float) -> float:
    solver = SolverSettings(tolerance=tolerance, result_checks=False)
    return _largest(replace(scenario, formulation=COMPILED, solver=solver))


def _engine_once(scenario: Scenario, steps: tuple[float, int]) -> float:
    solver = SolverSettings(impact_steps=steps[1], result_checks=False)
    return _largest(replace(scenario, formulation=ENGINE, step=steps[0], solver=solver))


OURS_COMPILED, OURS_ENGINE = "support-exudyn, compiled", "support-exudyn on Exudyn"
ONCE = ", single run"
STOCK = "Exudyn, stock recipe"
_ACCURACIES = {preset: preset for preset in PRESETS}
_IMPACTS = {f"{n} steps an impact": (step, n) for step, n in ((1e-3, 64), (1e-3, 256), (5e-4, 512))}
_BLUE, _LIGHT_BLUE = ("#0072B2", "o"), ("#56B4E9", "o")  # of this program
PROGRAMS: Mapping[str, PeerProgram] = {
    program.name: program
    for program in (
        PeerProgram(OURS_COMPILED, _ACCURACIES, _to_accuracy(COMPILED), _BLUE),
        PeerProgram(OURS_ENGINE, _ACCURACIES, _to_accuracy(ENGINE), _LIGHT_BLUE, slow=["reference"]),
        PeerProgram(
            OURS_COMPILED + ONCE,
            {f"tolerance {x:.0e}": x for x in (1e-3, 1e-4, 1e-5, 1e-6)},
            _compiled_once,
            _BLUE,
        ),
        PeerProgram(OURS_ENGINE + ONCE, _IMPACTS, _engine_once, _LIGHT_BLUE),
        PeerProgram(
            STOCK,
            {f"step {1e3 * step:g} ms": step for step in (3e-4, 2e-4, 1e-4, 5e-5)},
            lambda scenario, step: run_stock(scenario, step).force.max(),
            ("#000000", "s"),
        ),
        PeerProgram(
            "scipy's LSODA",
            {f"tolerance {x:.0e}": x for x in (1e-4, 1e-5, 1e-6, 1e-7)},
            lambda scenario, tolerance: run_lsoda(scenario, tolerance).force.max(),
            ("#009E73", "v"),
        ),
    )
}


# --- measured ---


def measured(with_slow: bool = False) -> Iterator[TradePoint]:
    """Run all programs, each by all its settings."""
    warm_up()
    scenario, exact = rise(), exact_force().value
    for program in PROGRAMS.values():
        warn(f"{WORK}: {program.name}")
        for label, value in program.settings.items():
            if with_slow or label not in program.slow:
                seconds, force = _timed(lambda p=program, v=value: p.run(scenario, v))  # type: ignore[misc]
                yield TradePoint(program.name, label, seconds, float(abs(force / exact - 1.0)))


def _timed(run: Callable[[], float]) -> tuple[float, float]:
    """Processor time [s] and outcome of a run; of a short one the median of several."""
    times = []
    for _ in range(TURNS):
        began = time.process_time()
        force = run()
        times.append(time.process_time() - began)
        if times[0] > SHORT:
            break
    return statistics.median(times), force


def lasting_errors(points: Sequence[TradePoint]) -> list[float]:
    """Of one program's settings, from coarse to fine: the largest error of a setting and all finer ones.

    So an error that is small by chance, as that of a single number may be, does not count.
    """
    errors: list[float] = np.maximum.accumulate([point.error for point in reversed(points)])[::-1].tolist()
    return errors


def cheapest(points: Sequence[TradePoint], program: str, error: float = GOOD) -> TradePoint | None:
    """The fastest setting of a program whose error, and that of all finer ones, is at most so large."""
    mine = [point for point in points if point.program == program]
    good = [point for point, lasting in zip(mine, lasting_errors(mine), strict=True) if lasting <= error]
    return min(good, key=lambda point: point.seconds) if good else None


# --- figure and table ---

CAPTION = (
    f"Relative error of the largest force in the rear-link pin over processor time ({WORK}), against the "
    "compiled formulation at a tolerance of 1e-12. Where a finer setting has a larger error, that is drawn. "
    "Filled circles: runs to an accuracy (draft, standard, reference), at least three each, that report their"
    " error; all others are single runs. Exudyn, stock recipe: generalised alpha at fixed steps, the contact "
    "as a Python user function, no impact located. support-exudyn on Exudyn: the same engine and integrator "
    "with located impacts; compiled: an embedded Runge-Kutta 5(4) method with error control. LSODA: equations"
    " of motion by hand."
)
SMALLEST = 1e-10  # errors below are those of the reference


def figure(points: Sequence[TradePoint]) -> Figure:
    """Errors of all programs over their processor time, on logarithmic axes."""
    drawing = Figure(figsize=style.size(160, 100))
    axes = drawing.subplots()
    for program in PROGRAMS.values():
        mine = [point for point in points if point.program == program.name]
        (colour, marker), reports = program.look, program.name in (OURS_COMPILED, OURS_ENGINE)
        axes.plot(
            [point.seconds for point in mine],
            [max(error, SMALLEST) for error in lasting_errors(mine)],
            color=colour,
            marker=marker,
            ms=7.0 if reports else 5.0,
            mfc=colour if reports else "white",
            lw=1.8 if reports else 1.0,
            ls="--" if program.name.endswith(ONCE) else "-",
            label=f"{program.name},\nto an accuracy"
            if reports
            else program.name.replace(ONCE, ",\nsingle run"),
        )
    axes.set(
        xscale="log",
        yscale="log",
        xlabel="processor time [s]",
        ylabel="relative error of the largest pin force",
    )
    axes.margins(x=0.08, y=0.08)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(numticks=12))
        axis.set_minor_formatter(NullFormatter())
    axes.grid(which="major", lw=0.4, color="#DDDDDD")
    drawing.legend(loc="outside right upper", fontsize=8, frameon=False)
    return drawing


def table(points: Sequence[TradePoint]) -> Sheet:
    """All settings of all programs."""
    return Sheet(
        title="What accuracy costs: error of the largest pin force and time",
        header=("program", "setting", "processor [s]", "error"),
        rows=tuple((p.program, p.setting, f"{p.seconds:.3g}", f"{p.error:.1e}") for p in points),
        caption="Processor times on one core, of short runs the median of three.",
        left=2,
    )


# --- the study ---


class SpeedAccuracy(Study):
    """What does a number cost: the error of a pin force over processor time, by this program and by others."""

    name, seconds = "speed_accuracy", 120.0

    def work(self) -> None:
        """Measure the programs one after another, for they are timed; no run is kept."""
        self.points, exact = list(measured()), exact_force()
        name = "relative error of the largest pin force"
        self.numbers = [Number("largest pin force", "reference", exact.value, "N", exact.error)] + [
            Number(name, f"{point.program}, {point.setting}", point.error, "1", exact.error / exact.value)
            for point in self.points
        ]

    def figures(self) -> dict[str, Figure]:
        """Errors over processor time."""
        return {FIGURE: figure(self.points)}

    def tables(self) -> dict[str, Sheet]:
        """All settings."""
        return {"settings": table(self.points)}

    def words(self) -> dict[str, object]:
        """The cheapest settings, and captions."""
        points = self.points
        return {
            "exact": exact_force(),
            "good": GOOD,
            "work": WORK,
            "best": {name: cheapest(points, name) for name in dict.fromkeys(point.program for point in points)},
            "headline": (OURS_COMPILED + ONCE, STOCK),
            "presets": [point for point in points if point.program in (OURS_COMPILED, OURS_ENGINE)],
            "caption": CAPTION,
            "table_caption": table(points).caption,
        }


def benchmark(*, out: Path = HERE) -> int:
    """How fast is the program among others? The command `python -m studies benchmark`.

    Args:
        out: Folder for RESULTS.md and its figure (here).
    """
    return work_in_folder(lambda out: write_results(out, list(measured(with_slow=True))), out)


def write_results(out: Path, points: Sequence[TradePoint]) -> None:
    """Print the table of all settings; write it into RESULTS.md, and the figure into the same folder."""
    sheet = table(points)
    rows = (sheet.header, ["---"] * len(sheet.header), *sheet.rows)
    packages = ", ".join(f"{name} {number}" for name, number in versions().items())
    words = [
        "# Benchmark",
        f"Made by `python -m studies benchmark`. {packages}.",
        f"![Error of the largest pin force over processor time, a line a program]({FIGURE}.png)",
        f"*{CAPTION}*",
        f"**{sheet.title}**",
        "\n".join(f"| {' | '.join(row)} |" for row in rows),
        sheet.caption,
    ]
    with style.look():
        style.save(figure(points), out, FIGURE, pdf=False)
    print_table(sheet, width=100)
    with whole_file(out / "RESULTS.md") as temporary:
        temporary.write_text("\n\n".join(words) + "\n", encoding="utf-8")
    say(f"\nlook at {out / 'RESULTS.md'}")
