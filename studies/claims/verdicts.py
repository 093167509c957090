"""From judgements of many machines to a verdict in words."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from studies.claims.claim_list import Claim, Judge, Varied
from studies.claims.conditions import best_condition, shares_by
from studies.claims.evidence import Evidence, NotedEvidence, Verdict
from studies.claims.plausible import Sample
from studies.claims.plausible_runs import OIL

KINDS = ("holds", "holds only", "not supported", "cannot be judged")
# share of all plausible machines from which a claim holds; up to one less this it is not supported. That of the
# machines that were drawn decides it where its whole interval is on one side
NEARLY_ALL = 0.95
# share that a condition must get right, of machines not used to find it, to be the one that decides
TELLING = 0.85
GAIN = 0.05  # by how much it must beat the same answer for all to be named at all
ENOUGH = 60  # machines from which conditions are looked for; with fewer chance looks like one


Machines = Sequence[tuple[Sample, Evidence]]
Judged = list[tuple[Sample, Verdict]]


class AtThreshold(NamedTuple):
    """What a claim is with a threshold: share of the machines, None if all are open; which of KINDS."""

    threshold: float
    share: float | None
    kind: str


@dataclass(frozen=True)
class Ruling:
    """A claim, judged.

    reference: on the reference support. holds, fails, open: numbers of plausible machines. ours: our numbers,
    on the reference support. verdict: in words. error: the largest numerical error of our numbers, as a share
    of the number; None for closed forms and where nothing is judged. thresholds: what it would be with
    others, if its judge has one.
    """

    claim: Claim
    reference: Verdict
    holds: int
    fails: int
    open: int
    ours: str
    verdict: str
    error: float | None = None
    thresholds: tuple[AtThreshold, ...] = ()

    @property
    def hangs(self) -> bool:
        """Whether another threshold would make it another kind of verdict, and not for want of machines."""
        return len({one.kind for one in self.thresholds} - {"cannot be judged"}) > 1

    @property
    def share(self) -> float | None:
        """Share of the plausible machines for which it holds, of those that are decided."""
        decided = self.holds + self.fails
        return self.holds / decided if decided else None

    @property
    def interval(self) -> tuple[float, float] | None:
        """Between what shares the whole population lies with 95 % confidence (Wilson)."""
        return _interval(self.holds, self.holds + self.fails)

    @property
    def kind(self) -> str:
        """Which of KINDS the verdict is; the longest that it begins with."""
        return kind_of(self.verdict)

    @property
    def too_few(self) -> bool:
        """Whether more machines could decide it."""
        return self.kind == "cannot be judged" and self.share is not None


def known_to(machines: int) -> float:
    """Half of the interval in which a share of one half lies, if so many machines are decided."""
    low, high = _interval(machines // 2, machines) or (0.0, 1.0)
    return 0.5 * (high - low)


def _interval(holds: int, decided: int) -> tuple[float, float] | None:
    if not decided:
        return None
    from scipy.stats import binomtest  # takes a second to import

    found = binomtest(holds, decided).proportion_ci(0.95, "wilson")
    return float(found.low), float(found.high)


def kind_of(verdict: str) -> str:
    """Which of KINDS a verdict is, the longest that it begins with."""
    return max((kind for kind in KINDS if verdict.startswith(kind)), key=len)


def asked(claim: Claim, machines: Machines) -> Machines:
    """The machines that are asked whether a claim holds."""
    if claim.alone:
        return []
    return [one for one in machines if OIL in one[1].measures] if claim.on_oil else machines


def judgements(judge: Judge, machines: Machines) -> Judged:
    """How each machine judges."""
    return [(sample, judge(evidence)) for sample, evidence in machines]


def rule(claim: Claim, reference: Evidence, machines: Machines) -> Ruling:
    """Judge a claim on the reference support and on plausible machines."""
    if claim.judge is None:
        return Ruling(claim, None, 0, 0, 0, "", "cannot be judged")
    on_reference = claim.judge(reference)
    those = asked(claim, machines)
    judged = judgements(claim.judge, those)
    holds, fails, left = (sum(verdict is kind for _, verdict in judged) for kind in (True, False, None))
    noted = NotedEvidence(reference.measures)
    ours, verdict = claim.tell(noted), _words(on_reference, judged)
    others = _thresholds(claim.judge, those) if isinstance(claim.judge, Varied) else ()
    found = Ruling(claim, on_reference, holds, fails, left, ours, verdict, noted.largest_error, others)
    if claim.on_oil and found.kind == "holds only":
        decided = [(sample, one) for sample, one in judged if one is not None]
        shares = shares_by("contact", decided)
        found = replace(found, verdict=f"{verdict}: {shares}" if shares else verdict)
    return replace(found, verdict=f"{found.verdict}; hangs on the threshold") if found.hangs else found


def _thresholds(judge: Varied, machines: Machines) -> tuple[AtThreshold, ...]:
    found = []
    for threshold in judge.shown:
        judged = judgements(judge.at(threshold), machines)
        decided = [verdict for _, verdict in judged if verdict is not None]
        if decided:
            found.append(
                AtThreshold(
                    threshold, sum(decided) / len(decided), kind_of(_words(None, judged, of_data=False))
                )
            )
        else:
            found.append(AtThreshold(threshold, None, "cannot be judged"))
    return tuple(found)


def _words(reference: Verdict, judged: Judged, *, of_data: bool = True) -> str:
    """The verdict; of_data: with the bounds on data that decide, if there are machines enough."""
    decided = [(sample, verdict) for sample, verdict in judged if verdict is not None]
    if not decided:
        alone = {True: "holds", False: "not supported", None: "cannot be judged: within the numerical error"}
        return alone[reference]
    holds = sum(verdict for _, verdict in decided)
    share = holds / len(decided)
    low, high = _interval(holds, len(decided)) or (0.0, 1.0)
    if low >= NEARLY_ALL:
        return "holds"
    if high <= 1.0 - NEARLY_ALL:
        return "not supported"
    if any(low < bound < high for bound in (NEARLY_ALL, 1.0 - NEARLY_ALL)):
        counted = "1 machine" if len(decided) == 1 else f"{len(decided)} machines"
        return f"cannot be judged ({counted}: holds for {percent(low)} to {percent(high)} %)"
    part = f"{percent(share)} % of the machines"
    condition = best_condition(decided) if of_data and len(decided) >= ENOUGH else None
    if condition is None or condition.unseen < max(share, 1.0 - share) + GAIN:
        return f"holds only for {part}"
    right = f"right for {100 * condition.unseen:.0f} %"
    if condition.unseen < TELLING:
        return f"holds only for {part}; most telling: {condition.text} ({right})"
    return f"holds only for {condition.text} ({right})"


def percent(share: float) -> str:
    """A share in per cent, not rounded onto the bounds that decide."""
    text = f"{100.0 * share:.0f}"
    bounds = (100.0 * NEARLY_ALL, 100.0 * (1.0 - NEARLY_ALL))
    return f"{100.0 * share:.1f}" if any(abs(float(text) - bound) < 0.5 for bound in bounds) else text
