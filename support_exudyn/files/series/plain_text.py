"""Text of files that others have written."""

from __future__ import annotations

import codecs
import io
from collections.abc import Iterator
from pathlib import Path

from support_exudyn.files.free_memory import available
from support_exudyn.files.whole_file import contents
from user_forces.values.value import InputError

SHARE = 12  # of the memory that is free, one part is for the file; the worst, "1;1;1", takes ten times itself
UTF_16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
ALLOWED = "text in UTF-8, UTF-16 or Windows-1252"


def text_of(path: Path) -> tuple[bytes, list[str]]:
    """The text of a file in UTF-8, its lines ended by line feeds, and what is told of it.

    Raises InputError for what is no text, or more than fits into memory; OSError if it cannot be read.
    """
    data, notes = contents(path, available() // SHARE), []
    if data.startswith(UTF_16):
        data = _decoded(path, data, "utf-16").encode()
    data = data.removeprefix(codecs.BOM_UTF8)
    if b"\0" in data:
        raise InputError(f"{path}: byte {data.index(0)} is 0, which no text has; allowed: {ALLOWED}")
    try:
        data.decode()
    except UnicodeDecodeError:
        data = _decoded(path, data, "cp1252").encode()
        notes.append("The text is not in UTF-8; it was read as Windows-1252.")
    if b"\r" in data:
        data = data.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    return data, notes


def _decoded(path: Path, data: bytes, encoding: str) -> str:
    try:
        return data.decode(encoding)
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: byte {error.start} is no text; allowed: {ALLOWED}") from None


def lines_of(data: bytes) -> Iterator[str]:
    """The lines of a text in UTF-8."""
    return (line.decode(errors="replace").rstrip("\n") for line in io.BytesIO(data))
