"""What was found out about a scene, kept as a file as soon as it is known: a study that was killed goes on.

A row is known by the inputs of its scene, by the program that runs it, and by the source of what looks at it.
"""

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path
from types import ModuleType

from support_exudyn import Scenario
from support_exudyn.files.whole_file import whole_file
from support_exudyn.sweeps.key import key


def row_file(folder: Path, scene: Scenario, module: ModuleType) -> Path:
    """The file of a scene's row in a folder; module: what finds it out."""
    source = Path(module.__file__ or "").read_bytes()
    known = hashlib.sha256(key(scene, errors=True).encode() + source).hexdigest()
    return folder / f"{known[:32]}.json"


def read_row(path: Path) -> dict[str, object] | None:
    """The row of a file; None if it is not there, or not whole."""
    try:
        digest, _, text = path.read_text(encoding="utf-8").partition("\n")
    except (OSError, UnicodeDecodeError):
        return None
    if digest != _digest(text):
        return None
    found: dict[str, object] = json.loads(text)
    return found


def write_row(path: Path, row: Mapping[str, object]) -> None:
    """Write a row, whole or not at all. Raises OSError if it cannot be written."""
    text = json.dumps(row)
    with whole_file(path) as temporary:
        temporary.write_text(f"{_digest(text)}\n{text}", encoding="utf-8")


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()
