"""The channels of a scenario before it is run."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from support_exudyn.files.machines.read import SHIPPED, load_machine
from support_exudyn.files.scenarios.scenario_file import scenario_of
from support_exudyn.files.toml.text import load_toml
from support_exudyn.files.whole_file import missing_file
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.model.machine import Machine
from support_exudyn.postprocessing.figures.selection import matching
from support_exudyn.postprocessing.result_table import ResultTable
from support_exudyn.scenario.scenario import Scenario
from user_forces.values.names import Named
from user_forces.values.value import InputError, short

HEADER = ("channel", "unit", "meaning")
ALLOWED = f"the TOML file of a scenario or of a machine, or one of {', '.join(SHIPPED)}"


class KnownChannel(NamedTuple):
    """What a channel is in: its unit, and what it is."""

    unit: str
    meaning: str


class ChannelTable(Named[KnownChannel]):
    """Channels by name, each with its unit and meaning."""

    def rows(self) -> list[tuple[str, str, str]]:
        """Name, unit and meaning of each."""
        return [(name, *one) for name, one in self.items()]

    def __str__(self) -> str:
        width, unit = (max(map(len, column), default=0) for column in list(zip(*self.rows(), strict=True))[:2])
        return "\n".join(f"{name:{width}}  {one.unit:{unit}}  {one.meaning}" for name, one in self.items())

    __repr__ = __str__

    def _repr_html_(self) -> str:
        """The table, for notebooks."""
        return ResultTable(f"{len(self)} channels", HEADER, self.rows()).html()


def channels(of: Scenario | Machine | MachineData | str | Path, *patterns: str) -> ChannelTable:
    """All channels that a run can record, by name, each with unit and meaning; nothing is run.

        channels("zf18000", "pin.*.force")
        channels(scenario)["pin.rear_base.depth"].unit

    Arguments:
        of: a scenario, its file, a machine, its file, or the name of one that comes with the package. What
            clearance pins and oil record is known of scenarios only.
        patterns: only these: names, or patterns of them as in a shell.

    Raises InputError if the file cannot be used, or a pattern matches no channel; OSError if there is no file.
    """
    known = _scenario(of).channel_definitions
    names = matching(known, patterns) or list(known)
    return ChannelTable(
        {name: KnownChannel(known[name].unit, known[name].meaning) for name in names}, "channel"
    )


def _scenario(of: object) -> Scenario:
    if isinstance(of, (str, Path)):
        if str(of) not in SHIPPED:
            try:
                table = load_toml(of)
            except FileNotFoundError as error:
                raise missing_file(of, ALLOWED, SHIPPED) from error
            if "kind" not in table or "machine" in table:
                return scenario_of(table, str(of), Path(of).parent)
        of = load_machine(of)
    if isinstance(of, MachineData):
        of = of.machine
    if isinstance(of, Machine):
        return Scenario(machine=of, duration=1.0)
    if not isinstance(of, Scenario):
        raise InputError(f"of = {short(of)}: allowed: a scenario, a machine, or {ALLOWED}")
    return of
