"""Files that are written whole or not at all, and folders that one process at a time writes to."""

from __future__ import annotations

import errno
import os
import re
import stat
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

try:
    import fcntl as _fcntl
except ImportError:  # Windows
    _fcntl = None  # type: ignore[assignment]

fcntl: Any = _fcntl
LONGEST_STEM = 40  # characters of a name that its temporary file shares: with all of them it might be too long
LOCK = ".lock"
REFUSED = "it cannot be written"


@contextmanager
def whole_file(path: str | Path) -> Iterator[Path]:
    """A temporary path beside `path` to write to; it takes the place of `path` if nothing goes wrong.

    Missing folders are made. A link stays, and the file that it points to is written. What is written is on the
    disk before it takes its place, so that `path` is whole after a power cut too. After an error or an
    interruption `path` is as it was before; of a process that is killed a temporary file stays, see
    `remove_leftovers`.

    Raises OSError that names `path` if it cannot be written: before the block where that can be known, after it
    otherwise (a full disk).
    """
    try:
        real = real_path(path)
        real.parent.mkdir(parents=True, exist_ok=True)
        check_may_be_replaced(real)
        handle, name = tempfile.mkstemp(
            prefix=f".{real.stem[:LONGEST_STEM]}-{os.getpid()}-", suffix=real.suffix, dir=real.parent
        )
    except FileExistsError:
        raise named(NotADirectoryError(errno.ENOTDIR, "A file stands where a folder should be"), path) from None
    except OSError as error:  # of a name that nobody has given
        raise named(error, path) from None
    os.close(handle)
    temporary = Path(name)
    try:
        yield temporary
        temporary.chmod(0o666 & ~_umask())
        write_through(temporary)
        temporary.replace(real)
    except OSError as error:
        if error.errno is None or error.filename not in (None, name, temporary):
            raise  # of something else
        raise named(error, path) from error
    finally:
        temporary.unlink(missing_ok=True)


def real_path(path: str | Path) -> Path:
    """Where a path leads, links followed."""
    if "\0" in str(path):
        raise OSError(errno.EINVAL, "a name cannot hold a NUL")
    real = os.path.realpath(path)
    if os.path.islink(real):  # noqa: PTH114
        raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))
    return Path(real)


def check_may_be_replaced(path: Path) -> None:
    """As opening it for writing would be refused; replacing asks only whether the folder may be written to."""
    try:
        mode = path.stat().st_mode
    except FileNotFoundError:
        return
    if stat.S_ISDIR(mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    if not stat.S_ISREG(mode):
        raise OSError(errno.EINVAL, "Not a regular file")
    if not os.access(path, os.W_OK):
        raise PermissionError(errno.EACCES, "The file is read-only")


def named(error: OSError, path: str | Path) -> OSError:
    """The same error, of the name that was given."""
    return type(error)(error.errno, f"{error.strerror}; {REFUSED}", str(path))


def write_through(path: Path) -> None:
    """Wait until a file is on the disk. Otherwise its new name might get there first."""
    handle = os.open(path, os.O_RDWR)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


LEFTOVER = re.compile(r"\..+-(\d+)-\w+(\.\w+)?")  # name of a temporary file, with the process that made it


def remove_leftovers(folder: Path, below: bool = False) -> None:
    """Remove temporary files of `whole_file` whose process is gone, in a folder, or in all below it too."""
    for path in list(folder.rglob(".*") if below else folder.iterdir()):
        found = LEFTOVER.fullmatch(path.name)
        if found and not is_alive(int(found.group(1))):
            path.unlink(missing_ok=True)


@contextmanager
def writing_alone(folder: Path) -> Iterator[None]:
    """Keep other processes that ask for it, too, from a folder while the block runs.

    The lock ends with the process, however it ends. Where the system has no such lock (Windows, some network
    disks) nobody is kept out.

    Raises OSError that names the process which is writing there.
    """
    if fcntl is None:
        yield
        return
    path = folder / LOCK
    while True:
        handle = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
            if _is_open(path, handle):
                break
        except BlockingIOError:
            owner = os.read(handle, 32).decode("ascii", "replace").strip() or "starting"
            os.close(handle)
            raise BlockingIOError(
                errno.EWOULDBLOCK,
                f"another process ({owner}) is writing there; wait, or choose another folder",
                str(folder),
            ) from None
        except OSError as error:
            if error.errno not in (errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP):
                os.close(handle)
                raise
            break
        os.close(handle)  # it was removed by the one that had it
    try:
        os.ftruncate(handle, 0)
        os.write(handle, f"{os.getpid()}\n".encode())
        yield
    finally:
        path.unlink(missing_ok=True)
        os.close(handle)


def _is_open(path: Path, handle: int) -> bool:
    """Whether a path is the file that is open."""
    try:
        return os.path.samestat(path.stat(), os.fstat(handle))
    except FileNotFoundError:
        return False


def is_alive(process: int) -> bool:
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
