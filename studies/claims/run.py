"""What is each of the paper's claims worth, when everything it leaves open is uncertain?

Every claim of abstract, sections 3 to 5 and conclusions is judged on the reference support and on plausible
machines: a Latin hypercube over all data that the paper does not give.
"""

from __future__ import annotations

import csv
import time
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from studies.claims import hypercube
from studies.claims.claim_list import CLAIMS
from studies.claims.evidence import Evidence, Measured
from studies.claims.figures import figures, pictures
from studies.claims.plausible import FACTORS, REFERENCE, Sample, samples
from studies.claims.plausible_runs import CASES, LARGEST_FORCE, TOLERANCE, evidence, measures, oil_scenarios
from studies.claims.verdicts import Ruling, percent, rule
from studies.common.chapter import Chapter, Sheet
from studies.common.study import (
    Number,
    Options,
    measured,
    options,
    run_main,
    run_with_errors,
    save_figures,
    show_table,
    write_summary,
)
from support_exudyn.files.whole_file import whole_file
from support_exudyn.postprocessing.figures import style

STUDY = "claims"
MACHINES, QUICK_MACHINES = 256, 8
SEED = 1
KINDS = ("holds", "holds only", "not supported", "cannot be judged")

Machines = list[tuple[Sample, Evidence]]


# --- tables ---


def claim_sheet(rulings: Sequence[Ruling]) -> Sheet:
    """One row a claim."""
    rows = []
    for n, ruling in enumerate(rulings, 1):
        claim = ruling.claim
        numbers = f"{ruling.ours} (paper: {claim.paper})" if claim.paper else ruling.ours
        rows.append(
            (
                str(n),
                f"{claim.text} ({claim.where})",
                ruling.verdict,
                _share(ruling),
                numbers,
                _error(ruling),
                claim.reading,
            )
        )
    return Sheet(
        "The paper's claims",
        ("no.", "claim (where)", "verdict", "machines", "reference support (paper)", "error", "read as"),
        tuple(rows),
        "Four numbers: clearances of 0.5, 1.0, 1.5, 2.0 mm; drive mode 2 unless said; no digit is shown that "
        "the numerical error does not leave. Error: the largest numerical error of these numbers, as a share "
        "of the number (mean accelerations are next to zero). Machines: share of the plausible machines for "
        "which the claim holds, 95 % confidence interval, and how many the numerical error leaves open. "
        "Verdict: holds from 95 % on, not supported up to 5 %; in between, the bound on one datum, or two "
        "together, that foretells most judgements. Right for: machines that were not used to find the bound; "
        "below 85 % it is called most telling.",
        wide=True,
    )


def _error(ruling: Ruling) -> str:
    if ruling.claim.judge is None:
        return ""
    return "0" if ruling.error is None else f"{ruling.error:.0e}"


def _share(ruling: Ruling) -> str:
    if ruling.share is None or ruling.interval is None:
        return ruling.claim.alone
    low, high = (100.0 * bound for bound in ruling.interval)
    left = f", {ruling.open} open" if ruling.open else ""
    return f"{percent(ruling.share)} % ({low:.0f} to {high:.0f}){left}"


def factor_sheet() -> Sheet:
    """What is varied."""
    rows = []
    for factor in FACTORS:
        assumed = REFERENCE[factor.name]
        said = assumed if isinstance(assumed, str) else f"{assumed:g}"
        rows.append((factor.said, factor.meaning, factor.span, said, factor.reason))
    return Sheet(
        "Plausible machines: what is varied",
        ("datum", "meaning", "range", "reference support", "reason"),
        tuple(rows),
        "The pin's size, the materials, the clearances and the stroke are the paper's and stay.",
        wide=True,
    )


