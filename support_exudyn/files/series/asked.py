"""What is asked of a reader of series."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from fnmatch import fnmatchcase

Progress = Callable[[float], None]  # is told the share that is read, 0 to 1


def silent(share: float) -> None:
    """Progress that nobody looks at."""


@dataclass(frozen=True)
class Asked:
    """What is wanted of a file.

    units: what unit a column without one has, by patterns of names as in a shell; the first that
        matches counts.
    analysis: the name of one, of several in a file; None: the first.
    names: patterns of the series that are wanted; all if there are none.
    progress: is told the share that is read.
    """

    units: Mapping[str, str] = field(default_factory=dict)
    analysis: str | None = None
    names: Sequence[str] = ()
    progress: Progress = silent

    def unit(self, name: str, given: str | None) -> str | None:
        """The unit of a series: that of the file if it gives one."""
        if given is not None:
            return given
        return next(
            (unit for pattern, unit in self.units.items() if name == pattern or fnmatchcase(name, pattern)),
            None,
        )

    def wants(self, name: str) -> bool:
        """Whether a series is wanted."""
        return not self.names or any(name == pattern or fnmatchcase(name, pattern) for pattern in self.names)
