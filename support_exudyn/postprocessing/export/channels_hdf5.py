"""All channels as plain HDF5 that MATLAB, Octave and h5py read without knowing this program."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from support_exudyn.files.whole_file import whole_file
from support_exudyn.mechanics.contact_state import Onset
from support_exudyn.postprocessing.export.whole_set import check_is_no_run
from support_exudyn.simulation.result import Result

FORMAT = "support_exudyn channels 1"
ONSET_COLUMNS = {  # field of an onset: unit, meaning
    "time": ("s", "beginning of the contact"),
    "speed": ("m/s", "approach speed at zero depth"),
    "parting_time": ("s", "end of the contact; infinite: not before the end of the run or the next touch"),
    "parting_speed": ("m/s", "speed of parting at zero depth"),
}


def write_channels(result: Result, path: Path, records: Sequence[int]) -> None:
    """Write the file; see `postprocessing.export.export.to_hdf5` for what is in it."""
    check_is_no_run(path)
    # made in memory: on a full disk HDF5 would end the whole process
    with h5py.File("channels", "w", driver="core", backing_store=False) as file:
        _set_text(file, "format", FORMAT)
        for name, channel in result.channels.items():
            _put(file, f"channels/{name}", channel.values[list(records)], channel.unit, channel.meaning)
        for pin, onsets in result.onsets.items():
            _put_onsets(file.create_group(f"onsets/{pin}"), onsets, result.largest_force[pin])
        for name, said in _texts(result).items():
            text = json.dumps(said)  # in ASCII
            file.create_dataset(f"json/{name}", data=np.bytes_(text.encode("ascii")))
        file.flush()
        image = file.id.get_file_image()
    with whole_file(path) as temporary:
        temporary.write_bytes(image)


def _texts(result: Result) -> Mapping[str, Any]:
    """What else is known of a run, by name."""
    return {
        "scenario": result.scenario.to_data(),
        "provenance": dict(result.provenance),
        "counts": asdict(result.counts),
        "impulses": [asdict(impulse) for impulse in result.impulses],
    }


def _put_onsets(group: h5py.Group, onsets: Sequence[Onset], largest_force: float) -> None:
    columns = np.array(onsets, dtype=np.float64).reshape(-1, len(Onset._fields)).T
    for field, values in zip(Onset._fields, columns, strict=True):
        _put(group, field, values, *ONSET_COLUMNS[field])
    group.attrs["largest_force_N"] = largest_force


def _put(group: h5py.Group, name: str, values: np.ndarray, unit: str, meaning: str) -> None:
    data = group.create_dataset(name, data=np.ascontiguousarray(values, dtype=np.float64))
    _set_text(data, "unit", unit or "1")
    _set_text(data, "meaning", meaning)


def _set_text(where: Any, name: str, text: str) -> None:
    """An attribute of fixed length, which all readers know."""
    data = text.encode("utf-8")
    encoding = "ascii" if text.isascii() else "utf-8"
    where.attrs.create(name, np.array(data), dtype=h5py.string_dtype(encoding, max(1, len(data))))
