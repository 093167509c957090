"""What has changed, in words: rows of a table, and lines of a message."""

import math
from collections.abc import Sequence

from support_exudyn.postprocessing.baselines.changes import RunChange
from support_exudyn.postprocessing.figures.units import readable_change
from support_exudyn.simulation.estimate import Estimate

HEADER = ("change", "of", "name", "was -> is", ">times both errors", ">at")
MOST = 12  # rows of a scenario


def worst_first(changes: Sequence[RunChange]) -> list[RunChange]:
    """Keys of the scenario first, for they explain the rest; then what is gone and new, then the farthest."""
    return sorted(changes, key=lambda one: (one.what != "key", -one.ratio))


def rows(changes: Sequence[RunChange], most: int = MOST) -> list[tuple[str, ...]]:
    """The worst changes as rows of a table with `HEADER`, and how many more there are."""
    shown = worst_first(changes)[:most]
    found: list[tuple[str, ...]] = [_row(one) for one in shown]
    if len(changes) > len(shown):
        found.append(("", "", f"and {len(changes) - len(shown)} more", "", "", ""))
    return found


def line(change: RunChange) -> str:
    """A change in a line."""
    kind, what, name, values, ratio, time = _row(change)
    told = f"{what} {name} {kind}" + (f": {values}" if values else "")
    return told + (f", {ratio} times both errors" if ratio else "") + (f", at {time}" if time else "")


def _row(change: RunChange) -> tuple[str, str, str, str, str, str]:
    ratio = f"{change.ratio:.3g}" if math.isfinite(change.ratio) else ""
    time = f"{change.time:.6g} s" if change.time is not None else ""
    return change.kind, change.what, change.name, change.said or _values(change.was, change.now), ratio, time


def _values(was: Estimate | None, now: Estimate | None) -> str:
    """Both numbers in the unit in which they are read best."""
    both = [one for one in (was, now) if one is not None]
    if not both:
        return ""
    size = max(abs(one.value) for one in both)
    off = abs(both[-1].value - both[0].value)
    shown = readable_change(both[0].unit, size, off)
    texts = [str(Estimate(shown.scale * one.value, shown.scale * one.error, shown.name)) for one in both]
    return " -> ".join(texts)
