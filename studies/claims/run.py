"""What is each of the paper's claims worth, when everything it leaves open is uncertain?

Every claim of abstract, sections 3 to 5 and conclusions is judged on the reference support and on plausible
machines: a Latin hypercube over all data that the paper does not give.
"""

import csv
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from studies.claims import hypercube
from studies.claims.changes import FORMER_MACHINES, change_table
from studies.claims.claim_list import CLAIMS, Claim
from studies.claims.evidence import Evidence, Measured
from studies.claims.figures import figures
from studies.claims.plausible import FACTORS, ON_OIL_EVERY, REFERENCE, Sample, samples
from studies.claims.plausible_runs import CASES, LARGEST_FORCE, TOLERANCE, evidence, measures, oil_scenarios
from studies.claims.verdicts import KINDS, Ruling, asked, judgements, known_to, percent, rule
from studies.common.chapter import JudgedClaim
from studies.common.numbers import Number, measured
from studies.common.options import Options
from studies.common.runs import run_with_errors
from studies.common.study import Study, StudyOutcome
from studies.common.words import TextTable
from support_exudyn.files.whole_file import whole_file

MACHINES = 80  # a statement that holds on all of them holds on more than 95 % of such machines
SEED = 1

Machines = list[tuple[Sample, Evidence]]


# --- tables ---


def message_table(rulings: Sequence[Ruling]) -> TextTable:
    """What the abstract says and can be judged, a row a claim."""
    rows = [
        (str(n), ruling.claim.text, ruling.verdict, _share(ruling), ruling.ours)
        for n, ruling in enumerate(rulings, 1)
        if ruling.claim.is_message
    ]
    header = ("no.", "message of the abstract", "verdict", "machines", "reference support")
    return TextTable(header, tuple(rows), wide=True, width=160)


def claim_table(rulings: Sequence[Ruling]) -> TextTable:
    """One row a claim."""
    rows = []
    for n, ruling in enumerate(rulings, 1):
        claim = ruling.claim
        numbers = f"{ruling.ours} (paper: {claim.paper})" if claim.paper else ruling.ours
        what = f"{claim.text} ({claim.where})"
        rows.append((str(n), what, ruling.verdict, _share(ruling), numbers, _error(ruling), claim.reading))
    header = ("no.", "claim (where)", "verdict", "machines", "reference support (paper)", "error", "read as")
    return TextTable(header, tuple(rows), wide=True, width=200)


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


def threshold_table(rulings: Sequence[Ruling]) -> TextTable:
    """A row a claim whose judge has a threshold: its share of machines with others."""
    rows = []
    for n, ruling in enumerate(rulings, 1):
        if ruling.thresholds:
            cells = (
                f"{_threshold(threshold)}: {'open' if share is None else f'{percent(share)} %'}, {kind}"
                for threshold, share, kind in ruling.thresholds
            )
            rows.append((str(n), ruling.claim.name, *cells, "yes" if ruling.hangs else "no"))
    header = ("no.", "claim", "lower", "middle", "upper", "hangs on it")
    return TextTable(header, tuple(rows), wide=True, width=160)


def _threshold(value: float) -> str:
    """A share in per cent; a correlation as it is."""
    return f"{100.0 * value:g} %" if value < 0.5 else f"{value:g}"


def factor_table() -> TextTable:
    """What is varied."""
    rows = []
    for factor in FACTORS:
        assumed = REFERENCE[factor.name]
        said = assumed if isinstance(assumed, str) else f"{assumed:g}"
        rows.append((factor.said, factor.meaning, factor.span, said, factor.reason))
    header = ("datum", "meaning", "range", "reference support", "reason")
    return TextTable(header, tuple(rows), wide=True, width=160)


def failure_table(rows: Sequence[hypercube.MachineRow]) -> TextTable:
    """Machines that could not be run."""
    failed = tuple(
        (str(n), f"{row.sample['scale']:.3g}", f"{row.sample['start_height']:.3g}", row.failure)
        for n, row in enumerate(rows, 1)
        if row.failure is not None
    )
    return TextTable(("machine", "scale", "start height", "reason"), failed, wide=True, width=160)


def write_machines(path: Path, rows: Sequence[hypercube.MachineRow]) -> None:
    """One row a machine: its data, what went wrong, and how it judges every claim, by the claim's number."""
    judged = [(n, claim) for n, claim in enumerate(CLAIMS, 1) if claim.judge is not None and not claim.alone]
    with whole_file(path) as temporary, temporary.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        names = [factor.name for factor in FACTORS]
        writer.writerow(["machine", *names, "failure", *(f"claim_{n}" for n, _ in judged)])
        for n, row in enumerate(rows, 1):
            known = None if row.measures is None else evidence(row.measures)
            verdicts = ["" if known is None else _mark_of(claim, row.sample, known) for _, claim in judged]
            writer.writerow([n, *(row.sample[name] for name in names), row.failure or "", *verdicts])


def _mark_of(claim: Claim, sample: Sample, known: Evidence) -> str:
    """How a machine judges a claim; empty if it is not asked."""
    those = asked(claim, [(sample, known)])
    return _mark(claim.judge(known)) if those and claim.judge is not None else ""


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
    left = float(sum(ruling.too_few for ruling in rulings))  # which more machines may put elsewhere
    numbers += [Number("claims", kind, float(_kinds(rulings)[kind]), "1", left) for kind in KINDS]
    for n, ruling in enumerate(rulings, 1):
        if ruling.share is not None and ruling.interval is not None:
            low, high = ruling.interval
            error = max(high - ruling.share, ruling.share - low)
            numbers.append(Number("share_of_machines", f"claim {n}", ruling.share, "1", error))
    for case, row in reference.measures.items():
        numbers += [Number(name, case, m.value, _unit(name), m.error) for name, m in row.items()]
    return numbers


