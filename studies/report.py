"""The report on all studies: report.html, the answer in a minute, and appendix.html, all that is behind it.

`python -m studies.report` writes both again from the results that are there.
"""

import sys
from contextlib import ExitStack
from pathlib import Path

from studies.catalogue import DEFAULT, STUDIES
from studies.common.words import FILE
from studies.reporting.arranged import PAGE, pages
from studies.reporting.content import ReportSection
from support_exudyn.commands.command_line import carry_out, new_app, say
from support_exudyn.files.whole_file import whole_file
from user_forces.values.value import InputError

app = new_app("python -m studies.report", "Write the report from the results that are there.", version_flags=())


def rebuild(out: Path) -> None:
    """Write report.html and appendix.html from the folders below `out`, both whole or none.

    Studies stand in the order of the catalogue, others behind them by name.

    Raises InputError or OSError if results cannot be read or pages cannot be written.
    """
    there = sorted(path.parent.name for path in out.glob(f"*/{FILE}"))
    if not there:
        raise InputError(f"{out}: no folder with a {FILE} in it; run python -m studies first")
    names = [name for name in STUDIES if name in there] + [name for name in there if name not in STUDIES]
    sections = [ReportSection.load(out / name) for name in names]
    own = any(section.chapter.machine for section in sections)
    missing = {n: one for n, one in STUDIES.items() if n not in there and (one.own_machine or not own)}
    waited = [name for name in missing if name in DEFAULT]
    others = {name: one.question() for name, one in missing.items() if name not in DEFAULT}
    with ExitStack() as files:
        for name, written in pages(out, sections, waited, others).items():
            files.enter_context(whole_file(out / name)).write_text(written, encoding="utf-8")


@app.default
def report(*, out: Path = Path("results")) -> None:
    """Write the report.

    Args:
        out: Folder of results (results).
    """
    rebuild(out)
    say(out / PAGE)


if __name__ == "__main__":
    sys.exit(carry_out(app, None))
