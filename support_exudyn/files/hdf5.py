"""Files that say of themselves whether they are as they were written.

An HDF5 file may begin with a block of the user's own, which everything that reads HDF5 passes over. Here it
holds the format and the SHA-256 digest of all that follows. It is looked at before HDF5 is: that ends the whole
process on some damaged files, and on others gives other numbers.
"""

from __future__ import annotations

import hashlib

BLOCK = 512  # bytes; the smallest that HDF5 takes
HDF5 = b"\x89HDF\r\n\x1a\n"


def seal(image: bytes, kind: str) -> bytes:
    """The bytes of a file of this kind from those of an HDF5 file, without its block if it has one."""
    return _block(image, kind) + image


def check_seal(data: bytes, kind: str) -> None:
    """Raise ValueError if this is not what `seal` gave for this kind of file."""
    if data[:BLOCK] == _block(memoryview(data)[BLOCK:], kind):
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


def _block(image: bytes | memoryview, kind: str) -> bytes:
    digest = hashlib.sha256(image).hexdigest()
    return f"{kind}\nsha256 of all bytes from {BLOCK} on: {digest}\n".encode("ascii").ljust(BLOCK, b"\n")
