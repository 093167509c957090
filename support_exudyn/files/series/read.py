"""Series of any file that this program can read. What it is is found by its content."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from support_exudyn.files.series.adams_requests import read_adams_requests
from support_exudyn.files.series.adams_results import read_adams_results
from support_exudyn.files.series.exudyn_files import read_exudyn_binary, read_exudyn_text
from support_exudyn.files.series.labview import read_labview
from support_exudyn.files.series.matlab import is_matlab, read_matlab
from support_exudyn.files.series.named_series import Asked, Progress, SeriesFile, silent
from support_exudyn.files.series.own_runs import is_exported, is_run, read_own_file
from support_exudyn.files.series.text_tables import UTF_16, read_text_table
from support_exudyn.files.series.typed_tables import read_typed_table, read_workbook
from support_exudyn.files.whole_file import check_is_file, missing_file
from user_forces.values.value import InputError, short

HEAD = 4096  # bytes by which a format is found
PLAIN = (read_text_table, read_adams_results)  # which many files seem to be
NO_UNITS: Mapping[str, str] = {}


UNPACKED, WORKBOOK = "the file that it holds, unpacked", "the table saved as .xlsx or CSV"
REFUSED = (  # how files begin that are no tables, what they are, and what to do
    (rb"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", "an old workbook of Excel (.xls)", WORKBOOK),
    (rb"TDSm", "a TDMS file of LabVIEW", "its channels as CSV, as npTDMS and LabVIEW write it, or .lvm"),
    (rb"\x1f\x8b", "a compressed file (gzip)", UNPACKED),
    (rb"BZh|\xfd7zXZ|7z\xbc\xaf|Rar!|\x28\xb5\x2f\xfd", "a compressed file", UNPACKED),
    (rb"%PDF", "a PDF document", "the table as CSV"),
    (rb"PK\x03\x04", "an archive (zip)", f"{UNPACKED}; of spreadsheets CSV"),
    (rb"(?si)[^<]{0,9}<(!doctype html|html|table|meta|head|body|style)\b", "a page of HTML", WORKBOOK),
    (rb"(?s)[^<]{0,9}<.{0,900}schemas-microsoft-com:office:spreadsheet", "a workbook as XML", WORKBOOK),
)  # fmt: skip


class _Format(NamedTuple):
    """A kind of files in words, how they begin (a pattern or a function of the first bytes), and its reader."""

    name: str
    begins: bytes | Callable[[bytes], bool]
    read: Callable[[Path, Asked], SeriesFile]

    def fits(self, head: bytes) -> bool:
        begins = self.begins
        return re.match(begins, head) is not None if isinstance(begins, bytes) else begins(head)


REQUESTS = rb"(?i)\s*A\.R\d\b|MotionSolve\b[^\n]*Plot File|[^\n]{0,200}RecurDyn"
EXUDYN = rb"(?i)#exudyn[^\n]*(sensor output|solution) file"
FORMATS = (  # the first that fits is taken
    _Format("run of this program", is_run, read_own_file),
    _Format("channels that `export --to hdf5` has written", is_exported, read_own_file),
    _Format("MATLAB file (.mat)", is_matlab, read_matlab),
    _Format("Parquet file", rb"PAR1", read_typed_table),
    _Format("Feather file", rb"ARROW1|FEA1", read_typed_table),
    _Format("workbook of Excel (.xlsx)", rb"(?s)PK\x03\x04.*(\[Content_Types\]|xl/|docProps/)", read_workbook),
    _Format("binary solution of Exudyn", rb"EXUBIN", read_exudyn_binary),
    _Format("ADAMS result file (.res)", rb"[\xef\xbb\xbf\xff\xfe\0\s]*<", read_adams_results),
    _Format("LabVIEW measurement file (.lvm)", rb"(?i)(\xef\xbb\xbf)?\s*LabVIEW Measurement\b", read_labview),
    _Format("JSON file", rb"(\xef\xbb\xbf)?\s*(\{|\[\s*[{\[])", read_typed_table),
    _Format("ADAMS request file (.req)", REQUESTS, read_adams_requests),
    _Format("sensor or solution of Exudyn as text", EXUDYN, read_exudyn_text),
    _Format("table of text (CSV)", lambda head: b"\0" not in head or head.startswith(UTF_16), read_text_table),
)
KNOWN = ", ".join(one.name for one in FORMATS)


def read_series(
    path: str | Path,
    *,
    units: Mapping[str, str] = NO_UNITS,
    analysis: str | None = None,
    sheet: str | None = None,
    rate: float | None = None,
    names: Sequence[str] = (),
    progress: Progress = silent,
) -> SeriesFile:
    """All series of a file, whatever program has written it.

    Arguments:
        path: of the file.
        units, analysis, sheet, rate, names, progress: see `Asked`. Of large result files only the series that
            are wanted take memory.

    Raises InputError for a file of no known kind, damaged, ambiguous, or too large for the free memory, with
    what is wrong and where; OSError if it cannot be read.
    """
    path = Path(path)
    if not path.exists():
        raise missing_file(path, f"files of series: {KNOWN}")
    check_is_file(path, 2**63)
    with path.open("rb") as file:
        head = file.read(HEAD)
    if not head:
        raise InputError(f"{path}: is empty; allowed: {KNOWN}")
    if rate is not None and not 0.0 < rate < float("inf"):
        raise InputError(f"{path}: rate = {rate}: allowed: > 0, samples per second [Hz]")
    kind = next((one for one in FORMATS if one.fits(head)), None)
    for begin, what, instead in REFUSED if kind is None or kind.read in PLAIN else ():
        if re.match(begin, head):
            raise InputError(f"{path}: is {what}, which is not read; allowed: {instead}")
    if kind is None:
        raise InputError(f"{path}: is of no kind that can be read; allowed: {KNOWN}")
    for name, value, reader in (("analysis", analysis, read_adams_results), ("sheet", sheet, read_workbook)):
        if value is not None and kind.read is not reader:
            raise InputError(f"{path}: {name} {short(value)}: a {kind.name} has none; allowed: none")
    try:
        return kind.read(path, Asked(units, analysis, sheet, rate, names, progress))
    except MemoryError:
        size = f"{path.stat().st_size / 1e6:.3g} MB"
        raise InputError(
            f"{path}: has {size}, too much for the free memory; allowed: fewer rows or columns"
        ) from None
