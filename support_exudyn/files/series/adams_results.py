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


def read_adams_results(path: Path, asked: Asked) -> SeriesFile:
    """The series of an analysis of an ADAMS result file, called `ENTITY.COMPONENT`.

    Steps of the model as it was given, before it is assembled, are left out. Raises InputError for what is no
    such file, damaged, or more than fits into memory; OSError if it cannot be read.
    """
    reading = _Analysis(path, asked)
    analyses = list[str]()
    size = path.stat().st_size
    try:
        with path.open("rb") as file:
            for element in _elements(path, ElementTree.iterparse(file, ("start", "end")), asked, analyses):
                reading.take(element, file.tell() / size)
                asked.progress(file.tell() / size)
    except ElementTree.ParseError as error:
        line, column = error.position
        phrase = str(error).partition(":")[0]
        where = f"{path}: line {line}, column {column + 1}"
        raise _wrong(where, phrase, "the whole of an ADAMS result file") from None
    except (LookupError, UnicodeError) as error:
        raise _wrong(path, f"is no text in its encoding ({error})", "UTF-8") from None
    if not reading.titles:
        known = ", ".join(map(short, analyses[:5])) or "none"
        wanted = "with a map of steps" if asked.analysis is None else short(asked.analysis)
        raise _wrong(path, f"has no analysis {wanted}", f"one of its {len(analyses)}: {known}")
    if not reading.numbers:
        raise _wrong(path, "has no steps", "one or more")
    notes = reading.notes
    if asked.analysis is None and len(analyses) > 1:
        notes.append(
            f"Of {len(analyses)} analyses the first is taken, {analyses[0]}; others are "
            f"{', '.join(analyses[1:5])} (analysis = of compare.toml)."
        )
    rows = np.frombuffer(reading.numbers, dtype=np.float64).reshape(-1, len(reading.titles))
    columns = [Column(name, unit, one) for (name, unit), one in zip(reading.titles, rows.T, strict=True)]
    return series_file(path, "ADAMS result file", [(columns[0], columns[1:])], asked, notes)


def _wrong(where: Path | str, phrase: str, allowed: str) -> InputError:
    return InputError(f"{where}: {phrase}; allowed: {allowed}")


def _elements(
    path: Path, events: Iterator[tuple[str, Element]], asked: Asked, analyses: list[str]
) -> Iterator[Element]:
    """The elements of the analysis that is wanted, at their ends; those that have been read are dropped.

    analyses: receives the names of all.
    """
    _, root = next(events)
    if _name(root) != "Results":
        raise _wrong(path, f"is XML of {short(_name(root))}", "ADAMS result files, of <Results>")
    chosen = False
    for event, element in events:
        name = _name(element)
        if name == "Analysis" and event == "start":
            analyses.append(element.get("name", ""))
            chosen = analyses[-1] == (analyses[0] if asked.analysis is None else asked.analysis)
            if chosen and analyses.count(analyses[-1]) > 1:
                raise _wrong(path, f"a second analysis {short(analyses[-1])}", "one of each name")
        if chosen and event == "end":
            yield element
        if event == "end" and name in ("Step", "StepMap", "Analysis"):
            element.clear()


def _name(element: Element) -> str:
    """The name of an element without its namespace."""
    return str(element.tag).rpartition("}")[2]


class _Analysis:
    """The numbers of an analysis; `titles` are names and units of a row of `numbers`, the first is time."""

    def __init__(self, path: Path, asked: Asked) -> None:
        self._path, self._asked = path, asked
        self.notes: list[str] = []
        self.numbers = array("d")
        self.titles: list[tuple[str, str | None]] = []
        self._places: list[int] = []  # in a step, of `titles`
        self._width = self._steps = 0
        self._time_unit = ""

    def take(self, element: Element, share: float) -> None:
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
        if self.titles:
            raise _wrong(self._path, "a second map of steps in one analysis", "one")
        found: dict[int, tuple[str, str | None]] = {}
        for entity in step_map:
            for item in entity:
                number, name = item.get("id", ""), f"{entity.get('name', '')}.{item.get('name', '')}"
                if not number.isdecimal() or int(number) in found:
                    raise _wrong(
                        self._path, f"id {number} of component {short(name)}", "each number from 1 on once"
                    )
                found[int(number)] = name, _component_unit(item)
        titles, known = list[tuple[str, str | None]](), set[str]()
        for place, (name, unit) in sorted(found.items()):
            if name in known:
                self.notes.append(f"{name} stands twice; that of id {place} is called by it.")
                name = f"{name}#{place}"
            known.add(name)
            titles.append((name, unit))
        times = [n for n, (name, _) in enumerate(titles) if name.casefold() == "time.time"]
        if len(times) != 1:
            raise _wrong(self._path, f"{len(times)} components TIME", "one, of the entity time")
        kept = [n for n, (name, _) in enumerate(titles) if n != times[0] and self._asked.wants(name)]
        self._width, self._places = len(titles), [times[0], *kept]
        name, unit = titles[times[0]]
        self.titles = [(name, unit or adams_unit(self._time_unit)), *(titles[n] for n in kept)]

    def _take_step(self, text: str) -> None:
        if not self.titles:
            raise _wrong(self._path, "a step before the map of steps", "the map first")
        self._steps += 1
        words = text.split()
        if len(words) != self._width:
            phrase = f"step {self._steps} has {len(words)} numbers"
            raise _wrong(self._path, phrase, f"{self._width}, as the map has")
        try:
            self.numbers.extend([float(words[n]) for n in self._places])
        except ValueError:
            phrase = f"step {self._steps} has what is no number"
            raise _wrong(self._path, phrase, "numbers such as 1.5e-3") from None

    def _check_room(self, share: float) -> None:
        """Raise InputError if the numbers of the whole file, of which a share is read, need too much memory."""
        taken = 8 * len(self.numbers)
        needed, there = taken / max(share, 1e-9), SHARE * (available() + taken)
        if needed > there:
            phrase = f"{len(self.titles)} series of it take {needed / 1e9:.3g} GB, {there / 1e9:.3g} are free"
            raise _wrong(self._path, phrase, "fewer, by their names or patterns of them")


def _component_unit(item: Element) -> str | None:
    """The unit of a component, by its own words or by brackets in its label, such as (RPM)."""
    unit, label = adams_unit(item.get("unitsValue", "")), item.get("plotLabel", "").strip()
    if unit is None and label[:1] == "(" and label[-1:] == ")":
        return adams_unit(label[1:-1])
    return split_title(label)[1] if unit is None and label else unit


def adams_unit(text: str) -> str | None:
    """The unit of `newton-meter`, `inch/sec**2` or `no_units`; None if there is none, or pint reads none."""
    return read_unit(text)[0] if text.strip() else None
