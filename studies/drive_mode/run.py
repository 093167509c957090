"""What does the oil inlet's drive mode do to the rise? (Section 5 of the paper.)

Mode 1 starts and stops the columns suddenly, mode 2 gently; with the ideal pin and with 1.5 mm of clearance;
on rigid columns, which pass a jump of speed on as an impulse, on columns of oil, in which its peaks have a
limit, and on hydraulic cylinders, which no displacement drives but the oil that a valve lets in.
"""

from collections.abc import Callable, Mapping

import numpy as np
from matplotlib.figure import Figure

from studies.common import rise
from studies.common.numbers import Number, against, cell
from studies.common.panels import finish, grid, heading
from studies.common.study import LivePanels
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
    ModeCases,
    case_name,
    extension,
    start_name,
)
from support_exudyn import Result, SuddenOpening
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
Curve = Callable[[Result], rise.Series]  # what is drawn of a run at its records


class DriveMode(ModeCases):
    """What does the oil inlet's drive mode do to the rise? (Section 5 of the paper.)"""

    name, seconds, live = "drive_mode", 50.0, LIVE

    def saved(self) -> dict[str, Result]:
        return {name: self.runs[name] for name in self.rises}

    def tables(self) -> dict[str, Sheet]:
        """The largest pin force by actuators and pin; what the gentle drive saves; the band of the oil."""
        watched, kinds = self.subject.watched, [(one, pin) for one in self.columns for pin in self.pins]

        def both(name: str, columns: str, pin: str) -> list[Number | None]:
            return [self.found.get((name, case_name(mode, pin, columns))) for mode in MODES]

        def saved(name: str, columns: str, pin: str) -> str:
            sudden, gentle = both(name, columns, pin)
            return IMPULSE if sudden is None or gentle is None else against(gentle, sudden)

        windows = {START: f"{watched.start:g} to {watched.end:g} s", STOP: f"after {watched.end:g} s"}
        headings = (f"{mode}, {window} [kN]" for mode in MODES for window in windows.values())
        peaks = []
        for kind in kinds:
            numbers = (both(name, *kind)[n] for n in range(len(MODES)) for name in windows)
            peaks.append((*kind, *(cell(number, 1e-3) or IMPULSE for number in numbers)))
        names = (*SAVED, *(f"largest_{actuator}_force" for actuator in self.actuators))
        savings = [(name.replace("_", " "), *(saved(name, *kind) for kind in kinds)) for name in names]
        sheets = {
            "drive_modes": text_table(("actuators", "pin", *headings), peaks, left=2),
            "table_saving": text_table(("quantity", *(f"{one}, {pin}" for one, pin in kinds)), savings),
        }
        if self.subject.is_paper:
            rows = []
            for pin, title in START_PINS.items():
                change = "" if pin == PINS[0] else against(self.peak(pin), self.peak(PINS[0]))
                usual, soft, stiff = (cell(self.peak(pin, oil)) for oil in (USUAL, SOFTEST, STIFFEST))
                rows.append((title, usual, change, soft, stiff))
            header = ("pin", "peak [kN]", "against ideal", f"{SOFTEST} [kN]", f"{STIFFEST} [kN]")
            sheets["assumed"] = text_table(header, rows)
        return sheets

    def peak(self, pin: str, oil: str = USUAL) -> Number:
        """The peak of the sudden start, by pin and oil."""
        return self.found[PEAK, start_name(pin, oil)]

    def band(self, pin: str) -> str:
        """From where to where the peak of a pin may lie, in words."""
        peaks = [self.peak(pin, oil).value for oil in OIL]
        return f"{min(peaks):.0f} to {max(peaks):.0f} kN"

    def heat(self, mode: str) -> float:
        """Share of the pumps' work that valves and seals turn into heat [%]."""
        loss, work = (
            self.found[name, case_name(mode, PINS[0], "cylinder")].value
            for name in ("loss_in_valves", "work_of_pumps")
        )
        return 100.0 * loss / work

    def words(self) -> dict[str, object]:
        ideal, with_clearance = self.pins
        struck = case_name("mode 1", with_clearance, "rigid")  # by the sudden start
        # whether the paper's Fig. 13 b, for mode 1 on rigid columns, has a limit: its errors are small
        velocities = [self.found[VELOCITY, case_name("mode 1", pin, "rigid")] for pin in self.pins]
        return {
            "cases": cases,
            "case_name": case_name,
            "START": START,
            "STOP": STOP,
            "ideal": ideal,
            "with_clearance": with_clearance,
            "softest": "oil" if "oil" in self.columns else "rigid",
            "drive": self.drive("mode 1", self.leading[0]),
            "impulses": [name for name, case in self.found if name.startswith("impulse") and case == struck],
            "velocity_converges": all(one.numerical_error <= CONVERGED * one.value for one in velocities),
        }

    # --- counterparts of Fig. 13 of the paper, and the rise on hydraulic cylinders ---

    def figures(self) -> dict[str, Figure]:
        watched, first = self.subject.watched, self.actuators[0]
        curves: dict[str, Curve] = {
            "extension [mm]": lambda run: 1e3 * extension(run, first),
            "angular velocity\n[deg/s]": lambda run: rise.DEGREES * run[watched.speed],
            "angular acceleration\n[deg/s²]": lambda run: rise.DEGREES * run[watched.acceleration],
            "pin force [kN]": lambda run: 1e-3 * run[watched.force],
        }
        found = {
            f"fig13_{columns}_columns": self.by_mode(columns, curves)
            for columns in ("oil", "rigid")
            if columns in self.columns
        }
        if self.subject.is_paper:
            found["cylinders"] = self.by_mode("cylinder", ON_CYLINDERS)
        return found

    def by_mode(self, columns: str, curves: Mapping[str, Curve]) -> Figure:
        """A column of panels for each mode, a row for each quantity, with the same scale in both."""
        drawing, panels = grid(165, len(curves), 2, sharey="row", sharex=True)
        watched = self.subject.watched
        margin = 0.05 * (watched.end - watched.start)
        end = END if columns == "cylinder" else watched.end + margin
        looks = ((self.pins[1], style.WITH_CLEARANCE, "-", 1.0), (self.pins[0], style.IDEAL, (0, (4, 2)), 0.8))
        for column, mode in zip(panels.T, MODES, strict=True):
            for axes, (label, curve) in zip(column, curves.items(), strict=True):
                for pin, colour, dashes, width in looks:
                    run = self.runs[case_name(mode, pin, columns)]
                    inside = rise.between(run, watched.start - margin, end)
                    values = curve(run)[inside]
                    axes.plot(run.time[inside], values, color=colour, ls=dashes, lw=width, label=pin)
                axes.set(xlim=(watched.start - margin, end), xticks=np.linspace(watched.start, watched.end, 5))
                if mode == "mode 1":
                    axes.set_ylabel(label)
            heading(column[0], mode)
            column[-1].set_xlabel("time [s]")
        drawing.align_ylabels(panels[:, 0])
        return finish(drawing, panels, 2)


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
