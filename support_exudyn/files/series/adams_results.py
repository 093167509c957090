"""Series from ADAMS result files (`.res`): XML with entities, their components, and a step for each time.

A file has analyses. Each has a map of steps, which says what entity and component the numbers of a step are,
and the steps, whose numbers are broken over lines in the order of the ids of the components:

    <Results><Analysis name="..."><StepMap>
    <Entity name="PART_2_XFORM"><Component name="Y" unitsValue="inch" id="3" /></Entity>
    </StepMap><Data><Step type="dynamic"> 0.01 0 -0.0194 ... </Step></Data></Analysis></Results>

The parser is expat, which is given the file piece by piece: nothing is kept but the numbers that are wanted.
Such files declare no entities, so that a declaration of the document's type, by which few bytes could become
gigabytes, is refused. Step maps as of genuine files of Adams 2015 to 2022, and of VI-CarRealTime.
"""

from __future__ import annotations

from array import array
from collections.abc import Mapping
from pathlib import Path
from typing import Any
from xml.parsers import expat

import numpy as np

from support_exudyn.files.free_memory import available
from support_exudyn.files.series.adams_units import adams_unit
from support_exudyn.files.series.asked import Asked
from support_exudyn.files.series.columns import Column, series_file
from support_exudyn.files.series.named_series import SeriesFile
from support_exudyn.files.series.titles import split_title
from user_forces.values.value import InputError, short

PIECE = 2**20  # bytes that are read at a time
DEEPEST = 32  # elements in elements; such files have 5
LONGEST = 2**26  # bytes of a tag; those of genuine files have a few hundred
COMPONENTS = 2_000_000  # that a map may have
LETTERS = 64  # of a number, with blanks and line ends
SKIPPED = ("input",)  # steps of the model as it was given, before it is assembled
FIRST_LOOK = 256  # steps, after which it is known how much memory the file takes
SHARE = 0.8  # of the memory that is free


class _Component:
    """What a number of a step is."""

    __slots__ = ("name", "number", "unit")

    def __init__(self, name: str, unit: str | None, number: int) -> None:
        self.name, self.unit, self.number = name, unit, number


