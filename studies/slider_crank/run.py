"""Does the program agree with others on the field's benchmark, a slider-crank with a loose slider pin?

Crank 50 mm at 5000 rpm, rod 120 mm, bearing 10 mm, journal 9.5 mm at the slider, steel, Lankarani-Nikravesh
with restitution 0.9 and the stiffness of internal contact; start with the velocities of the ideal machine and
the journal in the middle of its bore. Without friction, and with a coefficient of 0.03.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Literal

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.common.chapter import Chapter, Picture, Sheet
from studies.common.rise import Peak
from studies.common.study import (
    Number,
    Options,
    measured,
    options,
    rounded,
    run_main,
    run_with_errors,
    save_figures,
    save_run,
    show_table,
    touches,
    write_summary,
)
from studies.common.wording import by_case, how_sure, said
from support_exudyn import ClearancePin, Result, Scenario, SolverSettings, Steady, ravn_slider_crank
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.journal import journal
from support_exudyn.postprocessing.figures.orbit import draw_path
from support_exudyn.postprocessing.figures.units import Unit
from user_forces import (
    Ambrosio,
    Frictionless,
    JournalBearing,
    JournalContact,
    LankaraniNikravesh,
    Material,
    TouchSpeed,
    internal_contact_stiffness,
)

Series = npt.NDArray[np.float64]
STUDY = "slider_crank"
PIN = "slider_pin"
SPEED = 5000.0 * 2.0 * math.pi / 60.0  # of the crank [rad/s]
REVOLUTION = 2.0 * math.pi / SPEED  # [s]
BEARING = JournalBearing(bore_radius=0.01, clearance=0.0005)
STEEL = Material(name="steel", elastic_modulus=207e9, poisson_ratio=0.3, density=7800.0)
IDEAL, SMOOTH, DRY = "ideal", "no friction", "friction 0.03"
ONSETS = 12  # reported
MILLIMETRES = Unit("mm", 1e3)
# an independent solution with two free coordinates and located onsets: time [us], approach speed [m/s]
REFERENCE = (
    (227.286, 4.385783),
    (637.056, 2.756949),
    (749.700, 1.826699),
    (1085.947, 1.101851),
    (1205.816, 0.823801),
)
# the ideal machine in closed form
IDEAL_REFERENCE = {
    "largest_slider_speed": 28.4113,
    "largest_crank_moment": 138.5217,
    "largest_pin_force": 2718.71,
}


def scenarios(quick: bool) -> dict[str, Scenario]:
    """One revolution of the ideal machine and of both loose ones, at the longest of their steps."""
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
    normal = LankaraniNikravesh(stiffness=stiffness, restitution=0.9, damping_speed=TouchSpeed(floor=1e-3))
    frictions = {SMOOTH: Frictionless(), DRY: Ambrosio(sliding_coefficient=0.03)}
    loose = {
        name: replace(
            base,
            pins={PIN: ClearancePin(contact=JournalContact(bearing=BEARING, normal=normal, friction=friction))},
        )
        for name, friction in frictions.items()
    }
    return loose | {IDEAL: base}


# --- measures ---


def measure(results: Mapping[str, Result]) -> list[Number]:
    """All numbers of the study."""
    ideal: dict[str, tuple[str, Callable[[Result], float]]] = {
        "largest_slider_speed": ("m/s", Peak("slider.velocity_x", begin=0.0)),
        "largest_crank_moment": ("N m", Peak("crank.moment", begin=0.0)),
        "largest_pin_force": ("N", Peak(f"pin.{PIN}.force", begin=0.0)),
    }
    numbers = [
        measured(name, IDEAL, unit, results[IDEAL], get, IDEAL_REFERENCE[name])
        for name, (unit, get) in ideal.items()
    ]
    for case in (SMOOTH, DRY):
        result = results[case]
        numbers.append(
            measured("largest_pin_force_any_step", case, "N", result, lambda r: float(r.largest_force[PIN]))
        )
        for n in range(min(ONSETS, touches(result, PIN))):
            known = REFERENCE[n] if case == SMOOTH and n < len(REFERENCE) else (None, None)
            numbers += [
                measured(f"onset_{n + 1}_time", case, "us", result, _onset(n, "time", 1e6), known[0]),
                measured(f"onset_{n + 1}_speed", case, "m/s", result, _onset(n, "speed", 1.0), known[1]),
            ]
    return numbers


def _onset(n: int, field: Literal["time", "speed"], scale: float) -> Callable[[Result], float]:
    return lambda r: scale * float(getattr(r.onsets[PIN][n], field))


# --- figure ---


def figure(results: Mapping[str, Result]) -> Figure:
    """Pin force and guide force over the crank angle, and the journal's path in its bore."""
    drawing = Figure(figsize=style.size(170, 130))
    grid = drawing.add_gridspec(2, 2, height_ratios=(1.0, 1.15))
    paths: list[Axes] = []
    force = drawing.add_subplot(grid[0, :])
    for case, colour in ((SMOOTH, style.SMOOTH), (DRY, style.LOOSE)):
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


