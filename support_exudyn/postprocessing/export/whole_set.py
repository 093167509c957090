"""Several files that belong together, written all or none."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from support_exudyn.files.whole_file import (
    REFUSED,
    named,
    remove_leftovers,
    workshop,
    writable,
    write_through,
)
from user_forces.values.value import InputError

RUN = b"support_exudyn result "  # as files of runs begin, see `simulation.result`


@contextmanager
def whole_set(folder: Path, files: Sequence[str], stale: Sequence[str] = ()) -> Iterator[Path]:
    """A temporary folder to write files to; they take their places in `folder` if nothing goes wrong.

    After an error or an interruption of the writing all is as it was before.

    Arguments:
        folder: made if missing.
        files: names of all that the block writes; those that name the others come last.
        stale: files that are known to be of an earlier set, which are removed first, in this order. With the
            indexes ahead, a killed process leaves no index without its files.

    Raises OSError that names what cannot be written; InputError if one of the files is a run.
    """
    made = not folder.exists()
    try:
        place = folder.resolve()
        place.mkdir(parents=True, exist_ok=True)
        remove_leftovers(place)
        with workshop(place) as temporary:
            for name in files:
                check_is_no_run(place / name)
                writable(place / name)
            yield temporary
            for name in files:
                write_through(temporary / name)
            for name in stale:
                (place / name).unlink(missing_ok=True)
            for name in files:
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
