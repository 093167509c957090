"""Words of a command line that are files or channels, and files of figures."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from cyclopts import Parameter

from support_exudyn.files.series.matlab import is_matlab
from support_exudyn.files.series.own_runs import is_exported, is_run
from support_exudyn.files.whole_file import whole_file
from user_forces.values.value import InputError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

RUN, CSV, TOML = ".h5", ".csv", ".toml"
# a word with such an ending is a file even if it is not there, and no channel
ENDINGS = (RUN, CSV, ".txt", ".tab", ".tsv", ".dat", ".res", ".req", ".mat", ".parquet", ".xml")
HEAD = 600  # bytes by which runs are distinguished from series of others
NO_NAME = re.compile(r"[^\w.-]+")  # what is left out of a file's name
LONGEST = 80  # letters of what a file's name says of channels
PICTURES = (".png", ".pdf", ".svg")


def _check_figures(type_: object, out: Path | None) -> None:
    """Raise ValueError for a name of figures whose ending is that of no format that is drawn."""
    del type_
    if out is not None and out.suffix and not out.is_dir() and out.suffix.lower() not in PICTURES:
        raise ValueError(f"allowed: a file that ends in {', '.join(PICTURES)}, or a folder, without an ending")


FIGURES = Parameter(validator=_check_figures)  # of an option that names a file of a figure, or a folder


def is_figure(out: Path | None) -> bool:
    """Whether an output is the file of a figure; otherwise it is a folder."""
    return out is not None and not out.is_dir() and out.suffix.lower() in PICTURES


def save_figures(drawings: Mapping[str, Figure], out: Path | None, folder: Path) -> dict[str, list[Path]]:
    """Write figures by name as PNG and PDF into a folder, or the only figure into its file.

    Arguments:
        drawings: the figures by name.
        out: what was asked for, a folder or a file; None: folder.
        folder: where they lie by default.

    Returns the files by the names of the figures. Raises InputError for several figures and a file.
    """
    from support_exudyn.postprocessing.figures import style

    if out is None or not is_figure(out):
        return {name: style.save(drawing, out or folder, name) for name, drawing in drawings.items()}
    if len(drawings) > 1:
        raise InputError(f"--out {out}: is a figure, and {len(drawings)} are drawn; allowed: a folder")
    for drawing in drawings.values():
        with whole_file(out) as temporary:
            drawing.savefig(temporary, format=out.suffix[1:].lower())
    return {name: [out] for name in drawings}


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


def joined(*parts: str) -> str:
    """The name of a figure's file: what it shows, without characters that file systems refuse."""
    return "_".join(filter(None, (NO_NAME.sub("_", part).strip("_.") for part in parts)))


def in_name(patterns: Sequence[str]) -> str:
    """Channels as a part of a file's name, patterns without their stars; "overview" if there are none."""
    if not patterns:
        return "overview"
    words = [pattern.replace("*", "").replace("?", "").replace("..", ".").strip(".") for pattern in patterns]
    text = "_".join(filter(None, words)) or "channels"
    return text if len(text) <= LONGEST else f"{text[:LONGEST].rstrip('_.')}_and_others"


def window_in_name(after: float, until: float) -> str:
    """A window [s] as a part of a file's name; empty for the whole run."""
    if after > 0.0:
        return f"{after:g}_to_{until:g}_s" if until < math.inf else f"after_{after:g}_s"
    return f"until_{until:g}_s" if until < math.inf else ""
