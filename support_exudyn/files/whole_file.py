"""Files that are written whole or not at all, and folders that one process at a time writes to."""

import errno
import os
import secrets
import shutil
import stat
import tempfile
import time
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from difflib import get_close_matches
from pathlib import Path

from filelock import FileLock, Timeout

from user_forces.values.value import InputError, cleaned

PREFIX = ".support_exudyn-"  # of temporary files and folders
LOCK = ".support_exudyn.lock"
DAY = 86400.0  # [s]
REFUSED = "it cannot be written"
LETTERS = 80  # of a name that are compared and shown


@contextmanager
def whole_file(path: str | Path, within: Path | None = None, lasting: bool = True) -> Iterator[Path]:
    """A temporary path to write to; it takes the place of `path` if nothing goes wrong.

    Missing folders are made. A link stays, and the file that it points to is written. After an error or an
    interruption `path` is as it was before; of a process that is killed the temporary file stays.

    Arguments:
        path: of the file.
        within: a folder on the same disk for the temporary file; None: that of the file.
        lasting: whether to wait until the file is on the disk, so that it is whole after a power cut too.

    Raises OSError that names `path` if it cannot be written: before the block where that can be known, after it
    otherwise (a full disk).
    """
    real = writable(path)
    temporary = (within or real.parent) / f"{PREFIX}{secrets.token_hex(4)}{real.suffix}"
    try:
        real.parent.mkdir(parents=True, exist_ok=True)
        temporary.touch()
    except OSError as error:  # of a name that nobody has given
        raise named(error, path) from None
    try:
        yield temporary
        if lasting:
            write_through(temporary)
        temporary.replace(real)
    except OSError as error:
        if error.errno is None or error.filename not in (None, str(temporary), temporary):
            raise  # of something else
        raise named(error, path) from error
    finally:
        temporary.unlink(missing_ok=True)


def writable(path: str | Path) -> Path:
    """The file that a path leads to, links followed.

    Raises OSError that names the path where opening for writing would; replacing a file asks for the folder's
    permissions only.
    """
    real = Path(os.path.realpath(path))
    try:
        mode = real.stat().st_mode
        if stat.S_ISDIR(mode):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
        if not stat.S_ISREG(mode):
            raise OSError(errno.EINVAL, "Not a regular file")
        if not os.access(real, os.W_OK):
            raise PermissionError(errno.EACCES, "The file is read-only")
    except FileNotFoundError:
        return real
    except OSError as error:
        raise named(error, path) from None
    return real


def contents(path: str | Path, most: int) -> bytes:
    """All bytes of a file.

    Raises OSError if it cannot be read; InputError if it is no regular file (a pipe, a device), or has more
    than `most` bytes: all that is read of others' files is read here, so that nothing of them has no end.
    """
    check_is_file(path, most)
    with Path(path).open("rb") as file:
        data = file.read(most + 1)  # it may grow, and some have no size
    if len(data) > most:
        raise InputError(f"{path}: has more than {most} bytes; allowed: as many")
    return data


def check_is_file(path: str | Path, most: int) -> None:
    """Raise as `contents` does: before something is opened, for opening a pipe may take for ever."""
    status = Path(path).stat()
    if stat.S_ISDIR(status.st_mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
    if not stat.S_ISREG(status.st_mode):
        raise InputError(f"{path}: is no regular file; allowed: files")
    if status.st_size > most:
        raise InputError(f"{path}: has more than {most} bytes, {status.st_size}; allowed: as many")


def missing_file(path: str | Path, allowed: str, names: Collection[str] = ()) -> FileNotFoundError:
    """What is raised of a file that is not there: the folder, names that look like it, and what is allowed.

    Arguments:
        path: that was given.
        allowed: what could have been given.
        names: that could have been given instead of a path.
    """
    path = Path(path)
    there = path.parent.iterdir() if path.parent.is_dir() else ()
    others = [other.name for other in there if other.suffix == path.suffix or not path.suffix]
    near = get_close_matches(path.name[:LETTERS], [*names, *others], 1)
    guess = f"; did you mean {near[0]!r}?" if near else ""
    folder = "" if path.parent.is_dir() else f", nor a folder {str(path.parent)!r:.{LETTERS}}"
    sentence = f"no such file{folder}; allowed: {allowed}{guess}"
    return FileNotFoundError(errno.ENOENT, cleaned(sentence), str(path))


def named(error: OSError, path: str | Path) -> OSError:
    """The error with the name that was given."""
    return type(error)(error.errno, f"{error.strerror}; {REFUSED}", str(path))


def write_through(path: Path) -> None:
    """Wait until a file is on the disk. Otherwise its new name might get there first."""
    with path.open("rb+") as file:
        os.fsync(file.fileno())


@contextmanager
def writing_alone(folder: Path) -> Iterator[None]:
    """Keep other processes that ask for it, too, from a folder while the block runs.

    The lock ends with the process, however it ends.

    Raises OSError that names the folder if another process is writing there.
    """
    lock = FileLock(folder / LOCK, timeout=0)
    try:
        lock.acquire()
    except Timeout:
        raise BlockingIOError(
            errno.EWOULDBLOCK,
            "another process is writing there; wait, or choose another folder",
            str(folder),
        ) from None
    try:
        yield
    finally:
        (folder / LOCK).unlink(missing_ok=True)
        lock.release()


@contextmanager
def workshop(parent: Path) -> Iterator[Path]:
    """A new temporary folder below `parent`, removed with all that is in it after the block.

    Raises OSError if it cannot be made.
    """
    folder = Path(tempfile.mkdtemp(prefix=PREFIX, dir=parent))
    try:
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def remove_leftovers(folder: Path, below: bool = False, older: float = DAY) -> None:
    """Remove the temporary files and folders that killed processes left behind.

    Arguments:
        folder: where they are.
        below: whether they are removed in all folders below it, too.
        older: time since their last change [s]; 0 if the caller alone writes to the folder.
    """
    now = time.time()
    for path in list((folder.rglob if below else folder.glob)(f"{PREFIX}*")):
        if path.is_symlink() or not path.exists() or now - path.stat().st_mtime < older:
            continue
        if path.is_dir():
            shutil.rmtree(path, ignore_errors=True)
        else:
            path.unlink(missing_ok=True)
