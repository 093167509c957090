"""Does the program agree with others on the field's benchmark, a slider-crank with a clearance slider pin?

Crank 50 mm at 5000 rpm, rod 120 mm, bearing 10 mm, journal 9.5 mm at the slider, steel, Lankarani-Nikravesh
with restitution 0.9 and the stiffness of internal contact; start with the velocities of the ideal machine and
the journal in the middle of its bore. Without friction, and with a coefficient of 0.03.
"""

import math
import sys
from collections.abc import Mapping
from dataclasses import replace
from typing import ClassVar

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.common.numbers import Measured, Measures, Number, cell, off, printed
from studies.common.panels import letters
from studies.common.rise import Crest, onset
from studies.common.runs import impacts
from studies.common.study import Study
from studies.common.words import text_table
from support_exudyn import ClearancePin, Result, Scenario, SolverSettings, Steady, ravn_slider_crank
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.journal import journal
from support_exudyn.postprocessing.figures.orbit import draw_path
from support_exudyn.postprocessing.figures.units import DisplayUnit
from support_exudyn.postprocessing.page.pieces import Sheet
from user_forces import (
    Ambrosio,
    Frictionless,
    JournalBearing,
    JournalContact,
    LankaraniNikravesh,
    Material,
    internal_contact_stiffness,
)

PIN = "slider_pin"
SPEED = 5000.0 * 2.0 * math.pi / 60.0  # of the crank [rad/s]
REVOLUTION = 2.0 * math.pi / SPEED  # [s]
BEARING = JournalBearing(bore_radius=0.01, clearance=0.0005)
STEEL = Material(name="steel", elastic_modulus=207e9, poisson_ratio=0.3, density=7800.0)
IDEAL, SMOOTH, DRY = "ideal", "no friction", "friction 0.03"
ONSETS = 12  # reported
PEAK = "largest_pin_force_any_step"
ALIKE = 1e-3  # relative, of impacts that are said to agree
MILLIMETRES = DisplayUnit("mm", 1e3)
# an independent solution with two free coordinates and located onsets: time [us], initial impact velocity [m/s]
REFERENCE = (
    (227.286, 4.385783),
    (637.056, 2.756949),
    (749.700, 1.826699),
    (1085.947, 1.101851),
    (1205.816, 0.823801),
)
# the ideal machine in closed form
IDEAL_REFERENCE = {  # channel, unit and largest value
    "largest_slider_speed": ("slider.velocity_x", "m/s", 28.4113),
    "largest_crank_moment": ("crank.moment", "N m", 138.5217),
    "largest_pin_force": (f"pin.{PIN}.force", "N", 2718.71),
}


def scenarios() -> dict[str, Scenario]:
    """One revolution of the ideal machine and of both with clearance, at the longest of their steps."""
    base = Scenario(
        machine=ravn_slider_crank(),
        drive=Steady(rate=SPEED),
        duration=REVOLUTION,
        step=2e-6,
        record_period=REVOLUTION / 3600,
        gravity=(0.0, 0.0),
        solver=SolverSettings(impact_steps=128),
    )
    stiffness = internal_contact_stiffness(BEARING, STEEL, STEEL)
    normal = LankaraniNikravesh(stiffness=stiffness, restitution=0.9, rest_velocity=1e-3)
    found = {}
    for name, friction in {SMOOTH: Frictionless(), DRY: Ambrosio(sliding_coefficient=0.03)}.items():
        contact = JournalContact(bearing=BEARING, normal=normal, friction=friction)
        found[name] = replace(base, pins={PIN: ClearancePin(contact=contact)})
    return found | {IDEAL: base}


KNOWN = {  # by name and case
    **{(name, IDEAL): value for name, (_, _, value) in IDEAL_REFERENCE.items()},
    **{(f"onset_{n}_time", SMOOTH): time for n, (time, _) in enumerate(REFERENCE, 1)},
    **{(f"onset_{n}_speed", SMOOTH): speed for n, (_, speed) in enumerate(REFERENCE, 1)},
}


