"""A comparison for other programs: plain data in SI for scripts, JUnit XML for test servers."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from support_exudyn.files.whole_file import whole_file
from support_exudyn.postprocessing.comparing.compared_channel import ComparedChannel
from support_exudyn.postprocessing.comparing.files_compared import ComparedPair, FilesCompared
from support_exudyn.postprocessing.comparing.tables import faults, notes
from user_forces.values.value import cleaned

NAME = "support-exudyn compare"


def as_data(compared: FilesCompared) -> dict[str, Any]:
    """The whole comparison: the verdict, and the results of each file and each of its channels."""
    return {
        "reference": compared.reference.path,
        "kind": compared.reference.kind,
        "verdict": compared.verdict,
        "files": {pair.other.name: _plain(_pair(pair)) for pair in compared.pairs},
    }


def _pair(pair: ComparedPair) -> dict[str, Any]:
    return {
        "path": pair.other.path,
        "kind": pair.other.kind,
        "verdict": pair.verdict,
        "notes": list(notes(pair)),
        "shift_s": pair.other.mapped.shift,
        "horizon_s": pair.window.horizon,
        "left_out": pair.common.lacking,
        "not_alike": pair.common.not_alike,
        "channels": {name: _channel(one) for name, one in pair.channels.items()},
    }


def _channel(one: ComparedChannel) -> dict[str, Any]:
    within = {"within": True, "not within": False}
    return {
        "unit": one.unit,
        "verdict": one.verdict,
        "tolerance": None if one.tolerance is None else one.tolerance.text,
        "allowed": one.allowed,
        "faults": faults(one),
        "reference": one.means[0],
        "other": one.means[1],
        "mean": one.mean,
        "largest": one.largest,
        "beside_errors": {"within": within.get(one.beside_errors.verdict), "times": one.beside_errors.ratio},
        "measures": one.measures,
        "statistics": {name: {**what._asdict(), "equal": what.equal} for name, what in one.statistics.items()},
    }


def _plain(item: Any) -> Any:
    """Named tuples and mappings as dictionaries, sequences as lists."""
    if hasattr(item, "_asdict"):
        return _plain(item._asdict())
    if isinstance(item, Mapping):
        return {name: _plain(value) for name, value in item.items()}
    return [_plain(value) for value in item] if isinstance(item, (list, tuple)) else item


def write_junit(compared: FilesCompared, path: Path) -> None:
    """Write JUnit XML, whole or not at all: a test suite for each file, a test case for each channel.

    A channel that is not within its tolerance, or not decided, is a failure; a channel that could not be
    compared is skipped. Raises OSError if the file cannot be written.
    """
    whole = ElementTree.Element("testsuites", name=NAME)
    for pair in compared.pairs:
        suite = _within(whole, "testsuite", name=f"{pair.other.name} less {pair.reference.name}", errors="0")
        for one in pair.channels.values():
            _case(suite, pair, one)
        for name, why in pair.common.not_alike.items():
            case = _within(suite, "testcase", classname=pair.other.name, name=name)
            _within(case, "skipped", message=why)
        if lines := "\n".join(notes(pair)):
            _within(suite, "system-out").text = cleaned(lines)
    for counted in (whole, *whole):
        for name, found in (("tests", "testcase"), ("failures", "failure"), ("skipped", "skipped")):
            counted.set(name, str(len(list(counted.iter(found)))))
    ElementTree.indent(whole)
    with whole_file(path) as temporary:
        ElementTree.ElementTree(whole).write(temporary, encoding="UTF-8", xml_declaration=True)


def _within(parent: ElementTree.Element, tag: str, **attributes: str) -> ElementTree.Element:
    return ElementTree.SubElement(parent, tag, {name: cleaned(text) for name, text in attributes.items()})


def _case(suite: ElementTree.Element, pair: ComparedPair, one: ComparedChannel) -> None:
    case = _within(suite, "testcase", classname=pair.other.name, name=one.name)
    if lines := faults(one):
        _within(case, "failure", type=one.verdict, message=lines[0]).text = cleaned("\n".join(lines))
