"""Sentences of a study: the template `words.md.j2` in its folder, filled with the numbers of a run.

The filled template is a page of Markdown: the title; the question; "## Answer", one to three sentences that
someone who has never heard of the paper understands; "## Numbers", a list of the three that matter, each
"what: value"; "## Method" with paragraphs; "## Findings" with a list; "## Figures" with a list of
"stem: caption", the most telling first; and "## Tables", where each table has a heading "### name", its title
and, if there is one, its caption, the key table first. The rows of the tables come from the study.

A sentence refers to a figure or a table by `[@stem]` or `[@name]`, to that of another study by
`[@study/stem]`; the report makes a link of it, see `studies.common.words`.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TypeVar

from jinja2 import ChoiceLoader, Environment, PackageLoader, StrictUndefined
from pydantic import BaseModel, ConfigDict, ValidationError

from studies.common import numbers
from studies.common.subject import Subject
from support_exudyn.files.whole_file import contents, whole_file
from support_exudyn.postprocessing.page.pieces import KeyNumber, Sheet
from user_forces.values.value import InputError

ALL_NUMBERS = "All numbers of the study; the number behind ± is the numerical error"


def text_table(
    header: Sequence[str], rows: Iterable[Sequence[str]], left: int = 1, wide: bool = False
) -> Sheet:
    """The cells of a table, see `Sheet` for left and wide; name, title and caption come with the template."""
    return Sheet("", tuple(header), tuple(map(tuple, rows)), left=left, wide=wide)


@dataclass(frozen=True)
class Words:
    """The sentences of a study, or of the report around them; template: below `studies`."""

    study: str
    template: str

    @cached_property
    def templates(self) -> Environment:
        """All templates below `studies`, and `phrases.md.j2` of `studies.common` by its bare name."""
        loaders = [PackageLoader("studies", ""), PackageLoader("studies.common", "")]
        surroundings = Environment(
            loader=ChoiceLoader(loaders),
            autoescape=False,  # what shows a chapter escapes it
            undefined=StrictUndefined,
            trim_blocks=True,
            lstrip_blocks=True,
        )
        surroundings.filters["fmt"] = format
        tools = (numbers.said, numbers.against, numbers.percent, numbers.rounded, numbers.short, numbers.off)
        for tool in tools:
            surroundings.globals[tool.__name__] = surroundings.filters[tool.__name__] = tool
        return surroundings

    def blocks(self, told: Mapping[str, object]) -> dict[str, list[str]]:
        """Paragraphs and items of lists of the filled template, each in one line, by their heading."""
        found: dict[str, list[str]] = {}
        here: list[str] = []
        begins = True
        for line in self.templates.get_template(self.template).render(told).splitlines():
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
        tables: Mapping[str, Sheet],
        figures: Collection[str],
        tiles: Sequence[KeyNumber] = (),
        claims: Sequence[JudgedClaim] = (),
    ) -> tuple[Chapter, dict[str, Sheet]]:
        """The study as a chapter of the report, and all tables by name, those that are not in it among them.

        figures: names of those that were drawn: the template may have captions of others.

        Raises KeyError if the template has no title for a table.
        """
        blocks = self.blocks(told)
        title = next(iter(blocks))
        blocks.setdefault(numbers.NUMBERS, [ALL_NUMBERS])
        sheets = {name: titled(table, name, blocks) for name, table in tables.items()}
        short = [one for one in sheets.values() if len(one.rows) <= numbers.LONGEST]
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
            sheets=tuple(short),
            tiles=tuple(tiles),
            claims=tuple(claims),
        )
        return chapter, sheets


def _item(block: str) -> str:
    return block.removeprefix("- ")


def titled(table: Sheet, name: str, blocks: Mapping[str, Sequence[str]]) -> Sheet:
    """A table with its name, and with title and caption from the blocks of a template.

    Raises KeyError if the template has no title for the table.
    """
    title, *caption = blocks[name]
    return replace(table, name=name, title=title, caption=" ".join(caption))


# --- the chapter of a study ---

FILE = "chapter.json"
REFERENCE = re.compile(r"\[@([\w.-]+(?:/[\w.-]+)?)\]")
LARGEST_FILE = 200_000_000  # bytes, of files that are read for a report


@dataclass(frozen=True)
class Picture:
    """A figure: stem.png, stem.pdf and stem.csv in the study's folder, and its caption.

    A time series has stem.live.json, too, from which the report makes a figure that readers can zoom.
    """

    stem: str
    caption: str

    def __post_init__(self) -> None:
        if not self.stem or Path(self.stem).name != self.stem or "\\" in self.stem:
            raise ValueError(f"stem = {self.stem!r}: allowed: a file name without folder and ending")


@dataclass(frozen=True)
class JudgedClaim:
    """A statement of the paper and the verdict on it.

    number: such as "12". where: section or figure of the paper. verdict: "holds", "in part", "fails", "needs
    more machines" or "not measurable". why: the reason, with numbers. figure, table: "study/stem" and
    "study/name" of the evidence; empty without.
    """

    number: str
    where: str
    text: str
    verdict: str
    why: str
    figure: str = ""
    table: str = ""


class Chapter(BaseModel):
    """A study in words, pictures and tables; all texts are plain sentences.

    answer: one to three sentences. numbers: the three that matter, each "what: value". method: paragraphs.
    findings: bullet points, with the numbers of this very run. pictures, sheets: the key ones first. tiles: for
    the first screen of the report. claims: of the study that judges them. machine: the name of the
    user's machine that it is about; empty: the paper's. contact: of the user's pin, in a sentence. computed_by:
    engine and method in a sentence, where the report's first screen is to name them.
    """

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)

    study: str
    title: str
    question: str
    method: tuple[str, ...]
    findings: tuple[str, ...]
    pictures: tuple[Picture, ...]
    sheets: tuple[Sheet, ...]
    answer: str = ""
    numbers: tuple[str, ...] = ()
    tiles: tuple[KeyNumber, ...] = ()
    claims: tuple[JudgedClaim, ...] = ()
    machine: str = ""
    contact: str = ""
    computed_by: str = ""

    def save(self, out: Path) -> Path:
        """Write DIR/chapter.json, whole or not at all."""
        path = out / FILE
        with whole_file(path) as temporary:
            temporary.write_text(self.model_dump_json(indent=1) + "\n", encoding="utf-8")
        return path

    @staticmethod
    def load(folder: Path) -> Chapter:
        """Read a chapter. Raises InputError with the file and the reason."""
        return read_stored(Chapter, folder / FILE)


Read = TypeVar("Read", bound=BaseModel)


def read_stored(model: type[Read], path: Path) -> Read:
    """Read data that a study has left as JSON. Raises InputError with the file, the place and the reason."""
    try:
        return model.model_validate_json(contents(path, LARGEST_FILE))
    except FileNotFoundError:
        raise InputError(f"{path}: no such file; the study that writes it has not run here") from None
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(map(str, first["loc"]))
        raise InputError(f"{path}: {place}: {first['msg']}") from None


def without_references(text: str) -> str:
    """A sentence for a terminal: names of files stand in place of links."""
    return REFERENCE.sub(r"\1", text)
