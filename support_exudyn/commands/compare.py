"""`compare REFERENCE OTHER... [CHANNEL...]`: by how much files differ, and whether that is allowed."""

import math
from pathlib import Path
from typing import Annotated

from support_exudyn.commands.command_line import (
    After,
    Json,
    Rate,
    Until,
    answer,
    answered,
    output,
    say,
    show_table,
    shown_progress,
)
from support_exudyn.commands.runs import files_and_channels
from user_forces.values.value import InputError

DIFFERENT, REFUSED = 1, 2  # exit codes
FEWEST = 2  # files


def compare(
    reference: str,
    /,
    *others: str,
    map: Path | None = None,  # noqa: A002, the option's name
    shift: bool = False,
    tolerance: str | None = None,
    csv: Annotated[Path | None, output(".csv", folder=False)] = None,
    junit: Path | None = None,
    figure: Path | None = None,
    page: Path | None = None,
    after: After = -math.inf,
    until: Until = math.inf,
    rate: Rate | None = None,
    json: Json = False,
) -> int:
    """Print by how much files differ from the first, and the verdict, which the exit code gives.

    Any file that can be read will do: runs, CSV and text tables, results of ADAMS, Exudyn's sensor and solution
    files, MATLAB, Parquet. Columns are channels by their names, or by --map.

    Args:
        reference: File that the others are compared with.
        others: Files, then channels: names or patterns, such as `tip.*` (forces and traced points of runs, and
            all that other files have in common).
        map: compare.toml: which column is which channel, tolerances.
        shift: Determine by how much each file lags behind the reference, and take it off.
        tolerance: What is allowed: shares of the reference's range or amounts, `pin.*.force=2%,tip.*=0.1mm`.
        csv: The table as CSV, in SI: a row for each measure of each channel.
        junit: JUnit XML for test servers: a test case for each channel.
        figure: Figure, .png, .pdf or .svg: curves, differences, what is allowed.
        page: Page for a browser with all of it.
        rate: Rows per second [Hz] of files without times.
    """

    def work() -> int:
        from support_exudyn.postprocessing.comparing import compare_page, tables
        from support_exudyn.postprocessing.comparing.files_compared import compare_files

        files, channels = _files_and_channels([reference, *others])
        for path, endings in ((figure, compare_page.FIGURES), (page, compare_page.PAGES)):
            if path is not None:
                compare_page.check_ending(path, endings)
        with shown_progress("reading") as progress:
            compared = compare_files(
                *files,
                channels=channels,
                mapping=map,
                tolerance=tolerance or (),
                after=after,
                until=until,
                find_shift=shift,
                rate=rate,
                progress=progress,
            )
        written: list[Path] = []
        writers = (
            (csv, tables.write_csv),
            (junit, tables.write_junit),
            (figure, compare_page.write_figure),
            (page, compare_page.write_page),
        )
        for path, write in writers:
            if path is not None:
                write(compared, path)
                written.append(path)
        if json:
            answer(tables.as_data(compared) | {"written": written})
        else:
            for pair in compared.pairs:
                sheet = tables.table(pair)
                header = [head if n < sheet.left else f">{head}" for n, head in enumerate(sheet.header)]
                show_table(sheet.title, header, sheet.rows)
                for line in (*tables.notes(pair), *pair.faults):
                    say(line)
            say("\n".join([tables.conclusion(compared), *(str(path) for path in written)]))
        return DIFFERENT if compared.failed else 0

    return answered(work, REFUSED)


def _files_and_channels(words: list[str]) -> tuple[list[Path], list[str]]:
    """The files and the channels among words.

    Raises InputError if there are not two files, or if one of them is the file of a comparison.
    """
    files, channels = files_and_channels(words)
    for path in files:
        if path.suffix.lower() == ".toml":
            raise InputError(f"{path}: is no file that is compared; allowed: --map {path}")
    if len(files) < FEWEST:
        rest = f"; {channels[0]} is no file that is there, so it is taken for a channel" if channels else ""
        raise InputError(
            f"{files[0]}: is the only file{rest}; allowed: two files or more, the first is the reference"
        )
    return files, channels
