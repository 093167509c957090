"""Reading HDF5 of somebody else's: nothing that stands in other files, and no more than there is.

A group of HDF5 may lead elsewhere, to another file or round in a circle; a data set may be the bytes of any
file of this machine, or be of a size that no machine has, for what was never written takes no room.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

import h5py
import numpy as np

from user_forces.values.value import cleaned, short


@dataclass(frozen=True)
class Series:
    """A data set that has been read: its values, and what is said of it."""

    values: np.ndarray
    attributes: dict[str, Any]

    def text(self, name: str) -> str:
        """An attribute that is text. Raises ValueError if it is none."""
        found = self.attributes[name]
        if not isinstance(found, str):
            raise ValueError(f"attribute {name!r} is {short(found)}; allowed: text")
        return cleaned(found)


class Inside:
    """A group in a file.

    Arguments:
        group: open for reading.
        room: bytes of the file; all that is read of it together is no more.
    """

    def __init__(self, group: h5py.Group, room: int) -> None:
        self._group = group
        self._room = [room]  # what is left of it, shared by all groups

    def __contains__(self, name: str) -> bool:
        return name in self._group

    @property
    def attributes(self) -> Any:
        """Of the group."""
        return self._group.attrs

    def data(self, name: str) -> Any:
        """An attribute in JSON."""
        return json.loads(self._group.attrs[name])

    def inside(self, name: str) -> Inside:
        """A group in it. Raises ValueError unless it lies there itself."""
        self._check(name)
        if not isinstance(found := self._group[name], h5py.Group):
            raise ValueError(f"{name!r} is no group")
        below = Inside(found, 0)
        below._room = self._room
        below._take(1, name)  # so that no circle is gone round for ever
        return below

    def series(self) -> dict[str, Series]:
        """All data sets in it. Raises ValueError unless each lies there itself, whole and as it is written."""
        return {name: self._series(name) for name in self._group}

    def _series(self, name: str) -> Series:
        self._check(name)
        data = self._group[name]
        if not isinstance(data, h5py.Dataset):
            raise ValueError(f"{short(name)} is no data set")
        if data.external or data.is_virtual:
            raise ValueError(f"{short(name)} is kept in another file; allowed: in this one")
        if data.chunks is not None or data.dtype.kind not in "fiu":
            raise ValueError(
                f"{short(name)} is compressed, in pieces or no numbers; allowed: numbers in one piece"
            )
        size = int(np.prod(data.shape, dtype=object)) * data.dtype.itemsize
        if size != data.id.get_storage_size():
            raise ValueError(f"{short(name)} is of {size} bytes, of which not all are there")
        self._take(size, name)
        return Series(data[()], dict(data.attrs))

    def _check(self, name: str) -> None:
        link = self._group.get(name, getlink=True)
        if not isinstance(link, h5py.HardLink):
            raise ValueError(f"{short(name)} is a link that leads elsewhere; allowed: what the file itself has")

    def _take(self, size: int, name: str) -> None:
        self._room[0] -= size
        if self._room[0] < 0:
            raise ValueError(f"{short(name)}: says that there is more than the file has")
