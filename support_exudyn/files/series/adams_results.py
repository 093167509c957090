"""Series from ADAMS result files (`.res`): XML with entities, their components, and a step for each time.

A file has analyses. Each has a map of steps, which says what entity and component the numbers of a step are,
and the steps, whose numbers are broken over lines in the order of the ids of the components:

    <Results><Analysis name="..."><StepMap>
    <Entity name="PART_2_XFORM"><Component name="Y" unitsValue="inch" id="3" /></Entity>
    </StepMap><Data><Step type="dynamic"> 0.01 0 -0.0194 ... </Step></Data></Analysis></Results>

Elements are read one after the other and dropped, so that nothing is kept but the numbers that are wanted.
Step maps as of genuine files of Adams 2015 to 2022, and of VI-CarRealTime.
"""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from array import array
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from support_exudyn.files.free_memory import available
from support_exudyn.files.series.columns import Column, series_file
from support_exudyn.files.series.named_series import Asked, SeriesFile
from support_exudyn.files.series.units import read_unit, split_title
from user_forces.values.value import InputError, short

SKIPPED = "input"  # the step of the model as it was given, before it is assembled
FIRST_CHECK = 256  # steps, after which it is known how much memory the file takes
SHARE = 0.8  # of the memory that is free
Element = ElementTree.Element


@dataclass
class _Component:
    """What a number of a step is."""

    name: str
    unit: str | None
    number: int


class AdamsReading:
    """The numbers of an analysis of a file.

    path: of the file. asked: which analysis and which series are wanted.
    """

    def __init__(self, path: Path, asked: Asked) -> None:
        self._path, self._asked = path, asked
        self.analyses: list[str] = []
        self.notes: list[str] = []
        self.numbers = array("d")
        self.columns: list[_Component] = []  # of a row of `numbers`; the first is time
        self._places: list[int] = []  # in a step, of `columns`
        self._width = self._steps = 0
        self._time_unit = ""

    def read(self) -> None:
        """Read the file. Raises InputError if it is none, or damaged, with the line or the step."""
        size = max(1, self._path.stat().st_size)
        try:
            with self._path.open("rb") as file:
                for event, element in self._elements(ElementTree.iterparse(file, ("start", "end"))):
                    if event == "end":
                        self._end(element, file.tell() / size)
                        self._asked.progress(min(1.0, file.tell() / size))
        except ElementTree.ParseError as error:
            line, column = error.position
            phrase = str(error).partition(":")[0]
            raise InputError(
                f"{self._path}: line {line}, column {column + 1}: {phrase}; allowed: the whole of an ADAMS "
                "result file"
            ) from None
        except (LookupError, UnicodeError) as error:
            raise self._wrong(f"is no text in its encoding ({error})", "UTF-8") from None

    def _elements(self, events: Iterator[tuple[str, Element]]) -> Iterator[tuple[str, Element]]:
        """The elements of the analysis that is wanted, at their ends; those that have been read are dropped."""
        chosen = False
        first = True
        for event, element in events:
            name = _name(element)
            if first and name != "Results":
                raise self._wrong(f"is XML of {short(name)}", "ADAMS result files, of <Results>")
            first = False
            if name == "Analysis" and event == "start":
                chosen = self._chooses(element.get("name", ""))
            if chosen:
                yield event, element
            if event == "end" and name in ("Step", "StepMap", "Analysis"):
                element.clear()

    def _wrong(self, phrase: str, allowed: str) -> InputError:
        return InputError(f"{self._path}: {phrase}; allowed: {allowed}")

    def _chooses(self, name: str) -> bool:
        """Whether an analysis that begins is the one that is wanted."""
        self.analyses.append(name)
        wanted = self._asked.analysis
        chosen = name == wanted if wanted is not None else len(self.analyses) == 1
        if chosen and self.columns:
            raise self._wrong(f"a second analysis {short(name)}", "one of each name")
        return chosen

    def _end(self, element: Element, share: float) -> None:
        """Take what an element has. share: of the file that is read."""
        name = _name(element)
        if name == "Units":
            self._time_unit = element.get("time", "")
        elif name == "StepMap":
            self._take_map(element)
        elif name == "Step" and element.get("type", "") != SKIPPED:
            self._take_step(element.text or "")
            if self._steps >= FIRST_CHECK and self._steps & (self._steps - 1) == 0:
                self._check_room(share)

    def _take_map(self, step_map: Element) -> None:
        """Choose what is kept of a step."""
        if self.columns:
            raise self._wrong("a second map of steps in one analysis", "one")
        found: dict[int, _Component] = {}
        for entity in step_map:
            for item in entity:
                one = self._component(entity.get("name", ""), item)
                if one.number < 1 or one.number in found:
                    raise self._wrong(
                        f"id {one.number} of component {short(one.name)}", "each number from 1 on once"
                    )
                found[one.number] = one
        ordered = [found[number] for number in sorted(found)]
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
        self._width, self._places = len(ordered), [times[0], *kept]
        self.columns = [ordered[n] for n in self._places]

    def _component(self, entity: str, item: Element) -> _Component:
        try:
            number, name = int(item.attrib["id"]), item.attrib["name"]
        except (KeyError, ValueError):
            phrase = f"entity {short(entity)}: a component without a name or a number as its id"
            raise self._wrong(phrase, "both") from None
        unit = adams_unit(item.get("unitsValue", ""))
        if unit is None and (label := item.get("plotLabel", "").strip()):
            bare = label[:1] == "(" and label[-1:] == ")"  # such as (RPM)
            unit = adams_unit(label[1:-1]) if bare else split_title(label)[1]
        return _Component(f"{entity}.{name}", unit, number)

    def _take_step(self, text: str) -> None:
        if not self.columns:
            raise self._wrong("a step before the map of steps", "the map first")
        self._steps += 1
        words = text.split()
        if len(words) != self._width:
            raise self._wrong(f"step {self._steps} has {len(words)} numbers", f"{self._width}, as the map has")
        try:
            if "_" in text:  # which Python takes for a number's
                raise ValueError
            self.numbers.extend([float(words[n]) for n in self._places])
        except ValueError:
            raise self._wrong(f"step {self._steps} has what is no number", "numbers such as 1.5e-3") from None

    def _check_room(self, share: float) -> None:
        """Raise InputError if the numbers of the whole file, of which a share is read, need too much memory."""
        taken = 8 * len(self.numbers)
        needed, there = taken / max(share, 1e-9), SHARE * (available() + taken)
        if needed > there:
            phrase = (
                f"{len(self.columns)} series of it take {needed / 1e9:.3g} GB, and {there / 1e9:.3g} are free"
            )
            raise self._wrong(phrase, "fewer, by their names or patterns of them")


def _name(element: Element) -> str:
    """The name of an element without its namespace."""
    return str(element.tag).rpartition("}")[2]


def read_adams_results(path: Path, asked: Asked) -> SeriesFile:
    """The series of an analysis of an ADAMS result file, called `ENTITY.COMPONENT`.

    Steps of the model as it was given, before it is assembled, are left out. Raises InputError for what is no
    such file, damaged, or more than fits into memory; OSError if it cannot be read.
    """
    found = AdamsReading(path, asked)
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


def adams_unit(text: str) -> str | None:
    """The unit of `newton-meter`, `inch/sec**2` or `no_units`; None if there is none, or pint reads none."""
    return read_unit(text)[0] if text.strip() else None
