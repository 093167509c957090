"""Several files that belong together, written all or none."""

import errno
from collections.abc import Collection, Iterable, Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from support_exudyn.files.whole_file import (
    REFUSED,
    check_may_be_replaced,
    named,
    real_path,
    remove_leftovers,
    workshop,
    write_through,
)
from user_forces.values.value import InputError

RUN = b"support_exudyn result "  # as files of runs begin, see `simulation.result`


@contextmanager
def whole_set(
    folder: Path, files: Sequence[str], indexes: Sequence[str], stale: Collection[str] = ()
) -> Iterator[Path]:
    """A temporary folder to write files to; they take their places in `folder` if nothing goes wrong.

    The indexes, which name the other files, go before the rest is replaced and come when all of it is there: so
    there is never an index without its files, also when the process is killed. After an error or an
    interruption of the writing all is as it was before.

    Arguments:
        folder: made if missing.
        files, indexes: names of all that the block writes.
        stale: files in the folder that are known to be of an earlier set; what this one lacks is removed.

    Raises OSError that names what cannot be written; InputError if one of the files is a run.
    """
    asked = folder
    with ExitStack() as held:
        try:
            folder = real_path(folder)
            made = not folder.exists()
            folder.mkdir(parents=True, exist_ok=True)
            remove_leftovers(folder)
            if made:
                held.callback(_remove_if_empty, folder)
            temporary = held.enter_context(workshop(folder))
        except (FileExistsError, NotADirectoryError):
            raise named(
                NotADirectoryError(errno.ENOTDIR, "A file stands where a folder should be"), asked
            ) from None
        except OSError as error:
            raise named(error, asked) from None
        try:
            _check_each(folder / name for name in (*files, *indexes))
            yield temporary
            for name in (*files, *indexes):
                write_through(temporary / name)
            _put_in_place(temporary, folder, files, indexes, stale)
        except OSError as error:
            if error.errno is None or REFUSED in str(error.strerror):
                raise
            raise named(error, _meant(error, temporary, folder)) from error


def _remove_if_empty(folder: Path) -> None:
    with suppress(OSError):
        folder.rmdir()


def _check_each(paths: Iterable[Path]) -> None:
    for path in paths:
        check_is_no_run(path)
        try:
            check_may_be_replaced(path)
        except OSError as error:
            raise named(error, path) from None


def _put_in_place(
    temporary: Path, folder: Path, files: Sequence[str], indexes: Sequence[str], stale: Collection[str]
) -> None:
    for name in indexes:
        (folder / name).unlink(missing_ok=True)
    for name in stale:
        if name not in files:
            (folder / name).unlink(missing_ok=True)
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
