"""What accuracy costs: the error of one number over computing time, by this program and by others.

The work is the paper's rise with 1.5 mm of clearance and friction in the rear-link pin; the number is the
largest force in that pin. Its error is the distance from a run of the compiled formulation at a tolerance of
1e-12. Programs that are not installed are left out.
"""

import os
import platform
import statistics
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from studies.benchmarking.peers.in_drake import run_drake
from studies.benchmarking.peers.in_mujoco import run_mujoco
from studies.benchmarking.peers.in_scipy import run_lsoda
from studies.benchmarking.peers.on_exudyn import run_stock
from studies.benchmarking.peers.plain_support import PeerRun
from studies.common import paper_machine
from support_exudyn import Estimate, Scenario, SolverSettings, simulate
from support_exudyn.commands.command_line import warn
from support_exudyn.formulations.registry import FormulationName
from support_exudyn.postprocessing.figures import style
from support_exudyn.sweeps.warm_up import warm_up

CLEARANCE_MM = 1.5
REST_VELOCITY = 1e-3  # of the law [m/s]
TIGHT = (1e-12, 1e-11)  # tolerances of the reference, and of the run that gives its error
WORK = "rise of 5 s, 1.5 mm, friction 0.25"
SHORT, TURNS = 1.0, 3  # a run that is shorter [s] is timed so often, and the median counts
GOOD = 1e-3  # error of the largest force by which programs are compared in the table
COMPILED: FormulationName = "compiled"
ENGINE: FormulationName = "exudyn"
PRESETS = ("draft", "standard", "reference")


def rise(friction: float = paper_machine.SLIDING_COEFFICIENT) -> Scenario:
    """The paper's rise with clearance in the rear-link pin and so much sliding friction, without settings."""
    scenario = paper_machine.clearance_rise(CLEARANCE_MM, friction, 5e-4, law=paper_machine.PAPERS_LAW)
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


@dataclass(frozen=True)
class PeerProgram:
    """A program or a way to use it.

    settings: labels and values from coarse to fine. run: the scenario by a setting, and the largest pin force
    [N]. package: that has to be installed. slow: labels of settings that take minutes.
    """

    name: str
    settings: Mapping[str, Any]
    run: Callable[[Scenario, Any], float]
    package: str = ""
    slow: Sequence[str] = ()

    @property
    def is_installed(self) -> bool:
        """Whether it can be run here."""
        return not self.package or find_spec(self.package) is not None


class TradePoint(NamedTuple):
    """A program by a setting: processor time [s], its ratio to that of COMMON, error of the force [-]."""

    program: str
    setting: str
    seconds: float
    ratio: float
    error: float


def _to_accuracy(formulation: FormulationName) -> Callable[[Scenario, Any], float]:
    return lambda scenario, accuracy: _largest(replace(scenario, formulation=formulation, accuracy=accuracy))


def _once(formulation: FormulationName) -> Callable[[Scenario, Any], float]:
    def run(scenario: Scenario, settings: Mapping[str, Any]) -> float:
        solver = SolverSettings(**settings["solver"], result_checks=False)
        step = settings.get("step", scenario.step)
        return _largest(replace(scenario, formulation=formulation, step=step, solver=solver))

    return run


def _largest(scenario: Scenario) -> float:
    (force,) = simulate(scenario).largest_force.values()
    return force


def _of_peer(run: Callable[[Scenario, float], PeerRun]) -> Callable[[Scenario, Any], float]:
    return lambda scenario, setting: run(scenario, setting).largest


def _steps(*steps: float) -> Mapping[str, float]:
    return {f"step {1e3 * step:g} ms": step for step in steps}


OURS_COMPILED, OURS_ENGINE = "support-exudyn, compiled", "support-exudyn on Exudyn"
ONCE = ", single run"
STOCK = "Exudyn, stock recipe"
COMMON = (OURS_COMPILED, "standard")
_ACCURACIES = dict(zip(PRESETS, PRESETS, strict=True))
_TOLERANCES = {f"tolerance {x:.0e}": {"solver": {"tolerance": x}} for x in (1e-3, 1e-4, 1e-5, 1e-6)}
_IMPACTS = {
    f"{n} steps an impact": {"step": step, "solver": {"impact_steps": n}}
    for step, n in ((1e-3, 64), (1e-3, 256), (5e-4, 512))
}
_OF_DRAKE = {f"accuracy {x:.0e}": x for x in (1e-2, 1e-3, 1e-4, 1e-5)}
_OF_LSODA = {f"tolerance {x:.0e}": x for x in (1e-4, 1e-5, 1e-6, 1e-7)}
PROGRAMS: Mapping[str, PeerProgram] = {
    one.name: one
    for one in (
        PeerProgram(OURS_COMPILED, _ACCURACIES, _to_accuracy(COMPILED)),
        PeerProgram(OURS_ENGINE, _ACCURACIES, _to_accuracy(ENGINE), slow=["reference"]),
        PeerProgram(OURS_COMPILED + ONCE, _TOLERANCES, _once(COMPILED)),
        PeerProgram(OURS_ENGINE + ONCE, _IMPACTS, _once(ENGINE)),
        PeerProgram(STOCK, _steps(3e-4, 2e-4, 1e-4, 5e-5), _of_peer(run_stock)),
        PeerProgram("MuJoCo", _steps(2e-4, 1e-4, 5e-5, 2e-5), _of_peer(run_mujoco), "mujoco"),
        PeerProgram("Drake", _OF_DRAKE, _of_peer(run_drake), "pydrake"),
        PeerProgram("scipy's LSODA", _OF_LSODA, _of_peer(run_lsoda)),
    )
}


