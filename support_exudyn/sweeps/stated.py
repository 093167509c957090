"""Ranges that files state for their numbers, from which a sweep draws."""

from collections.abc import Mapping
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

from support_exudyn.files.machines.read import read_machine
from support_exudyn.files.scenarios.scenario_file import scenario_file_of
from support_exudyn.files.toml.faults import nearest
from support_exudyn.sweeps.plan import Range
from user_forces.values.sourced import SourcedNumber
from user_forces.values.value import InputError

MACHINE = "machine"
STATED = "stated range"  # in place of a range: that which the file of scenario or machine states
STRENGTH = "strength"  # section of a machine's file that `stand` alone reads, and no run
RANGED = "{value = 1960, from = 1500, to = 2200}"


def stated_ranges(
    patterns: list[str], method: Any, table: Mapping[str, Any], where: str, folder: Path
) -> dict[str, Range]:
    """The ranges that are stated for numbers, by their keys as far as these fit one of some patterns.

    Numbers of [strength] are left out, for no run depends on them.

    Arguments:
        patterns: as in a shell, at least one.
        method: of the sweep.
        table: of the scenario file. where: what errors call it. folder: from which paths in it go on.

    Raises InputError for another method than a Latin hypercube, and for a pattern that no number fits, or those
    of [strength] alone; OSError if the machine's file cannot be read.
    """
    if method != "latin_hypercube":
        raise InputError(f"vary.{patterns[0]!r} = {STATED!r}: allowed with method = 'latin_hypercube'")
    given = table.get(MACHINE)
    numbers: dict[str, SourcedNumber] = {}
    fault: InputError | None = None
    try:
        scenario_file_of(table, where, folder, numbers)
    except InputError as error:  # also of what is missing because it varies
        fault = error
    if isinstance(given, str):
        numbers |= {f"{MACHINE}.{key}": one for key, one in read_machine(given, folder).sourced.items()}
    ranges = {
        key: Range(one.low, one.high)
        for key, one in numbers.items()
        if one.low is not None and one.high is not None
    }
    drawn = {key: one for key, one in ranges.items() if not key.startswith(f"{MACHINE}.{STRENGTH}.")}
    for pattern in patterns:
        if any(fnmatchcase(key, pattern) for key in drawn):
            continue
        if any(fnmatchcase(key, pattern) for key in ranges):
            raise of_strength(pattern)
        if pattern.startswith(f"{MACHINE}.") and not isinstance(given, str):
            raise InputError(f"vary.{pattern!r} = {STATED!r}: allowed where the machine is named by its file")
        if fault is not None:
            raise fault
        files = f"{where} and {given}" if isinstance(given, str) else where
        raise InputError(
            f"vary.{pattern!r} = {STATED!r}: no range is stated for such a number in {files}; "
            f"{nearest(pattern, drawn)}; a number there states one as {RANGED}"
        )
    return {key: one for key, one in drawn.items() if any(fnmatchcase(key, pattern) for pattern in patterns)}


def of_strength(name: str) -> InputError:
    """The refusal of numbers on which no run depends."""
    return InputError(
        f"vary.{name!r}: no run depends on [{STRENGTH}], which `support-exudyn stand` alone reads; "
        "allowed: other numbers of the machine's file"
    )