def table(numbers: Sequence[Number]) -> Sheet:
    """All numbers, a row each, beside the reference."""
    return Sheet(
        title="Slider-crank at 5000 rpm",
        header=("case", "quantity", "unit", "here", "independent solution"),
        rows=tuple(
            (
                n.case,
                n.name.replace("_", " "),
                n.unit,
                rounded(n.value, n.numerical_error),
                "" if n.paper is None else f"{n.paper:.9g}",
            )
            for n in numbers
        ),
        caption=(
            "± is the estimated error, of three runs. Every touch multiplies the errors of the earlier ones; "
            "after about a revolution the motion is chaotic and only statistics can be compared."
        ),
        left=3,
    )


# --- words ---


def chapter(numbers: Sequence[Number], quick: bool) -> Chapter:
    """The study as a chapter of the report."""
    return Chapter(
        study=STUDY,
        title="The field's benchmark: a slider-crank with a loose slider pin",
        question=(
            "Does the program agree with others on the slider-crank with a loose slider pin (Ravn; Flores and "
            "Ambrosio)?"
        ),
        method=_method(quick),
        findings=_findings(numbers),
        pictures=(
            Picture(
                "slider_crank",
                "Force in the slider pin over the crank angle (a), and the journal's path in its bore without "
                "friction (b) and with (c): "
                "thin and light in free flight, thick and dark in contact.",
            ),
        ),
        sheets=(table(numbers),),
        quick=quick,
    )


def _method(quick: bool) -> tuple[str, ...]:
    case = scenarios(quick)[SMOOTH]
    return (
        "A crank of 50 mm turns steadily at 5000 rpm and drives a slider by a rod of 120 mm; there is no "
        f"gravity. The bearing at the slider has a radius of {1e3 * BEARING.bore_radius:g} mm, the journal is "
        f"{1e3 * BEARING.clearance:g} mm smaller. Both are of steel; the contact force is that of Lankarani "
        "and Nikravesh with a restitution of 0.9 and the stiffness of internal contact, friction is that of "
        "Ambrosio.",
        "The run begins with the velocities of the ideal machine and the journal in the middle of its bore, "
        "and lasts one revolution. Touches are located in time, and compared with an independent solution of "
        "the frictionless machine in two free coordinates; the ideal machine is compared with its closed form.",
        f"Steps of the first run are {1e6 * case.step:g} µs, {case.solver.impact_steps} to an impact. "
        f"{how_sure(quick)}",
    )


def _findings(numbers: Sequence[Number]) -> tuple[str, ...]:
    found = by_case(numbers)
    sentences = []
    touches = [n for n in range(1, len(REFERENCE) + 1) if (f"onset_{n}_time", SMOOTH) in found]
    if touches:
        times = [_off(found[f"onset_{n}_time", SMOOTH]) for n in touches]
        speeds = [_off(found[f"onset_{n}_speed", SMOOTH]) for n in touches]
        sentences.append(
            f"Without friction the first {len(touches)} touches are within {max(times):.0e} (time) and "
            f"{max(speeds):.0e} (approach speed) of the independent solution, relatively."
        )
    ideal = [found[name, IDEAL] for name in IDEAL_REFERENCE]
    sentences.append(
        "With ideal pins the largest slider speed, crank moment and pin force are "
        f"{', '.join(said(n) for n in ideal)}; the closed form gives the same within "
        f"{max(_off(n) for n in ideal):.0e}."
    )
    peaks = [found["largest_pin_force_any_step", case] for case in (SMOOTH, DRY)]
    sentences.append(
        f"With clearance the largest pin force is {said(peaks[0], 1e-3, 'kN')} without friction and "
        f"{said(peaks[1], 1e-3, 'kN')} with; with ideal pins it is {said(ideal[-1], 1e-3, 'kN')}."
    )
    first, last = (found.get((f"onset_{n}_time", DRY)) for n in (1, ONSETS))
    if first and last:
        sentences.append(
            f"With friction the error of a touch's time grows from {first.numerical_error:.0e} µs at the first "
            f"to {last.numerical_error:.0e} µs at touch {ONSETS}: each touch multiplies the errors of the "
            "earlier ones. The first few touches are results; the hundredth is not."
        )
    return tuple(sentences)


def _off(number: Number) -> float:
    """Relative distance from the other solution."""
    assert number.paper is not None
    return abs(number.value / number.paper - 1.0)


# --- main ---


def study(chosen: Options) -> None:
    """Run, measure, draw and write everything into the output folder."""
    started = time.perf_counter()
    results = run_with_errors(scenarios(chosen.quick), chosen.workers)
    for name, result in results.items():
        save_run(result, chosen.out, name.replace(" ", "_").replace(".", "p"))
    numbers = measure(results)
    with style.look():
        drawings = {"slider_crank": figure(results)}
    save_figures(chosen, drawings)
    show_table(chosen.out / "table.txt", table(numbers), width=120)
    chapter(numbers, chosen.quick).save(chosen.out)
    write_summary(chosen.out, STUDY, numbers, time.perf_counter() - started)


def main(argv: Sequence[str] | None = None) -> int:
    """Entry of `python -m studies.slider_crank`."""
    description = (__doc__ or "").splitlines()[0]
    return run_main(study, options(STUDY, argv, description))
