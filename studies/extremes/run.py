"""Where does the model break? Thousands of runs at the extremes, each good, or refused with a reason.

Clearance, stiffness, restitution, friction, steps, spectral radius, masses, postures, starts, loads and speeds
far beyond what is sensible, in grids and random corners; and runs of a thousand seconds. Every run is judged:
see `studies.extremes.judge`.
"""

from __future__ import annotations

import json
import math
import time
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from studies.common.chapter import Chapter, Sheet
from studies.common.study import Number, Options, options, run_main, save_figures, show_table, write_summary
from studies.extremes import long_runs
from studies.extremes.cases import MAPS, RANDOM, cases
from studies.extremes.figures import figures, pictures
from studies.extremes.judge import FREE, GOOD, MORE, REFUSED, SILENT, Case, Verdict
from studies.extremes.long_runs import LongRun
from studies.extremes.ranges import SPANS
from studies.extremes.runs import PATIENCE, run_cases, run_long
from support_exudyn.files.whole_file import whole_file
from support_exudyn.formulations.limits import DEEPEST
from support_exudyn.postprocessing.figures import style
from support_exudyn.simulation.audit import OPEN

STUDY = "extremes"
LARGEST_GAP = 1e-8  # [m] in a long run
Judged = Sequence[tuple[Case, Verdict]]
Long = Mapping[str, LongRun | str]


# --- what came out ---


def numbers(judged: Judged, long: Long) -> list[Number]:
    """Shares and extremes of all verdicts, and what long runs came to."""
    box = [verdict for case, verdict in judged if case.box]
    good = [verdict for _, verdict in judged if verdict.outcome == GOOD]
    found = [
        _counted("good_in_box", "box", sum(one.outcome == GOOD for one in box) / len(box)),
        _counted("accuracy_met_in_box", "box", sum(one.met for one in box) / len(box)),
        _counted("largest_energy_open", "good runs", max(one.energy for one in good)),
        _counted("largest_depth", "good runs", max(one.depth for one in good)),
        _counted("largest_restitution_over_law", "good runs", _largest([one.restitution for one in good])),
        _counted("median_reported_error", "good runs", float(np.median([one.error for one in good]))),
        _counted(
            "largest_half_over_reported",
            "good runs",
            _largest([one.half / one.error for one in good if one.error]),
        ),
    ]
    for name, run in long.items():
        if isinstance(run, LongRun):
            case = f"{name}, {run.simulated:g} s"
            found += [
                Number("largest_gap", case, run.gap_last, "m", 0.0),
                Number("gap_slope", case, run.gap_slope, "m/s", 0.0),
                Number("energy_open", case, run.energy_share, "1", 0.0),
            ]
            if math.isfinite(run.memory_slope):
                found.append(Number("memory_slope", case, run.memory_slope, "bytes/s", 0.0))
    return found


def _counted(name: str, case: str, value: float) -> Number:
    return Number(name, case, value, "1", 0.0)


def _largest(values: Sequence[float]) -> float:
    """The largest of those that are numbers; 0 if none is."""
    return max((value for value in values if math.isfinite(value)), default=0.0)


def counts(judged: Judged) -> dict[str, int]:
    """How many runs ended how."""
    counted = Counter(verdict.outcome for _, verdict in judged)
    return {f"runs_{outcome}": counted[outcome] for outcome in (GOOD, REFUSED, SILENT)}


# --- tables ---


def group_sheet(judged: Judged) -> Sheet:
    """How the runs of every group ended."""
    rows = []
    for group in (*MAPS, *RANDOM):
        here = [verdict for case, verdict in judged if case.group == group]
        counted = Counter(verdict.outcome for verdict in here)
        checked = sum(math.isfinite(verdict.other) for verdict in here)
        good = [verdict for verdict in here if verdict.outcome == GOOD]
        rows.append((
            group, str(len(here)), *(str(counted[outcome]) for outcome in (GOOD, REFUSED, SILENT)),
            str(checked),
            f"{np.median([one.error for one in good]):.1g}" if good else "",
            f"{max(one.energy for one in good):.1g}" if good else "",
        ))  # fmt: skip
    header = (
        "group", "runs", "good", "refused", "silent", "compared with another formulation",
        "median error", "energy open, largest",
    )  # fmt: skip
    return Sheet("How runs at the extremes ended", header, tuple(rows))


def reason_sheet(judged: Judged) -> Sheet:
    """Why runs were refused, the commonest first."""
    counted = Counter(_kind(verdict.reason) for _, verdict in judged if verdict.outcome == REFUSED)
    rows = tuple((str(number), reason) for reason, number in counted.most_common())
    return Sheet("Why runs were refused", ("runs", "reason"), rows, wide=True)


def _kind(reason: str) -> str:
    """A reason without its numbers."""
    said = reason.partition(": ")[2] or reason
    words = ["#" if any(letter.isdigit() for letter in word) else word for word in said.split()]
    short = " ".join(words).split("; allowed")[0]
    return short[:110] + ("..." if len(short) > 110 else "")


def silent_sheet(judged: Judged) -> Sheet:
    """Silent failures, one by one."""
    rows = tuple((case.name, verdict.reason) for case, verdict in judged if verdict.outcome == SILENT)
    return Sheet("Silent failures", ("run", "what is wrong"), rows or (("none", ""),), wide=True)


