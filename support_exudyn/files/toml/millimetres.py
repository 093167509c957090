"""Messages in metres as people read them whose files are in mm."""

from __future__ import annotations

import re

NUMBER = r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?"
LENGTH = re.compile(rf"(?<![\w.])({NUMBER})(?: to ({NUMBER}))? m(?![\w^*])")
PLACE = re.compile(rf"\(({NUMBER}), ({NUMBER})\) m(?![\w^*])")


def in_millimetres(message: str) -> str:
    """A message with all its lengths in mm, also those over a time; areas and what has another unit stay."""
    message = PLACE.sub(lambda found: f"({_mm(found[1])}, {_mm(found[2])}) mm", message)
    return LENGTH.sub(lambda found: " to ".join(_mm(one) for one in found.groups() if one) + " mm", message)


def _mm(metres: str) -> str:
    return f"{1e3 * float(metres):.10g}"
