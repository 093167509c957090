"""Sentences of a study: the template `words.md.j2` in its folder, filled with the numbers of a run.

The filled template is a page of Markdown: the title; the question; "## Answer", one to three sentences that
someone who has never heard of the paper understands; "## Numbers", a list of the three that matter, each
"what: value"; "## Method" with paragraphs; "## Findings" with a list; "## Figures" with a list of
"stem: caption", the most telling first; and "## Tables", where each table has a heading "### name", its title
and, if there is one, its caption, the key table first. The rows of the tables come from the study.

A sentence refers to a figure or a table by `[@stem]` or `[@name]`, to that of another study by
`[@study/stem]`; the report makes a link of it, see `studies.common.chapter`.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from jinja2 import ChoiceLoader, Environment, PackageLoader, StrictUndefined

from studies.common import numbers
from studies.common.chapter import Chapter, JudgedClaim, Picture, Tile
from studies.common.subject import Subject
from support_exudyn.postprocessing.page.pieces import Sheet

TEMPLATE = "words.md.j2"


@dataclass(frozen=True)
class TextTable:
    """The cells of a table; title and caption stand in the template.

    left, wide: see `Sheet`. width: of the file, in characters. in_file, in_chapter: where it is shown.
    """

    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    left: int = 1
    wide: bool = False
    width: int = 150
    in_file: bool = True
    in_chapter: bool = True

    def sheet(self, name: str, title: str, caption: str = "") -> Sheet:
        """The table with its name and its words."""
        return Sheet(title, self.header, self.rows, caption, left=self.left, wide=self.wide, name=name)


@dataclass(frozen=True)
class Words:
    """The sentences of a study, or of the report around them, by the name of the folder."""

    study: str

    @cached_property
    def templates(self) -> Environment:
        """The templates in the folder of the study, and `phrases.md.j2` of `studies.common`."""
        loaders = [PackageLoader(f"studies.{self.study}", ""), PackageLoader("studies.common", "")]
        surroundings = Environment(
            loader=ChoiceLoader(loaders),
            autoescape=False,  # what shows a chapter escapes it
            undefined=StrictUndefined,
            trim_blocks=True,
            lstrip_blocks=True,
        )
        surroundings.filters["fmt"] = format
        for tool in (
            numbers.said,
            numbers.against,
            numbers.percent,
            numbers.rounded,
            numbers.short,
            numbers.off,
        ):
            surroundings.globals[tool.__name__] = surroundings.filters[tool.__name__] = tool
        return surroundings

    def blocks(self, told: Mapping[str, object]) -> dict[str, list[str]]:
        """Paragraphs and items of lists of the filled template, each in one line, by their heading."""
        found: dict[str, list[str]] = {}
        here: list[str] = []
        begins = True
        for line in self.templates.get_template(TEMPLATE).render(told).splitlines():
            text = " ".join(line.split())
            if line.startswith("#"):
                here = found.setdefault(text.lstrip("# "), [])
            elif text and (begins or text.startswith("- ")):
                here.append(text)
            elif text:
                here[-1] += f" {text}"
            begins = not text or line.startswith("#")
        return found

    def chapter(
        self,
        told: Mapping[str, object],
        tables: Mapping[str, TextTable],
        figures: Collection[str],
        tiles: Sequence[Tile] = (),
        claims: Sequence[JudgedClaim] = (),
    ) -> tuple[Chapter, dict[str, Sheet]]:
        """The study as a chapter of the report, and all tables by name, those that are not in it among them.

        figures: names of those that were drawn: the template may have captions of others.

        Raises KeyError if the template has no title for a table.
        """
        blocks = self.blocks(told)
        title = next(iter(blocks))
        sheets = {name: table.sheet(name, *blocks[name]) for name, table in tables.items()}
        pictures = (_item(block).partition(": ") for block in blocks["Figures"])
        subject = told.get("subject")
        own = subject if isinstance(subject, Subject) and not subject.is_paper else None
        chapter = Chapter(
            study=self.study,
            machine=own.name if own else "",
            contact=own.contact_in_words if own else "",
            title=title,
            question=" ".join(blocks[title]),
            answer=" ".join(blocks.get("Answer", ())),
            numbers=tuple(_item(block) for block in blocks.get("Numbers", ())),
            method=tuple(blocks["Method"]),
            findings=tuple(_item(block) for block in blocks["Findings"]),
            pictures=tuple(Picture(stem, caption) for stem, _, caption in pictures if stem in figures),
            sheets=tuple(sheets[name] for name, table in tables.items() if table.in_chapter),
            tiles=tuple(tiles),
            claims=tuple(claims),
        )
        return chapter, sheets


def _item(block: str) -> str:
    return block.removeprefix("- ")
