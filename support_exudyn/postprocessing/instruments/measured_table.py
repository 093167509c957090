"""What instruments have read, as a CSV table that `compare` and spreadsheets take."""

import csv
import math
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from support_exudyn.files.series.named_series import NamedSeries
from support_exudyn.files.whole_file import whole_file
from support_exudyn.postprocessing.export.whole_set import check_is_no_run

WRITTEN = {"Pa": ("MPa", 1e-6), "m": ("mm", 1e3), "rad": ("deg", 180.0 / math.pi)}
DIGITS = 10  # of a number: far more than instruments have
DECIMALS = 7  # of MPa, mm, deg: smaller is what rounding of a run leaves of nothing


def write_measured(measured: Mapping[str, NamedSeries], path: str | Path) -> Path:
    """Write series as columns such as `front_column.pressure_MPa`, one row for every time of any of them.

    Numbers have ten digits, and what is read at most seven decimals; a cell is empty where an instrument with
    another rate has no sample.

    Raises InputError if a run is at the path; OSError if it cannot be written.
    """
    path = Path(path)
    check_is_no_run(path)
    columns = {"time_s": np.unique(np.concatenate([one.time for one in measured.values()]))}
    for name, one in measured.items():
        unit, scale = WRITTEN[one.unit or ""]
        column = np.full(columns["time_s"].size, math.nan)
        column[np.searchsorted(columns["time_s"], one.time)] = (
            np.round(scale * one.values, DECIMALS) + 0.0
        )  # no -0
        columns[f"{name}_{unit}"] = column
    with whole_file(path) as temporary, temporary.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        for row in zip(*(column.tolist() for column in columns.values()), strict=True):
            writer.writerow("" if math.isnan(cell) else f"{cell:.{DIGITS}g}" for cell in row)
    return path
