"""What do the paper's drive modes become if valves and a pump make them?

A valve opens at once (mode 1) or along a ramp (mode 2) and lets oil of a pump into both rows of columns. The
usual station gives 450 l/min, shared by all; a station without a limit makes the paper's rise of 2 s.
"""

import itertools
import math
from collections.abc import Mapping
from dataclasses import replace
from functools import partial

from matplotlib.figure import Figure

from studies.common import paper_machine, rise
from studies.common.numbers import Measured, Measures, cell
from studies.common.panels import finish, grid
from studies.common.paper_machine import CLEARANCE_MM
from studies.common.study import Study
from studies.common.words import text_table
from studies.drive_mode.cases import extension, extension_at, speed
from support_exudyn import (
    CheckValve,
    Inlet,
    PumpStation,
    RampedOpening,
    Result,
    Scenario,
    SolverSettings,
    SuddenOpening,
    YieldValve,
)
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.page.pieces import Sheet

START, LONG, SHORT = 3.0, 15.0, 5.0  # the valve opens, and closes on the limited pump and on the other [s]
AFTER = 1.0  # of a run, after the valve has closed [s]
PERIOD = 1e-3  # between records [s]
VAPOUR = -99e3  # of water, above the atmosphere's [Pa]
PUMP = PumpStation(flow=450e-3 / 60.0, pressure=paper_machine.SYSTEM_PRESSURE)
CHECK = CheckValve(pilot_ratio=4.0)
YIELD = YieldValve(opening_pressure=40e6, rated_flow=1.0 / 60.0, rated_overpressure=4e6)
MODES = ("mode 1", "mode 2")
PUMPS = ("450 l/min", "no limit")
OILS = ("boils", "pulls")
PINS = ("ideal pin", f"{CLEARANCE_MM} mm")
ROWS = ("front", "rear")
FIRST = SolverSettings(tolerance=1e-5)  # of the first of three runs, each finer than the one before
CHANNELS = ("front_column.*", "rear_column.*", "pin.rear_base.force", "energy.*")
MIDDLE = (0.3, 0.7)  # of the time that the valve is open


def case_name(mode: str, pump: str, pin: str, oil: str = "boils") -> str:
    """Name of a case."""
    return f"{mode}, {pump}, {pin}" + (", oil pulls" if oil == "pulls" else "")


class ValveModes(Study):
    """What do the paper's drive modes become if valves and a pump make them?"""

    name, seconds, sentences = "valve_modes", 40.0, "valves.md.j2"

    def cases(self) -> dict[str, Scenario]:
        """Both modes on both pumps, with both pins, and with oil that pulls; the longest first."""
        paper, found = self.subject, {}
        for pump, pin, oil, mode in itertools.product(PUMPS, reversed(PINS), OILS, MODES):
            base = paper.ideal(paper.friction)
            if pin != PINS[0]:
                base = paper.with_clearance(CLEARANCE_MM, paper.friction)
            limited = pump == PUMPS[0]
            end = LONG if limited else SHORT
            inlet: Inlet = RampedOpening(start=START, end=end, ramp=paper_machine.RAMP)
            if mode == "mode 1":
                inlet = SuddenOpening(start=START, end=end, extent=paper_machine.SUDDEN_OPENING)
            vapour = VAPOUR if oil == "boils" else None
            columns = {
                name: replace(column, check_valve=CHECK, yield_valve=YIELD, vapour_pressure=vapour)
                for name, column in paper_machine.hydraulic_cylinders(inlet).items()
            }
            found[case_name(mode, pump, pin, oil)] = replace(
                paper_machine.on_cylinders(base, inlet),
                actuators=columns,
                pump=PUMP if limited else None,
                duration=end + AFTER,
                record_period=PERIOD,
                accuracy=None,
                formulation="compiled",
                solver=FIRST,
                channels=(*CHANNELS, "pump.*") if limited else CHANNELS,
            )
        return found

    def measures(self, run: Result) -> Measures:
        closes = max(run.scenario.breaks)
        begin, end = (START + share * (closes - START) for share in MIDDLE)
        whole = partial(rise.Crest, begin=0.0, end=math.inf)
        found: dict[str, tuple[str, Measured]] = {
            "largest_pin_force_at_start": ("kN", rise.Crest(rise.FORCE, 1e-3, START, START + 1.0)),
            "largest_pin_force_at_end": ("kN", rise.Crest(rise.FORCE, 1e-3, closes, math.inf)),
        }
        boils = run.scenario.legs["front_column"].vapour_pressure is not None
        for row in ROWS:
            column, pressure = f"{row}_column", f"{row}_column.pressure"
            found[f"least_pressure_{row}"] = ("MPa", whole(pressure, 1e-6, extreme="min"))
            found[f"largest_pressure_{row}"] = ("MPa", whole(pressure, 1e-6, extreme="max"))
            found[f"least_force_{row}"] = ("kN", whole(f"{column}.force", 1e-3, extreme="min"))
            found[f"speed_in_mid_rise_{row}"] = ("mm/s", partial(speed, column, begin, end))
            found[f"extension_at_end_{row}"] = ("mm", partial(extension_at, column, closes))
            if boils:
                found[f"largest_cavity_{row}"] = ("ml", whole(f"{column}.cavity", 1e6, extreme="max"))
        if boils:
            found["time_with_cavity"] = ("ms", time_with_cavity)
        if run.scenario.pump is not None:
            found["least_pump_pressure"] = ("MPa", whole("pump.pressure", 1e-6, extreme="min"))
        return found

    def figures(self) -> dict[str, Figure]:
        return {"rise_by_valves": rise_figure(self.runs), "opening": start_figure(self.runs)}

    def tables(self) -> dict[str, Sheet]:
        """The pin's largest force, by pump, pin, mode and oil."""
        columns, rows = [(mode, oil) for mode in MODES for oil in OILS], []
        for when, pump, pin in itertools.product(("start", "end"), PUMPS, PINS):
            numbers = (
                self.found[f"largest_pin_force_at_{when}", case_name(mode, pump, pin, oil)]
                for mode, oil in columns
            )
            rows.append((f"at the {when}, {pump}, {pin}", *map(cell, numbers)))
        header = ("largest pin force", *(f"{mode}, oil {oil}" for mode, oil in columns))
        return {"table_pin": text_table(header, rows)}

    def words(self) -> dict[str, object]:
        return {"case_name": case_name, "pumps": PUMPS, "pins": PINS}


