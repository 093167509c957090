"""Temporary folders of our own: what a killed process leaves is known for ours, and nothing else is removed."""

import os
import shutil
import stat
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

try:
    import fcntl as _fcntl
except ImportError:  # Windows
    _fcntl = None  # type: ignore[assignment]

fcntl: Any = _fcntl
PREFIX = ".support_exudyn-"
OWNER = ".owner-of-this-folder"
MARK = b"Made by support_exudyn: this folder and all in it may be removed when no process holds this file.\n"


@contextmanager
def workshop(parent: Path) -> Iterator[Path]:
    """A new folder below `parent`, gone with all that is in it after the block.

    It says in a file whose it is; that file is locked until the block ends, however the process ends. Raises
    OSError if it cannot be made.
    """
    while True:
        folder = Path(tempfile.mkdtemp(prefix=PREFIX, dir=parent))
        handle = -1
        try:
            try:
                handle = os.open(folder / OWNER, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o666)
            except FileNotFoundError:  # another process took it for one left behind
                continue
            if fcntl is not None:
                with suppress(OSError):  # a disk without locks: what is left there is never known to be left
                    fcntl.flock(handle, fcntl.LOCK_EX)
            os.write(handle, MARK)  # now that it is locked
            if not (folder / OWNER).exists():  # as above, between the two
                continue
            yield folder
            return
        finally:
            shutil.rmtree(folder, ignore_errors=True)
            if handle >= 0:
                os.close(handle)
            shutil.rmtree(folder, ignore_errors=True)  # Windows and network disks keep files that are open


def remove_leftovers(folder: Path, below: bool = False) -> None:
    """Remove folders of `workshop` that no process holds any more, in a folder, or in all below it too.

    A name alone proves nothing: what is removed has the file that says whose it is, to the letter, or nothing
    in it, as of a process that was killed while it made or removed the folder.
    """
    for path in list((folder.rglob if below else folder.glob)(f"{PREFIX}*")):
        if fcntl is not None and path.is_dir() and not path.is_symlink():
            _remove_if_left(path)


def _remove_if_left(folder: Path) -> None:
    try:
        handle = os.open(folder / OWNER, os.O_RDWR | os.O_NOFOLLOW | os.O_NONBLOCK)
    except FileNotFoundError:
        with suppress(OSError):  # it is not empty
            folder.rmdir()
        return
    except OSError:  # nobody has said that it is ours
        return
    try:
        if not stat.S_ISREG(os.fstat(handle).st_mode):
            return
        said = os.read(handle, len(MARK) + 1)
        if said == MARK or (not said and list(folder.iterdir()) == [folder / OWNER]):
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
            shutil.rmtree(folder, ignore_errors=True)
    except OSError:  # it is held, or the disk has no locks
        pass
    finally:
        os.close(handle)