UNITS = {"force": "N", "speed": "deg/s", "acceleration": "deg/s^2", "impulse": "N s", "tip": "mm"}


def _unit(name: str) -> str:
    if name.startswith("likeness") or name.endswith("upright"):
        return "1"
    return next((unit for word, unit in UNITS.items() if word in name.split("_")), "deg")


def _kinds(rulings: Sequence[Ruling]) -> Counter[str]:
    return Counter(ruling.kind for ruling in rulings)


# --- the list of claims ---


def judged_claims(rulings: Sequence[Ruling]) -> tuple[JudgedClaim, ...]:
    """All claims with verdict, reason, and what shows it."""
    return tuple(
        JudgedClaim(str(n), r.claim.where, r.claim.text, r.verdict, _why(r), r.claim.figure, r.claim.table)
        for n, r in enumerate(rulings, 1)
    )


def _why(ruling: Ruling) -> str:
    """The reason for a verdict, in one or two sentences with numbers."""
    claim = ruling.claim
    if claim.judge is None:
        reason = claim.reading.removeprefix("cannot be judged: ")
        return f"{reason[0].upper()}{reason[1:]}."
    ours = f"Reference support: {ruling.ours}" + (f" (paper: {claim.paper})." if claim.paper else ".")
    if ruling.share is None or ruling.interval is None:
        return ours
    low, high = (percent(bound) for bound in ruling.interval)
    decided = ruling.holds + ruling.fails
    counted = f"It holds for {percent(ruling.share)} % of {decided} plausible machines"
    return f"{counted} (with 95 % confidence for {low} to {high} % of all). {ours}"


# --- the study ---


def work(chosen: Options) -> StudyOutcome:
    """The plausible machines and the reference support, and the verdicts on all claims."""
    rows = _run(samples(chosen.machines or MACHINES, SEED), chosen)
    write_machines(chosen.out / "machines.csv", rows)
    machines: Machines = [(row.sample, evidence(row.measures)) for row in rows if row.measures is not None]
    reference = reference_evidence(chosen)
    rulings = [rule(claim, reference, machines) for claim in CLAIMS]
    numbers = measure(rulings, reference, len(machines), len(rows) - len(machines))
    drawings = figures(rulings, reference, machines)
    claims = judged_claims(rulings)
    changes = change_table(rulings, [_decided(claim, machines) for claim in CLAIMS])
    sheets = tables(rulings, rows) | {"changes": changes}
    return StudyOutcome(numbers, words(rulings, rows), drawings, sheets, claims=claims)


def _decided(claim: Claim, machines: Machines) -> list[tuple[Sample, bool]]:
    """How the machines judge a claim that it is not open on."""
    if claim.judge is None:
        return []
    judged = judgements(claim.judge, asked(claim, machines))
    return [(sample, verdict) for sample, verdict in judged if verdict is not None]


def tables(rulings: Sequence[Ruling], rows: Sequence[hypercube.MachineRow]) -> dict[str, TextTable]:
    """All tables by name, but that of changes; that of failures only if there are some."""
    failures = failure_table(rows)
    found = {
        "messages": message_table(rulings),
        "table": claim_table(rulings),
        "thresholds": threshold_table(rulings),
        "factors": factor_table(),
    }
    return found | {"failures": failures} if failures.rows else found


def words(rulings: Sequence[Ruling], rows: Sequence[hypercube.MachineRow]) -> dict[str, object]:
    """What the sentences are filled with."""
    told = list(enumerate(rulings, 1))
    return {
        "machines": len(rows),
        "run": sum(row.failure is None for row in rows),
        "factors": len(FACTORS),
        "cases": len(CASES),
        "tolerance": TOLERANCE,
        "judged": len(rulings),
        "kinds": {kind: [n for n, ruling in told if ruling.kind == kind] for kind in KINDS},
        "on_oil": ON_OIL_EVERY,
        "former_machines": FORMER_MACHINES,
        "known_to": 100.0 * known_to(len(rows)),
        "formerly_known_to": 100.0 * known_to(FORMER_MACHINES),
        "hanging": [n for n, ruling in told if ruling.hangs],
        "too_few": [n for n, ruling in told if ruling.too_few],
        "messages": {
            kind: [r.claim.name for r in rulings if r.claim.is_message and r.kind == kind] for kind in KINDS
        },
        "named": {r.claim.name: _share(r) for r in rulings if r.claim.name and not r.claim.alone},
    }


def reference_evidence(chosen: Options) -> Evidence:
    """The reference support's measures, with those of the runs on columns of oil."""
    results = run_with_errors(oil_scenarios(), chosen)
    known = {
        case: {"largest_force": Measured(n.value, n.numerical_error)}
        for case, result in results.items()
        for n in [measured("largest_force", case, "N", result, LARGEST_FORCE[case])]
    }
    return Evidence(dict(evidence(measures(REFERENCE)).measures) | known)


def _run(chosen_samples: Sequence[Sample], chosen: Options) -> list[hypercube.MachineRow]:
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True)) as bars:
        task = bars.add_task("plausible machines", total=len(chosen_samples))

        def show(done: int, total: int) -> None:
            bars.update(task, completed=done, total=total)

        return hypercube.run(chosen_samples, chosen.out, chosen.workers, show)


study = Study("claims", __doc__, work, seconds=70.0)
main = study.main
