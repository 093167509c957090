"""What the fixtures of the pytest plugin do; nothing here knows pytest."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from fnmatch import fnmatchcase
from pathlib import Path

from support_exudyn.postprocessing.baselines.baseline_file import read_baseline
from support_exudyn.postprocessing.baselines.changes import changes
from support_exudyn.postprocessing.baselines.closeness import Closeness
from support_exudyn.postprocessing.baselines.difference_figure import changed_curve, save_figure
from support_exudyn.postprocessing.baselines.folder import ENDING, FOLDER, Looked, write_with_history
from support_exudyn.postprocessing.baselines.kept_run import KeptRun, kept_numbers, kept_run
from support_exudyn.postprocessing.baselines.told import line, worst_first
from support_exudyn.simulation.estimate import Estimate
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError, short

NO_NAME = re.compile(r"[^\w.-]+")  # what is left out of a file's name
TOLD = 5  # changes that a failure tells
LONGEST = 150  # letters of a name


def said_apart(found: Sequence[Closeness], figures: Path) -> str:
    """What a failed comparison says; empty if all is close.

    figures: folder for the figure of the worst curve.
    """
    apart = [one for one in found if not one.is_close]
    if not apart:
        return ""
    worst = apart[0]
    lines = [str(worst)]
    if len(found) > 1:
        others = ", ".join(one.name for one in apart[1:TOLD])
        lines.append(f"{len(apart)} of {len(found)} are not close" + (f"; further: {others}" if others else ""))
    if path := save_figure(worst, figures, file_name(worst.name)):
        lines.append(f"figure: {path}")
    return "\n".join(lines)


def said_changed(name: str, was: KeptRun, now: KeptRun, figures: Path) -> str:
    """What a changed baseline says; empty if nothing has changed."""
    found = worst_first(changes(was, now))
    if not found:
        return ""
    lines = [f"{name}: {len(found)} changed by more than both errors, new, or gone", *map(line, found[:TOLD])]
    if len(found) > TOLD:
        lines.append(f"and {len(found) - TOLD} more")
    if (curve := changed_curve(was, now, found)) and (
        path := save_figure(curve, figures, file_name(f"{name}.{curve.name}"))
    ):
        lines.append(f"figure: {path}")
    return "\n".join(lines)


def file_name(text: str) -> str:
    """A text as the name of a file."""
    return NO_NAME.sub("_", text).strip("_.")[:LONGEST] or "it"


class SessionBaselines:
    """The baselines of the tests of a session.

    Arguments:
        updated: names, or patterns of them, of baselines that are written.
    """

    def __init__(self, updated: Sequence[str]) -> None:
        self.updated = tuple(updated)
        self._used: set[Path] = set()

    def compare(
        self, item: Result | Estimate | Mapping[str, Estimate], beside: Path, name: str, figures: Path
    ) -> tuple[str, bool]:
        """Compare with the baseline, or write it if it is one of those.

        Arguments:
            item: what is compared: a result with errors, a number, or numbers by their names.
            beside: the file of the test, beside which the folder of baselines is.
            name: of the baseline.
            figures: folder for the figure of a failure.

        Returns:
            What has changed, or that there is no baseline, in lines, empty if nothing has changed; and whether
            the baseline was written.

        Raises InputError if it is damaged, or if its name was used before.
        """
        path = beside.parent / FOLDER / f"{file_name(name)}{ENDING}"
        if path in self._used:
            raise InputError(
                f"{path.stem}: is compared already; allowed: a name of its own, baseline(it, 'NAME')"
            )
        self._used.add(path)
        now = _kept(item)
        was = read_baseline(path) if path.exists() else None
        writes = any(fnmatchcase(path.stem, pattern) for pattern in self.updated)
        said = said_changed(path.stem, was, now, figures) if was is not None else f"{path.stem}: first"
        if not said:
            return "", False
        if writes:
            found = tuple(changes(was, now)) if was is not None else ()
            write_with_history(Looked(path.stem, was, now, found), path)
            return f"{path}: written\n{said}", True
        if was is None:
            said = f"{path}: there is no such baseline"
        return f"{said}\nto write it: pytest --baseline-update {path.stem}", False


def _kept(item: Result | Estimate | Mapping[str, Estimate]) -> KeptRun:
    if isinstance(item, Result):
        return kept_run(item)
    named = {"it": item} if isinstance(item, Estimate) else item
    if not isinstance(named, Mapping) or not all(isinstance(one, Estimate) for one in named.values()):
        raise InputError(
            f"{short(item)}: cannot be a baseline; allowed: a Result with errors, an Estimate, or Estimates by "
            "their names"
        )
    return kept_numbers(named)
