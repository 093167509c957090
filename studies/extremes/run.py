"""Where does the model break? Thousands of runs at the extremes, each good, or refused with a reason.

Clearance, stiffness, restitution, friction, steps, spectral radius, masses, postures, starts, loads and speeds
far beyond what is sensible, in grids and random corners; and runs of a thousand seconds. Every run is judged:
see `studies.extremes.judge`.
"""

import json
import math
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import SimpleNamespace

import numpy as np

from studies.common.numbers import Number
from studies.common.options import Options
from studies.common.study import Study, StudyOutcome
from studies.common.words import TextTable
from studies.extremes import long_runs
from studies.extremes.cases import MAPS, RANDOM, cases
from studies.extremes.figures import figures
from studies.extremes.judge import FREE, GOOD, MORE, REFUSED, SILENT, Case, Judgement
from studies.extremes.long_runs import LongRun
from studies.extremes.ranges import SPANS
from studies.extremes.runs import PATIENCE, run_cases, run_long
from support_exudyn.files.whole_file import whole_file
from support_exudyn.formulations.limits import DEEPEST
from support_exudyn.simulation.result_checks import OPEN

LARGEST_GAP = 1e-8  # [m] in a long run
Judged = Sequence[tuple[Case, Judgement]]
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


def group_table(judged: Judged) -> TextTable:
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
    return TextTable(header, tuple(rows), width=200)


def reason_table(judged: Judged) -> TextTable:
    """Why runs were refused, the commonest first."""
    counted = Counter(_kind(verdict.reason) for _, verdict in judged if verdict.outcome == REFUSED)
    rows = tuple((str(number), reason) for reason, number in counted.most_common())
    return TextTable(("runs", "reason"), rows, wide=True, width=200)


def _kind(reason: str) -> str:
    """A reason without its numbers."""
    said = reason.partition(": ")[2] or reason
    words = ["#" if any(letter.isdigit() for letter in word) else word for word in said.split()]
    short = " ".join(words).split("; allowed")[0]
    return short[:110] + ("..." if len(short) > 110 else "")


def silent_table(judged: Judged) -> TextTable:
    """Silent failures, one by one."""
    rows = tuple((case.name, verdict.reason) for case, verdict in judged if verdict.outcome == SILENT)
    return TextTable(("run", "what is wrong"), rows or (("none", ""),), wide=True, width=200)


def long_table(long: Long) -> TextTable:
    """Long runs."""
    rows = []
    for name, run in long.items():
        if isinstance(run, str):
            rows.append((name, run, *("",) * 7))
            continue
        memory = f"{run.memory_slope:.0f}" if math.isfinite(run.memory_slope) else ""
        rows.append((
            name, f"{run.simulated:g}", f"{run.wall:.0f}", f"{run.steps}", f"{run.impacts}",
            f"{run.gap_first:.1e}", f"{run.gap_last:.1e}", f"{run.energy_share:.1e}", memory,
        ))  # fmt: skip
    header = (
        "scene", "time [s]", "took [s]", "steps", "impacts", "gap, first tenth [m]", "gap, last tenth [m]",
        "energy open / turned over", "memory beyond records [bytes/s]",
    )  # fmt: skip
    return TextTable(header, tuple(rows), width=200)


# --- the study ---


def work(chosen: Options) -> StudyOutcome:
    """All scenes and long runs, judged; every verdict is kept as a line of runs.jsonl."""
    found = cases(chosen.quick)
    judged = list(zip(found, run_cases(found, chosen.quick, chosen.workers), strict=True))
    long = run_long(long_runs.QUICK if chosen.quick else long_runs.FULL, chosen.workers)
    save_rows(chosen.out / "runs.jsonl", judged)
    tables = {
        "table_groups": group_table(judged),
        "table_reasons": reason_table(judged),
        "table_silent": silent_table(judged),
        "table_long": long_table(long),
    }
    return StudyOutcome(
        numbers(judged, long), words(judged, long), figures(judged), tables, counts=counts(judged)
    )


def words(judged: Judged, long: Long) -> dict[str, object]:
    """What the sentences are filled with."""
    box = [verdict for case, verdict in judged if case.box]
    lasting = [run for run in long.values() if isinstance(run, LongRun)]
    return {
        "runs": len(judged),
        "spans": SPANS,
        "limits": SimpleNamespace(OPEN=OPEN, DEEPEST=DEEPEST, FREE=FREE, MORE=MORE),
        "patience": PATIENCE,
        "counts": counts(judged),
        "box": {
            "all": len(box),
            "good": sum(verdict.outcome == GOOD for verdict in box),
            "met": sum(verdict.met for verdict in box),
        },
        "energy_open": _largest([one.energy for _, one in judged if one.outcome == GOOD]),
        "gap": _largest([run.gap_last for run in lasting]),
        "long_energy": _largest([run.energy_share for run in lasting]),
    }


def save_rows(path: Path, judged: Judged) -> None:
    """One line of JSON a run: its name, what was varied, and its verdict."""
    with whole_file(path) as temporary, temporary.open("w", encoding="utf-8") as file:
        for case, verdict in judged:
            row = {"name": case.name, "group": case.group, "box": case.box, "values": case.values}
            file.write(json.dumps(row | _known(verdict), allow_nan=False) + "\n")


def _known(verdict: Judgement) -> dict[str, object]:
    """What a verdict says, without what JSON has no word for."""
    said = verdict.row().items()
    return {name: value for name, value in said if not isinstance(value, float) or math.isfinite(value)}


study = Study("extremes", __doc__, work)
main = study.main
