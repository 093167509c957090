"""Several files that belong together, written all or none."""

from __future__ import annotations

import errno
import os
import re
import shutil
import tempfile
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from support_exudyn.files import REFUSED, check_may_be_replaced, is_alive, named, real_path, write_through
from user_forces.values import InputError

RUN = b"support_exudyn result "  # as files of runs begin, see `support_exudyn.result`
TEMPORARY = re.compile(r"\.export_(\d+)_\w+")  # with the process that made it


@contextmanager
def whole_set(
    folder: Path,
    files: Sequence[str],
    indexes: Sequence[str],
    stale: Callable[[str], bool] = lambda name: False,
) -> Iterator[Path]:
    """A temporary folder to write files to; they take their places in `folder` if nothing goes wrong.

    The indexes, which name the other files, go before the rest is replaced and come when all of it is there: so
    there is never an index without its files, also when the process is killed. After an error or an
    interruption of the writing all is as it was before.

    Arguments:
        folder: made if missing.
        files, indexes: names of all that the block writes.
        stale: tells of names in the folder whether they are of an earlier set; what this one lacks is removed.

    Raises OSError that names what cannot be written; InputError if one of the files is a run.
    """
    asked = folder
    try:
        folder = real_path(folder)
        made = not folder.exists()
        folder.mkdir(parents=True, exist_ok=True)
        _remove_leftovers(folder)
        temporary = Path(tempfile.mkdtemp(prefix=f".export_{os.getpid()}_", dir=folder))
    except FileExistsError:
        raise named(
            NotADirectoryError(errno.ENOTDIR, "A file stands where a folder should be"), asked
        ) from None
    except OSError as error:
        raise named(error, asked) from None
    done = False
    try:
        _check_each(folder / name for name in (*files, *indexes))
        yield temporary
        for name in (*files, *indexes):
            write_through(temporary / name)
        _put_in_place(temporary, folder, files, indexes, stale)
        done = True
    except OSError as error:
        if error.errno is None or REFUSED in str(error.strerror):
            raise
        raise named(error, _meant(error, temporary, folder)) from error
    finally:
        shutil.rmtree(temporary, ignore_errors=True)
        if made and not done:
            with suppress(OSError):  # somebody else has put something there
                folder.rmdir()


def _check_each(paths: Iterable[Path]) -> None:
    for path in paths:
        check_is_no_run(path)
        try:
            check_may_be_replaced(path)
        except OSError as error:
            raise named(error, path) from None


def _put_in_place(
    temporary: Path, folder: Path, files: Sequence[str], indexes: Sequence[str], stale: Callable[[str], bool]
) -> None:
    for name in indexes:
        (folder / name).unlink(missing_ok=True)
    for path in list(folder.iterdir()):
        if stale(path.name) and path.name not in files:
            path.unlink()
    for name in (*files, *indexes):
        (temporary / name).replace(folder / name)


def _meant(error: OSError, temporary: Path, folder: Path) -> Path:
    """The name that the user knows for what an error is of."""
    path = Path(str(error.filename)) if error.filename else folder
    return folder / path.name if path.parent == temporary else path


def check_is_no_run(path: Path) -> None:
    """Raise InputError if a run is at `path`: no export takes its place."""
    with suppress(FileNotFoundError, NotADirectoryError), path.open("rb") as file:
        if file.read(len(RUN)) == RUN:
            raise InputError(f"{path}: is a run, which would be lost; allowed: another name")


def _remove_leftovers(folder: Path) -> None:
    """Of processes that are gone."""
    for path in list(folder.iterdir()):
        found = TEMPORARY.fullmatch(path.name)
        if found and not is_alive(int(found.group(1))):
            shutil.rmtree(path, ignore_errors=True)