def time_with_cavity(result: Result) -> float:
    """How long any chamber of either row has a cavity [ms], by the instants at which cavities begin and end."""
    changes = [
        (event.time, -1 if event.begins else 1)
        for events in result.oil_events.values()
        for event in events
        if event.what.endswith("filled")
    ]
    times = [time for time, _ in sorted(changes)] + [result.scenario.duration]
    cavities = itertools.accumulate(change for _, change in sorted(changes))
    return 1e3 * sum(
        end - begin for (begin, end), n in zip(itertools.pairwise(times), cavities, strict=True) if n > 0
    )


# --- figures ---

COLOURS = dict(zip(ROWS, (style.SMOOTH, style.WITH_CLEARANCE), strict=True))
DASHES = (0, (4, 2))
ENLARGED = (START - 0.01, START + 0.25)


def rise_figure(results: Mapping[str, Result]) -> Figure:
    """Extensions of both rows, and the pump's pressure, in both modes on the limited pump."""
    drawing, panels = grid(100, 2, 2, sharex=True, sharey="row")
    for mode, (upper, lower) in zip(MODES, panels.T, strict=True):
        run = results[case_name(mode, PUMPS[0], PINS[0])]
        for row in ROWS:
            upper.plot(
                run.time, 1e3 * extension(run, f"{row}_column"), color=COLOURS[row], label=f"{row} columns"
            )
        lower.plot(run.time, 1e-6 * run["pump.pressure"], color=style.IDEAL, lw=0.9)
        upper.set_title(mode, fontsize=9)
        lower.set(xlabel="time [s]", xlim=(START - 0.5, LONG + 1.0))
    panels[0, 0].set_ylabel("extension [mm]")
    panels[1, 0].set_ylabel("pump [MPa]")
    return finish(drawing, panels, 2)


def start_figure(results: Mapping[str, Result]) -> Figure:
    """Pressures, cavities and the pin's force just after the valve opens, on the limited pump."""
    drawing, panels = grid(130, 3, 2, sharex=True, sharey="row")
    for mode, (pressures, cavities, forces) in zip(MODES, panels.T, strict=True):
        for oil, dashes, note in (("boils", "-", ""), ("pulls", DASHES, ", oil that pulls")):
            run = results[case_name(mode, PUMPS[0], PINS[0], oil)]
            inside = rise.between(run, *ENLARGED)
            time = 1e3 * (run.time[inside] - START)
            for row, colour in COLOURS.items():
                pressure = 1e-6 * run[f"{row}_column.pressure"][inside]
                pressures.plot(time, pressure, color=colour, ls=dashes, lw=1.0, label=f"{row} columns{note}")
                if oil == "boils":
                    cavities.plot(time, 1e6 * run[f"{row}_column.cavity"][inside], color=colour)
            forces.plot(time, 1e-3 * run[rise.FORCE][inside], color=style.IDEAL, ls=dashes)
        pressures.axhline(0.0, color="0.6", lw=0.6, zorder=0)
        pressures.set_title(mode, fontsize=9)
        forces.set_xlabel("time since the valve opens [ms]")
    for axes, label in zip(panels[:, 0], ("pressure [MPa]", "cavity [ml]", "pin force [kN]"), strict=True):
        axes.set_ylabel(label)
    return finish(drawing, panels, 2)
