"""The pages of the project: README and the pages of the rooms, and the listings in them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[1]
README = ROOT / "README.md"
LINK = re.compile(r"\[[^\]\n]*\]\(([^)\s#]+)(?:#[^)]*)?\)")


def pages() -> list[Path]:
    """All pages of Markdown, the README first."""
    rooms = (ROOT / name for name in ("support_exudyn", "user_forces", "studies", ".github"))
    return [README, *sorted(path for room in rooms for path in room.rglob("*.md"))]


def named(page: Path) -> str:
    """A page's path from the project's folder on."""
    return page.relative_to(ROOT).as_posix()


class Listing(NamedTuple):
    """A block of code of a page: its kind (python, toml, sh), its text, and which of the page's it is."""

    page: Path
    kind: str
    text: str
    number: int


def listings(page: Path) -> Iterator[Listing]:
    """The blocks of code of a page, in their order."""
    found = re.findall(r"^```(\w+)\n(.*?)^```", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
    for number, (kind, text) in enumerate(found):
        yield Listing(page, kind, text, number)


def links(page: Path) -> list[str]:
    """Where a page's links and pictures point to within the project."""
    found = LINK.findall(
        re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    )
    return [one for one in found if not re.match(r"\w+:", one)]
