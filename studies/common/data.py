"""Data of studies that lie beside their modules as TOML."""

import sys
from collections.abc import Callable
from importlib.resources import files
from typing import Any

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib


def tables(package: str, file: str, parse_float: Callable[[str], Any] = float) -> dict[str, Any]:
    """The tables of a TOML file in a package, as written; parse_float: the reader of its numbers."""
    text = files(package).joinpath(file).read_text(encoding="utf-8")
    return tomllib.loads(text, parse_float=parse_float)
