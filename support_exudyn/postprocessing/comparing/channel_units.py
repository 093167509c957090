"""The unit in which a channel of two files is told, and why there may be none."""

from __future__ import annotations

from support_exudyn.postprocessing.comparing.compared_file import ComparedFile
from support_exudyn.postprocessing.comparing.si_units import of_a_kind, si_unit
from user_forces.values.value import InputError


def channel_unit(reference: ComparedFile, other: ComparedFile, channel: str) -> str:
    """The unit in which a channel is told: that of a run, else the SI unit of what the files name.

    Raises InputError if a file names none, or if both are of two kinds.
    """
    files = (reference, other)
    known = [file.unit(channel) for file in files]
    units = [one for one in known if one is not None]
    if len(units) < len(files):
        raise InputError(_without(files[known.index(None)], channel, neither=not units))
    runs = [one for file, one in zip(files, units, strict=True) if file.run is not None]
    for told in runs[:1] or [si_unit(one) for one in units]:  # a reference in g is no acceleration beside kg
        if all(of_a_kind(one, told) for one in units):
            return told
    mine, its = (one or "pure numbers" for one in units)
    raise InputError(
        f"{channel}: is in {mine} in {reference.name}, and in {its} in {other.name}; allowed: units of one kind"
    )


def _without(file: ComparedFile, channel: str, neither: bool) -> str:
    """Why there is no unit, and where to give it."""
    column = file.column(channel).column
    said = f"{channel}: has a unit in neither" if neither else f"{file.path}: {column}: its file gives no unit"
    return (
        f"{said}; allowed: one in the column's title, such as '{column} [mm]', or in compare.toml, [units] "
        f'"{column}" = "mm"'
    )
