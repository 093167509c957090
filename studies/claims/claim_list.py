"""The claims of the paper, as rows of claims.toml, and how each is judged on a machine."""

import math
from dataclasses import dataclass

from pydantic import ConfigDict, TypeAdapter

from studies.claims.evidence import RELATIONS, Evidence, Measured, Verdict, every
from studies.claims.plausible_runs import CLEARANCES, IDEAL
from studies.common import paper_machine
from studies.common.data import tables
from studies.common.numbers import DIGITS
from support_exudyn.postprocessing.shown_numbers import rounded

LAST_DIGIT = 5.1e-4  # of a printed stiffness [N/mm^1.5]


WHOLE = ConfigDict(extra="forbid")  # no key of the file is left out


@dataclass(frozen=True)
class Judge:
    """A relation that every one of some measures has on a machine.

    relation: of RELATIONS, over the cases. at: its threshold. of: a measure of the ideal pin of which the
    threshold is a share. shown: thresholds that others might choose, and `at`, at which shares are shown.
    """

    __pydantic_config__ = WHOLE

    relation: str
    measures: tuple[str, ...]
    cases: tuple[str, ...] = CLEARANCES
    at: float = 0.0
    of: str = ""
    shown: tuple[float, ...] = ()

    def __call__(self, evidence: Evidence, at: float | None = None) -> Verdict:
        """Whether it holds on a machine; at: another threshold."""
        of = evidence[IDEAL][self.of] if self.of else None
        rows = ([evidence[case][name] for case in self.cases] for name in self.measures)
        return every(RELATIONS[self.relation](row, self.at if at is None else at, of) for row in rows)

    def compared(self, evidence: Evidence) -> dict[str, dict[str, Measured]]:
        """The numbers that it compares, by measure and case."""
        found = {name: {case: evidence[case][name] for case in self.cases} for name in self.measures}
        return found | ({self.of: {IDEAL: evidence[IDEAL][self.of]}} if self.of else {})

    def describe(self, evidence: Evidence) -> str:
        """The numbers that it compares, in words; cases are named unless they are the four clearances."""
        texts = []
        for name, row in self.compared(evidence).items():
            shown = {case: rounded(m.value, m.error, DIGITS).partition(" ± ")[0] for case, m in row.items()}
            bare = tuple(row) == CLEARANCES
            named = [text if bare else f"{text} ({case})" for case, text in shown.items()]
            what = " ".join(IN_WORDS.get(word, word) for word in name.split("_"))
            texts.append(f"{what} {', '.join(named)} {unit(name)}".rstrip())
        return "; ".join(texts)

    def largest_error(self, evidence: Evidence) -> float:
        """The largest numerical error of the numbers that it compares, as a share of the number."""
        numbers = [m for row in self.compared(evidence).values() for m in row.values()]
        return max(m.error / abs(m.value) if m.value else math.inf for m in numbers)


IN_WORDS = {"rms": "RMS fluctuation of", "likeness": "correlation of trends of", "std": "standard deviation of"}
UNITS = {"force": "N", "speed": "deg/s", "acceleration": "deg/s^2", "impulse": "N s", "tip": "mm"}


def unit(name: str) -> str:
    """The unit of a measure, by its name; empty for a correlation."""
    if name.startswith("likeness"):
        return ""
    return next((unit for word, unit in UNITS.items() if word in name.split("_")), "deg")


@dataclass(frozen=True)
class Claim:
    """A statement of the paper.

    where: abstract, section or conclusion. text: what is claimed. reading: what is measured, or why it is not
    measurable. name: in a few words. judge: whether it holds on a machine. stiffness_mm: clearances [mm] whose
    stiffness by Eq. 5, a closed form, it states; with neither it is not measurable. paper: what it prints, if
    anything. follows_from: name of a statement that contains this one. figure, table: what shows it, as
    study/stem and study/name; without a table all numbers of the figure's study do.
    """

    __pydantic_config__ = WHOLE

    where: str
    text: str
    reading: str
    judge: Judge | None = None
    stiffness_mm: tuple[float, ...] = ()
    name: str = ""
    paper: str = ""
    follows_from: str = ""
    figure: str = ""
    table: str = ""

    @property
    def is_measurable(self) -> bool:
        """Whether it can be judged."""
        return self.judge is not None or bool(self.stiffness_mm)

    @property
    def is_message(self) -> bool:
        """Whether the abstract says it, and it can be judged: a main message of the paper."""
        return self.is_measurable and self.where.startswith("abstract")

    @property
    def shown_in(self) -> str:
        """The table that shows it."""
        return self.table or f"{self.figure.partition('/')[0]}/numbers"


def stiffnesses(claim: Claim) -> tuple[bool, str]:
    """Whether stiffnesses by Eq. 5 are those that the paper prints, to the last digit; and ours [N/mm^1.5]."""
    ours = [paper_machine.stiffness(size) / 1e3**1.5 for size in claim.stiffness_mm]
    printed = [paper_machine.STIFFNESS[size] for size in claim.stiffness_mm]
    same = all(abs(a - b) < LAST_DIGIT for a, b in zip(ours, printed, strict=True))
    return same, ", ".join(f"{k:.3f}" for k in ours)


CLAIMS = TypeAdapter(tuple[Claim, ...]).validate_python(tables("studies.claims", "claims.toml")["claim"])
