"""The report on all studies: report.html, the answer in a minute, and appendix.html, all that is behind it.

`python -m studies.report` writes both again from the results that are there.
"""

import sys
from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path

from studies.catalogue import DEFAULT, STUDIES
from studies.common.words import FILE
from studies.reporting.arranged import PAGE, pages
from studies.reporting.content import ReportSection
from support_exudyn.commands.command_line import carry_out, new_app, say, warn
from support_exudyn.files.whole_file import whole_file
from user_forces.values.value import InputError


def write_report(out: Path, sections: Sequence[ReportSection]) -> Path:
    """Write report.html and appendix.html into `out`, both whole or none; returns the path of the first.

    Arguments:
        out: folder; links to files of the studies are relative to it.
        sections: in the order in which they are to be read.

    Raises InputError or OSError; the files are then as they were before.
    """
    there = [section.chapter.study for section in sections]
    own = any(section.chapter.machine for section in sections)
    missing = [name for name in STUDIES if name not in there and (STUDIES[name].own_machine or not own)]
    waited = [name for name in missing if name in DEFAULT]
    others = {name: STUDIES[name].question for name in missing if name not in DEFAULT}
    with ExitStack() as files:
        for name, written in pages(out, sections, waited, others).items():
            temporary = files.enter_context(whole_file(out / name))
            temporary.write_text(written, encoding="utf-8")
    return out / PAGE


def sections(out: Path, order: Sequence[str]) -> list[ReportSection]:
    """Chapters of all studies in the folders below `out`: those of `order` first, then others by name.

    Raises InputError if there is none, or if a chapter cannot be read.
    """
    there = sorted(path.parent.name for path in out.glob(f"*/{FILE}"))
    if not there:
        raise InputError(f"{out}: no folder with a {FILE} in it; run python -m studies first")
    names = [name for name in order if name in there] + [name for name in there if name not in order]
    return [ReportSection.load(out / name) for name in names]


def rebuild(out: Path, order: Sequence[str]) -> int:
    """Write the report from the folders below `out`; errors are printed. Returns the exit code."""
    try:
        write_report(out, sections(out, order))
    except (InputError, OSError) as error:
        warn(f"error: {error}")
        return 1
    return 0


def main(argv: Sequence[str] | None = None) -> int:
    """Entry of `python -m studies.report`."""
    return carry_out(app, argv)


app = new_app("python -m studies.report", "Write the report from the results that are there.", version_flags=())


@app.default
def report(*, out: Path = Path("results")) -> int:
    """Write the report.

    Args:
        out: Folder of results (results).
    """
    code = rebuild(out, list(STUDIES))
    if not code:
        say(out / PAGE)
    return code


if __name__ == "__main__":
    sys.exit(main())
