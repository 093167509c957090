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

from support_exudyn.files.series.columns import Column, first_names, series_file
from support_exudyn.files.series.named_series import Asked, SeriesFile
from support_exudyn.files.series.units import read_unit, split_title
from user_forces.values.value import InputError, short

SKIPPED = "input"  # the step of the model as it was given, before it is assembled
Element = ElementTree.Element
Titles = list[tuple[str, str | None]]  # names of components, each with its unit, None without


def read_adams_results(path: Path, asked: Asked) -> SeriesFile:
    """The series of an analysis of an ADAMS result file, called `ENTITY.COMPONENT`.

    Steps of the model as it was given, before it is assembled, are left out. Raises InputError for what is no
    such file, or damaged; OSError if it cannot be read.
    """
    analyses, titles, places, notes = list[str](), Titles(), list[int](), list[str]()
    numbers, width, steps, time_unit = array("d"), 0, 0, ""
    try:
        for name, element in _elements(path, asked, analyses):
            if name == "Units":
                time_unit = element.get("time", "")
            elif name == "StepMap" and titles:
                raise _wrong(path, "a second map of steps in one analysis", "one")
            elif name == "StepMap":
                known = _components(path, element, notes)
                width = len(known)
                places = _wanted(path, known, asked)
                titles = [known[n] for n in places]
            elif name == "Step" and element.get("type", "") != SKIPPED:
                if not titles:
                    raise _wrong(path, "a step before the map of steps", "the map first")
                steps += 1
                words = (element.text or "").split()
                if len(words) != width:
                    raise _wrong(path, f"step {steps} has {len(words)} numbers", f"{width}, as the map has")
                try:
                    numbers.extend([float(words[n]) for n in places])
                except ValueError:
                    raise _wrong(
                        path, f"step {steps} has what is no number", "numbers such as 1.5e-3"
                    ) from None
    except ElementTree.ParseError as error:
        line, column = error.position
        where = f"{path}: line {line}, column {column + 1}"
        raise _wrong(where, str(error).partition(":")[0], "the whole of an ADAMS result file") from None
    except (LookupError, UnicodeError) as error:
        raise _wrong(path, f"is no text in its encoding ({error})", "UTF-8") from None
    if not titles:
        wanted = "with a map of steps" if asked.analysis is None else short(asked.analysis)
        known_names = first_names(analyses) or "none"
        raise _wrong(path, f"has no analysis {wanted}", f"one of its {len(analyses)}: {known_names}")
    if not numbers:
        raise _wrong(path, "has no steps", "one or more")
    if asked.analysis is None and len(analyses) > 1:
        notes.append(
            f"Of {len(analyses)} analyses the first is taken, {analyses[0]}; others are "
            f"{', '.join(analyses[1:5])} (analysis = of compare.toml)."
        )
    titles[0] = titles[0][0], titles[0][1] or _unit_of(time_unit)
    rows = np.frombuffer(numbers, dtype=np.float64).reshape(-1, len(titles))
    columns = [Column(name, unit, one) for (name, unit), one in zip(titles, rows.T, strict=True)]
    return series_file(path, "ADAMS result file", [(columns[0], columns[1:])], asked, notes)


def _wrong(where: Path | str, phrase: str, allowed: str) -> InputError:
    return InputError(f"{where}: {phrase}; allowed: {allowed}")


def _elements(path: Path, asked: Asked, analyses: list[str]) -> Iterator[tuple[str, Element]]:
    """The elements of the analysis that is wanted, by their names without namespace, at their ends.

    analyses: receives the names of all. Elements that have been read are dropped.
    """
    chosen, size = False, path.stat().st_size
    with path.open("rb") as file:
        for n, (event, element) in enumerate(ElementTree.iterparse(file, ("start", "end"))):
            name = str(element.tag).rpartition("}")[2]
            if n == 0 and name != "Results":
                raise _wrong(path, f"is XML of {short(name)}", "ADAMS result files, of <Results>")
            if name == "Analysis" and event == "start":
                analyses.append(element.get("name", ""))
                wanted = analyses[0] if asked.analysis is None else asked.analysis
                chosen = analyses[-1] == wanted
                if chosen and wanted in analyses[:-1]:
                    raise _wrong(path, f"a second analysis {short(wanted)}", "one of each name")
            if chosen and event == "end":
                yield name, element
            if event == "end" and name in ("Step", "StepMap", "Analysis"):
                element.clear()
                asked.progress(file.tell() / size)


def _components(path: Path, step_map: Element, notes: list[str]) -> Titles:
    """All components of a step in the order of their ids. notes: receives those whose name stands twice."""
    found: dict[int, tuple[str, str | None]] = {}
    for entity in step_map:
        for item in entity:
            number, name = item.get("id", ""), f"{entity.get('name', '')}.{item.get('name', '')}"
            if not number.isdecimal() or int(number) in found:
                phrase = f"id {number} of component {short(name)}"
                raise _wrong(path, phrase, "each number from 1 on once")
            unit, label = _unit_of(item.get("unitsValue", "")), item.get("plotLabel", "").strip()
            if unit is None and label:
                bracketed = label[:1] == "(" and label[-1:] == ")"
                unit = _unit_of(label[1:-1]) if bracketed else split_title(label)[1]
            found[int(number)] = name, unit
    titles, known = Titles(), set[str]()
    for place, (name, unit) in sorted(found.items()):
        if name in known:
            notes.append(f"{name} stands twice; that of id {place} is called by it.")
            name = f"{name}#{place}"
        known.add(name)
        titles.append((name, unit))
    return titles


def _wanted(path: Path, titles: Titles, asked: Asked) -> list[int]:
    """The places in a step of the time and of what is wanted."""
    times = [n for n, (name, _) in enumerate(titles) if name.casefold() == "time.time"]
    if len(times) != 1:
        raise _wrong(path, f"{len(times)} components TIME", "one, of the entity time")
    return times + [n for n, (name, _) in enumerate(titles) if n != times[0] and asked.wants(name)]


def _unit_of(text: str) -> str | None:
    """The unit of `newton-meter`, `inch/sec**2` or `no_units`; None if there is none, or pint reads none."""
    return read_unit(text)[0] if text.strip() else None
