"""Files in memory: each has its own numbers."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np

from support_exudyn.files.hdf5 import BLOCK, check_checksum, file_image, with_checksum

KIND = "support_exudyn result 6"
TEXTS = {"unit": "m", "meaning": "of a body, größer"}


def read(path: Path, image: bytearray) -> dict[str, np.ndarray]:
    """All series of a file, which any program can read."""
    path.write_bytes(with_checksum(bytes(image), KIND))
    check_checksum(path.read_bytes(), KIND)
    found: dict[str, np.ndarray] = {}

    def note(name: str, item: object) -> None:
        if isinstance(item, h5py.Dataset):
            found[name] = item[()]

    with h5py.File(path) as file:
        assert file.userblock_size == BLOCK
        file.visititems(note)
        assert file["channels/a"].attrs["meaning"] == TEXTS["meaning"]
        assert file.attrs["of"] == "this"
    return found


def write(file: h5py.File) -> None:
    """What is no series."""
    file.attrs["of"] = "this"
    file["onsets/pin"] = np.arange(8.0).reshape(2, 4)


def test_each_file_has_its_own_numbers(tmp_path: Path) -> None:
    random = np.random.default_rng(1)
    images = []
    for count in (5, 5, 700, 5):
        table = random.random((count, 3))  # columns are not contiguous
        series = {
            "channels/a": (table[:, 0], TEXTS),
            "channels/tip.x": (table[:, 1], TEXTS),
            "coarser/coarser/channels/a": (random.random(2 * count), {}),
        }
        images.append(({name: values for name, (values, _) in series.items()}, file_image(series, write)))
    for series, image in images:
        found = read(tmp_path / "run.h5", image)
        assert np.array_equal(found.pop("onsets/pin"), np.arange(8.0).reshape(2, 4))
        assert found.keys() == series.keys()
        assert all(np.array_equal(found[name], series[name]) for name in series)
