"""The report as Markdown that reads well in a terminal."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from pathlib import Path
from urllib.parse import quote

from studies.common.chapter import Picture, Sheet
from studies.common.markdown import bullets, escaped, paragraph
from studies.reporting.content import Report, Section


def text(report: Report, out: Path) -> str:
    """The whole report; pictures are links relative to the folder `out`."""
    blocks = [
        f"# {escaped(report.title)}",
        paragraph(f"Written {report.made_at}."),
        *map(paragraph, report.summary),
        bullets([section.chapter.title for section in report.sections] + ["Assumptions", "Versions"]),
        *(block for section in report.sections for block in _section(section, out)),
        "## Assumptions",
        *map(paragraph, report.notes),
        *_sheets(report.assumptions),
        "## Versions and how to repeat",
        "\n".join(f"    {command:<36}# {meaning}" for command, meaning in report.commands),
        *_sheets([report.times, report.versions]),
    ]
    return "\n\n".join(block for block in blocks if block) + "\n"


def _section(section: Section, out: Path) -> Iterator[str]:
    chapter = section.chapter
    yield f"## {escaped(chapter.title)}"
    yield f"**Question.**\n{paragraph(chapter.question)}"
    yield "### Method"
    yield from map(paragraph, chapter.method)
    yield "### Findings"
    yield bullets(chapter.findings)
    yield from (_picture(picture, section.folder, out) for picture in chapter.pictures)
    yield from _sheets(chapter.sheets)


def _picture(picture: Picture, folder: Path, out: Path) -> str:
    place = Path(os.path.relpath(folder, out)) / f"{picture.stem}.png"
    name = escaped(picture.caption.partition(".")[0])  # Figure 1
    return f"![{name}]({quote(place.as_posix())})\n\n{paragraph(picture.caption)}"


def _sheets(sheets: Iterable[Sheet]) -> Iterator[str]:
    return (sheet.markdown().rstrip("\n") for sheet in sheets)