def long_sheet(long: Long) -> Sheet:
    """Long runs."""
    rows = []
    for name, run in long.items():
        if isinstance(run, str):
            rows.append((name, run, *("",) * 7))
            continue
        memory = f"{run.memory_slope:.0f}" if math.isfinite(run.memory_slope) else ""
        rows.append((
            name, f"{run.simulated:g}", f"{run.wall:.0f}", f"{run.steps}", f"{run.touches}",
            f"{run.gap_first:.1e}", f"{run.gap_last:.1e}", f"{run.energy_share:.1e}", memory,
        ))  # fmt: skip
    header = (
        "scene", "time [s]", "took [s]", "steps", "touches", "gap, first tenth [m]", "gap, last tenth [m]",
        "energy open / turned over", "memory beyond records [bytes/s]",
    )  # fmt: skip
    return Sheet("Long runs: raised and lowered by 100 mm every 4 s", header, tuple(rows))


# --- the chapter ---


def chapter(judged: Judged, long: Long, quick: bool) -> Chapter:
    """The study as a chapter of the report."""
    return Chapter(
        study=STUDY,
        title="Where the model breaks",
        question="Where does the model break, and does it say so?",
        method=(
            f"{len(judged)} scenes: grids for the maps, and random corners of "
            + ", ".join(f"{name} {span.low:g} to {span.high:g}" for name, span in SPANS.items())
            + "; mass ratios of 1e-4 to 1e4, postures up to dead centres and past them, no gravity, every kind "
            "of start, clearance in all pins, a roof that presses with up to 10 MN, free impacts, space. "
            "Stiffness is in times the paper's, at a depth of 1 mm whatever the exponent; ramp is v_d "
            "over v_s.",
            "Each is run at its step, at half and at a quarter of it, or to an accuracy. It is good if all of "
            f"this holds: it has finished; all numbers are finite; energy is open by at most {OPEN:.0%} of "
            f"what was turned over; no journal is deeper than {DEEPEST:.0%} of the bore's radius; no free "
            f"impact (without friction, gravity changing the speed by less than {FREE:.0%}) gives back more "
            f"than its law by {MORE:.1%}; half the step agrees within the reported error; so does another "
            "formulation, where one covers the scene. It is refused if it ends with an error that names cause, "
            f"time and advice. Anything else, among it a run of more than {PATIENCE:g} s, a crash or a "
            "warning, is a silent failure.",
            f"The box is what is physically sensible: {_box()}, friction speeds as wide as outside of it; its "
            "runs are made to an accuracy (draft, standard, reference) and choose their own formulation.",
        ),
        findings=_findings(judged, long),
        pictures=pictures(),
        sheets=(group_sheet(judged), reason_sheet(judged), silent_sheet(judged), long_sheet(long)),
        quick=quick,
    )


def _box() -> str:
    names = ("clearance_m", "stiffness", "restitution", "mu")
    return ", ".join(f"{name} {SPANS[name].sensible[0]:g} to {SPANS[name].sensible[1]:g}" for name in names)


def _findings(judged: Judged, long: Long) -> tuple[str, ...]:
    counted = counts(judged)
    box = [verdict for case, verdict in judged if case.box]
    good = sum(verdict.outcome == GOOD for verdict in box)
    met = sum(verdict.met for verdict in box)
    lasting = [run for run in long.values() if isinstance(run, LongRun)]
    return (
        f"{counted['runs_good']} runs are good, {counted['runs_refused']} refused, {counted['runs_silent']} "
        "failed silently.",
        f"In the box {good} of {len(box)} are good, and {met} reach the accuracy that was asked for.",
        "In good runs energy is open by at most "
        f"{_largest([one.energy for _, one in judged if one.outcome == GOOD]):.1g} of what was turned over.",
        f"Long runs: joints are at most {_largest([run.gap_last for run in lasting]):.1g} m apart in their "
        f"last tenth, energy is open by at most {_largest([run.energy_share for run in lasting]):.1g} of what "
        "was turned over.",
    )


# --- main ---


def study(chosen: Options) -> None:
    """Run, judge, draw and write everything into the output folder."""
    started = time.perf_counter()
    found = cases(chosen.quick)
    judged = list(zip(found, run_cases(found, chosen.quick, chosen.workers), strict=True))
    long = run_long(long_runs.QUICK if chosen.quick else long_runs.FULL, chosen.workers)
    save_rows(chosen.out / "runs.jsonl", judged)
    with style.look():
        drawings = figures(judged)
    save_figures(chosen, drawings)
    told = chapter(judged, long, chosen.quick)
    for name, sheet in zip(("groups", "reasons", "silent", "long"), told.sheets, strict=True):
        show_table(chosen.out / f"table_{name}.txt", sheet, width=200)
    told.save(chosen.out)
    write_summary(chosen.out, STUDY, numbers(judged, long), time.perf_counter() - started, counts(judged))


def save_rows(path: Path, judged: Judged) -> None:
    """One line of JSON a run: its name, what was varied, and its verdict."""
    with whole_file(path) as temporary, temporary.open("w", encoding="utf-8") as file:
        for case, verdict in judged:
            row = {"name": case.name, "group": case.group, "box": case.box, "values": case.values}
            file.write(json.dumps(row | _known(verdict), allow_nan=False) + "\n")


def _known(verdict: Verdict) -> dict[str, object]:
    """What a verdict says, without what JSON has no word for."""
    said = verdict.row().items()
    return {name: value for name, value in said if not isinstance(value, float) or math.isfinite(value)}


def main(argv: Sequence[str] | None = None) -> int:
    """Entry of `python -m studies.extremes`."""
    description = (__doc__ or "").splitlines()[0]
    return run_main(study, options(STUDY, argv, description, taken=("quick", "workers")))


if __name__ == "__main__":
    raise SystemExit(main())