def failure_sheet(rows: Sequence[hypercube.Row]) -> Sheet:
    """Machines that could not be run."""
    failed = [
        (str(n), f"{row.sample['scale']:.3g}", f"{row.sample['start_height']:.3g}", row.failure)
        for n, row in enumerate(rows, 1)
        if row.failure is not None
    ]
    return Sheet(
        f"Plausible machines that could not be run: {len(failed)} of {len(rows)}",
        ("machine", "scale", "start height", "reason"),
        tuple(failed),
        wide=True,
    )


def write_machines(path: Path, rows: Sequence[hypercube.Row]) -> None:
    """One row a machine: its data, what went wrong, and how it judges every claim, by the claim's number."""
    judged = [(n, claim) for n, claim in enumerate(CLAIMS, 1) if claim.judge is not None and not claim.alone]
    with whole_file(path) as temporary, temporary.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        names = [factor.name for factor in FACTORS]
        writer.writerow(["machine", *names, "failure", *(f"claim_{n}" for n, _ in judged)])
        for n, row in enumerate(rows, 1):
            known = None if row.measures is None else evidence(row.measures)
            verdicts = [
                "" if known is None or claim.judge is None else _mark(claim.judge(known)) for _, claim in judged
            ]
            writer.writerow([n, *(row.sample[name] for name in names), row.failure or "", *verdicts])


def _mark(verdict: bool | None) -> str:
    return {True: "holds", False: "fails", None: "open"}[verdict]


# --- numbers ---


def measure(rulings: Sequence[Ruling], reference: Evidence, machines: int, failed: int) -> list[Number]:
    """Shares and their uncertainty; the reference support's measures with their numerical errors."""
    numbers = [
        Number("plausible_machines", "run", float(machines), "1", 0.0),
        Number("plausible_machines", "failed", float(failed), "1", 0.0),
        Number("claims", "all", float(len(rulings)), "1", 0.0),
    ]
    numbers += [Number("claims", kind, float(_kinds(rulings)[kind]), "1", 0.0) for kind in KINDS]
    for n, ruling in enumerate(rulings, 1):
        if ruling.share is not None and ruling.interval is not None:
            low, high = ruling.interval
            numbers.append(Number("share_of_machines", f"claim {n}", ruling.share, "1", 0.5 * (high - low)))
    for case, row in reference.measures.items():
        numbers += [Number(name, case, m.value, _unit(name), m.error) for name, m in row.items()]
    return numbers


UNITS = {"force": "N", "speed": "deg/s", "acceleration": "deg/s^2", "impulse": "N s", "tip": "mm"}


def _unit(name: str) -> str:
    if name.startswith("likeness") or name.endswith("upright"):
        return "1"
    return next((unit for word, unit in UNITS.items() if word in name.split("_")), "deg")


def _kinds(rulings: Sequence[Ruling]) -> Counter[str]:
    return Counter(_kind(ruling) for ruling in rulings)


def _kind(ruling: Ruling) -> str:
    """Which of KINDS a verdict is; the longest that it begins with."""
    return max((kind for kind in KINDS if ruling.verdict.startswith(kind)), key=len)


# --- words ---


def chapter(rulings: Sequence[Ruling], rows: Sequence[hypercube.Row], quick: bool) -> Chapter:
    """The study as a chapter of the report."""
    run = sum(row.failure is None for row in rows)
    sheets = [claim_sheet(rulings), factor_sheet()]
    if run < len(rows):
        sheets.append(failure_sheet(rows))
    return Chapter(
        study=STUDY,
        title="The claims",
        question="What is each of the paper's claims worth when everything it leaves open is uncertain?",
        method=(
            f"The claims of abstract, sections 3 to 5 and conclusions are {len(CLAIMS)} once repetitions are "
            "taken together. Each is given a reading that can be measured, with thresholds stated; where none "
            "can be given the table says why.",
            f"The paper gives no dimensions, masses, restitution or friction. {len(rows)} plausible machines "
            f"are drawn by a Latin hypercube over {len(FACTORS)} data. On each, {len(CASES)} rises are "
            "computed: the ideal pin and four clearances in mode 2, the ideal pin and 1.5 mm in mode 1 (rigid "
            "columns). They are computed with the two free coordinates of the support alone, an independent "
            "formulation that agrees with the engine's runs of the chapters before.",
            f"Every run is made three times, the first at a tolerance of {TOLERANCE:g}, each with half the "
            "steps of the one before; how fast their distances fall tells the numerical error. A comparison of "
            "two numbers whose errors overlap is open, and open ones are not counted.",
        ),
        findings=_findings(rulings, rows, run),
        pictures=pictures(),
        sheets=tuple(sheets),
        quick=quick,
    )


