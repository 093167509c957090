"""Which channels two files have in common."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from support_exudyn.postprocessing import summary
from support_exudyn.postprocessing.comparing.channel_units import channel_unit
from support_exudyn.postprocessing.comparing.compared_file import ComparedFile
from support_exudyn.postprocessing.comparing.tolerances import Tolerance, check_patterns
from support_exudyn.postprocessing.figures.selection import matching
from user_forces.values.value import InputError

SHOWN = 6  # names that are told of many


class CommonChannels(NamedTuple):
    """The channels of two files.

    units: those that are compared, each with the unit that it is told in. lacking: those of the reference that
    the other file has not. not_alike: those that both have and that cannot be compared, each with the reason:
    a unit that a file does not name, or units of two kinds.
    """

    units: Mapping[str, str]
    lacking: tuple[str, ...]
    not_alike: Mapping[str, str]


def common_channels(reference: ComparedFile, other: ComparedFile, patterns: Sequence[str]) -> CommonChannels:
    """The channels that are compared, and those that are not, though they are asked for.

    patterns: names, or patterns as in a shell; without, of two runs forces and traced points, else all.

    Raises InputError if nothing is left, or if a channel that is asked for by its name, or that is mapped,
    cannot be compared.
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
    units, not_alike = dict[str, str](), dict[str, str]()
    named = {*patterns, *reference.mapped.columns, *other.mapped.columns}
    for name in found:
        unit, why = _unit_or_why(reference, other, name)
        if why and name in named:
            raise InputError(why)
        if why:
            not_alike[name] = why
        else:
            units[name] = unit
    if not units:
        raise InputError("\n".join(list(not_alike.values())[:SHOWN]))
    return CommonChannels(units, tuple(name for name in asked if name not in its), not_alike)


def _unit_or_why(reference: ComparedFile, other: ComparedFile, name: str) -> tuple[str, str]:
    """The unit that a channel is told in, or why there is none; the other one is empty."""
    try:
        return channel_unit(reference, other, name), ""
    except InputError as error:
        return "", str(error)


def check_named(tolerances: Sequence[Tolerance], common: Sequence[CommonChannels]) -> None:
    """Raise InputError for a tolerance of no channel that is compared.

    Of several files, a channel whose tolerance has its name has to be compared in each.
    """
    for one in tolerances:
        for of_pair in common:
            if one.pattern in of_pair.not_alike:
                raise InputError(of_pair.not_alike[one.pattern])
            if one.pattern in of_pair.lacking:
                raise InputError(
                    f"{one.pattern}: has a tolerance, {one.text}, and is not in all files; allowed: channels "
                    "that are, or patterns"
                )
    check_patterns(tolerances, list(dict.fromkeys(name for of_pair in common for name in of_pair.units)))


def _usual(reference: ComparedFile, other: ComparedFile) -> list[str]:
    """What is compared if nothing is asked for."""
    if reference.run is None:  # of which nothing is lost without a word, but columns that are mapped
        used, its = {one.column for one in reference.mapped.columns.values()}, set(other.channels)
        return [name for name in reference.channels if name in its or name not in used]
    if other.run is None:
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
