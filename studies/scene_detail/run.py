"""What does each element of the model change, and what does it cost?

Clearance, friction, mass and oil of the columns, the tail beam, the start and space: each is added to the
plainest scene and taken from the fullest, and every number comes with its numerical error. From the table
follows which scene a question needs.
"""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from pathlib import Path

from studies.common import paper_machine
from studies.common.chapter import Chapter
from studies.common.study import (
    Options,
    add_options,
    brief,
    run_main,
    save_figures,
    show_table,
    write_summary,
)
from studies.common.wording import how_sure
from studies.scene_detail import measures, sheets
from studies.scene_detail.figures import figures, pictures
from studies.scene_detail.measures import Measured
from studies.scene_detail.runs import run_timed
from studies.scene_detail.scenes import (
    APART,
    CLEARANCE_MM,
    FRICTION,
    FULLEST,
    LOOSE,
    LOOSE_IN_SPACE,
    PAPERS,
    PAPERS_IN_SPACE,
    PLAINEST,
    SECTIONS,
    UNEQUAL_FULLEST,
    UNEQUAL_IDEAL,
    Scene,
    scenes,
)
from support_exudyn import recommend
from support_exudyn.commands.command_line import Parser, folder, warn
from support_exudyn.postprocessing.figures import style
from support_exudyn.simulation.evidence.table import Table, check_replaceable
from support_exudyn.simulation.recommend import QUESTIONS, STROKE, UNEQUAL
from support_exudyn.sweeps.workers import Workers
from user_forces.values.value import InputError

STUDY = "scene_detail"
SHORT_RUN, SHORT_RUN_IF_QUICK = 0.3, 0.01  # shorter runs are timed alone [s]
TABLE = "scene_table.json"
ORDER = ("unequal", "taken", "combined", "space", "added")  # the longest runs first
GROUPS = ("added", "taken", "combined", "space")


# --- runs ---


def run(quick: bool, workers: int | Workers) -> dict[str, Measured]:
    """All scenes, each at its steps, at half and at a quarter of them, measured."""
    chosen = scenes(quick)
    longest_first = sorted(chosen.values(), key=lambda scene: ORDER.index(scene.group))
    runs = run_timed({scene.name: scene.scenario for scene in longest_first}, workers)
    return measures.measure(chosen, runs, SHORT_RUN_IF_QUICK if quick else SHORT_RUN)


def said(chosen: Mapping[str, Scene]) -> dict[str, str]:
    """What machine and drive the numbers are of, by family."""
    return {
        STROKE: f"reference support, {_drive(chosen[PLAINEST])}",
        UNEQUAL: f"reference support on oil columns, {_drive(chosen[UNEQUAL_FULLEST])}, front columns "
        f"{200 * APART:g} % apart, settled start",
    }


def _drive(scene: Scene) -> str:
    stroke = scene.scenario.drive.span(scene.scenario.duration)[1]
    return f"{1e3 * stroke:g} mm from {scene.begin:g} to {scene.end:g} s, run of {scene.scenario.duration:g} s"


# --- words ---


def chapter(measured: Mapping[str, Measured], tried: Table, quick: bool) -> Chapter:
    """The study as a chapter of the report."""
    return Chapter(
        study=STUDY,
        title="What each element of the model changes, and what it costs",
        question="What does each element of the model change, and what does it cost?",
        method=(
            f"Elements are added one at a time to the {PLAINEST} scene (in the plane, ideal pins, no friction, "
            f"rigid columns without mass, tail beam fixed to its body), and taken one at a time from the "
            f"{FULLEST} one in the plane (clearance {CLEARANCE_MM:g} mm and friction {FRICTION:g} in all five "
            "pins of the linkage, columns of two bodies on oil, the tail beam a body of its own on a jack of "
            f"oil). All make the same stroke from a concentric start: {_drive(measured[PLAINEST].scene)}; peak "
            "acceleration as in the paper's rise. Means and spreads are of the records of the stroke.",
            "Pins are damped by the depth that they are pressed to (DepthSpeed), not as the paper's law has "
            "it by the last touch, whose chance decides how long a pin without friction goes on vibrating. "
            "Such a pin still bounces when the stroke begins: what clearance does from a settled start stands "
            "in the tables beside it. " + paper_machine.OIL_SAID,
            f"Then the front columns are driven {200 * APART:g} % apart, which only space can show: "
            f"{_drive(measured[UNEQUAL_FULLEST].scene)}, settled start, {SECTIONS} sections in the pin. "
            "All five pins loose in space cost some 2 ms a step, too much for a study.",
            how_sure(quick)
            + " A change is called below the error if it is smaller than the errors of both scenes together.",
            "All by the redundant formulation, contact in Python.",
        ),
        findings=_findings(measured, tried),
        pictures=pictures(),
        sheets=(
            *(sheets.change_sheet(measured, group) for group in GROUPS),
            sheets.unequal_sheet(measured),
            sheets.advice_sheet(tried),
            sheets.cost_sheet(measured),
            sheets.value_sheet(measured),
        ),
        quick=quick,
    )


def _findings(measured: Mapping[str, Measured], tried: Table) -> tuple[str, ...]:
    return (
        *(_of_group(measured, group) for group in ("added", "taken")),
        _of_space(measured),
        _of_unequal(measured),
        *(f"{name[0].upper()}{name[1:]}: {recommend(name, tried).scene}. {recommend(name, tried).reason}"
          for name in QUESTIONS),
    )  # fmt: skip


