"""What errors of the engine mean, in words of the field."""

import re

UNSOLVABLE = (
    "the equations of a step could not be solved: the linkage may be at a dead centre, or constraints may hold "
    "the same twice"
)
ADVICE = (
    "Look whether the posture is at a dead centre, and if two pins, columns or guides hold the same bodies "
    "in the same way; if not, try a smaller step."
)
PLACE = re.compile(r"\s*\[(Python )?file .*\]", re.IGNORECASE)  # in a source, which says nothing to a user


def first_line(error: BaseException) -> str:
    """The first line of an error that says something; its class if none does."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip(" =*-")]
    return lines[0] if lines else type(error).__name__


def explained(error: BaseException) -> str:
    """Why a run stopped that the engine has ended by an error of its own, which follows in brackets."""
    said = PLACE.sub("", first_line(error))
    reason = UNSOLVABLE if re.search("matrix|factori|solve", said, re.IGNORECASE) else "the engine gave up"
    return f"{reason} (engine: {said})"
