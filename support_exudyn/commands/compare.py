"""`compare REFERENCE OTHER... [CHANNEL...]`: by how much files differ, and whether that is allowed."""

from __future__ import annotations

import argparse
import math
import textwrap
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console

from support_exudyn.commands.command_line import (
    add_json,
    add_times,
    answer,
    folder,
    refusing,
    say,
    shown_progress,
)
from support_exudyn.commands.tables import printed, show_table
from user_forces.values.value import InputError

if TYPE_CHECKING:
    from support_exudyn.postprocessing.comparing.files_compared import FilesCompared

DIFFERENT, REFUSED = 1, 2  # exit codes
# a word with such an ending is a file even if it is not there, and no channel
ENDINGS = (".h5", ".csv", ".txt", ".tab", ".tsv", ".dat", ".res", ".req", ".mat", ".parquet", ".xml")
FEWEST = 2  # files
WIDTH = 78  # letters of a line of help
WHOLE = (-math.inf, math.inf)
CODES = """\
The first file is the reference. Any file that can be read will do: runs, CSV
and text tables, results of ADAMS, Exudyn's sensor and solution files, MATLAB,
Parquet. Columns are channels by their names, or by --map.

exit codes:
  0  within all tolerances, or none was given
  1  not within, or not decided: errors are larger than what is allowed
  2  a wrong command line, file, mapping or tolerance: nothing was compared
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The files, what of them is compared, what is allowed, and what is written."""
    parser.formatter_class = argparse.RawDescriptionHelpFormatter  # which does not fold the description either
    parser.epilog, parser.description = CODES, textwrap.fill(parser.description or "", WIDTH)
    add = parser.add_argument
    add(
        "names",
        nargs="+",
        metavar="FILE|CHANNEL",
        help="the reference, then the files that are compared with it, then channels: names or patterns, such "
        "as 'tip.*'; by default forces and traced points of runs, and all that other files have in common",
    )
    add(
        "--map",
        type=folder,
        metavar="FILE",
        help="compare.toml: which column is which channel, tolerances",
    )
    add(
        "--shift",
        action="store_true",
        help="find by how much each file lags behind the reference, and take it off",
    )
    add(
        "--tolerance",
        metavar="LIST",
        help="what is allowed: shares of the reference's range or amounts, 'pin.*.force=2%%,tip.*=0.1mm'",
    )
    add_json(parser)
    add("--junit", type=folder, metavar="FILE", help="JUnit XML for test servers: a test case for each channel")
    add(
        "--figure",
        type=folder,
        metavar="FILE",
        help="figure, .png, .pdf or .svg: curves, differences, what is allowed",
    )
    add("--page", type=folder, metavar="FILE", help="page for a browser with all of it")
    add_times(parser, *WHOLE)


def run(given: argparse.Namespace) -> None:
    """Compare, print the tables and write what is asked for; ends with the exit code of the verdict."""
    with refusing(REFUSED):
        verdict = _compared(given)
    if verdict in ("not within", "not decided"):
        raise SystemExit(DIFFERENT)


def _compared(given: argparse.Namespace) -> str:
    """Print and write; returns the verdict. Files that cannot be written are refused before any is read."""
    files, channels = files_and_channels(given.names)
    from support_exudyn.postprocessing.comparing import compare_page, tables
    from support_exudyn.postprocessing.comparing.files_compared import compare_files

    for path, endings in ((given.figure, compare_page.FIGURES), (given.page, compare_page.PAGES)):
        if path is not None:
            compare_page.check_ending(path, endings)
    with shown_progress("reading") as progress:
        compared = compare_files(
            *files,
            channels=channels,
            mapping=given.map,
            tolerance=() if given.tolerance is None else given.tolerance,
            after=given.after,
            until=given.until,
            find_shift=given.shift,
            progress=progress,
        )
    outputs = (
        (given.junit, tables.write_junit),
        (given.figure, compare_page.write_figure),
        (given.page, compare_page.write_page),
    )
    written = [path for path, _ in outputs if path is not None]
    for path, write in outputs:
        if path is not None:
            write(compared, path)
    if given.json:
        answer(tables.as_data(compared) | {"written": written})
        return compared.verdict
    printed(lambda console: _show(console, compared))
    for path in written:
        say(str(path))
    return compared.verdict


def files_and_channels(words: Sequence[str]) -> tuple[list[Path], list[str]]:
    """The files and the channels among words: the first is a file, others are if they are there or end so.

    Raises InputError if there are not two files, or if one of them is the file of a comparison.
    """
    chosen = [
        n == 0 or folder(word).is_file() or (word.lower().endswith(ENDINGS) and not set(word) & set("*?"))
        for n, word in enumerate(words)
    ]
    files = [folder(word) for word, is_file in zip(words, chosen, strict=True) if is_file]
    for path in files:
        if path.suffix.lower() == ".toml":
            raise InputError(f"{path}: is no file that is compared; allowed: --map {path}")
    channels = [word for word, is_file in zip(words, chosen, strict=True) if not is_file]
    if len(files) < FEWEST:
        rest = f"; {channels[0]} is no file that is there, so it is taken for a channel" if channels else ""
        raise InputError(
            f"{files[0]}: is the only file{rest}; allowed: two files or more, the first is the reference"
        )
    return files, channels


def _show(console: Console, compared: FilesCompared) -> None:
    """Print the tables and the notes on them."""
    from support_exudyn.postprocessing.comparing import tables

    for pair in compared.pairs:
        sheet = tables.table(pair)
        header = [head if n < sheet.left else f">{head}" for n, head in enumerate(sheet.header)]
        show_table(console, sheet.title, header, sheet.rows)
        for line in (*tables.notes(pair), *pair.faults):
            console.print(line, markup=False, soft_wrap=True)
    console.print(tables.VERDICTS[compared.verdict], markup=False, soft_wrap=True)
