"""TOML as text and as tables; numbers with a point are decimals, so that units round them once."""

from __future__ import annotations

import re
import sys
from decimal import Decimal, InvalidOperation
from pathlib import Path
from typing import Any

from user_forces.values import DEEPEST, InputError

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

LARGEST_FILE = 50_000_000  # bytes
TOO_DEEP = f"is nested too deep; allowed: {DEEPEST} levels"
LIST = re.compile(r"\[\n((?:\s+[^\[\]{}\n]+,\n)+)\s*\]")  # of numbers or texts, one a line
LINE = 112


def load_toml(path: str | Path) -> dict[str, Any]:
    """The table of a TOML file; its numbers with a point or an exponent are of type Decimal.

    Raises InputError, with file and line, if the file is no TOML; OSError if it cannot be read.
    """
    path = Path(path)
    if "\0" in str(path):
        raise InputError(f"{path!s:.80}: allowed: a name that a file can have")
    if path.stat().st_size > LARGEST_FILE:
        raise InputError(f"{path}: has more than {LARGEST_FILE} bytes; allowed: a text that people write")
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: byte {error.start} is not UTF-8; allowed: text in UTF-8") from None
    return parsed(text, str(path))


def parsed(text: str, where: str) -> dict[str, Any]:
    """The table of a text in TOML, as `load_toml` gives it; `where` is what errors call it."""
    try:
        table = tomllib.loads(text, parse_float=_decimal)
    except RecursionError:
        raise InputError(f"{where}: {TOO_DEEP}") from None
    except ValueError as error:  # of TOML, or of a whole number with thousands of digits
        raise InputError(f"{where}: {error}; allowed: TOML") from None
    _check_depth(table, where)
    return table


def _decimal(text: str) -> Decimal:
    try:
        return Decimal(text.replace("_", ""))
    except InvalidOperation:  # an exponent of 20 digits
        raise ValueError(f"{text[:40]} is no number that can be read") from None


def _check_depth(table: dict[str, Any], where: str) -> None:
    """Raise InputError if tables lie in tables too deep; keys with many dots make them without brackets."""
    level: list[Any] = [table]
    for _ in range(DEEPEST):
        inside = [item.values() if isinstance(item, dict) else item for item in level]
        level = [item for items in inside for item in items if isinstance(item, (dict, list))]
        if not level:
            return
    raise InputError(f"{where}: {TOO_DEEP}")


def toml_text(table: dict[str, Any]) -> str:
    """A table as TOML. Raises InputError if a text in it cannot be written in UTF-8."""
    import tomli_w

    text = LIST.sub(_in_a_line, tomli_w.dumps(table))
    try:
        text.encode("utf-8")
    except UnicodeEncodeError as error:
        raise InputError(f"{error.object[error.start]!r}: allowed in texts: what UTF-8 can write") from None
    return text


def _in_a_line(found: re.Match[str]) -> str:
    """A list as it is written where it fits into a line."""
    line = "[" + ", ".join(item.strip().removesuffix(",") for item in found[1].splitlines()) + "]"
    return line if len(line) < LINE // 2 else found[0]
