"""Legs of a pair: each has its share of what counts all together."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any, ClassVar, TypeVar

Whole = TypeVar("Whole", bound="Shared")


class Shared:
    """A value that counts all legs of a pair together.

    extensive: names of what it has of them all, such as areas and flows; the others are alike for each, such as
    lengths and pressures.
    """

    extensive: ClassVar[tuple[str, ...]] = ()

    def share(self: Whole, fraction: float) -> Whole:
        """What a fraction of all legs is, > 0, at most 1; so of all its parts."""
        made: Any = self
        changes = {name: fraction * getattr(self, name) for name in self.extensive}
        for field in fields(made):
            if isinstance(part := getattr(self, field.name), Shared):
                changes[field.name] = part.share(fraction)
        shared: Whole = replace(made, **changes)
        return shared
