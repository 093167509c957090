"""The check of a machine of any kind: what is said of its kind, and what is said of its linkage."""

from collections.abc import Iterator
from dataclasses import replace

from support_exudyn.machines.check.any_machine import check_any
from support_exudyn.machines.check.report import CheckReport, CheckTable
from support_exudyn.machines.check.shield import check_shield
from support_exudyn.machines.four_bar_shield import FourBarShield
from support_exudyn.machines.machine_data import MachineData


def check_machine(data: MachineData, stroke: float | None = None) -> CheckReport:
    """The report of all that can be said of a machine before it is run.

    Arguments:
        data: the machine as its file describes it.
        stroke: by how much its columns extend from the start on [m]; by default as the file says, otherwise
            three tenths of the shortest column.

    Machines of other kinds are looked at by their linkage alone.

    Raises InputError if it cannot go so far.
    """
    data = data if data.kind else replace(data, kind=type(data.machine).__name__)
    report = _of_its_kind(data, stroke)
    told = {key: one.data() for key, one in data.sourced.items()}
    return replace(
        report, sheets=[*report.sheets, *_sourced(data)], numbers={**report.numbers, "file_numbers": told}
    )


def _of_its_kind(data: MachineData, stroke: float | None) -> CheckReport:
    if isinstance(data.machine, FourBarShield):
        return check_shield(data, data.machine, stroke)
    return check_any(data, stroke)


def _sourced(data: MachineData) -> Iterator[CheckTable]:
    """The numbers that say their range or source: a table for every source, with the keys of the file."""
    by_source: dict[str, list[tuple[str, ...]]] = {}
    for key, one in data.sourced.items():
        row = (key, *("-" if item is None else str(item) for item in (one.value, one.low, one.high)))
        by_source.setdefault(one.source or "their source is not said", []).append(row)
    for source, rows in by_source.items():
        yield CheckTable(f"numbers of the file: {source}", ("key", "value", "from", "to"), rows)