def figure(results: Mapping[str, Result]) -> Figure:
    """Pin force over the crank angle without friction and with, and the journal's paths in its bore."""
    drawing = Figure(figsize=style.size(170, 165))
    grid = drawing.add_gridspec(3, 2, height_ratios=(0.75, 0.75, 1.35))
    cases = {SMOOTH: style.SMOOTH, DRY: style.WITH_CLEARANCE}
    forces: list[Axes] = []
    for row, (case, colour) in enumerate(cases.items()):
        forces.append(drawing.add_subplot(grid[row, :], sharex=forces[0] if forces else None))
        _over_angle(forces[-1], results[case], colour, f"0.5 mm clearance, {case}")
        _over_angle(forces[-1], results[IDEAL], style.IDEAL, "ideal pin")
        forces[-1].set(xlim=(0, 360), ylim=(0, None), ylabel="pin force [kN]")
        forces[-1].set_xticks(range(0, 361, 60))
        forces[-1].legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2, borderaxespad=0.0)
    top = max(axes.get_ylim()[1] for axes in forces)
    for axes in forces:
        axes.set_ylim(0, top)
    forces[0].tick_params(labelbottom=False)
    forces[-1].set_xlabel("crank angle [deg]")
    paths = [drawing.add_subplot(grid[2, column]) for column in range(len(cases))]
    for axes, case in zip(paths, cases, strict=True):
        draw_path(axes, journal(results[case], PIN), MILLIMETRES)
        axes.set(xlim=(-0.65, 0.65), ylim=(-0.65, 0.65))
    letters([*forces, *paths])
    drawing.legend(*paths[0].get_legend_handles_labels(), loc="outside lower center", ncols=6, fontsize=7)
    return drawing


def _over_angle(axes: Axes, result: Result, colour: str, label: str) -> None:
    angle = np.degrees(SPEED * result.time)
    axes.plot(angle, 1e-3 * result[f"pin.{PIN}.force"], color=colour, lw=0.9, label=label)


# --- the study ---


class SliderCrankStudy(Study):
    """Does the program agree with others on the benchmark of a slider-crank with a loose slider pin?"""

    name, seconds = "slider_crank", 18.0
    live: ClassVar = {"slider_crank": (0, 1)}
    papers = KNOWN

    def cases(self) -> dict[str, Scenario]:
        return scenarios()

    def measures(self, run: Result) -> Measures:
        """Of the ideal machine what is known in closed form, of others impacts."""
        if not run.scenario.clearance_pins:
            known = IDEAL_REFERENCE.items()
            return {name: (unit, Crest(channel, begin=0.0)) for name, (channel, unit, _) in known}
        found: dict[str, tuple[str, Measured]] = {PEAK: ("N", lambda run: float(run.largest_force[PIN]))}
        for n in range(min(ONSETS, impacts(run, PIN))):
            found[f"onset_{n + 1}_time"] = ("us", onset(PIN, n, "time", 1e6))
            found[f"onset_{n + 1}_speed"] = ("m/s", onset(PIN, n, "speed"))
        return found

    def onsets(self, case: str, what: str, most: int) -> list[Number]:
        """Times or speeds of the first impacts of a case, so many at most."""
        names = [(f"onset_{n}_{what}", case) for n in range(1, most + 1)]
        return [self.found[name] for name in names if name in self.found]

    def figures(self) -> dict[str, Figure]:
        return {"slider_crank": figure(self.runs)}

    def tables(self) -> dict[str, Sheet]:
        """The first impacts without friction beside the independent solution."""
        both = (self.onsets(SMOOTH, what, len(REFERENCE)) for what in ("time", "speed"))
        rows = [
            (str(n), cell(time), printed(time), cell(speed), printed(speed))
            for n, (time, speed) in enumerate(zip(*both, strict=True), 1)
        ]
        known = "independent solution"
        header = ("impact", "time [µs]", known, "initial impact velocity [m/s]", known)
        return {"table_agreement": text_table(header, rows)}

    def words(self) -> dict[str, object]:
        times, speeds = (self.onsets(SMOOTH, what, len(REFERENCE)) for what in ("time", "speed"))
        return {
            "run": sys.modules[__name__],
            "case": scenarios()[SMOOTH],
            "ideal": [self.found[name, IDEAL] for name in IDEAL_REFERENCE],
            "times": [off(one) for one in times],
            "speeds": [off(one) for one in speeds],
            "onsets": self.onsets(DRY, "time", ONSETS),
        }
