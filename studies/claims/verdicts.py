"""From judgements of many machines to verdicts.

A statement holds if the share of machines on which it holds is at least 95 % with 95 % confidence, fails if
that share is at most 5 %, and holds in part if the share is between both. Undecided machines, on which the
numerical error exceeds what is compared, may be of either kind: the interval of the share covers both.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from studies.claims.claim_list import Claim, stiffnesses
from studies.claims.evidence import Evidence, Verdict
from studies.claims.plausible import FACTORS, Factor, Sample

HOLDS, IN_PART, FAILS, NEEDS_MORE, NOT_MEASURABLE = KINDS = (
    "holds", "in part", "fails", "needs more machines", "not measurable",
)  # fmt: skip
NEARLY_ALL = 0.95  # share of the machines from which a statement holds; up to one less this it fails
BOUNDS = (1.0 - NEARLY_ALL, NEARLY_ALL)
CONFIDENCE = 0.95
CHANCE = 0.01  # how often chance alone would part machines so by any of the data, if a datum is named

Machines = Sequence[tuple[Sample, Evidence]]


class Count(NamedTuple):
    """Numbers of machines on which a statement holds, fails, or is undecided."""

    holds: int = 0
    fails: int = 0
    undecided: int = 0

    @property
    def share(self) -> float | None:
        """Share of the decided machines on which it holds; None if there are none."""
        decided = self.holds + self.fails
        return self.holds / decided if decided else None

    @property
    def interval(self) -> tuple[float, float]:
        """Where the share of all machines lies with 95 % confidence (Wilson), undecided ones of either kind."""
        machines = sum(self)
        return wilson(self.holds, machines)[0], wilson(self.holds + self.undecided, machines)[1]

    @property
    def kind(self) -> str:
        """The verdict: one entry of KINDS."""
        low, high = self.interval
        if low >= NEARLY_ALL:
            return HOLDS
        if high <= 1.0 - NEARLY_ALL:
            return FAILS
        if BOUNDS[0] <= low and high <= BOUNDS[1]:
            return IN_PART
        machines = sum(self)
        least, most = wilson(self.holds, machines)[1], wilson(self.holds + self.undecided, machines)[0]
        return NOT_MEASURABLE if any(least < bound < most for bound in BOUNDS) else NEEDS_MORE

    def __str__(self) -> str:
        """Share of the decided machines, interval of all, and the number of undecided machines."""
        if self.share is None:
            return f"{self.undecided} undecided" if self.undecided else ""
        low, high = map(percent, self.interval)
        left = f", {self.undecided} undecided" if self.undecided else ""
        return f"{percent(self.share)} % ({low} to {high}{left})"


NO_MACHINES = Count()


@dataclass(frozen=True)
class Ruling:
    """A statement and its verdict.

    reference: on the reference support. first, second: the machines of both hypercubes. ours: our numbers on
    the reference support. error: the largest numerical error of these numbers, as a share of the number; None
    for closed forms and where nothing is measured. thresholds: the first hypercube by other thresholds.
    depends: the datum on which the verdict depends most, empty if on none beyond chance.
    """

    claim: Claim
    reference: Verdict = None
    first: Count = NO_MACHINES
    second: Count = NO_MACHINES
    ours: str = ""
    error: float | None = None
    thresholds: Mapping[float, Count] = field(default_factory=dict)
    depends: str = ""

    @property
    def kind(self) -> str:
        """The verdict on machines that have what is printed."""
        return self.verdict(self.first)

    def verdict(self, count: Count) -> str:
        """The verdict on the machines of a hypercube: one entry of KINDS."""
        if self.claim.judge is not None:
            return count.kind
        if not self.claim.is_measurable:
            return NOT_MEASURABLE
        return HOLDS if self.reference else FAILS

    @property
    def hangs(self) -> bool:
        """Whether another threshold makes it another verdict, and not for want of machines."""
        return len({count.kind for count in self.thresholds.values()} - {NEEDS_MORE, NOT_MEASURABLE}) > 1

    @property
    def differs(self) -> bool:
        """Whether the share in the second hypercube differs: the intervals do not overlap."""
        (low, high), (second_low, second_high) = self.first.interval, self.second.interval
        return high < second_low or second_high < low


def wilson(holds: int, machines: int) -> tuple[float, float]:
    """The interval of a share with 95 % confidence; 0 to 1 without machines."""
    if not machines:
        return 0.0, 1.0
    from scipy.stats import binomtest  # takes a second to import

    interval = binomtest(holds, machines).proportion_ci(CONFIDENCE, "wilson")
    return float(interval.low), float(interval.high)


def rule(claim: Claim, reference: Evidence, first: Machines, second: Machines = ()) -> Ruling:
    """Judge a statement on the reference support and on the machines of both hypercubes."""
    judge = claim.judge
    if judge is None:
        if not claim.is_measurable:
            return Ruling(claim)
        same, ours = stiffnesses(claim)
        return Ruling(claim, same, ours=ours)

    def count(verdict_of: Callable[[Evidence], Verdict], machines: Machines) -> Count:
        verdicts = [verdict_of(evidence) for _, evidence in machines]
        return Count(*(sum(verdict is kind for verdict in verdicts) for kind in (True, False, None)))

    counted = count(judge, first)
    decided = [(sample, verdict) for sample, e in first if (verdict := judge(e)) is not None]
    return Ruling(
        claim,
        judge(reference),
        counted,
        count(judge, second),
        judge.describe(reference),
        judge.largest_error(reference),
        {at: count(lambda e, at=at: judge(e, at), first) for at in judge.shown},  # type: ignore[misc]
        dependence(decided) if counted.kind == IN_PART else "",
    )


def independent(rulings: Sequence[Ruling]) -> list[Ruling]:
    """The measurable statements without those that follow from another statement with the same verdict."""
    kinds = {ruling.claim.name: ruling.kind for ruling in rulings}
    measurable = [ruling for ruling in rulings if ruling.kind != NOT_MEASURABLE]
    return [ruling for ruling in measurable if kinds.get(ruling.claim.follows_from) != ruling.kind]


def percent(share: float) -> str:
    """A share in per cent, not rounded onto the bounds that decide."""
    text = f"{100.0 * share:.0f}"
    return f"{100.0 * share:.1f}" if any(abs(float(text) - 100.0 * bound) < 0.5 for bound in BOUNDS) else text


def dependence(decided: Sequence[tuple[Sample, bool]]) -> str:
    """The datum by which machines part most, with the share of each part; empty if by none beyond chance."""
    chance, text = min((_split(factor, decided) for factor in FACTORS), key=lambda part: part[0])
    return text if chance < CHANCE / len(FACTORS) else ""


def _split(factor: Factor, decided: Sequence[tuple[Sample, bool]]) -> tuple[float, str]:
    """How often chance alone would part the machines so by a datum, and the shares of the parts in words.

    The parts are those of its choices, or of both sides of the median; Pearson's test of independence.
    """
    from scipy.stats import chi2_contingency  # takes a second to import

    values = np.array([sample[factor.name] for sample, _ in decided])
    if factor.choices:
        parts = {factor.phrase.format(choice): values == choice for choice in factor.choices}
    else:
        middle = float(np.median(values))
        bound = f"{factor.label} {{}} {middle:.3g} {factor.unit}".rstrip()
        parts = {bound.format("below"): values < middle, bound.format("above"): values >= middle}
    holds = np.array([verdict for _, verdict in decided])
    counts = np.array([[np.sum(holds & part), np.sum(~holds & part)] for part in parts.values()])
    if not (counts.any(axis=0).all() and counts.any(axis=1).all()):
        return 1.0, ""
    shares = 100.0 * counts[:, 0] / counts.sum(axis=1)
    text = ", ".join(f"{part} {share:.0f} %" for part, share in zip(parts, shares, strict=True))
    return float(chi2_contingency(counts).pvalue), text
