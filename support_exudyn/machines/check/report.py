"""The result of a check: sentences, tables in mm, degrees and N, warnings, and numbers in SI."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from support_exudyn.machines.check.drive_way import DriveWay, Moved
from support_exudyn.machines.check.transmission import TransmissionAngle
from support_exudyn.model.linkage import Linkage
from support_exudyn.model.loads.load import ActingLoad


@dataclass(frozen=True)
class CheckTable:
    """A table: its title, the heads of its columns and its rows, as text."""

    title: str
    header: Sequence[str]
    rows: Sequence[Sequence[str]]

    def lines(self) -> Iterator[str]:
        """The table as text."""
        yield self.title
        yield from aligned([self.header, *self.rows])


def aligned(rows: Sequence[Sequence[str]]) -> Iterator[str]:
    """Rows of cells as lines: the first column to the left, numbers to the right."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for first, *others in rows:
        cells = [first.ljust(widths[0]), *map(str.rjust, others, widths[1:])]
        yield ("  " + "  ".join(cells)).rstrip()


@dataclass(frozen=True)
class CheckReport:
    """A check of a machine.

    Arguments:
        name, kind: of the machine.
        facts: sentences.
        sheets: tables.
        warnings: doubts, in sentences.
        notes: assumptions, what cannot be done for want of data, and where the data come from.
        numbers: plain data, SI and radians, with the unit in the key.
        linkage: the mechanism.
        start: its start posture, with the forces there.
        loads: that act on it besides its weight, by name.
        ways: of its driven parts; none where driven parts do not determine the posture.
        transmission: transmission angles of these ways, by `DriveWay.drive`.
    """

    name: str
    kind: str
    facts: Sequence[str]
    sheets: Sequence[CheckTable]
    warnings: Sequence[str]
    notes: Sequence[str]
    numbers: dict[str, Any] = field(repr=False)
    linkage: Linkage = field(repr=False)
    start: Moved = field(repr=False)
    loads: Mapping[str, ActingLoad] = field(repr=False)
    ways: Sequence[DriveWay] = field(repr=False)
    transmission: Mapping[str, Sequence[TransmissionAngle]] = field(repr=False)

    def lines(self) -> Iterator[str]:
        """The whole report as text."""
        yield f"{self.name or 'machine'} ({self.kind})"
        yield ""
        yield from self.facts
        for sheet in self.sheets:
            yield ""
            yield from sheet.lines()
        for title, said in (("notes", self.notes), ("warnings", self.warnings)):
            yield ""
            yield f"{title}: none" if not said else f"{title} ({len(said)})"
            yield from (f"  - {one}" for one in said)

    def data(self) -> dict[str, Any]:
        """The numbers, warnings and notes as plain data."""
        return {
            "name": self.name,
            "kind": self.kind,
            **self.numbers,
            "warnings": list(self.warnings),
            "notes": list(self.notes),
        }
