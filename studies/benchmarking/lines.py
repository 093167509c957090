"""Lines of the benchmark's table: what and how, ours, that of another, their ratio, what was asked, verdict."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from support_exudyn.postprocessing.page.pieces import Sheet

HEADER = ("what", "setting", "ours", "against", "theirs", "ratio", "asked at most", "")


@dataclass(frozen=True)
class BenchmarkLine:
    """A line of the table.

    what, how: what was measured, and how it was set. ours, other: time [s], or another number of the unit; not
    a number if it was not measured. asked: a ratio as "3" or "1/10", or a time as "0.06 s". is_more: ours was
    ended before it had finished, and would have been more. note: why something is missing or was cut.
    """

    what: str
    how: str
    ours: float
    against: str = ""
    other: float = math.nan
    asked: str = ""
    is_more: bool = False
    note: str = ""
    unit: str = "s"

    @property
    def ratio(self) -> str:
        """Ours over the other's, as 1/x if the other's is larger."""
        if math.isnan(self.ours) or math.isnan(self.other) or self.is_more:
            return ""
        if self.ours <= self.other:
            return f"1/{_brief(self.other / self.ours)}"
        return _brief(self.ours / self.other)

    @property
    def is_missed(self) -> bool | None:
        """Whether more was needed than was asked for; None if nothing was asked, or it is not known."""
        if not self.asked or math.isnan(self.ours):
            return None
        if self.asked.endswith(" s"):
            missed = self.ours > float(self.asked[:-2])
            return True if missed else None if self.is_more else False
        if math.isnan(self.other) or self.is_more:
            return None
        return self.ours / self.other > float(Fraction(self.asked))

    @property
    def verdict(self) -> str:
        """Met or missed, and what is to be known of the measurement."""
        said = {None: "", True: "missed", False: "met"}[self.is_missed]
        return "; ".join(filter(None, (said, self.note)))

    def cells(self) -> tuple[str, ...]:
        """The line as text."""
        more = "> " if self.is_more else ""
        ours, other = (_number(x, self.unit) for x in (self.ours, self.other))
        return self.what, self.how, more + ours, self.against, other, self.ratio, self.asked, self.verdict


def left_out(what: str, why: str, how: str = "", against: str = "", asked: str = "") -> BenchmarkLine:
    """A line of what could not be measured, and why."""
    return BenchmarkLine(what, how, math.nan, against, asked=asked, note=why)


def _brief(ratio: float) -> str:
    return f"{ratio:.3g}" if ratio < 100.0 else f"{ratio:.0f}"


def _number(x: float, unit: str) -> str:
    return "" if math.isnan(x) else f"{x:.3g} {unit}"


def sheet(lines: Sequence[BenchmarkLine]) -> Sheet:
    """All lines as a table."""
    return Sheet(
        title="Ours, and what it is set against",
        header=HEADER,
        rows=tuple(line.cells() for line in lines),
        caption=(
            "Times are those of the processor on one core, the least of several turns in one run; those of "
            "commands go from start to end. To the goal (1.5 mm, no friction, 5 s): mean 1e-4, spread and peak "
            "1e-3, speeds of the first three impacts 1e-3, 1e-3, 1e-2 of a tight reference of the same model, "
            "by the coarsest setting tried that meets it. Compilation is not counted, but in the first run of "
            "a fresh installation."
        ),
        left=2,
    )