def _of_group(measured: Mapping[str, Measured], group: str) -> str:
    found = []
    for one in measured.values():
        if one.scene.group == group and one.scene.reference == (PLAINEST if group == "added" else FULLEST):
            changed = sheets.changes(one, measured[one.scene.reference])
            mean, tip = changed[sheets.RELATIVE["mean_pin_force"]], changed[sheets.FARTHEST]
            force = "below the error" if mean.below_error else f"{mean.value:+.2g} %"
            moved = "below the error" if tip.below_error else f"{tip.value:.2g} mm"
            times = measures.times_as_long(one, measured[one.scene.reference])
            found.append(f"{one.scene.element[2:]} {force}, {moved}, {sheets.ratio(times)} times")
    verb = (
        f"Added to the {PLAINEST} scene"
        if group == "added"
        else f"Taken from the {FULLEST} scene, what is left"
    )
    return (
        f"{verb} (change of the mean force, of the tip at its farthest, and of the time): {'; '.join(found)}."
    )


def _of_space(measured: Mapping[str, Measured]) -> str:
    parts = []
    for plane, space in ((LOOSE, LOOSE_IN_SPACE), (PAPERS, PAPERS_IN_SPACE)):
        apart = measures.change(
            measured[space].numbers["mean_pin_force"], measured[plane].numbers["mean_pin_force"]
        )
        times = measures.times_as_long(measured[space], measured[plane])
        parts.append(f"{abs(apart.value):.1g} N (errors {apart.error:.1g} N) at {times:.2g} times the time")
    return (
        "If all is driven alike, space changes the mean force of the paper's pin by "
        f"{parts[0]} without friction, {parts[1]} with it: the plane is enough."
    )


def _of_unequal(measured: Mapping[str, Measured]) -> str:
    loose, ideal = measured[UNEQUAL_FULLEST].numbers, measured[UNEQUAL_IDEAL].numbers

    def both(name: str, scale: float, unit: str) -> str:
        a, b = loose[name], ideal[name]
        return f"{scale * a.value:.3g} {unit} with clearance and {scale * b.value:.3g} {unit} with ideal pins"

    return (
        f"Front columns {200 * APART:g} % apart roll the canopy by "
        f"{loose['largest_roll'].value:.3g} deg with clearance and not at all with ideal pins, load a "
        f"front column with {both('largest_front_column_force', 1e-3, 'kN')}, and the rear pin with a moment "
        f"of {1e-3 * loose['largest_moment'].value:.3g} kN m with clearance: ideal pins hold the linkage "
        "straight, which a loose one does not, by moments of which rigid bodies do not tell the rear pin's "
        f"share; the yaw is {brief(loose['largest_yaw'].value, loose['largest_yaw'].error)} deg with "
        f"clearance. The pin's edges are pressed in by {1e3 * loose['largest_left_depth'].value:.2g} mm, and "
        "where a column's force is negative its oil pulls: beyond what either law is made for, so that turns "
        "are results and forces bounds."
    )


# --- main ---


def study(chosen: Options) -> None:
    """Run, measure, draw and write everything into the output folder."""
    started = time.perf_counter()
    measured = run(chosen.quick, chosen.workers)
    tried = measures.table(measured, said({one.scene.name: one.scene for one in measured.values()}))
    tried.save(chosen.out / TABLE)
    with style.look():
        drawings = figures(measured)
    save_figures(chosen, drawings)
    for group in GROUPS:
        show_table(chosen.out / f"table_{group}.txt", sheets.change_sheet(measured, group), width=220)
    show_table(chosen.out / "table_unequal.txt", sheets.unequal_sheet(measured), width=200)
    show_table(chosen.out / "table_advice.txt", sheets.advice_sheet(tried), width=220)
    show_table(chosen.out / "table_cost.txt", sheets.cost_sheet(measured), width=220)
    show_table(chosen.out / "table_values.txt", sheets.value_sheet(measured), width=260)
    chapter(measured, tried, chosen.quick).save(chosen.out)
    write_summary(chosen.out, STUDY, measures.listed(measured), time.perf_counter() - started)


def main(argv: Sequence[str] | None = None) -> int:
    """Entry of `python -m studies.scene_detail`."""
    parser = Parser(prog=f"python -m studies.{STUDY}", description=(__doc__ or "").splitlines()[0])
    add_options(parser, Path("results") / STUDY, taken=("quick", "workers"))
    parser.add_argument(
        "--commit-evidence",
        type=folder,
        metavar="PATH",
        help="write the table that support_exudyn.simulation.recommend reads there, too; not if quick",
    )
    given = parser.parse_args(argv)
    if given.commit_evidence is not None and given.quick:
        parser.error("--commit-evidence: advice is taken from the full form; allowed: without --quick")
    try:
        if given.commit_evidence is not None:
            check_replaceable(given.commit_evidence)  # now, and not when all is computed
    except InputError as error:
        parser.error(f"--commit-evidence {error}")
    code = run_main(study, Options(given.out, given.quick, given.workers))
    if code == 0 and given.commit_evidence is not None:
        try:
            Table.load(given.out / TABLE).save(given.commit_evidence)
        except (OSError, InputError) as error:
            warn(f"error: --commit-evidence {given.commit_evidence}: {error}")
            return 1
    return code
