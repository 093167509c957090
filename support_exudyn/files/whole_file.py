"""Files that are written whole or not at all, and folders that one process at a time writes to."""

import errno
import os
import re
import stat
from collections.abc import Collection, Iterator
from contextlib import ExitStack, contextmanager
from difflib import get_close_matches
from pathlib import Path

from support_exudyn.files.temporary import fcntl, workshop
from user_forces.values.value import InputError, cleaned

LOCK = ".support_exudyn.lock"
HOLDER = re.compile(rb"(\d+\n)?")  # what is in a lock: the process that has it
REFUSED = "it cannot be written"
LETTERS = 80  # of a name that are compared and told


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

    The lock ends with the process, however it ends. Where the system has no such lock (Windows, some network
    disks) nobody is kept out.

    Raises OSError that names the process which is writing there, or a file of the lock's name that is none.
    """
    if fcntl is None:
        yield
        return
    path = folder / LOCK
    while True:
        handle = _opened(path)
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


def _opened(path: Path) -> int:
    """A lock, opened; made if missing. Raises OSError if something else has its name."""
    try:
        handle = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK, 0o666)
    except OSError as error:
        if error.errno in (errno.ELOOP, errno.EISDIR, errno.ENXIO):
            raise _no_lock(path) from None
        raise
    regular = stat.S_ISREG(os.fstat(handle).st_mode)
    if regular and HOLDER.fullmatch(os.pread(handle, 64, 0)):
        return handle
    os.close(handle)
    raise _no_lock(path)


def _no_lock(path: Path) -> OSError:
    said = "is no lock of this program, which needs the name; allowed: move it elsewhere"
    return FileExistsError(errno.EEXIST, said, str(path))


def _is_open(path: Path, handle: int) -> bool:
    """Whether a path is the file that is open."""
    try:
        return os.path.samestat(path.stat(), os.fstat(handle))
    except FileNotFoundError:
        return False
