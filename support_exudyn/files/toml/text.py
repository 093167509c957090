"""TOML files and texts as tables, and back; numbers with a point are decimals, rounded once by their unit."""

import re
import sys
import textwrap
from decimal import Decimal, InvalidOperation
from pathlib import Path
from typing import Any

from support_exudyn.files.whole_file import contents
from user_forces.values.value import DEEPEST, InputError, short

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

LARGEST_FILE = 50_000_000  # bytes
TOO_DEEP = f"is nested too deep; allowed: {DEEPEST} levels"
PLACE = re.compile(r" \(at line (\d+), column \d+\)$")  # after what the library says
COMMA = re.compile(r"=\s*[-+]?\d+,\d+\s*(#.*)?$")  # a decimal comma


def load_toml(path: str | Path, named: bool = False) -> dict[str, Any]:
    """The table of a TOML file; its numbers with a point or an exponent are of type Decimal.

    named: another file names it. It may then be any file of this machine, whose lines are not repeated.

    Raises InputError, with file and line, if the file is no TOML; OSError if it cannot be read.
    """
    return parsed(text_of(Path(path)), str(path), named)


def text_of(path: Path) -> str:
    """The text of a file that people write. Raises InputError if it is none, OSError if it cannot be read."""
    if "\0" in str(path):
        raise InputError(f"{path!s:.80}: allowed: a name that a file can have")
    try:
        return contents(path, LARGEST_FILE).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: byte {error.start} is not UTF-8; allowed: text in UTF-8") from None


def parsed(text: str, where: str, named: bool = False) -> dict[str, Any]:
    """The table of a text in TOML, as `load_toml` gives it; `where` is what errors call it."""
    try:
        table = tomllib.loads(text, parse_float=_decimal)
    except RecursionError:
        raise InputError(f"{where}: {TOO_DEEP}") from None
    except ValueError as error:  # of TOML, or of a whole number with thousands of digits
        raise InputError(f"{where}: {_reason(str(error), text, named)}") from None
    _check_depth(table, where)
    return table


def _reason(said: str, text: str, named: bool) -> str:
    """The fault of a text, from what the library says: its line, what is wrong, what is allowed.

    named: the line by its number only.
    """
    lines = text.replace("\r\n", "\n").removesuffix("\n").split("\n")
    place = PLACE.search(said)
    number = int(place[1]) if place else len(lines)
    if named:
        return f"line {number}: is no TOML; allowed: TOML"
    line = lines[number - 1] if 0 < number <= len(lines) else ""
    comma = COMMA.search(line)
    allowed = "decimals after a point, as in 1.5" if comma else "TOML, with each key and each table once"
    return f"line {number}: {short(line.strip())}: {PLACE.sub('', said)}; allowed: {allowed}"


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


LIST = re.compile(r"\[\n((?:\s+[^\[\]{}\n]+,\n)+)\s*\]")  # of numbers or texts, one a line
LINE, INDENT = 112, "    "


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
    """A list as it is written where it fits into a line; of numbers, as many in a line as fit."""
    items = [item.strip() for item in found[1].split("\n")]
    line = "[" + " ".join(items).removesuffix(",") + "]"
    if len(line) < LINE // 2:
        return line
    if any(item.startswith('"') for item in items):
        return found[0]
    return "[\n" + textwrap.fill(" ".join(items), LINE, initial_indent=INDENT, subsequent_indent=INDENT) + "\n]"
