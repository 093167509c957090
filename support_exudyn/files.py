"""Files that are written whole or not at all."""

from __future__ import annotations

import os
import re
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def whole_file(path: str | Path) -> Iterator[Path]:
    """A temporary path beside `path` to write to; it takes the place of `path` if nothing goes wrong.

    Missing folders are made. After an error or an interruption `path` is as it was before; of a process that is
    killed a temporary file stays, see `remove_leftovers`.
    """
    path = Path(path)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(
            prefix=f".{path.stem}-{os.getpid()}-", suffix=path.suffix, dir=path.parent
        )
    except OSError as error:  # of a name that nobody has given
        raise type(error)(error.errno, f"{error.strerror}; it cannot be written here", str(path)) from None
    os.close(handle)
    temporary = Path(name)
    try:
        yield temporary
        temporary.chmod(0o666 & ~_umask())
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


LEFTOVER = re.compile(r"\..+-(\d+)-\w+(\.\w+)?")  # name of a temporary file, with the process that made it


def remove_leftovers(folder: Path) -> None:
    """Remove temporary files of `whole_file` in a folder whose process is gone."""
    for path in list(folder.iterdir()):
        found = LEFTOVER.fullmatch(path.name)
        if found and not _is_alive(int(found.group(1))):
            path.unlink(missing_ok=True)


def _is_alive(process: int) -> bool:
    """Whether a process runs; yes where that cannot be asked without harm."""
    if os.name != "posix":
        return True
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except OSError:
        pass
    return not _has_ended(process)


def _has_ended(process: int) -> bool:
    """Whether a process has ended, though nobody has waited for it; no where the system does not tell."""
    try:
        text = Path(f"/proc/{process}/stat").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return False
    return text.rpartition(")")[2].split()[:1] in (["Z"], ["X"])  # the name before it may hold anything


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
