"""Do the errors that runs tell cover those that they have? Fresh scenes of every kind, drawn from a seed.

    python -m studies.benchmarking.coverage --seed 7 --scenes 300
    python -m studies.benchmarking.coverage --seed 7 --only 42      # one scene again, number by number

Each scene is run to the accuracies "draft" and "standard", a fifth of those whose steps are chosen by a
tolerance to "reference" too, and every number is judged as `studies.benchmarking.covered` tells. What is done
is kept in the folder, so that an interrupted command goes on where it was.
"""

import argparse
import json
import math
import os
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, fields
from functools import partial
from pathlib import Path

import numpy as np

from studies.benchmarking import covered
from studies.benchmarking.covered import CoveredRun, Judged
from studies.benchmarking.fresh_scenes import KINDS, fresh
from studies.common.numbers import Number, write_summary
from studies.common.options import MOST_WORKERS
from studies.common.runs import bar
from studies.common.study import output_folder, show_table
from support_exudyn.commands.command_line import Parser, answered, count, folder
from support_exudyn.files.whole_file import whole_file
from support_exudyn.postprocessing.page.pieces import Sheet
from support_exudyn.sweeps.key import key
from support_exudyn.sweeps.workers import ProcessEndedError, Workers, report, worker_pool

STUDY = "coverage"
MOST_SCENES, LARGEST_SEED = 100_000, 2**32
WORST = 15  # offenders that are listed
ALL = "all"
GOAL_COVERED, GOAL_RATIO, GOAL_OVERSTATED = 0.98, 5.0, 10.0


@dataclass(frozen=True)
class Chosen:
    """The command line asks for these."""

    seed: int
    scenes: int
    only: int | None
    out: Path
    workers: int | Workers


# --- a scene, in a worker ---


def judged_scene(place: int, seed: int, number: int) -> list[CoveredRun]:
    """Make and judge all runs of a scene; one that fails unexplained is a row with its reason."""
    report(0.0)
    scene = fresh(seed, number)
    try:
        return list(covered.rows(scene))
    except Exception as error:
        return [CoveredRun(scene.kind, number, ALL, refused=f"{type(error).__name__}: {error}")]


def kept(out: Path, seed: int, number: int) -> Path:
    """Return the file of a scene: another one for another program, or if scenes are judged in another way."""
    scene = fresh(seed, number)
    return out / "scenes" / f"{seed}-{number}-{key(scene.scenario)[:16]}{covered.digest()[:8]}.json"


def load(path: Path) -> list[CoveredRun] | None:
    """Read what is kept of a scene; return None if that is nothing, or damaged."""
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
        return [CoveredRun(**row | {"judged": tuple(Judged(**one) for one in row["judged"])}) for row in data]
    except (OSError, ValueError, TypeError, KeyError):
        return None


def save(path: Path, rows: Sequence[CoveredRun]) -> None:
    """Keep what came of a scene; errors without end stand as Infinity."""
    with whole_file(path) as temporary:
        temporary.write_text(json.dumps([asdict(row) for row in rows]), encoding="utf-8")


def run_scenes(chosen: Chosen, numbers: Sequence[int]) -> list[CoveredRun]:
    """Return the rows of all scenes in their order; those that are not kept are made under a progress bar."""
    (chosen.out / "scenes").mkdir(exist_ok=True)
    paths = {number: kept(chosen.out, chosen.seed, number) for number in numbers}
    found = {number: old for number, path in paths.items() if (old := load(path)) is not None}
    jobs = [number for number in numbers if number not in found]
    with worker_pool(chosen.workers) as pool, bar(f"{len(numbers)} scenes") as told:
        told([len(found) / len(numbers)])
        for place, made in pool.stream([(chosen.seed, number) for number in jobs], judged_scene):
            number = jobs[place]
            if isinstance(made, ProcessEndedError):
                made = [CoveredRun(fresh(chosen.seed, number).kind, number, ALL, refused=made.reason)]
            save(paths[number], made)
            found[number] = made
            told([len(found) / len(numbers)])
    return [row for number in numbers for row in found[number]]


# --- what came out ---


@dataclass(frozen=True)
class Share:
    """What came of some runs.

    runs, refused, met: how many. numbers: judged. apart: that no reference can judge. covered: share of the
    judged. worst: largest true error over the claimed one. overstated: median of claimed over true errors.
    """

    runs: int
    refused: int
    met: int
    numbers: int
    apart: int
    covered: float
    worst: float
    overstated: float


def share(rows: Sequence[CoveredRun]) -> Share:
    """Sum up what was judged of some runs."""
    numbers = [one for row in rows for one in row.judged]
    told = [one for one in numbers if not one.apart]
    wrong = [one.claimed / one.away for one in told if one.away > 0.0]
    return Share(
        runs=len(rows),
        refused=sum(bool(row.refused) for row in rows),
        met=sum(row.met for row in rows),
        numbers=len(told),
        apart=len(numbers) - len(told),
        covered=float(np.mean([one.ratio <= 1.0 for one in told])) if told else math.nan,
        worst=max((one.ratio for one in told), default=math.nan),
        overstated=float(np.median(wrong)) if wrong else math.nan,
    )


