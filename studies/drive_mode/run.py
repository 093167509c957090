"""What does the oil inlet's drive mode do to the rise? (Section 5 of the paper.)

Mode 1 starts and stops the columns suddenly, mode 2 gently; with the ideal pin and with 1.5 mm of clearance;
on rigid columns, which pass a jump of speed on as an impulse, on columns of oil, in which its peaks have a
limit, and on hydraulic cylinders, which no displacement drives but the oil that a valve lets in.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property

import numpy as np
from matplotlib.figure import Figure

from studies.common import rise
from studies.common.numbers import Found, Measures, Number, against, by_case, cell
from studies.common.panels import finish, grid, heading
from studies.common.study import LivePanels, Study
from studies.common.words import text_table
from studies.drive_mode import cases
from studies.drive_mode.cases import (
    END,
    MODES,
    OIL,
    PEAK,
    PINS,
    SOFTEST,
    START,
    START_PINS,
    STIFFEST,
    STOP,
    USUAL,
    ModePlan,
    case_name,
    extension,
    start_name,
)
from support_exudyn import Result, Scenario, SuddenOpening
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.page.pieces import Sheet

SAVED = (START, STOP, "std_pin_force", "rms_pin_force", "largest_angular_acceleration")
IMPULSE = "an impulse"
VELOCITY = "rms_angular_velocity"
CONVERGED = 0.01  # error of a number that has a limit, as a share of it
# panels to look into, by figure
PIN_FORCES = {6: "pin force, mode 1 [kN]", 7: "pin force, mode 2 [kN]"}
LIVE: dict[str, LivePanels] = {
    "fig13_rigid_columns": PIN_FORCES, "fig13_oil_columns": PIN_FORCES,
    "cylinders": {2: "speed, front, mode 1 [mm/s]", 4: "pressure, rear, mode 1 [MPa]", **PIN_FORCES},
}  # fmt: skip


# --- tables ---


def tables(plan: ModePlan, numbers: Sequence[Number]) -> dict[str, Sheet]:
    """The largest pin force by actuators and pin; what the gentle drive saves; the band of the oil."""
    found, watched = by_case(numbers), plan.subject.watched
    kinds = [(columns, pin) for columns in plan.columns for pin in plan.pins]

    def both(name: str, columns: str, pin: str) -> list[Number | None]:
        return [found.get((name, case_name(mode, pin, columns))) for mode in MODES]

    def saved(name: str, columns: str, pin: str) -> str:
        sudden, gentle = both(name, columns, pin)
        return IMPULSE if sudden is None or gentle is None else against(gentle, sudden)

    windows = {START: f"{watched.start:g} to {watched.end:g} s", STOP: f"after {watched.end:g} s"}
    peaks = [
        (*kind, *(cell(both(name, *kind)[n], 1e-3) or IMPULSE for n in range(len(MODES)) for name in windows))
        for kind in kinds
    ]
    headings = (f"{mode}, {window} [kN]" for mode in MODES for window in windows.values())
    names = (*SAVED, *(f"largest_{actuator}_force" for actuator in plan.actuators))
    savings = [(name.replace("_", " "), *(saved(name, *kind) for kind in kinds)) for name in names]
    sheets = {
        "drive_modes": text_table(("actuators", "pin", *headings), peaks, left=2),
        "table_saving": text_table(("quantity", *(f"{columns}, {pin}" for columns, pin in kinds)), savings),
    }
    if plan.subject.is_paper:
        rows = []
        for pin, title in START_PINS.items():
            change = "" if pin == PINS[0] else against(peak(found, pin), peak(found, PINS[0]))
            usual, soft, stiff = (cell(peak(found, pin, oil)) for oil in (USUAL, SOFTEST, STIFFEST))
            rows.append((title, usual, change, soft, stiff))
        header = ("pin", "peak [kN]", "against ideal", f"{SOFTEST} [kN]", f"{STIFFEST} [kN]")
        sheets["assumed"] = text_table(header, rows)
    return sheets


def peak(found: Found, pin: str, oil: str = USUAL) -> Number:
    """The peak of the sudden start, by pin and oil."""
    return found[PEAK, start_name(pin, oil)]


def band(found: Found, pin: str) -> str:
    """From where to where the peak of a pin may lie, in words."""
    peaks = [peak(found, pin, oil).value for oil in OIL]
    return f"{min(peaks):.0f} to {max(peaks):.0f} kN"


# --- figures: counterparts of Fig. 13 of the paper, and the rise on hydraulic cylinders ---

Curve = Callable[[Result], rise.Series]  # what is drawn of a run at its records


def figures(plan: ModePlan, results: Mapping[str, Result]) -> dict[str, Figure]:
    """All figures, by file name."""
    watched, first = plan.subject.watched, plan.actuators[0]
    curves: dict[str, Curve] = {
        "extension [mm]": lambda run: 1e3 * extension(run, first),
        "angular velocity\n[deg/s]": lambda run: rise.DEGREES * run[watched.speed],
        "angular acceleration\n[deg/s²]": lambda run: rise.DEGREES * run[watched.acceleration],
        "pin force [kN]": lambda run: 1e-3 * run[watched.force],
    }
    found = {
        f"fig13_{columns}_columns": by_mode(plan, results, columns, curves)
        for columns in ("oil", "rigid")
        if columns in plan.columns
    }
    if plan.subject.is_paper:
        found["cylinders"] = by_mode(plan, results, "cylinder", ON_CYLINDERS)
    return found


def _behind(run: Result) -> rise.Series:
    """How far the front columns are behind the displacement drive of the mode [mm]."""
    sudden = isinstance(run.scenario.valved["front_column"].inlet, SuddenOpening)
    drive = MODES["mode 1" if sudden else "mode 2"]()
    driven = np.array([drive.extension(t) for t in run.time.tolist()])
    return np.asarray(1e3 * (driven - extension(run, "front_column")))


ON_CYLINDERS: dict[str, Curve] = {
    "behind the drive\n[mm]": _behind,
    "speed, front\n[mm/s]": lambda run: 1e3 * np.gradient(extension(run, "front_column"), run.time),
    "pressure, rear\n[MPa]": lambda run: 1e-6 * run["rear_column.pressure"],
    "pin force [kN]": lambda run: 1e-3 * run[rise.FORCE],
}


def by_mode(plan: ModePlan, results: Mapping[str, Result], columns: str, curves: Mapping[str, Curve]) -> Figure:
    """A column of panels for each mode, a row for each quantity, with the same scale in both."""
    drawing, panels = grid(165, len(curves), 2, sharey="row", sharex=True)
    watched = plan.subject.watched
    margin = 0.05 * (watched.end - watched.start)
    end = END if columns == "cylinder" else watched.end + margin
    looks = ((plan.pins[1], style.WITH_CLEARANCE, "-", 1.0), (plan.pins[0], style.IDEAL, (0, (4, 2)), 0.8))
    for column, mode in zip(panels.T, MODES, strict=True):
        for axes, (label, curve) in zip(column, curves.items(), strict=True):
            for pin, colour, dashes, width in looks:
                run = results[case_name(mode, pin, columns)]
                inside = rise.between(run, watched.start - margin, end)
                axes.plot(run.time[inside], curve(run)[inside], color=colour, ls=dashes, lw=width, label=pin)
            axes.set(xlim=(watched.start - margin, end), xticks=np.linspace(watched.start, watched.end, 5))
            if mode == "mode 1":
                axes.set_ylabel(label)
        heading(column[0], mode)
        column[-1].set_xlabel("time [s]")
    drawing.align_ylabels(panels[:, 0])
    return finish(drawing, panels, 2)


# --- the study ---


def velocity_converges(found: Found) -> bool:
    """Whether the paper's Fig. 13 b, for mode 1 on rigid columns, has a limit: its errors are small."""
    numbers = [found[VELOCITY, case_name("mode 1", pin, "rigid")] for pin in PINS]
    return all(one.numerical_error <= CONVERGED * one.value for one in numbers)


