"""What is each of the paper's claims worth on machines that have all that the paper prints?

Every statement of abstract, sections 3 to 5 and conclusions is judged on the reference support and on two
hypercubes of machines: with what the paper prints, and with an engineer's contact, heavier bodies and other
times.
"""

from collections.abc import Sequence

from studies.claims.claim_list import CLAIMS
from studies.claims.evidence import unit
from studies.claims.figures import figures
from studies.claims.plausible import CONTACT, FACTORS, LOT, REFERENCE, Sample, samples
from studies.claims.plausible_runs import CASES, TOLERANCE, MachineRow, evidence, run_machines
from studies.claims.verdicts import (
    KINDS,
    NEEDS_MORE,
    NOT_MEASURABLE,
    Machines,
    Ruling,
    independent,
    percent,
    rule,
)
from studies.common.numbers import Number
from studies.common.options import Options
from studies.common.paper_machine import CYLINDERS
from studies.common.runs import bar
from studies.common.study import Study, StudyOutcome
from studies.common.words import JudgedClaim, text_table
from support_exudyn.postprocessing.page.pieces import Sheet
from user_forces.values.value import InputError

MACHINES = 80  # of the first hypercube; of the second half as many
MOST_MACHINES = 800  # of the first hypercube where all studies are run
FEW = 5  # statements that may need more machines there
SEED = 1

# --- machines ---


def is_second(sample: Sample) -> bool:
    """Whether a machine is of the second hypercube."""
    return sample[CONTACT] == CYLINDERS


