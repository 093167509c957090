"""HDF5 files with a checksum, made in memory.

A file may begin with a user block, which everything that reads HDF5 skips. Here it holds the format and the
SHA-256 digest of all bytes after it. The digest is compared before HDF5 reads the file: HDF5 ends the whole
process on some damaged files, and reads wrong numbers from others.
"""

from __future__ import annotations

import hashlib
import secrets
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import h5py
import numpy as np
from h5py import h5a, h5d, h5s, h5t

from user_forces.values.value import cleaned, short

BLOCK = 512  # bytes; the smallest that HDF5 takes
HDF5 = b"\x89HDF\r\n\x1a\n"
TEXT = h5py.string_dtype()
IN_FILE, IN_MEMORY = h5t.py_create(TEXT, logical=True), h5t.py_create(TEXT)


def with_checksum(image: bytes, kind: str) -> bytes:
    """The bytes of a file of this kind from those of an HDF5 file, without its block if it has one."""
    return checksum_block(image, kind) + image


def check_checksum(data: bytes, kind: str) -> None:
    """Raise ValueError if this is not what `with_checksum` gave for this kind of file."""
    if data[:BLOCK] == checksum_block(memoryview(data)[BLOCK:], kind):
        return
    family = kind.rpartition(" ")[0].encode()
    first = data[:BLOCK].partition(b"\n")[0]
    if data.startswith(HDF5):
        raise ValueError(f"an HDF5 file without a digest, as no version from {kind!r} on writes it")
    if first == kind.encode():
        raise ValueError("what is in it does not fit its digest: it was cut off or changed")
    if first.startswith(family):
        raise ValueError(f"format is {first.decode('ascii', 'replace')!r}, expected {kind!r}")
    raise ValueError(f"does not begin with {kind!r}")


def checksum_block(image: bytes | bytearray | memoryview, kind: str) -> bytes:
    """What a file of this kind begins with, from the bytes that follow it."""
    digest = hashlib.sha256(image).hexdigest()
    return f"{kind}\nsha256 of all bytes from {BLOCK} on: {digest}\n".encode("ascii").ljust(BLOCK, b"\n")


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


def series_in(group: h5py.Group) -> dict[str, Series]:
    """All data sets of a group by name. Raises ValueError for what is no data set of numbers."""
    for name, data in group.items():
        if not isinstance(data, h5py.Dataset) or data.dtype.kind not in "fiu":
            raise ValueError(f"{short(name)} is no data set of numbers")
    return {name: Series(data[()], dict(data.attrs)) for name, data in group.items()}


def write_texts(place: h5py.Group | h5py.Dataset, texts: Mapping[str, str]) -> None:
    """Write texts as attributes; by h5py's low-level calls, its own way takes four times as long."""
    _write_texts(place.id, texts)


def _write_texts(place: Any, texts: Mapping[str, str]) -> None:
    scalar = h5s.create(h5s.SCALAR)
    for key, text in texts.items():
        attribute = h5a.create(place, key.encode(), IN_FILE, scalar)
        attribute.write(np.array(text, dtype=TEXT), mtype=IN_MEMORY)


def file_image(
    series: Mapping[str, tuple[np.ndarray, Mapping[str, str]]], write: Callable[[h5py.File], None]
) -> bytearray:
    """The bytes of a file, without its block, made in memory: on a full disk HDF5 would end the whole process.

    Arguments:
        series: values (n,) of float64 by the paths of their data sets, each with texts that are its attributes.
        write: writes all else into the file, in which these data sets are already.
    """
    name = secrets.token_hex(8)  # HDF5 tells open files in memory apart by their names
    with h5py.File(name, "w", driver="core", backing_store=False, userblock_size=BLOCK) as file:
        for path, (values, texts) in series.items():
            group, _, own = path.rpartition("/")
            space = h5s.create_simple(values.shape)
            data = h5d.create(file.require_group(group or "/").id, own.encode(), h5t.IEEE_F64LE, space)
            data.write(h5s.ALL, h5s.ALL, np.ascontiguousarray(values, np.float64))
            _write_texts(data, texts)
        write(file)
        file.flush()
        return bytearray(file.id.get_file_image())
