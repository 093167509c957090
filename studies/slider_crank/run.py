"""Does the program agree with others on the field's benchmark, a slider-crank with a clearance slider pin?

Crank 50 mm at 5000 rpm, rod 120 mm, bearing 10 mm, journal 9.5 mm at the slider, steel, Lankarani-Nikravesh
with restitution 0.9 and the stiffness of internal contact; start with the velocities of the ideal machine and
the journal in the middle of its bore. Without friction, and with a coefficient of 0.03.
"""

import math
import sys
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.common.numbers import Number, by_case, measured, off, printed, rounded
from studies.common.options import Options
from studies.common.rise import Peak, onset
from studies.common.runs import impacts, run_with_errors
from studies.common.study import Study, StudyOutcome
from studies.common.words import TextTable
from support_exudyn import ClearancePin, Result, Scenario, SolverSettings, Steady, ravn_slider_crank
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.journal import journal
from support_exudyn.postprocessing.figures.orbit import draw_path
from support_exudyn.postprocessing.figures.units import DisplayUnit
from user_forces import (
    Ambrosio,
    Frictionless,
    ImpactVelocity,
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


def scenarios(quick: bool) -> dict[str, Scenario]:
    """One revolution of the ideal machine and of both those with clearance, at the longest of their steps."""
    base = Scenario(
        machine=ravn_slider_crank(),
        drive=Steady(rate=SPEED),
        duration=REVOLUTION,
        step=8e-6 if quick else 2e-6,
        record_period=REVOLUTION / (1500 if quick else 3600),
        gravity=(0.0, 0.0),
        solver=SolverSettings(impact_steps=32 if quick else 128, backend="symbolic"),
    )
    stiffness = internal_contact_stiffness(BEARING, STEEL, STEEL)
    normal = LankaraniNikravesh(stiffness=stiffness, restitution=0.9, damping_speed=ImpactVelocity(floor=1e-3))
    frictions = {SMOOTH: Frictionless(), DRY: Ambrosio(sliding_coefficient=0.03)}
    with_clearance = {
        name: replace(
            base,
            pins={PIN: ClearancePin(contact=JournalContact(bearing=BEARING, normal=normal, friction=friction))},
        )
        for name, friction in frictions.items()
    }
    return with_clearance | {IDEAL: base}


# --- measures ---


def measure(results: Mapping[str, Result]) -> list[Number]:
    """All numbers of the study."""
    numbers = [
        measured(name, IDEAL, unit, results[IDEAL], Peak(channel, begin=0.0), known)
        for name, (channel, unit, known) in IDEAL_REFERENCE.items()
    ]
    for case in (SMOOTH, DRY):
        result = results[case]
        numbers.append(
            measured("largest_pin_force_any_step", case, "N", result, lambda r: float(r.largest_force[PIN]))
        )
        for n in range(min(ONSETS, impacts(result, PIN))):
            known = REFERENCE[n] if case == SMOOTH and n < len(REFERENCE) else (None, None)
            numbers += [
                measured(f"onset_{n + 1}_time", case, "us", result, onset(PIN, n, "time", 1e6), known[0]),
                measured(f"onset_{n + 1}_speed", case, "m/s", result, onset(PIN, n, "speed"), known[1]),
            ]
    return numbers


# --- figure ---


def figure(results: Mapping[str, Result]) -> Figure:
    """Pin force and guide force over the crank angle, and the journal's path in its bore."""
    drawing = Figure(figsize=style.size(170, 130))
    grid = drawing.add_gridspec(2, 2, height_ratios=(1.0, 1.15))
    paths: list[Axes] = []
    force = drawing.add_subplot(grid[0, :])
    for case, colour in ((SMOOTH, style.SMOOTH), (DRY, style.WITH_CLEARANCE)):
        _over_angle(force, results[case], colour, case)
    _over_angle(force, results[IDEAL], style.IDEAL, "ideal pin")
    force.set(xlim=(0, 360), ylim=(0, None), xlabel="crank angle [deg]", ylabel="pin force [kN]")
    force.set_xticks(range(0, 361, 60))
    force.set_title("a) force in the slider pin")
    force.legend(loc="upper right", ncols=3)
    for column, case in enumerate((SMOOTH, DRY)):
        paths.append(drawing.add_subplot(grid[1, column]))
        _path(paths[-1], results[case], f"{'bc'[column]}) journal's path, {case}")
    drawing.legend(*paths[0].get_legend_handles_labels(), loc="outside lower center", ncols=6, fontsize=7)
    drawing.suptitle("Slider-crank at 5000 rpm, 0.5 mm clearance in the slider pin")
    return drawing


def _over_angle(axes: Axes, result: Result, colour: str, label: str) -> None:
    angle = np.degrees(SPEED * result.time)
    axes.plot(angle, 1e-3 * result[f"pin.{PIN}.force"], color=colour, lw=0.9, label=label)


def _path(axes: Axes, result: Result, title: str) -> None:
    draw_path(axes, journal(result, PIN), MILLIMETRES)
    axes.set(xlim=(-0.65, 0.65), ylim=(-0.65, 0.65), title=title)


def table(numbers: Sequence[Number]) -> TextTable:
    """All numbers, a row each, beside the reference."""
    rows = (
        (n.case, n.name.replace("_", " "), n.unit, rounded(n.value, n.numerical_error), printed(n))
        for n in numbers
    )
    return TextTable(
        ("case", "quantity", "unit", "here", "independent solution"), tuple(rows), left=3, width=120
    )


# --- the study ---


def work(chosen: Options) -> StudyOutcome:
    """A revolution of each machine, its impacts beside the independent solution."""
    cases = scenarios(chosen.quick)
    results = run_with_errors(cases, chosen)
    numbers = measure(results)
    found = by_case(numbers)
    known = [n for n in range(1, len(REFERENCE) + 1) if (f"onset_{n}_time", SMOOTH) in found]
    words = {
        "run": sys.modules[__name__],
        "found": found,
        "case": cases[SMOOTH],
        "ideal": [found[name, IDEAL] for name in IDEAL_REFERENCE],
        "times": [off(found[f"onset_{n}_time", SMOOTH]) for n in known],
        "speeds": [off(found[f"onset_{n}_speed", SMOOTH]) for n in known],
        "first": found.get(("onset_1_time", DRY)),
        "last": found.get((f"onset_{ONSETS}_time", DRY)),
    }
    return StudyOutcome(numbers, words, {"slider_crank": figure(results)}, {"table": table(numbers)}, results)


study = Study("slider_crank", __doc__, work)
main = study.main
