"""Series of any file that this program can read. What it is is found by its content."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from support_exudyn.files.series.adams_requests import is_request_file, read_adams_requests
from support_exudyn.files.series.adams_results import read_adams_results
from support_exudyn.files.series.exudyn_files import (
    is_exudyn_binary,
    is_exudyn_text,
    read_exudyn_binary,
    read_exudyn_text,
)
from support_exudyn.files.series.matlab import is_matlab, read_matlab
from support_exudyn.files.series.named_series import Asked, Progress, SeriesFile, silent
from support_exudyn.files.series.own_runs import is_exported, is_run, read_exported, read_own_run
from support_exudyn.files.series.parquet import is_parquet, read_parquet
from support_exudyn.files.series.text_tables import UTF_16, read_text_table
from support_exudyn.files.whole_file import check_is_file, missing_file
from user_forces.values.value import InputError, short

HEAD = 4096  # bytes by which a format is found
NO_UNITS: Mapping[str, str] = {}


@dataclass(frozen=True)
class SeriesFormat:
    """A kind of files. name: in words. fits: whether the first bytes of a file are of it. read: its reader."""

    name: str
    fits: Callable[[bytes], bool]
    read: Callable[[Path, Asked], SeriesFile]


def _is_xml(head: bytes) -> bool:
    text = head.decode("utf-16" if head.startswith(UTF_16) else "utf-8-sig", "replace")
    return text.lstrip().startswith("<")


def _is_text(head: bytes) -> bool:
    return bool(head.strip()) and (b"\0" not in head or head.startswith(UTF_16))


FORMATS = (  # the first that fits is taken
    SeriesFormat("run of this program", is_run, read_own_run),
    SeriesFormat("channels that `export --to hdf5` has written", is_exported, read_exported),
    SeriesFormat("MATLAB file (.mat)", is_matlab, read_matlab),
    SeriesFormat("Parquet file", is_parquet, read_parquet),
    SeriesFormat("binary solution of Exudyn", is_exudyn_binary, read_exudyn_binary),
    SeriesFormat("ADAMS result file (.res)", _is_xml, read_adams_results),
    SeriesFormat("ADAMS request file (.req)", is_request_file, read_adams_requests),
    SeriesFormat("sensor or solution of Exudyn as text", is_exudyn_text, read_exudyn_text),
    SeriesFormat("table of text (CSV)", _is_text, read_text_table),
)


def read_series(
    path: str | Path,
    *,
    units: Mapping[str, str] = NO_UNITS,
    analysis: str | None = None,
    names: Sequence[str] = (),
    progress: Progress = silent,
) -> SeriesFile:
    """All series of a file, whatever program has written it.

    Arguments:
        path: of the file.
        units: what unit a column without one has, by patterns of names as in a shell.
        analysis: of an ADAMS result file, its name; None: the first.
        names: patterns of the series that are wanted, all if there are none. Of large result files only those
            take memory.
        progress: receives the share that is read.

    Raises InputError for a file of no known kind, damaged or ambiguous, with what is wrong and where; OSError
    if it cannot be read.
    """
    path = Path(path)
    if not path.exists():
        raise missing_file(path, f"files of series: {known_formats()}")
    check_is_file(path, 2**63)
    with path.open("rb") as file:
        head = file.read(HEAD)
    if not head:
        raise InputError(f"{path}: is empty; allowed: {known_formats()}")
    asked = Asked(units, analysis, names, progress)
    for one in FORMATS:
        if one.fits(head):
            if analysis is not None and one.read is not read_adams_results:
                raise InputError(f"{path}: analysis {short(analysis)}: a {one.name} has none; allowed: none")
            return one.read(path, asked)
    raise InputError(f"{path}: is of no kind that can be read; allowed: {known_formats()}")


def known_formats() -> str:
    """The kinds of files in words."""
    return ", ".join(one.name for one in FORMATS)
