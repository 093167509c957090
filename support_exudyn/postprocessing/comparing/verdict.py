"""Whether a difference is as small as is allowed, and whether that can be told."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Literal, NamedTuple

ToleranceVerdict = Literal["within", "not within", "not decided", "told"]
ROUNDING = 1e-9  # share of what is allowed: 1.1 - 1.0 is 0.1, in whatever digits
WORST_FIRST: tuple[ToleranceVerdict, ...] = ("not within", "not decided", "within", "told")


class JudgedDifference(NamedTuple):
    """A difference beside what is allowed.

    what: of which number, such as "largest difference". value: magnitude of the difference. error: by how much
    it may be wrong, 0 if nothing is known. allowed: magnitude; NaN: no tolerance is given. All in SI.
    """

    what: str
    value: float
    error: float
    allowed: float

    @property
    def verdict(self) -> ToleranceVerdict:
        """Within, or not; not decided if the error is larger than what is allowed and could turn the answer.

        A difference that is no number is not decided: it could not be computed. Without a tolerance it is told.
        """
        if math.isnan(self.allowed):
            return "told"
        if math.isnan(self.value) or math.isinf(self.error):
            return "not decided"
        if self.error > self.allowed and self.value - self.error <= self.allowed:
            return "not decided"
        return "within" if self.value <= self.allowed * (1.0 + ROUNDING) else "not within"


def worst(verdicts: Iterable[ToleranceVerdict]) -> ToleranceVerdict:
    """The verdict on all: the worst of those on each."""
    found = set(verdicts)
    return next((one for one in WORST_FIRST if one in found), "told")
