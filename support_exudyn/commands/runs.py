"""Files of runs on a command line: how they are told from channels, and what they are called."""

import re
from collections.abc import Collection, Sequence
from pathlib import Path

from support_exudyn.commands.command_line import folder
from support_exudyn.files.series.matlab import is_matlab
from support_exudyn.files.series.own_runs import is_exported, is_run
from user_forces.values.value import InputError

ENDING = ".h5"  # of runs
CSV, TOML = ".csv", ".toml"
HEAD = 600  # bytes by which runs are told from series of others
NO_NAME = re.compile(r"[^\w.-]+")  # what is left out of a file's name
LONGEST = 80  # letters of what a file's name says of channels


def named_runs(paths: Sequence[Path]) -> dict[str, Path]:
    """Names of runs, of their files; with the folder where two have one name.

    Raises InputError if a run is given twice.
    """
    found: dict[str, Path] = {}
    for path in paths:
        same = [other for other in paths if other.stem == path.stem]
        name = path.stem if len(same) == 1 else str(path.with_suffix(""))
        if name in found:
            raise InputError(f"{path}: is given twice; allowed: every run once")
        found[name] = path
    return found


def named_curves(paths: Sequence[Path], taken: Collection[str]) -> dict[str, Path]:
    """Names of files of others: with the ending where that tells two apart, or with the folder.

    taken: names of runs. Raises InputError if a file is given twice.
    """
    found: dict[str, Path] = {}
    stems = [*taken, *(path.stem for path in paths)]
    for path in paths:
        if path in found.values():
            raise InputError(f"{path}: is given twice; allowed: every file once")
        name = path.stem if stems.count(path.stem) == 1 else path.name
        found[name if name not in found else str(path)] = path
    return found


def files_of_curves(words: Sequence[str]) -> list[Path]:
    """The files among words that are series of others; a table that is missing is one, too."""
    return [folder(word) for word in words if word.lower().endswith(CSV) or _is_of_others(folder(word))]


def _is_of_others(path: Path) -> bool:
    """Whether a path is a file, and neither a run, whole or damaged, nor a text of ours."""
    if not path.is_file() or path.suffix.lower() == TOML:
        return False
    with path.open("rb") as file:
        head = file.read(HEAD)
    return not is_run(head) and (path.suffix.lower() != ENDING or is_exported(head) or is_matlab(head))


def runs_and_channels(words: Sequence[str]) -> tuple[list[Path], list[str]]:
    """The runs and the channels among words: the first is a run, others are if they end so or are files."""
    runs = [word for n, word in enumerate(words) if n == 0 or word.endswith(ENDING) or folder(word).is_file()]
    return list(map(folder, runs)), [word for word in words if word not in runs]


def file_name(*parts: str) -> str:
    """A file's name of what a figure shows; patterns of channels without their stars."""
    return "_".join(filter(None, (NO_NAME.sub("_", part).strip("_.") for part in parts)))


def said_channels(patterns: Sequence[str]) -> str:
    """Channels as a part of a file's name."""
    words = [pattern.replace("*", "").replace("?", "").replace("..", ".").strip(".") for pattern in patterns]
    text = "_".join(filter(None, words)) or "channels"
    return text if len(text) <= LONGEST else f"{text[:LONGEST].rstrip('_.')}_and_others"


def said_window(after: float, until: float) -> str:
    """A window [s] as a part of a file's name; empty for the whole run."""
    begins, ends = after > 0.0, until < float("inf")
    if begins and ends:
        return f"{after:g}_to_{until:g}_s"
    return f"after_{after:g}_s" if begins else f"until_{until:g}_s" if ends else ""
