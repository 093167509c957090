"""A comparison as JUnit XML, which test servers read: a test suite a file, a test case a channel."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from pathlib import Path

from support_exudyn.files.whole_file import whole_file
from support_exudyn.postprocessing.comparing.compared_channel import ComparedChannel
from support_exudyn.postprocessing.comparing.files_compared import ComparedPair, FilesCompared
from support_exudyn.postprocessing.comparing.sentences import sentences
from support_exudyn.postprocessing.comparing.told import beside, faults, number, share, shown_unit
from user_forces.values.value import cleaned

NAME = "support-exudyn compare"


def junit_xml(found: FilesCompared) -> str:
    """The text of the XML. A channel that is not within its tolerance, or not decided, is a failure."""
    whole = ElementTree.Element("testsuites", name=NAME)
    for pair in found.pairs:
        whole.append(_suite(pair))
    for name in ("tests", "failures", "skipped"):
        whole.set(name, str(sum(int(suite.get(name, "0")) for suite in whole)))
    ElementTree.indent(whole)
    return ElementTree.tostring(whole, encoding="unicode", xml_declaration=False)


def write_junit(found: FilesCompared, path: Path) -> None:
    """Write the XML, whole or not at all. Raises OSError if it cannot be written."""
    with whole_file(path) as temporary:
        text = '<?xml version="1.0" encoding="UTF-8"?>\n' + junit_xml(found) + "\n"
        temporary.write_text(text, encoding="utf-8")


def _suite(pair: ComparedPair) -> ElementTree.Element:
    cases = [_case(pair, one) for one in pair.channels.values()]
    failures = sum(case.find("failure") is not None for case in cases)
    skipped = [_left_out(pair, name, why) for name, why in pair.common.not_alike.items()]
    suite = ElementTree.Element(
        "testsuite", name=cleaned(f"{pair.other.name} less {pair.reference.name}"),
        tests=str(len(cases) + len(skipped)), failures=str(failures), errors="0", skipped=str(len(skipped)),
    )  # fmt: skip
    suite.extend([*cases, *skipped])
    if notes := "\n".join(sentences(pair)):
        ElementTree.SubElement(suite, "system-out").text = cleaned(notes)
    return suite


def _left_out(pair: ComparedPair, name: str, why: str) -> ElementTree.Element:
    case = ElementTree.Element("testcase", classname=cleaned(pair.other.name), name=cleaned(name))
    ElementTree.SubElement(case, "skipped", message=cleaned(why))
    return case


def _case(pair: ComparedPair, one: ComparedChannel) -> ElementTree.Element:
    case = ElementTree.Element("testcase", classname=cleaned(pair.other.name), name=cleaned(one.name))
    if said := faults(one):
        kind = {"not within": "not within", "not decided": "not decided"}.get(one.verdict, one.verdict)
        failure = ElementTree.SubElement(case, "failure", type=kind, message=cleaned(said[0]))
        failure.text = cleaned("\n".join(said))
    ElementTree.SubElement(case, "system-out").text = cleaned(_numbers(one))
    return case


def _numbers(one: ComparedChannel) -> str:
    unit = shown_unit(one)
    return (
        f"mean difference {number(one.mean, unit.scale)} {unit.name}; largest difference "
        f"{number(one.largest, unit.scale)} {unit.name} at {one.measures.largest_time:.6g} s; RMS "
        f"{share(one.measures.rms_of_range)} of the range; Sprague-Geers C "
        f"{share(one.measures.combined_error)}; "
        f"beside the numerical errors: {beside(one)}"
    )
