"""Every verdict before and after, and why it changed: window, new data, or so many machines.

Before: as committed in formers.toml, of machines that had neither cylinders nor a stroke time of their own. Why
a share changed is computed: by what the rise alone as window did, and by the new datum on which it now depends.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from studies.claims.conditions import dependence
from studies.claims.plausible import FACTORS, NEW, Factor, Sample
from studies.claims.verdicts import Ruling, kind_of, percent
from studies.common.data import rows
from studies.common.words import TextTable

HEAVIER = "mass_"  # how the names of data begin whose range is wider
CHANCE = (
    0.05  # shares of two lots of machines differ by more than chance if it would do so less often than that
)
NOTICED = 0.02  # by which averages over the rise change a share to be named
Judged = Sequence[tuple[Sample, bool]]


class Judgements(NamedTuple):
    """So many machines for which a claim holds, fails, or is left open."""

    holds: int
    fails: int
    left: int = 0

    @property
    def share(self) -> float | None:
        """Share for which it holds, of those that are decided."""
        decided = self.holds + self.fails
        return self.holds / decided if decided else None

    @property
    def said(self) -> str:
        """The share in words."""
        return "" if self.share is None else f"{percent(self.share)} %"


@dataclass(frozen=True)
class Former:
    """A verdict of before.

    claim: its number. verdict: in words. counts: of machines. rise: with averages over the rise alone. Both are
    None if it was not asked of machines.
    """

    claim: int
    verdict: str
    counts: Judgements | None = None
    rise: Judgements | None = None

    @property
    def kind(self) -> str:
        """Which of KINDS the verdict is."""
        return kind_of(self.verdict)


def _former(
    claim: int, verdict: str, holds: int = 0, fails: int = 0, left: int = 0, rise: Sequence[int] = ()
) -> Former:
    """A row of formers.toml."""
    if not rise:
        return Former(claim, verdict)
    return Former(claim, verdict, Judgements(holds, fails, left), Judgements(*rise))


FORMER_MACHINES = 128
FORMERS = tuple(_former(**row) for row in rows("studies.claims", "former"))


def change_table(rulings: Sequence[Ruling], machines: Sequence[Judged]) -> TextTable:
    """A row a claim; machines: how those that are decided judge each."""
    found = []
    for former, ruling, judged in zip(FORMERS, rulings, machines, strict=True):
        before = _told(former.counts, former.verdict)
        after = _told(Judgements(ruling.holds, ruling.fails), ruling.verdict)
        found.append((str(former.claim), ruling.claim.text, before, after, reason(former, ruling, judged)))
    return TextTable(("no.", "claim", "before", "now", "reason"), tuple(found), wide=True, width=200)


def _told(counts: Judgements | None, verdict: str) -> str:
    """A verdict with its share, unless it says that itself."""
    if counts is None or not counts.said or counts.said in verdict:
        return verdict
    return f"{verdict}: {counts.said}"


def reason(former: Former, ruling: Ruling, judged: Judged) -> str:
    """Why a verdict is another one, or why it is not."""
    now = Judgements(ruling.holds, ruling.fails)
    if ruling.claim.judge is None:
        return "none: it has no measure"
    if former.counts is None or former.rise is None:
        if now.share is None:
            return "none: a closed form"
        said = "holds" if ruling.reference else "fails"
        now_asked = "asked of machines now, contact and oil varied"
        return f"{now_asked}; before on the reference support alone, where it {said}"
    parts = []
    was, alone = former.counts.share, former.rise.share
    if was is not None and alone is not None and abs(was - alone) > NOTICED:
        parts.append(f"averages over the rise alone make it {former.rise.said}")
    if differ(former.rise, now):
        parts.append(f"the new data make it {now.said}{_because(judged)}")
    elif not parts and (former.kind != ruling.kind or abs((now.share or 0.0) - (was or 0.0)) > NOTICED):
        parts.append("none beyond the chance of other machines")
    if now.share is None:
        parts.append("the numerical error leaves all machines open")
    return "; ".join(parts) or "none"


def differ(one: Judgements, other: Judgements) -> bool:
    """Whether two lots of machines judge differently by more than chance (Fisher's exact test)."""
    from scipy.stats import fisher_exact  # takes a second to import

    return bool(fisher_exact(np.array([one[:2], other[:2]])).pvalue < CHANCE)


def _because(judged: Judged) -> str:
    """The new datum on which a claim depends most, with the shares, in brackets."""
    found = dependence(judged, [factor for factor in FACTORS if _is_new(factor)])
    return f" ({found or 'none of them alone'})"


def _is_new(factor: Factor) -> bool:
    return factor.name in NEW or factor.name.startswith(HEAVIER)
