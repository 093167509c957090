"""Channels of a run by names and patterns."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from difflib import get_close_matches
from fnmatch import fnmatchcase

from user_forces.values.value import InputError, short


def matching(names: Collection[str], patterns: Sequence[str]) -> list[str]:
    """The names that any of the patterns matches, in the order of the patterns; time is not among them.

    Arguments:
        names: of channels.
        patterns: names, or patterns of them as in a shell, such as "pin.*.force".

    Raises InputError for a pattern that matches none.
    """
    found: list[str] = []
    for pattern in patterns:
        matched = [name for name in names if name != "time" and fnmatchcase(name, pattern)]
        if not matched:
            near = get_close_matches(pattern, names, 4, 0.4) or sorted(names)[:4]
            raise InputError(
                f"{short(pattern)}: no such channel; allowed: names or patterns such as 'pin.*.force', of the "
                f"{len(names)} that the run has, among them {', '.join(near)}"
            )
        found += [name for name in matched if name not in found]
    return found