def _findings(rulings: Sequence[Ruling], rows: Sequence[hypercube.Row], run: int) -> tuple[str, ...]:
    kinds = _kinds(rulings)
    failed = len(rows) - run
    found = [
        f"Of {len(rulings)} claims {kinds['holds']} hold, {kinds['holds only']} hold only for part of the "
        f"plausible machines, {kinds['not supported']} are not supported and {kinds['cannot be judged']} "
        "cannot be judged.",
        f"{run} of {len(rows)} plausible machines could be run"
        + (f"; {failed} could not, for the reasons given in the last table." if failed else "."),
    ]
    told = list(enumerate(rulings, 1))
    for kind in ("holds", "not supported", "cannot be judged"):
        listed = [str(n) for n, ruling in told if _kind(ruling) == kind]
        if listed:
            found.append(f"{kind.capitalize()}: {', '.join(listed)}.")
    for n, ruling in told:
        if _kind(ruling) == "holds only":
            found.append(f"No. {n}, {ruling.claim.text.rstrip('.')}: {ruling.verdict}.")
    return tuple(found)


# --- main ---


def study(chosen: Options) -> None:
    """Run, judge, draw and write everything into the output folder."""
    started = time.perf_counter()
    number = chosen.machines or (QUICK_MACHINES if chosen.quick else MACHINES)
    rows = _run(samples(number, SEED), chosen)
    machines: Machines = [(row.sample, evidence(row.measures)) for row in rows if row.measures is not None]
    reference = reference_evidence(chosen)
    rulings = [rule(claim, reference, machines) for claim in CLAIMS]
    write_machines(chosen.out / "machines.csv", rows)
    with style.look():
        drawings = figures(rulings, reference, machines)
    save_figures(chosen, drawings)
    show_table(chosen.out / "table.txt", claim_sheet(rulings), width=200)
    said = chapter(rulings, rows, chosen.quick)
    for sheet, name in zip(said.sheets[1:], ("factors", "failures"), strict=False):
        show_table(chosen.out / f"{name}.txt", sheet, width=160)
    said.save(chosen.out)
    numbers = measure(rulings, reference, len(machines), len(rows) - len(machines))
    write_summary(chosen.out, STUDY, numbers, time.perf_counter() - started)


def reference_evidence(chosen: Options) -> Evidence:
    """The reference support's measures, with those of the runs on columns of oil."""
    results = run_with_errors(oil_scenarios(chosen.quick), chosen.workers)
    known = {
        case: {"largest_force": Measured(n.value, n.numerical_error)}
        for case, result in results.items()
        for n in [measured("largest_force", case, "N", result, LARGEST_FORCE)]
    }
    return Evidence(dict(evidence(measures(REFERENCE)).measures) | known)


def _run(chosen_samples: Sequence[Sample], chosen: Options) -> list[hypercube.Row]:
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True)) as bars:
        task = bars.add_task("plausible machines", total=len(chosen_samples))

        def show(done: int, total: int) -> None:
            bars.update(task, completed=done, total=total)

        return hypercube.run(chosen_samples, chosen.out, chosen.workers, show)


def main(argv: Sequence[str] | None = None) -> int:
    """Entry of `python -m studies.claims`."""
    description = (__doc__ or "").splitlines()[0]
    return run_main(study, options(STUDY, argv, description))
