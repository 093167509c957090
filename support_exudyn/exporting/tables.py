"""All channels as CSV."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from pathlib import Path

from support_exudyn.exporting.whole_set import check_is_no_run
from support_exudyn.files import whole_file
from support_exudyn.progress import Progress
from support_exudyn.result import Result

AT_ONCE = 500  # rows


def header(result: Result) -> list[str]:
    """Names of all columns, such as `pin.rear_base.force [N]`."""
    return [f"{name} [{channel.unit or '1'}]" for name, channel in result.channels.items()]


def write_csv(result: Result, path: Path, records: Sequence[int], progress: Progress) -> None:
    """A row of names with units, then a row per record.

    Numbers have as many digits as tell them apart from all others: reading gives the same bits.
    """
    check_is_no_run(path)
    columns = [channel.values for channel in result.channels.values()]
    with whole_file(path) as temporary, temporary.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header(result))
        for start in range(0, len(records), AT_ONCE):
            chosen = list(records[start : start + AT_ONCE])
            writer.writerows(zip(*(column[chosen].tolist() for column in columns), strict=True))
            progress(min(1.0, (start + AT_ONCE) / len(records)))
