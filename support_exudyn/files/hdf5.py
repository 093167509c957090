"""HDF5 files: checksummed, and written in little time.

A file may begin with a user block, which everything that reads HDF5 skips. Here it holds the format and the
SHA-256 digest of all bytes after it. The digest is compared before HDF5 reads the file: HDF5 ends the whole
process on some damaged files, and reads wrong numbers from others.
"""

from __future__ import annotations

import hashlib
import threading
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import h5py
import numpy as np
from h5py import h5a, h5d, h5f, h5p, h5s, h5t

from user_forces.values.value import cleaned, short

BLOCK = 512  # bytes; the smallest that HDF5 takes
READ_AND_WRITE = 1  # a file that is given as its bytes
ALONE = threading.Lock()  # HDF5 knows files in memory by their names
TEMPLATES, LARGE = 4, 2**24  # of files that are kept, and bytes from which none is
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
    _write_texts(place.id, texts.items())


def _write_texts(place: Any, texts: Iterable[tuple[str, str]]) -> None:
    scalar = h5s.create(h5s.SCALAR)
    for key, text in texts:
        attribute = h5a.create(place, key.encode(), IN_FILE, scalar)
        attribute.write(np.array(text, dtype=TEXT), mtype=IN_MEMORY)


# a data set: path, number of values, texts by name
Outline = tuple[tuple[str, int, tuple[tuple[str, str], ...]], ...]


def file_image(
    series: Mapping[str, tuple[np.ndarray, Mapping[str, str]]], write: Callable[[h5py.File], None]
) -> bytearray:
    """The bytes of a file in memory: on a full disk HDF5 would end the whole process.

    Runs are alike in all but their numbers: a file without numbers is kept, and copied. Numbers are put where
    the library says that they lie. That takes a tenth of the time of making many small data sets.

    Arguments:
        series: values (n,) of float64 by the paths of their data sets, each with texts that are its attributes.
        write: writes all else into the file, in which there are these data sets already, without numbers.
    """
    outline = tuple((path, one.size, tuple(texts.items())) for path, (one, texts) in series.items())
    large = sum(one.nbytes for one, _ in series.values()) > LARGE
    with ALONE:
        template, places = (_without_numbers.__wrapped__ if large else _without_numbers)(outline)
        with h5py.File(h5f.open_file_image(template, READ_AND_WRITE)) as file:
            write(file)
            file.flush()
            image = bytearray(file.id.get_file_image())
    for place, (values, _) in zip(places, series.values(), strict=True):
        np.frombuffer(image, "<f8", values.size, place)[:] = values
    return image


@lru_cache(maxsize=TEMPLATES)
def _without_numbers(outline: Outline) -> tuple[bytes, list[int]]:
    """The bytes of a file with these data sets, and where the values of each are to be."""
    creation = h5p.create(h5p.FILE_CREATE)
    creation.set_userblock(BLOCK)
    at_once = h5p.create(h5p.DATASET_CREATE)
    at_once.set_alloc_time(h5d.ALLOC_TIME_EARLY)
    at_once.set_fill_time(h5d.FILL_TIME_NEVER)
    access = h5p.create(h5p.FILE_ACCESS)
    access.set_fapl_core(sum(8 * count for _, count, _ in outline) + BLOCK, backing_store=False)
    with h5py.File(h5f.create(b"without numbers", h5f.ACC_TRUNC, creation, access)) as file:
        places = []
        for path, count, texts in outline:
            file.require_group(path.rpartition("/")[0] or "/")
            space = h5s.create_simple((count,))
            data = h5d.create(file.id, path.encode(), h5t.IEEE_F64LE, space, at_once)
            _write_texts(data, texts)
            places.append(data.get_offset() - BLOCK)  # which an image has not
        file.flush()
        return file.id.get_file_image(), places
