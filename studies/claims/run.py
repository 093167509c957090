"""What is each of the paper's claims worth on machines that have all that the paper prints?

Every statement of abstract, sections 3 to 5 and conclusions is judged on the reference support and on two
hypercubes of machines: with what the paper prints, and with an engineer's contact, heavier bodies and other
times.
"""

from collections.abc import Sequence

from matplotlib.figure import Figure

from studies.claims.claim_list import CLAIMS, unit
from studies.claims.figures import figures
from studies.claims.plausible import CONTACT, FACTORS, LOT, REFERENCE, Choice, samples
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
from studies.common.study import Study
from studies.common.words import JudgedClaim, text_table
from support_exudyn.postprocessing.page.pieces import Sheet
from user_forces.values.value import InputError

MACHINES = 80  # of the first hypercube; of the second half as many
MOST_MACHINES = 800  # of the first hypercube where all studies are run
FEW = 5  # statements that may need more machines there
SEED = 1


def drawn(number: int) -> list[dict[str, Choice]]:
    """The reference support, so many machines of the first hypercube, and half as many of the second."""
    return [REFERENCE, *samples(number, SEED), *samples(-(-number // 2), SEED, second=True)]


def judged(rows: Sequence[MachineRow]) -> list[Ruling]:
    """The verdicts on all statements, by the machines that could be run, the reference support first.

    Raises InputError if the reference support could not be run.
    """
    if rows[0].measures is None:
        raise InputError(f"reference support: {rows[0].failure}")
    return [rule(claim, evidence(rows[0].measures), *hypercubes(rows)) for claim in CLAIMS]


def hypercubes(rows: Sequence[MachineRow]) -> tuple[Machines, Machines]:
    """The machines of both hypercubes that could be run."""
    ran = [(row.sample, evidence(row.measures)) for row in rows[1:] if row.measures is not None]
    first = [one for one in ran if one[0][CONTACT] != CYLINDERS]
    return first, [one for one in ran if one[0][CONTACT] == CYLINDERS]


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


def why(ruling: Ruling, numbers: dict[str, int]) -> str:
    """The reason for a verdict, in a few sentences with numbers; numbers: of statements by their names."""
    claim, first = ruling.claim, ruling.first
    if not claim.is_measurable:
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


class Claims(Study):
    """What is each of the paper's claims worth on machines that have all that the paper prints?"""

    name, seconds = "claims", 70.0

    def work(self) -> None:
        """The machines of both hypercubes and the reference support, and the verdicts on all statements."""
        self.rows, self.rulings = draw(self.chosen)
        self.hypercubes = hypercubes(self.rows)
        self.numbers = self.measured()

    def figures(self) -> dict[str, Figure]:
        """All figures."""
        return figures(self.rulings, evidence(self.rows[0].measures or {}), *self.hypercubes)

    def tables(self) -> dict[str, Sheet]:
        """Verdicts, statements, thresholds, data that are drawn, and machines that could not be run, if any."""
        rulings, apart = self.rulings, independent(self.rulings)
        numbered = list(enumerate(rulings, 1))
        verdicts = []
        for kind in KINDS:
            which = [n for n, ruling in numbered if ruling.kind == kind]
            second = sum(ruling.verdict(ruling.second) == kind for ruling in rulings)
            repeated = "" if kind == NOT_MEASURABLE else str(sum(ruling.kind == kind for ruling in apart))
            verdicts.append((kind, str(len(which)), repeated, str(second), ", ".join(map(str, which))))

        statements: list[tuple[str, ...]] = []
        thresholds: list[tuple[str, ...]] = []
        for n, ruling in numbered:
            claim = ruling.claim
            share = "closed form" if claim.stiffness_mm else str(ruling.first)
            ours = f"{ruling.ours} (paper: {claim.paper})" if claim.paper else ruling.ours
            error = f"{ruling.error:.0e}" if ruling.error else "0" if claim.is_measurable else ""
            text = f"{claim.text} ({claim.where})"
            statements.append(
                (str(n), text, ruling.kind, share, str(ruling.second), ours, error, claim.reading)
            )
            if ruling.thresholds:
                cells = (
                    f"{100.0 * at:g} %: {counted}, {counted.kind}"
                    if at < 0.5
                    else f"{at:g}: {counted}, {counted.kind}"
                    for at, counted in ruling.thresholds.items()
                )
                thresholds.append((str(n), claim.name, *cells, "yes" if ruling.hangs else "no"))

        factors = []
        for factor in FACTORS:
            first_span, second_span = factor.span(second=False), factor.span(second=True)
            reference = REFERENCE[factor.name]
            shown = reference if isinstance(reference, str) else f"{reference:g}"
            differing = "" if first_span == second_span else second_span
            factors.append((factor.label, factor.meaning, first_span, differing, shown, factor.reason))

        failures: list[tuple[str, ...]] = [
            (str(n), f"{row.sample['scale']:.3g}", f"{row.sample['start_height']:.3g}", row.failure)
            for n, row in enumerate(self.rows)
            if row.failure is not None
        ]
        found: dict[str, tuple[tuple[str, ...], Sequence[tuple[str, ...]]]] = {
            "verdicts": (
                ("verdict", "statements", "without repetitions", "second hypercube", "no."),
                verdicts,
            ),
            "table": (
                (
                    "no.", "statement (where)", "verdict", "machines", "second hypercube",
                    "reference support (paper)", "error", "read as",
                ),
                statements,
            ),
            "thresholds": (("no.", "statement", "lower", "middle", "upper", "hangs on it"), thresholds),
            "factors": (
                ("datum", "meaning", "first hypercube", "second, if not alike", "reference support", "reason"),
                factors,
            ),
            "failures": (("machine", "scale", "start height", "reason"), failures),
        }  # fmt: skip
        return {
            name: text_table(header, rows_of, wide=True)
            for name, (header, rows_of) in found.items()
            if rows_of or name != "failures"
        }

    def measured(self) -> list[Number]:
        """Verdicts, shares with their uncertainty, and the reference support's measures with errors."""
        rows, rulings, (first, second) = self.rows, self.rulings, self.hypercubes
        left = sum(ruling.kind == NEEDS_MORE for ruling in rulings)  # which more machines may put elsewhere
        counts = {
            ("plausible_machines", "first hypercube"): (len(first), 0),
            ("plausible_machines", "second hypercube"): (len(second), 0),
            ("plausible_machines", "failed"): (sum(row.measures is None for row in rows), 0),
            ("claims", "all"): (len(rulings), 0),
        }
        for case, those in (("", rulings), (", without repetitions", independent(rulings))):
            for kind in KINDS:
                counts["claims", f"{kind}{case}"] = sum(ruling.kind == kind for ruling in those), left
        numbers = [
            Number(name, case, float(n), "1", float(error)) for (name, case), (n, error) in counts.items()
        ]
        shares = {
            "share_of_machines": [ruling.first for ruling in rulings],
            "share_of_second_hypercube": [ruling.second for ruling in rulings],
        }
        for name, counted in shares.items():
            for n, one in enumerate(counted, 1):
                if one.share is not None:
                    low, high = one.interval
                    error = max(high - one.share, one.share - low)
                    numbers.append(Number(name, f"claim {n}", one.share, "1", error))
        for case, row in evidence(rows[0].measures or {}).items():
            numbers += [Number(name, case, m.value, unit(name) or "1", m.error) for name, m in row.items()]
        return numbers

    def claims(self) -> list[JudgedClaim]:
        """Every statement with its verdict."""
        places = {ruling.claim.name: n for n, ruling in enumerate(self.rulings, 1)}
        return [
            JudgedClaim(
                str(n), r.claim.where, r.claim.text, r.kind, why(r, places), r.claim.figure, r.claim.shown_in
            )
            for n, r in enumerate(self.rulings, 1)
        ]

    def words(self) -> dict[str, object]:
        """Counts and numbers of statements by their verdicts."""
        rulings, (first, second) = self.rulings, self.hypercubes
        numbered, apart = list(enumerate(rulings, 1)), independent(rulings)
        return {
            "first": len(first),
            "second": len(second),
            "failed": sum(row.measures is None for row in self.rows),
            "cases": len(CASES),
            "tolerance": TOLERANCE,
            "statements": len(rulings),
            "kinds": {kind: [n for n, ruling in numbered if ruling.kind == kind] for kind in KINDS},
            "independent": len(apart),
            "independent_holds": sum(ruling.kind == KINDS[0] for ruling in apart),
            "repeated": [n for n, r in numbered if r.claim.follows_from],
            "undecided": [n for n, r in numbered if r.kind == NOT_MEASURABLE and r.claim.is_measurable],
            "hanging": [n for n, ruling in numbered if ruling.hangs],
            "differs": [n for n, ruling in numbered if ruling.differs],
            "messages": {
                kind: [r.claim.name for r in rulings if r.claim.is_message and r.kind == kind] for kind in KINDS
            },
            "named": {r.claim.name: str(r.first) for r in rulings if r.claim.name},
        }