def drawn(number: int) -> list[dict[str, str | float]]:
    """The reference support, so many machines of the first hypercube, and half as many of the second."""
    second = samples(-(-number // 2), SEED, second=True)
    return [REFERENCE, *samples(number, SEED), *second]


def judged(rows: Sequence[MachineRow]) -> list[Ruling]:
    """The verdicts on all statements, by the machines that could be run, the reference support first.

    Raises InputError if the reference support could not be run.
    """
    if rows[0].measures is None:
        raise InputError(f"reference support: {rows[0].failure}")
    first, second = (known(rows[1:], second=second) for second in (False, True))
    return [rule(claim, evidence(rows[0].measures), first, second) for claim in CLAIMS]


def known(rows: Sequence[MachineRow], *, second: bool) -> Machines:
    """The machines of one of both hypercubes that could be run."""
    return [
        (r.sample, evidence(r.measures))
        for r in rows
        if r.measures is not None and is_second(r.sample) == second
    ]


def draw(chosen: Options) -> tuple[list[MachineRow], list[Ruling]]:
    """Run the chosen number of machines, MACHINES by default; with all studies until few need more."""
    number = chosen.machines or MACHINES
    while True:
        samples_of = drawn(number)
        with bar(f"{len(samples_of)} machines") as show:
            rows = run_machines(samples_of, chosen.out, chosen.workers, show)
        rulings = judged(rows)
        left = sum(ruling.kind == NEEDS_MORE for ruling in rulings)
        if chosen.machines or not chosen.thorough or left <= FEW or number >= MOST_MACHINES:
            return rows, rulings
        number += 2 * LOT


# --- tables ---


def verdict_table(rulings: Sequence[Ruling]) -> Sheet:
    """A row a verdict: how many statements have it, and which."""
    numbered = list(enumerate(rulings, 1))
    apart = independent(rulings)
    rows = []
    for kind in KINDS:
        which = [n for n, ruling in numbered if ruling.kind == kind]
        alone = [ruling for ruling in apart if ruling.kind == kind]
        second = sum(ruling.verdict(ruling.second) == kind for ruling in rulings)
        repeated = "" if kind == NOT_MEASURABLE else str(len(alone))
        rows.append((kind, str(len(which)), repeated, str(second), ", ".join(map(str, which))))
    header = ("verdict", "statements", "without repetitions", "second hypercube", "no.")
    return text_table(header, rows, wide=True)


def claim_table(rulings: Sequence[Ruling]) -> Sheet:
    """A row a statement."""
    rows = []
    for n, ruling in enumerate(rulings, 1):
        claim = ruling.claim
        numbers = f"{ruling.ours} (paper: {claim.paper})" if claim.paper else ruling.ours
        text = f"{claim.text} ({claim.where})"
        shares = (_share(ruling), str(ruling.second))
        rows.append((str(n), text, ruling.kind, *shares, numbers, _error(ruling), claim.reading))
    header = (
        "no.", "statement (where)", "verdict", "machines", "second hypercube", "reference support (paper)",
        "error", "read as",
    )  # fmt: skip
    return text_table(header, rows, wide=True)


def _error(ruling: Ruling) -> str:
    if ruling.claim.judge is None:
        return ""
    return "0" if ruling.error is None else f"{ruling.error:.0e}"


def _share(ruling: Ruling) -> str:
    return "closed form" if ruling.claim.closed_form else str(ruling.first)


def threshold_table(rulings: Sequence[Ruling]) -> Sheet:
    """A row a statement whose judge has a threshold: its share of machines with others."""
    rows = []
    for n, ruling in enumerate(rulings, 1):
        if ruling.thresholds:
            cells = (f"{_threshold(at.threshold)}: {at.counted}, {at.counted.kind}" for at in ruling.thresholds)
            rows.append((str(n), ruling.claim.name, *cells, "yes" if ruling.hangs else "no"))
    header = ("no.", "statement", "lower", "middle", "upper", "hangs on it")
    return text_table(header, rows, wide=True)


def _threshold(value: float) -> str:
    """A share in per cent; a correlation as it is."""
    return f"{100.0 * value:g} %" if value < 0.5 else f"{value:g}"


def factor_table() -> Sheet:
    """The data that are drawn."""
    rows = []
    for factor in FACTORS:
        first, second = (factor.span(second=second) for second in (False, True))
        assumed = REFERENCE[factor.name]
        shown = assumed if isinstance(assumed, str) else f"{assumed:g}"
        rows.append(
            (factor.label, factor.meaning, first, "" if first == second else second, shown, factor.reason)
        )
    header = ("datum", "meaning", "first hypercube", "second, if not alike", "reference support", "reason")
    return text_table(header, rows, wide=True)


def failure_table(rows: Sequence[MachineRow]) -> Sheet:
    """Machines that could not be run."""
    failed = tuple(
        (str(n), f"{row.sample['scale']:.3g}", f"{row.sample['start_height']:.3g}", row.failure)
        for n, row in enumerate(rows)
        if row.failure is not None
    )
    return text_table(("machine", "scale", "start height", "reason"), failed, wide=True)


def tables(rulings: Sequence[Ruling], rows: Sequence[MachineRow]) -> dict[str, Sheet]:
    """All tables by name; that of failures only if there are some."""
    found = {
        "verdicts": verdict_table(rulings),
        "table": claim_table(rulings),
        "thresholds": threshold_table(rulings),
        "factors": factor_table(),
    }
    failures = failure_table(rows)
    return found | {"failures": failures} if failures.rows else found


# --- numbers and words ---


def measure(rulings: Sequence[Ruling], rows: Sequence[MachineRow]) -> list[Number]:
    """Verdicts, shares with their uncertainty, and the reference support's measures with numerical errors."""
    left = float(sum(ruling.kind == NEEDS_MORE for ruling in rulings))  # which more machines may put elsewhere
    numbers = [
        Number("plausible_machines", case, float(len(known(rows[1:], second=second))), "1", 0.0)
        for case, second in (("first hypercube", False), ("second hypercube", True))
    ]
    numbers += [
        Number("plausible_machines", "failed", float(sum(row.measures is None for row in rows)), "1", 0.0),
        Number("claims", "all", float(len(rulings)), "1", 0.0),
    ]
    for case, those in (("", rulings), (", without repetitions", independent(rulings))):
        for kind in KINDS:
            of_kind = float(sum(ruling.kind == kind for ruling in those))
            numbers.append(Number("claims", f"{kind}{case}", of_kind, "1", left))
    for name, second in (("share_of_machines", False), ("share_of_second_hypercube", True)):
        for n, ruling in enumerate(rulings, 1):
            counted = ruling.second if second else ruling.first
            if counted.share is not None:
                low, high = counted.interval
                error = max(high - counted.share, counted.share - low)
                numbers.append(Number(name, f"claim {n}", counted.share, "1", error))
    for case, row in evidence(rows[0].measures or {}).measures.items():
        numbers += [Number(name, case, m.value, unit(name) or "1", m.error) for name, m in row.items()]
    return numbers


def judged_claims(rulings: Sequence[Ruling]) -> tuple[JudgedClaim, ...]:
    """All statements with verdict, reason, and what shows it."""
    numbers = {ruling.claim.name: n for n, ruling in enumerate(rulings, 1)}
    return tuple(
        JudgedClaim(
            str(n), r.claim.where, r.claim.text, r.kind, _why(r, numbers), r.claim.figure, r.claim.shown_in
        )
        for n, r in enumerate(rulings, 1)
    )


def _why(ruling: Ruling, numbers: dict[str, int]) -> str:
    """The reason for a verdict, in a few sentences with numbers."""
    claim, first = ruling.claim, ruling.first
    if claim.judge is None:
        reason = claim.reading.removeprefix(f"{NOT_MEASURABLE}: ")
        return f"{reason[0].upper()}{reason[1:]}."
    parts = []
    if first.share is not None:
        low, high = map(percent, first.interval)
        share = f"{percent(first.share)} % of {first.holds + first.fails} machines"
        parts.append(f"It holds on {share} (with 95 % confidence on {low} to {high} % of all)")
    if first.undecided:
        parts.append(f"On {first.undecided} of {sum(first)} machines the numerical error leaves it undecided")
    if ruling.depends:
        parts.append(f"The machines part most by {ruling.depends}")
    if ruling.second.share is not None:
        parts.append(f"In the second hypercube it holds on {percent(ruling.second.share)} %")
    if claim.follows_from:
        parts.append(f"It is contained in no. {numbers[claim.follows_from]}")
    parts.append(f"Reference support: {ruling.ours}" + (f" (paper: {claim.paper})" if claim.paper else ""))
    return "".join(f"{part}. " for part in parts).rstrip()


def words(rulings: Sequence[Ruling], rows: Sequence[MachineRow]) -> dict[str, object]:
    """The numbers of the sentences."""
    numbered = list(enumerate(rulings, 1))
    apart = independent(rulings)
    return {
        "first": len(known(rows[1:], second=False)),
        "second": len(known(rows[1:], second=True)),
        "failed": sum(row.measures is None for row in rows),
        "factors": len(FACTORS),
        "cases": len(CASES),
        "tolerance": TOLERANCE,
        "statements": len(rulings),
        "kinds": {kind: [n for n, ruling in numbered if ruling.kind == kind] for kind in KINDS},
        "independent": len(apart),
        "independent_holds": sum(ruling.kind == KINDS[0] for ruling in apart),
        "repeated": [(n, r.claim.follows_from) for n, r in numbered if r.claim.follows_from],
        "undecided": [n for n, r in numbered if r.kind == NOT_MEASURABLE and r.claim.judge is not None],
        "hanging": [n for n, ruling in numbered if ruling.hangs],
        "differs": [n for n, ruling in numbered if ruling.differs],
        "messages": {
            kind: [r.claim.name for r in rulings if r.claim.is_message and r.kind == kind] for kind in KINDS
        },
        "named": {r.claim.name: str(r.first) for r in rulings if r.claim.name},
    }


def work(chosen: Options) -> StudyOutcome:
    """The machines of both hypercubes and the reference support, and the verdicts on all statements."""
    rows, rulings = draw(chosen)
    first, second = (known(rows[1:], second=second) for second in (False, True))
    drawings = figures(rulings, evidence(rows[0].measures or {}), first, second)
    sheets = tables(rulings, rows)
    return StudyOutcome(
        measure(rulings, rows), words(rulings, rows), drawings, sheets, claims=judged_claims(rulings)
    )


study = Study("claims", __doc__, work, seconds=70.0)