# --- measured ---


def measured(names: Sequence[str] = tuple(PROGRAMS), with_slow: bool = False) -> Iterator[TradePoint]:
    """Run the programs that are installed, each by all its settings beside COMMON."""
    programs = [PROGRAMS[one] for one in names if PROGRAMS[one].is_installed]
    if not programs:
        return
    warm_up(with_legs=False)
    scenario, exact = rise(), exact_force().value
    name, setting = COMMON
    common = PROGRAMS[name]
    _timed(lambda: common.run(scenario, setting))  # imports
    for program in programs:
        warn(f"{WORK}: {program.name}")
        beside, _ = _timed(lambda: common.run(scenario, setting))
        for label, value in program.settings.items():
            if with_slow or label not in program.slow:
                seconds, force = _timed(lambda p=program, v=value: p.run(scenario, v))  # type: ignore[misc]
                yield TradePoint(program.name, label, seconds, seconds / beside, abs(force / exact - 1.0))


def _timed(run: Callable[[], float]) -> tuple[float, float]:
    """Processor time [s] and outcome of a run; of a short one the median of several."""
    times = []
    for _ in range(TURNS):
        began = time.process_time()
        found = run()
        times.append(time.process_time() - began)
        if times[0] > SHORT:
            break
    return statistics.median(times), found


def machine_name() -> str:
    """Processor and number of cores."""
    name, cpuinfo = platform.processor() or platform.machine(), Path("/proc/cpuinfo")
    if cpuinfo.exists():
        models = (line.partition(":")[2] for line in cpuinfo.read_text().splitlines() if "model name" in line)
        name = next(models, name).strip()
    return f"{name}, {os.cpu_count()} cores"


CAPTION = (
    f"Relative error of the largest force in the rear-link pin over processor time ({WORK}), against the "
    "compiled formulation at a tolerance of 1e-12. Where a finer setting has a larger error, that is drawn. "
    "Filled circles: runs to an accuracy, at least three each, that report their error; all others are single "
    "runs. Exudyn, stock recipe: generalised alpha at fixed steps, the contact as a Python user function, no "
    "impact located. support-exudyn on Exudyn: the same engine and integrator with located impacts; compiled: "
    "an embedded Runge-Kutta 5(4) method with error control. MuJoCo: Runge-Kutta 4 at fixed steps; Drake: "
    "Runge-Kutta 3 with error control; LSODA: equations of motion by hand."
)


def lasting_errors(points: Sequence[TradePoint]) -> list[float]:
    """Of one program's settings, from coarse to fine: the largest error of a setting and all finer ones.

    So an error that is small by chance, as that of a single number may be, does not count.
    """
    found: list[float] = np.maximum.accumulate([one.error for one in reversed(points)])[::-1].tolist()
    return found


def cheapest(points: Sequence[TradePoint], program: str, error: float = GOOD) -> TradePoint | None:
    """The fastest setting of a program whose error, and that of all finer ones, is at most so large."""
    mine = [one for one in points if one.program == program]
    good = [one for one, lasting in zip(mine, lasting_errors(mine), strict=True) if lasting <= error]
    return min(good, key=lambda one: one.ratio) if good else None


# --- the figure ---

# by program: colour, marker; ours are blue
LOOKS: Mapping[str, tuple[str, str]] = {
    OURS_COMPILED: ("#0072B2", "o"),
    OURS_ENGINE: ("#56B4E9", "o"),
    STOCK: ("#000000", "s"),
    "MuJoCo": ("#D55E00", "P"),
    "Drake": ("#882255", "^"),
    "scipy's LSODA": ("#009E73", "v"),
}
SMALLEST = 1e-10  # errors below are those of the reference


def figure(points: Sequence[TradePoint]) -> Figure:
    """Errors of all programs over their processor time, on logarithmic axes."""
    drawing = Figure(figsize=style.size(160, 100))
    axes = drawing.subplots()
    for name in PROGRAMS:
        _line(axes, name, [one for one in points if one.program == name])
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


def _line(axes: Axes, name: str, points: Sequence[TradePoint]) -> None:
    if not points:
        return
    colour, marker = LOOKS[name.removesuffix(ONCE)]
    reports = name in (OURS_COMPILED, OURS_ENGINE)
    x = [one.seconds for one in points]
    y = [max(error, SMALLEST) for error in lasting_errors(points)]
    label = f"{name},\nto an accuracy" if reports else name.replace(ONCE, f"{ONCE[:1]}\nsingle run")
    axes.plot(
        x,
        y,
        color=colour,
        marker=marker,
        ms=7.0 if reports else 5.0,
        mfc=colour if reports else "white",
        lw=1.8 if reports else 1.0,
        ls="--" if name.endswith(ONCE) else "-",
        label=label,
    )
    if reports:
        for one, at in zip(points, y, strict=True):
            # at the edge of the axes, and where two points can be next to each other
            is_left = (one.setting, name) in ((PRESETS[-1], OURS_ENGINE), (PRESETS[1], OURS_COMPILED))
            axes.annotate(
                f'"{one.setting}"',
                (one.seconds, at),
                (-7, -2) if is_left else (7, -2),
                textcoords="offset points",
                ha="right" if is_left else "left",
                fontsize=7.5,
                color=colour,
                bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 0.5},
            )
