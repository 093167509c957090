"""Data of studies that lie beside their modules as TOML."""

import sys
from importlib.resources import files
from typing import Any

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib


def rows(package: str, name: str) -> list[dict[str, Any]]:
    """The entries [[NAME]] of the file NAMEs.toml in a package, as written."""
    text = files(package).joinpath(f"{name}s.toml").read_text(encoding="utf-8")
    found: list[dict[str, Any]] = tomllib.loads(text)[name]
    return found