def groups(rows: Sequence[CoveredRun]) -> Iterator[tuple[str, str, Share]]:
    """Sum up the rows by kind and accuracy, by accuracy, and all together."""
    accuracies = list(dict.fromkeys(row.accuracy for row in rows))
    for kind in (*KINDS, ALL):
        for accuracy in (*accuracies, ALL):
            some = [row for row in rows if kind in (row.kind, ALL) and accuracy in (row.accuracy, ALL)]
            if some and (kind == ALL or accuracy != ALL):
                yield kind, accuracy, share(some)


def coverage_sheet(rows: Sequence[CoveredRun]) -> Sheet:
    """Lay out the table of kinds and accuracies."""
    header = (
        "scenes", "accuracy", "runs", "refused", "met", "numbers", "left out", "covered [%]",
        "worst true / claimed", "median claimed / true",
    )  # fmt: skip
    lines = tuple(
        (kind, accuracy, str(one.runs), str(one.refused), str(one.met), str(one.numbers), str(one.apart),
         f"{100.0 * one.covered:.2f}", f"{one.worst:.3g}", f"{one.overstated:.3g}")
        for kind, accuracy, one in groups(rows)
    )  # fmt: skip
    caption = (
        "Left out: numbers without a reference ten times closer than the error claimed or the distance. "
        f"Asked for, of all: at least {GOAL_COVERED:.0%} covered, worst below {GOAL_RATIO:g}, median at most "
        f"{GOAL_OVERSTATED:g}."
    )
    return Sheet("Errors claimed and true, on fresh scenes", header, lines, caption, left=2)


def offender_sheet(rows: Sequence[CoveredRun]) -> Sheet:
    """Lay out the numbers that are not covered, the worst first."""
    found = [(row, one) for row in rows for one in row.judged if not one.apart and one.ratio > 1.0]
    found.sort(key=lambda item: -item[1].ratio)
    lines = tuple(
        (str(row.number), row.kind, row.accuracy, row.formulation, one.name, f"{one.value:.9g}",
         f"{one.claimed:.2g}", f"{one.away:.2g}", f"{one.own:.1g}", one.by, f"{one.ratio:.3g}")
        for row, one in found[:WORST]
    )  # fmt: skip
    header = (
        "scene", "kind", "accuracy", "formulation", "number", "value", "error claimed", "true", "of reference",
        "reference", "true / claimed",
    )  # fmt: skip
    return Sheet(f"The worst of {len(found)} numbers that are not covered", header, lines, left=5)


def refusal_sheet(rows: Sequence[CoveredRun]) -> Sheet:
    """Lay out the runs that were refused, and why."""
    lines = tuple((str(row.number), row.kind, row.accuracy, row.refused) for row in rows if row.refused)
    return Sheet("Refused", ("scene", "kind", "accuracy", "reason"), lines, wide=True)


def numbers(rows: Sequence[CoveredRun]) -> list[Number]:
    """Return what summary.json holds."""
    return [
        Number(field.name, f"{kind}, {accuracy}", float(value), "1", 0.0)
        for kind, accuracy, one in groups(rows)
        for field in fields(Share)
        if math.isfinite(value := getattr(one, field.name))
    ]


# --- main ---


def study(chosen: Chosen) -> None:
    """Draw, run, judge and write everything into the output folder."""
    started = time.perf_counter()
    wanted = range(chosen.scenes) if chosen.only is None else [chosen.only]
    rows = run_scenes(chosen, wanted)
    tables: dict[str, Callable[[Sequence[CoveredRun]], Sheet]] = {
        "coverage": coverage_sheet,
        "worst": offender_sheet,
    }
    if any(row.refused for row in rows):
        tables["refused"] = refusal_sheet
    for name, sheet in tables.items():
        show_table(chosen.out / f"table_{name}", sheet(rows), width=200)
    counted = {"seed": chosen.seed, "scenes": len(wanted)}
    write_summary(chosen.out, STUDY, numbers(rows), time.perf_counter() - started, counted)


def _seed(text: str) -> int:
    """Read a seed from the command line, or a scene's number."""
    if not text.isdecimal() or int(text) >= LARGEST_SEED:
        raise argparse.ArgumentTypeError(f"{text[:40]!r}: allowed: a whole number from 0 to {LARGEST_SEED - 1}")
    return int(text)


def main(argv: Sequence[str] | None = None) -> int:
    """Run `python -m studies.benchmarking.coverage`; return its exit code."""
    parser = Parser(prog=f"python -m studies.benchmarking.{STUDY}", description=(__doc__ or "").splitlines()[0])
    add, out = parser.add_argument, Path("results") / STUDY
    add("--seed", type=_seed, required=True, metavar="S", help="that scenes are drawn from")
    add("--scenes", type=partial(count, most=MOST_SCENES), default=300, metavar="N", help="how many (300)")
    add("--only", type=_seed, metavar="K", help="scene K alone, from 0 on")
    add("--out", type=folder, default=out, metavar="DIR", help=f"folder for output ({out})")
    workers = partial(count, most=MOST_WORKERS)
    add("--workers", type=workers, default=os.cpu_count() or 1, metavar="N", help="processes (all cores)")
    given = parser.parse_args(argv)
    chosen = Chosen(given.seed, given.scenes, given.only, given.out, given.workers)

    def work() -> None:
        with output_folder(chosen.out):
            study(chosen)

    return answered(work)


if __name__ == "__main__":
    raise SystemExit(main())
