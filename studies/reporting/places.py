"""Where every figure and table stands, on the page or in the appendix, and the links that lead to it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from markupsafe import Markup, escape

from studies.common.chapter import REFERENCE

PAGE, APPENDIX = "report.html", "appendix.html"


@dataclass(frozen=True)
class Place:
    """Where a figure or table stands: the file, and its number such as "Fig. 5"."""

    file: str
    label: str


@dataclass
class Places:
    """Figures and tables by "study/stem", numbered in the order in which they are given their places."""

    known: dict[str, Place] = field(default_factory=dict)
    last: dict[str, int] = field(default_factory=dict)

    def number(self, file: str, kind: str, names: Iterable[str]) -> None:
        """Give figures ("Fig.") or tables ("Table") their places; those that have one keep it."""
        for name in names:
            if name not in self.known:
                self.last[kind] = self.last.get(kind, 0) + 1
                self.known[name] = Place(file, f"{kind} {self.last[kind]}")

    def link(self, file: str, name: str) -> Markup:
        """A link from a page to a figure or table; its bare name if it is not there."""
        place = self.known.get(name)
        if place is None:
            return escape(name.rpartition("/")[2])
        page = "" if place.file == file else place.file
        return Markup('<a href="{}#{}">{}</a>').format(page, anchor(name), place.label.replace(" ", "\u00a0"))

    def linked(self, file: str, study: str, text: str) -> Markup:
        """A sentence of a study, with links in place of its references."""
        parts = REFERENCE.split(text)  # every second one is a reference
        return Markup().join(
            self.link(file, part if "/" in part else f"{study}/{part}") if n % 2 else part
            for n, part in enumerate(parts)
        )


def anchor(name: str) -> str:
    """The id of an element: "study-stem" of "study/stem"."""
    return name.replace("/", "-").replace(" ", "-")
