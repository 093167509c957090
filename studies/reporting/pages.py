"""The report as a page that answers in a minute, and an appendix with all that is behind it."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from jinja2 import PackageLoader
from markupsafe import Markup

from studies.reporting.arranged import Arrangement
from studies.reporting.content import ReportSection, around_chapters
from studies.reporting.places import APPENDIX, PAGE
from support_exudyn.postprocessing.page.pieces import ShownTable, templates


def pages(
    out: Path,
    sections: Sequence[ReportSection],
    waited: Sequence[str] = (),
    others: Mapping[str, str] | None = None,
    beside: Sequence[str] = (),
) -> dict[str, str]:
    """Both pages, by the name of their file.

    Arguments:
        out: the folder of both; links to other files are relative to it.
        sections: in the order in which they are to be read.
        waited: studies of the paper's answer that are not there yet.
        others: questions of further studies that are not there, by their names.
        beside: of the sections those that stand in the appendix alone.

    Raises OSError if a picture cannot be read.
    """
    arranged = Arrangement(out, sections, beside)
    around = around_chapters(sections)
    made = templates(PackageLoader("studies.reporting"))
    told = {
        "around": around,
        "arranged": arranged,
        "waited": waited,
        "others": others or {},
        "table_of": ShownTable,
    }
    return {
        file: made.get_template(f"{file}.j2").render(
            **told,
            scripts=Markup(arranged.live[file].scripts),
        )
        for file in (PAGE, APPENDIX)
    }
