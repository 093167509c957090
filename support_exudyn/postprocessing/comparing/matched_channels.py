"""Which channels two files have in common."""

from __future__ import annotations

from collections.abc import Sequence

from support_exudyn.postprocessing import summary
from support_exudyn.postprocessing.comparing.compared_file import ComparedFile
from support_exudyn.postprocessing.figures.selection import matching
from user_forces.values.value import InputError

SHOWN = 6  # names that are told of many


def common_channels(
    reference: ComparedFile, other: ComparedFile, patterns: Sequence[str]
) -> tuple[list[str], tuple[str, ...]]:
    """The channels that are compared, and those of the reference that the other file has not.

    patterns: names, or patterns as in a shell; without, of two runs forces and traced points, else all.

    Raises InputError if nothing is left.
    """
    mine, its = reference.channels, set(other.channels)
    asked = matching(mine, patterns) if patterns else _usual(reference, other)
    for name in patterns:
        if name in mine and name not in its:
            raise InputError(f"{name}: {other.name} has no such channel; {_way_out(reference, other)}")
    found = [name for name in asked if name in its]
    if not found:
        raise InputError(
            f"{reference.path}, {other.path}: have no channel in common; {_way_out(reference, other)}"
        )
    return found, tuple(name for name in asked if name not in its)


def _usual(reference: ComparedFile, other: ComparedFile) -> list[str]:
    """What is compared if nothing is asked for."""
    if reference.run is None or other.run is None:
        return [name for name in reference.channels if name in set(other.channels)]
    told = summary.telling(reference.run)
    mapped = [name for file in (reference, other) for name in file.mapped.columns if name in reference.channels]
    return list(dict.fromkeys([*mapped, *(name for name in told if not name.startswith("energy."))]))


def _way_out(reference: ComparedFile, other: ComparedFile) -> str:
    return (
        f"{_has(reference)}; {_has(other)}; allowed: columns called as channels, or --map compare.toml, "
        "which says "
        f'which column is which: [files."{other.path.name}".columns] "{reference.channels[0]}" = '
        f'"{other.channels[0]}" (`--propose` writes one)'
    )


def _has(file: ComparedFile) -> str:
    names = file.channels
    more = f" and {len(names) - SHOWN} more" if len(names) > SHOWN else ""
    return f"{file.name} has {', '.join(names[:SHOWN])}{more}"
