"""What a study says: a chapter of the report, with its pictures and tables of text, kept as chapter.json.

Sentences refer to pictures and tables as `[@stem]`, `[@name]`, or `[@study/stem]` of another study.
"""

from __future__ import annotations

import json
import re
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path

from pydantic import ConfigDict, TypeAdapter, ValidationError

from support_exudyn.files.whole_file import contents, whole_file
from support_exudyn.postprocessing.page.pieces import Sheet
from user_forces.values.value import InputError

FILE = "chapter.json"
REFERENCE = re.compile(r"\[@([\w.-]+(?:/[\w.-]+)?)\]")
LARGEST_FILE = 200_000_000  # bytes, of what is read for a report


@dataclass(frozen=True)
class Picture:
    """A figure: stem.png, stem.pdf and stem.csv in the study's folder, and what it shows.

    A time series has stem.live.json too, from which the report makes a figure to look into.
    """

    __pydantic_config__ = ConfigDict(extra="forbid", strict=True)

    stem: str
    caption: str

    def __post_init__(self) -> None:
        if not self.stem or Path(self.stem).name != self.stem or "\\" in self.stem:
            raise ValueError(f"stem = {self.stem!r}: allowed: a file name without folder and ending")


@dataclass(frozen=True)
class Tile:
    """A number on the first screen: what it is, with the ideal pin, with clearance, and the change."""

    __pydantic_config__ = ConfigDict(extra="forbid", strict=True)

    name: str
    ideal: str
    with_clearance: str
    change: str


@dataclass(frozen=True)
class JudgedClaim:
    """A statement of the paper and the verdict on it.

    number: such as "12". where: section or figure of the paper. verdict: "holds", "in part", "fails", "needs
    more machines" or "not measurable". why: in a sentence, with numbers. figure, table: what shows it, as
    "study/stem" and "study/name"; empty if nothing does.
    """

    __pydantic_config__ = ConfigDict(extra="forbid", strict=True)

    number: str
    where: str
    text: str
    verdict: str
    why: str
    figure: str = ""
    table: str = ""


@dataclass(frozen=True)
class Chapter:
    """A study in words, pictures and tables; all texts are plain sentences.

    answer: one to three sentences. numbers: the three that matter, each "what: value". method: paragraphs.
    findings: bullet points, with the numbers of this very run. pictures, sheets: the key one first. tiles: for
    the first screen of the report. claims: of the study that judges them. machine: the name of the
    user's machine that it is about; empty: the paper's. contact: of the user's pin, in a sentence. computed_by:
    engine and method in a sentence, where the report's first screen is to name them.
    """

    __pydantic_config__ = ConfigDict(extra="forbid", strict=True)

    study: str
    title: str
    question: str
    method: tuple[str, ...]
    findings: tuple[str, ...]
    pictures: tuple[Picture, ...]
    sheets: tuple[Sheet, ...]
    answer: str = ""
    numbers: tuple[str, ...] = ()
    tiles: tuple[Tile, ...] = ()
    claims: tuple[JudgedClaim, ...] = ()
    machine: str = ""
    contact: str = ""
    computed_by: str = ""

    def save(self, out: Path) -> Path:
        """Write DIR/chapter.json, whole or not at all."""
        path = out / FILE
        with whole_file(path) as temporary:
            text = json.dumps(asdict(self), indent=1, ensure_ascii=False, allow_nan=False)
            temporary.write_text(text + "\n", encoding="utf-8")
        return path

    @staticmethod
    def load(folder: Path) -> Chapter:
        """Read it back. Raises InputError that names the file and what is wrong with it."""
        path = folder / FILE
        try:
            return _reader().validate_json(contents(path, LARGEST_FILE))
        except FileNotFoundError:
            raise InputError(f"{path}: no such file; the study that writes it has not run here") from None
        except ValidationError as error:
            raise InputError(f"{path}: {_complaints(error)}") from None


@cache
def _reader() -> TypeAdapter[Chapter]:
    return TypeAdapter(Chapter)


def _complaints(error: ValidationError) -> str:
    """All that is wrong, with places such as sheets.0.title."""
    found = [(".".join(str(part) for part in item["loc"]), item["msg"]) for item in error.errors()]
    return "; ".join(f"{place}: {message}" if place else message for place, message in found)


def without_references(text: str) -> str:
    """A sentence for a terminal: what it refers to stands there by the name of its file."""
    return REFERENCE.sub(r"\1", text)
