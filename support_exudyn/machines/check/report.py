"""What a check came to: tables in mm, degrees and kN, warnings, and numbers in SI."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class CheckTable:
    """A table: its title, the heads of its columns and its rows, as text."""

    title: str
    header: Sequence[str]
    rows: Sequence[Sequence[str]]

    def lines(self) -> Iterator[str]:
        """The table as text: the first column to the left, numbers to the right."""
        table = [self.header, *self.rows]
        widths = [max(len(row[n]) for row in table) for n in range(len(self.header))]
        yield self.title
        for row in table:
            cells = [
                row[0].ljust(widths[0]),
                *(cell.rjust(w) for cell, w in zip(row[1:], widths[1:], strict=True)),
            ]
            yield "  " + "  ".join(cells).rstrip()


@dataclass(frozen=True)
class CheckReport:
    """A check of a machine; its subclasses keep what a figure of it is drawn from.

    Arguments:
        name, kind: of the machine.
        facts: sentences.
        sheets: tables.
        warnings: what a colleague would point at, in sentences.
        notes: what was assumed, what cannot be done for want of data, and where the data come from.
        numbers: plain data, SI and radians, with the unit in the key.
    """

    name: str
    kind: str
    facts: Sequence[str]
    sheets: Sequence[CheckTable]
    warnings: Sequence[str]
    notes: Sequence[str]
    numbers: dict[str, Any] = field(repr=False)

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
