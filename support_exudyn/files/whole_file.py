"""Files that are written whole or not at all, and folders that one process at a time writes to."""

import errno
import os
import shutil
import stat
import tempfile
import time
from collections.abc import Collection, Iterator
from contextlib import ExitStack, contextmanager
from difflib import get_close_matches
from pathlib import Path

from filelock import FileLock, Timeout

from user_forces.values.value import InputError, cleaned

PREFIX = ".support_exudyn-"  # of temporary folders
LOCK = ".support_exudyn.lock"
DAY = 86400.0  # [s]
REFUSED = "it cannot be written"
LETTERS = 80  # of a name that are compared and shown


@contextmanager
def whole_file(path: str | Path, within: Path | None = None, lasting: bool = True) -> Iterator[Path]:
    """A temporary path beside `path` to write to; it takes the place of `path` if nothing goes wrong.

    Missing folders are made. A link stays, and the file that it points to is written. What is written is on the
    disk before it takes its place, so that `path` is whole after a power cut too. After an error or an
    interruption `path` is as it was before; of a process that is killed a folder stays, see `workshop`.

    Arguments:
        path: of the file.
        within: a folder of `workshop` on the same disk, for many files one after the other; None: one is made.
        lasting: whether it is waited until the file is on the disk. Otherwise a power cut may leave an empty or
            a cut one; for files that are known not to be whole, and can be made again.

    Raises OSError that names `path` if it cannot be written: before the block where that can be known, after it
    otherwise (a full disk).
    """
    with ExitStack() as held:
        try:
            real = real_path(path)
            real.parent.mkdir(parents=True, exist_ok=True)
            check_may_be_replaced(real)
            folder = within or held.enter_context(workshop(real.parent))
            temporary = folder / f"x{real.suffix}"  # never too long
            temporary.touch()
        except FileExistsError:
            raise named(
                NotADirectoryError(errno.ENOTDIR, "A file stands where a folder should be"), path
            ) from None
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


def real_path(path: str | Path) -> Path:
    """Where a path leads, links followed."""
    if "\0" in str(path):
        raise OSError(errno.EINVAL, "a name cannot hold a NUL")
    real = os.path.realpath(path)
    if os.path.islink(real):  # noqa: PTH114
        raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))
    return Path(real)


def check_may_be_replaced(path: Path) -> None:
    """Raise OSError where opening for writing would; replacing asks the folder's permissions only."""
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
    try:
        beside = [one.name for one in path.parent.iterdir() if one.suffix == path.suffix or not path.suffix]
    except OSError:
        beside = []
    near = get_close_matches(path.name[:LETTERS], [*names, *beside], 1)
    guess = f"; did you mean {near[0]!r}?" if near else ""
    folder = "" if path.parent.is_dir() else f", nor a folder {str(path.parent)!r:.{LETTERS}}"
    said = f"no such file{folder}; allowed: {allowed}{guess}"
    return FileNotFoundError(errno.ENOENT, cleaned(said), str(path))


def named(error: OSError, path: str | Path) -> OSError:
    """The error, told of the name that was given."""
    return type(error)(error.errno, f"{error.strerror}; {REFUSED}", str(path))


def write_through(path: Path) -> None:
    """Wait until a file is on the disk. Otherwise its new name might get there first."""
    handle = os.open(path, os.O_RDWR)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


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
    """Remove the temporary folders that killed processes left behind.

    Arguments:
        folder: where they are.
        below: whether they are removed in all folders below it, too.
        older: time since their last change [s]; 0 if the caller alone writes to the folder.
    """
    now = time.time()
    for path in list((folder.rglob if below else folder.glob)(f"{PREFIX}*")):
        if path.is_dir() and not path.is_symlink() and now - path.stat().st_mtime >= older:
            shutil.rmtree(path, ignore_errors=True)
