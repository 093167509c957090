"""Several files that belong together, written all or none."""

from collections.abc import Collection, Iterator, Sequence
from contextlib import contextmanager, suppress
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
    made, names = not folder.exists(), (*files, *indexes)
    try:
        place = real_path(folder)
        place.mkdir(parents=True, exist_ok=True)
        remove_leftovers(place)
        with workshop(place) as temporary:
            for name in names:
                check_is_no_run(place / name)
                check_may_be_replaced(place / name)
            yield temporary
            for name in names:
                write_through(temporary / name)
            for name in (*indexes, *(one for one in stale if one not in files)):
                (place / name).unlink(missing_ok=True)
            for name in names:
                (temporary / name).replace(place / name)
    except OSError as error:
        if error.errno is None or REFUSED in str(error.strerror):
            raise
        raise named(error, folder) from error
    finally:
        if made:
            with suppress(OSError):  # it is not empty
                folder.rmdir()


def check_is_no_run(path: Path) -> None:
    """Raise InputError if a run is at `path`: no export takes its place."""
    with suppress(FileNotFoundError, NotADirectoryError), path.open("rb") as file:
        if file.read(len(RUN)) == RUN:
            raise InputError(f"{path}: is a run, which would be lost; allowed: another name")
