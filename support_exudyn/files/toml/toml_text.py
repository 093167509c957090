"""Tables as texts in TOML."""

from __future__ import annotations

import re
import textwrap
from typing import Any

from user_forces.values.value import InputError

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
    items = [item.strip() for item in found[1].splitlines()]
    line = "[" + " ".join(items).removesuffix(",") + "]"
    if len(line) < LINE // 2:
        return line
    if any(item.startswith('"') for item in items):
        return found[0]
    return "[\n" + textwrap.fill(" ".join(items), LINE, initial_indent=INDENT, subsequent_indent=INDENT) + "\n]"
