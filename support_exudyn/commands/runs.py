"""Words of a command line that are files or channels."""

from collections.abc import Sequence
from pathlib import Path

from support_exudyn.files.series.matlab import is_matlab
from support_exudyn.files.series.own_runs import is_exported, is_run
from user_forces.values.value import InputError

RUN, CSV, TOML = ".h5", ".csv", ".toml"
# a word with such an ending is a file even if it is not there, and no channel
ENDINGS = (
    *(RUN, CSV, ".txt", ".tab", ".tsv", ".dat", ".res", ".req", ".mat", ".parquet", ".xml", ".lvm"),
    *(".xlsx", ".xlsm", ".feather", ".json", ".tdms", ".xls"),
)
HEAD = 600  # bytes by which runs are distinguished from series of others


def files_and_channels(words: Sequence[str]) -> tuple[list[Path], list[str]]:
    """The files and the channels among words: the first is a file, others are if they are there or end so."""
    are_files = [
        n == 0 or Path(word).is_file() or (word.lower().endswith(ENDINGS) and not set(word) & set("*?"))
        for n, word in enumerate(words)
    ]
    files = [Path(word) for word, is_file in zip(words, are_files, strict=True) if is_file]
    return files, [word for word, is_file in zip(words, are_files, strict=True) if not is_file]


def is_of_others(path: Path) -> bool:
    """Whether a file is a series of others, and neither a run, whole or damaged, nor a text of ours."""
    if not path.is_file() or path.suffix.lower() == TOML:
        return path.suffix.lower() == CSV
    with path.open("rb") as file:
        head = file.read(HEAD)
    return not is_run(head) and (path.suffix.lower() != RUN or is_exported(head) or is_matlab(head))


def by_name(paths: Sequence[Path]) -> dict[str, Path]:
    """Files by their names: without the ending or the folder where that distinguishes them.

    Raises InputError if a file is given twice.
    """
    found: dict[str, Path] = {}
    for path in paths:
        if path in found.values():
            raise InputError(f"{path}: is given twice; allowed: every file once")
        others = [other for other in paths if other != path]
        name = path.name if any(other.stem == path.stem for other in others) else path.stem
        found[str(path) if any(other.name == name for other in others) else name] = path
    return found