class AdamsReading:
    """What has been read of a file so far. Arguments: its path, its size [bytes], and what is asked of it."""

    def __init__(self, path: Path, size: int, asked: Asked) -> None:
        self._path, self._size, self._asked = path, size, asked
        self.analyses: list[str] = []
        self.notes: list[str] = []
        self.numbers = array("d")
        self.columns: list[_Component] = []  # of a row of `numbers`; the first is time
        self._map: dict[int, _Component] = {}
        self._places: list[int] = []  # in a step, of `columns`
        self._depth = self._steps = self._letters = 0
        self._entity = self._time_unit = ""
        self._chosen = self._in_map = False
        self._text: list[str] | None = None
        parser = expat.ParserCreate()
        parser.buffer_text, parser.buffer_size = True, PIECE
        parser.StartDoctypeDeclHandler = self._refuse_declaration
        parser.StartElementHandler, parser.EndElementHandler = self._start, self._end
        parser.CharacterDataHandler = self._characters
        self._parser = parser

    def read(self) -> None:
        """Read the file. Raises InputError with the line if it is none, or damaged."""
        done = 0
        try:
            with self._path.open("rb") as file:
                while piece := file.read(PIECE):
                    self._parser.Parse(piece, False)
                    done += len(piece)
                    if done - self._parser.CurrentByteIndex > LONGEST:
                        raise self._wrong("a tag has no end", "tags of a few hundred letters")
                    self._asked.progress(min(1.0, done / max(1, self._size)))
                self._parser.Parse(b"", True)
        except expat.ExpatError as error:
            said = expat.ErrorString(error.code)
            raise InputError(
                f"{self._path}: line {error.lineno}, column {error.offset + 1}: {said}; allowed: the whole of "
                "an ADAMS result file"
            ) from None
        except (LookupError, UnicodeError, ValueError) as error:
            if isinstance(error, InputError):
                raise
            raise self._wrong(f"is no text in its encoding ({error})", "UTF-8") from None

    def _wrong(self, said: str, allowed: str) -> InputError:
        where = f", entity {short(self._entity)}" if self._entity else ""
        line = self._parser.CurrentLineNumber
        return InputError(f"{self._path}: line {line}{where}: {said}; allowed: {allowed}")

    def _refuse_declaration(self, *_: Any) -> None:
        raise self._wrong("declares a document type", "none, for ADAMS writes none")

    # --- elements ---

    def _start(self, tag: str, attributes: Mapping[str, str]) -> None:
        self._depth += 1
        if self._depth > DEEPEST:
            raise self._wrong("elements are nested too deep", f"{DEEPEST} levels")
        name = tag.rpartition(":")[2]
        if self._depth == 1 and name != "Results":
            raise self._wrong(f"is XML of {short(name)}", "ADAMS result files, of <Results>")
        if self._text is not None:
            raise self._wrong(f"{short(name)} in a step", "numbers")
        if name == "Analysis":
            self._begin_analysis(attributes.get("name", ""))
        elif not self._chosen:
            return
        elif name == "Units":
            self._time_unit = attributes.get("time", "")
        elif name == "StepMap":
            self._begin_map()
        elif name == "Entity":
            self._entity = attributes.get("name", "")
        elif name == "Component" and self._in_map:
            self._component(attributes)
        elif name == "Step" and attributes.get("type", "") not in SKIPPED:
            self._text, self._letters = [], 0

    def _end(self, tag: str) -> None:
        self._depth -= 1
        name = tag.rpartition(":")[2]
        if name == "Analysis":
            self._chosen = False
        elif name == "Entity":
            self._entity = ""
        elif name == "StepMap" and self._in_map:
            self._end_map()
        elif name == "Step" and self._text is not None:
            self._step("".join(self._text))
            self._text = None

    def _characters(self, text: str) -> None:
        if self._text is None:
            return
        self._text.append(text)
        self._letters += len(text)
        if self._letters > LETTERS * max(16, len(self._map)):
            raise self._wrong("a step has more letters than numbers need", f"{len(self._map)} numbers")

    def _begin_analysis(self, name: str) -> None:
        self.analyses.append(name)
        wanted = self._asked.analysis
        self._chosen = name == wanted if wanted is not None else len(self.analyses) == 1
        if self._chosen and self.columns:
            raise self._wrong(f"a second analysis {short(name)}", "one of each name")

    # --- the map ---

    def _begin_map(self) -> None:
        if self.columns:
            raise self._wrong("a second map of steps in one analysis", "one")
        self._in_map, self._map = True, {}

    def _component(self, attributes: Mapping[str, str]) -> None:
        try:
            number = int(attributes["id"])
            name = attributes["name"]
        except (KeyError, ValueError):
            raise self._wrong("a component without a name or a number as its id", "both") from None
        if number < 1 or number in self._map or len(self._map) >= COMPONENTS:
            raise self._wrong(f"id {number} of component {short(name)}", "each number from 1 on once")
        unit = adams_unit(attributes.get("unitsValue", ""))
        if unit is None and (label := attributes.get("plotLabel", "")):
            unit = split_title(label)[1] if split_title(label)[1] is not None else _bare(label)
        self._map[number] = _Component(f"{self._entity}.{name}", unit, number)

    def _end_map(self) -> None:
        """Choose what is kept of a step."""
        self._in_map = False
        ordered = [self._map[number] for number in sorted(self._map)]
        times = [n for n, one in enumerate(ordered) if one.name.casefold() == "time.time"]
        if len(times) != 1:
            raise self._wrong(f"{len(times)} components TIME", "one, of the entity time")
        time = ordered[times[0]]
        time.unit = time.unit or adams_unit(self._time_unit)
        known: set[str] = set()
        for one in ordered:
            if one.name in known:
                self.notes.append(f"{one.name} stands twice; that of id {one.number} is called by it.")
                one.name = f"{one.name}#{one.number}"
            known.add(one.name)
        kept = [n for n, one in enumerate(ordered) if n != times[0] and self._asked.wants(one.name)]
        self._places = [times[0], *kept]
        self.columns = [ordered[n] for n in self._places]

    # --- steps ---

    def _step(self, text: str) -> None:
        if not self.columns:
            raise self._wrong("a step before the map of steps", "the map first")
        self._steps += 1
        words = text.split()
        if len(words) != len(self._map):
            raise self._wrong(
                f"step {self._steps} has {len(words)} numbers", f"{len(self._map)}, as the map has"
            )
        try:
            if "_" in text:  # which Python takes for a number's
                raise ValueError
            self.numbers.extend([float(words[n]) for n in self._places])
        except ValueError:
            raise self._wrong(f"step {self._steps} has what is no number", "numbers such as 1.5e-3") from None
        if self._steps >= FIRST_LOOK and self._steps & (self._steps - 1) == 0:
            self._check_room()

    def _check_room(self) -> None:
        """Raise InputError if the numbers of the whole file will not fit into memory."""
        taken = 8 * len(self.numbers)
        needed = taken * self._size / max(1, self._parser.CurrentByteIndex)
        there = SHARE * (available() + taken)
        if needed > there:
            raise InputError(
                f"{self._path}: {len(self.columns)} series of it take {needed / 1e9:.3g} GB, and "
                f"{there / 1e9:.3g} GB are free; allowed: fewer, by their names or patterns of them"
            )


def _bare(label: str) -> str | None:
    """The unit of a label that is one in brackets, `(RPM)`."""
    inside = label.strip()
    return adams_unit(inside[1:-1]) if inside[:1] == "(" and inside[-1:] == ")" else None


def read_adams_results(path: Path, asked: Asked) -> SeriesFile:
    """The series of an analysis of an ADAMS result file, called `ENTITY.COMPONENT`.

    Steps of the model as it was given, before it is assembled, are left out. Raises InputError for what is no
    such file, damaged, or more than fits into memory; OSError if it cannot be read.
    """
    found = AdamsReading(path, path.stat().st_size, asked)
    found.read()
    if not found.columns:
        known = ", ".join(map(short, found.analyses[:5])) or "none"
        wanted = "with a map of steps" if asked.analysis is None else short(asked.analysis)
        raise InputError(
            f"{path}: has no analysis {wanted}; allowed: one of its {len(found.analyses)}: {known}"
        )
    if not found.numbers:
        raise InputError(f"{path}: has no steps; allowed: one or more")
    if asked.analysis is None and len(found.analyses) > 1:
        others = ", ".join(found.analyses[1:5])
        found.notes.append(
            f"Of {len(found.analyses)} analyses the first is taken, {found.analyses[0]}; others are {others} "
            "(analysis = of compare.toml)."
        )
    rows = np.frombuffer(found.numbers, dtype=np.float64).reshape(-1, len(found.columns))
    columns = [Column(one.name, one.unit, rows[:, n]) for n, one in enumerate(found.columns)]
    return series_file(path, "ADAMS result file", [(columns[0], columns[1:])], asked, found.notes)
