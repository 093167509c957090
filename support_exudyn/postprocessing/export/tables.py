"""All channels as CSV."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from pathlib import Path

from support_exudyn.files.whole_file import whole_file
from support_exudyn.formulations.progress import Progress
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.export.whole_set import check_is_no_run
from support_exudyn.simulation.result import Result

AT_ONCE = 500  # rows


def columns_of(result: Result) -> dict[str, Series]:
    """All channels by names such as `pin.rear_base.force [N]`; time first, also of a run that was read back."""
    names = sorted(result.channels, key=lambda name: name != "time")
    return {f"{name} [{result.unit(name) or '1'}]": result[name] for name in names}


def write_csv(result: Result, path: Path, records: Sequence[int], progress: Progress) -> None:
    """A row of names with units, then a row per record.

    Numbers have as many digits as tell them apart from all others: reading gives the same bits.
    """
    check_is_no_run(path)
    columns = columns_of(result)
    with whole_file(path) as temporary, temporary.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        for start in range(0, len(records), AT_ONCE):
            chosen = list(records[start : start + AT_ONCE])
            writer.writerows(zip(*(column[chosen].tolist() for column in columns.values()), strict=True))
            progress(min(1.0, (start + AT_ONCE) / len(records)))