class DriveMode(Study):
    """What does the oil inlet's drive mode do to the rise? (Section 5 of the paper.)"""

    name, seconds = "drive_mode", 50.0
    own_machine = has_witness = True
    live = LIVE

    @cached_property
    def plan(self) -> ModePlan:
        """The cases of the machine."""
        return ModePlan(self.subject)

    def cases(self) -> dict[str, Scenario]:
        """Both modes on all kinds of columns, and the start by assumptions."""
        return {**self.plan.scenarios, **self.plan.starts}

    def measures(self, run: Result) -> Measures:
        """Every number that has a limit."""
        return self.plan.measures(run)

    def saved(self) -> dict[str, Result]:
        """The rises."""
        return {name: self.runs[name] for name in self.plan.scenarios}

    def figures(self) -> dict[str, Figure]:
        """Counterparts of Fig. 13."""
        return figures(self.plan, self.saved())

    def tables(self) -> dict[str, Sheet]:
        """Largest forces, savings, the band of the oil."""
        return tables(self.plan, self.numbers)

    def words(self) -> dict[str, object]:
        """Cases, and what is computed of several."""
        plan, found, is_paper = self.plan, self.found, self.subject.is_paper
        ideal, with_clearance = plan.pins
        struck = case_name("mode 1", with_clearance, "rigid")  # by the sudden start

        def heat(mode: str) -> float:
            of = case_name(mode, ideal, "cylinder")
            return 100.0 * found["loss_in_valves", of].value / found["work_of_pumps", of].value

        return {
            "cases": cases,
            "plan": plan,
            "case_name": case_name,
            "START": START,
            "STOP": STOP,
            "ideal": ideal,
            "with_clearance": with_clearance,
            "softest": "oil" if "oil" in plan.columns else "rigid",
            "drive": plan.drive("mode 1", plan.leading[0]),
            "impulses": [name for name, case in found if name.startswith("impulse") and case == struck],
            "heat": {mode: heat(mode) for mode in MODES} if is_paper else {},
            "assumed": {"peak": peak, "band": band} if is_paper else None,
            "velocity_converges": is_paper and velocity_converges(found),
        }
