"""All channels of a run as tables for other programs: CSV, and plain HDF5."""

import csv
import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from support_exudyn.files.series.own_runs import EXPORTED
from support_exudyn.files.whole_file import whole_file
from support_exudyn.postprocessing.export.sampling import Sampling
from support_exudyn.postprocessing.export.whole_set import check_is_no_run
from support_exudyn.scene.contract import Progress, silent
from support_exudyn.simulation.result import Result
from user_forces.contact_state import Onset

TABLES = Sampling()  # all records
AT_ONCE = 500  # rows
ONSET_COLUMNS = {  # field of an onset: unit, meaning
    "time": ("s", "beginning of the contact"),
    "speed": ("m/s", "initial impact velocity at zero depth"),
    "separation_time": ("s", "end of the contact; infinite: not before the end of the run or the next impact"),
    "separation_velocity": ("m/s", "speed of separation at zero depth"),
}


def to_csv(
    result: Result, path: str | Path, sampling: Sampling = TABLES, progress: Progress = silent
) -> tuple[Path, ...]:
    """All channels as a table: a row of names with units such as `pin.rear_base.force [N]`, then the records.

    Numbers read back as the same bits; pandas before 3 needs `read_csv(path, float_precision="round_trip")` for
    that. MATLAB keeps the names with `readtable(path, VariableNamingRule="preserve")`.

    Arguments are those of `to_vtu`; all records if nothing else is asked for. Returns the path.

    Raises InputError if no record is chosen, or if a run is at the path; OSError if it cannot be written.
    """
    path = Path(path)
    check_is_no_run(path)
    names = sorted(result.channels, key=lambda name: name != "time")  # which is first in a new run only
    columns = {f"{name} [{result.unit(name) or '1'}]": result[name] for name in names}
    records = sampling.records(result.time)
    with whole_file(path) as temporary, temporary.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        for start in range(0, len(records), AT_ONCE):
            chosen = records[start : start + AT_ONCE]
            writer.writerows(zip(*(column[chosen].tolist() for column in columns.values()), strict=True))
            progress(min(1.0, (start + AT_ONCE) / len(records)))
    return (path,)


def to_hdf5(result: Result, path: str | Path, sampling: Sampling = TABLES) -> tuple[Path, ...]:
    """All channels as plain HDF5, for MATLAB, Octave, h5py and others.

        /channels/NAME      doubles, with the attributes unit and meaning (text of fixed length)
        /onsets/PIN/...     time, speed, separation_time, separation_velocity of every contact, likewise
        /json/...           scenario, provenance, counts, impulses as JSON text

    In MATLAB: `h5read(path, "/channels/pin.rear_base.force")`, `h5readatt(path, "/channels/tip.x", "unit")`.
    It is not the file of a run, which `Result.save` writes and only `Result.load` reads.

    Arguments are those of `to_vtu`; all records if nothing else is asked for; onsets are always all.
    Returns the path.

    Raises InputError if no record is chosen, or if a run is at the path; OSError if it cannot be written.
    """
    path, records = Path(path), sampling.records(result.time)
    check_is_no_run(path)
    with whole_file(path) as temporary, h5py.File(temporary, "w") as file:
        _set_text(file, "format", EXPORTED)
        for name, channel in result.channels.items():
            _put(file, f"channels/{name}", channel.values[records], channel.unit, channel.meaning)
        for pin, onsets in result.onsets.items():
            columns = np.array(onsets, dtype=np.float64).reshape(-1, len(Onset._fields)).T
            for field, values in zip(Onset._fields, columns, strict=True):
                _put(file, f"onsets/{pin}/{field}", values, *ONSET_COLUMNS[field])
            file.require_group(f"onsets/{pin}").attrs["largest_force_N"] = result.largest_force[pin]
        told = {
            "scenario": result.scenario.to_data(),
            "provenance": dict(result.provenance),
            "counts": asdict(result.counts),
            "impulses": [asdict(impulse) for impulse in result.impulses],
        }
        for name, said in told.items():
            text = json.dumps(said)  # in ASCII
            file.create_dataset(f"json/{name}", data=np.bytes_(text.encode("ascii")))
    return (path,)


def _put(group: h5py.Group, name: str, values: np.ndarray, unit: str, meaning: str) -> None:
    data = group.create_dataset(name, data=np.ascontiguousarray(values, dtype=np.float64))
    _set_text(data, "unit", unit or "1")
    _set_text(data, "meaning", meaning)


def _set_text(where: Any, name: str, text: str) -> None:
    """An attribute of fixed length, which all readers know."""
    data = text.encode("utf-8")
    encoding = "ascii" if text.isascii() else "utf-8"
    where.attrs.create(name, np.array(data), dtype=h5py.string_dtype(encoding, max(1, len(data))))
