"""Sentences of a study: the template `words.md.j2` in its folder, filled with the numbers of a run.

The filled template is a page of Markdown: the title; the question; "## Answer", one to three sentences that
someone who has never heard of the paper understands; "## Numbers", a list of the three that matter, each
"what: value"; "## Method" with paragraphs; "## Findings" with a list; "## Figures" with a list of
"stem: caption", the most telling first; and "## Tables", where each table has a heading "### name", its title
and, if there is one, its caption, the key table first. The rows of the tables come from the study.

A sentence refers to a figure or a table by `[@stem]` or `[@name]`, to that of another study by
`[@study/stem]`; the report makes a link of it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

from jinja2 import ChoiceLoader, Environment, PackageLoader, StrictUndefined
from pydantic import BaseModel, ConfigDict, ValidationError

from studies.common import numbers
from support_exudyn.files.whole_file import contents
from support_exudyn.postprocessing.page.pieces import KeyNumber, Sheet
from support_exudyn.postprocessing.shown_numbers import rounded
from user_forces.values.value import InputError


def text_table(
    header: Sequence[str], rows: Iterable[Sequence[str]], left: int = 1, wide: bool = False
) -> Sheet:
    """The cells of a table, see `Sheet` for left and wide; name, title and caption come with the template."""
    return Sheet("", tuple(header), tuple(map(tuple, rows)), left=left, wide=wide)


@cache
def templates() -> Environment:
    """All templates below `studies`, and `phrases.md.j2` of `studies.common` by its bare name."""
    surroundings = Environment(
        loader=ChoiceLoader([PackageLoader("studies", ""), PackageLoader("studies.common", "")]),
        autoescape=False,  # what shows a chapter escapes it
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    surroundings.filters["fmt"] = format
    tools = (numbers.stated, numbers.against, numbers.percent, rounded, numbers.short, numbers.off)
    for tool in tools:
        surroundings.globals[tool.__name__] = surroundings.filters[tool.__name__] = tool
    return surroundings


def filled(template: str, numbers_by_name: Mapping[str, object]) -> dict[str, list[str]]:
    """Paragraphs and items of lists of a filled template, each in one line, by their heading."""
    found: dict[str, list[str]] = {}
    here: list[str] = []
    begins = True
    for line in templates().get_template(template).render(numbers_by_name).splitlines():
        text = " ".join(line.split())
        if line.startswith("#"):
            here = found.setdefault(text.lstrip("# "), [])
        elif text and (begins or text.startswith("- ")):
            here.append(text.removeprefix("- "))
        elif text:
            here[-1] += f" {text}"
        begins = not text or line.startswith("#")
    return found


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
    engine and method in a sentence, where the report's first screen is to name them. wall_s: that the study
    took [s]. versions: of the packages that made it.
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
    wall_s: float = 0.0
    versions: Mapping[str, str] = {}

    @staticmethod
    def load(folder: Path) -> Chapter:
        """Read a chapter. Raises InputError with the file, the place and the reason."""
        path = folder / FILE
        try:
            return Chapter.model_validate_json(contents(path, LARGEST_FILE))
        except FileNotFoundError:
            raise InputError(f"{path}: no such file; the study that writes it has not run here") from None
        except ValidationError as error:
            first = error.errors()[0]
            place = ".".join(map(str, first["loc"]))
            raise InputError(f"{path}: {place}: {first['msg']}") from None


def without_references(text: str) -> str:
    """A sentence for a terminal: names of files stand in place of links."""
    return REFERENCE.sub(r"\1", text)
