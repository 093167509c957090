"""Short forms of a scenario's file: a machine by its name, pins, actuators and drives in few words."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from difflib import get_close_matches
from functools import partial
from pathlib import Path
from typing import Any, Literal, TypeVar

from support_exudyn.files.machines.read import SHIPPED, read_machine
from support_exudyn.files.scenarios.drive_table import one_drive, read_drives
from support_exudyn.files.scenarios.short_joints import ShortContact, ShortGuide, ShortPin, pin_in_machine
from support_exudyn.files.toml.faults import Faults, Place
from support_exudyn.files.toml.reading import FAILED, Reader
from support_exudyn.files.toml.shapes import GroupShape, field_shapes
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.model.actuators import CylinderAndRod
from support_exudyn.model.drives.drive import CubicStep, Drive, Stroke, UniformSpeed
from support_exudyn.model.drives.table_drive import TableDrive
from support_exudyn.model.guides import Guide, IdealGuide
from support_exudyn.model.hydraulics.leg import HydraulicCylinder
from support_exudyn.model.machine import Machine
from support_exudyn.model.pins import IdealPin, Pin
from user_forces.values.names import unknown
from user_forces.values.units import ANGLES, LENGTHS, Hertz
from user_forces.values.value import InputError, Positive, Value, value

S = TypeVar("S", bound=ShortContact)


MODES: Mapping[Any, type[Stroke]] = {1: UniformSpeed, 2: CubicStep}


@value
class DrivesFile(Value):
    """Drives of several actuators from one CSV file, `time_s,front_column_mm,rear_column_mm`.

    Arguments:
        table: path of the file, from the folder of the scenario's file on; each of its columns drives the part
            of the machine by its name.
        between: how the points are joined: "smooth", or "linear", at constant speeds that jump.
        rate: rows per second of a table without times [Hz], > 0.
    """

    table: str
    between: Literal["smooth", "linear"] = TableDrive.between
    rate: Hertz[Positive] | None = None


@value
class DriveFile(DrivesFile):
    """A displacement over time from a CSV file, whose first line names columns as in `time_s,extension_mm`.

    Arguments:
        table: path of the file, from the folder of the scenario's file on.
        column: name of its column, without unit; may be left out if there is one besides the time.
    """

    column: str | None = None


def read_machine_of(table: Mapping[str, Any], faults: Faults, folder: Path) -> MachineData | None:
    """The machine that a scenario's table names or holds; None, with the reason among the faults."""
    given = table.get("machine")
    if isinstance(given, str):
        return _from_file(given, faults, folder)
    if isinstance(given, dict):
        found = Reader(faults).member(GroupShape((Machine,)), given, ("machine",))
        return None if found is FAILED else MachineData(found)
    if isinstance(given, (Machine, MachineData)):  # made by a program, see `simple_scenario`
        return MachineData(given) if isinstance(given, Machine) else given
    allowed = f"a path that ends in .toml, one of {', '.join(SHIPPED)}, or a table [machine]"
    if given is None:
        faults.add(("machine",), f"missing; allowed: {allowed}")
    else:
        faults.wrong(("machine",), given, allowed)
    return None


def _from_file(name: str, faults: Faults, folder: Path) -> MachineData | None:
    try:
        return read_machine(name, folder)
    except InputError as error:
        of_file = name.lower().endswith(".toml")  # which it then names itself
        faults.lines += [line if of_file else f"{faults.where}: {line}" for line in str(error).splitlines()]
    except (OSError, ValueError) as error:  # ValueError: of names that no file can have
        reason = getattr(error, "strerror", None) or error
        allowed = f"a file that can be read, from {folder.resolve()} on ({reason})"
        faults.wrong(("machine",), name, allowed)
    return None


OF_CRANKS = (
    'none of cranks, for modes extend actuators; type = "Steady" with rate_rpm, "CubicStep" with stroke_deg, '
    "or a table in degrees"
)


class ShortForms:
    """Readers of the short forms.

    folder: from which files lie. data: the machine, None if it could not be read. table: of the scenario.
    """

    def __init__(self, folder: Path, data: MachineData | None, table: Mapping[str, Any]) -> None:
        self.folder = folder
        self.data = data
        self.table = table
        self.columns: Collection[str] = ()  # of the file of all drives

    def machine(self, reader: Reader, item: Any, place: Place) -> Any:
        """The machine, which has been read before all else."""
        del reader, item, place
        return FAILED if self.data is None else self.data.machine

    def pin(self, reader: Reader, item: Any, place: Place) -> Any:
        """A pin with `ideal = true`, or by its clearance."""

        def made(data: MachineData, short: ShortPin) -> Pin:
            name = place[-1]
            radius = data.bore_radii.get(name)
            if short.clearance == 0.0:  # as at the end of a sweep over clearances
                return short.ideal(radius)
            return pin_in_machine(short, data.machine, name, radius)

        return self._joint(reader, item, place, IdealPin, ShortPin, made)

    def guide(self, reader: Reader, item: Any, place: Place) -> Any:
        """A guide with `ideal = true`, or by its clearance."""

        def made(data: MachineData, short: ShortGuide) -> Guide:
            return short.guide(data.blocks.get(place[-1]))

        return self._joint(reader, item, place, IdealGuide, ShortGuide, made)

    def _joint(
        self,
        reader: Reader,
        item: Any,
        place: Place,
        ideal: type[Value],
        short: type[S],
        made: Callable[[MachineData, S], Value],
    ) -> Any:
        """A joint with `ideal = true`, or of a short form; None: in full."""
        if not isinstance(item, dict) or "type" in item:
            return None
        if "ideal" in item:
            if item["ideal"] is not True:
                allowed = "true; a joint with clearance has a clearance_mm instead"
                reader.faults.wrong((*place, "ideal"), item["ideal"], allowed)
                return FAILED
            return reader.value(ideal, {key: one for key, one in item.items() if key != "ideal"}, place)
        found = reader.value(short, item, place)
        if found is FAILED or self.data is None:
            return FAILED
        try:
            return made(self.data, found)
        except InputError as error:
            linkage, (what, name) = self.data.machine.linkage(), place
            known = linkage.pins if what == "pins" else linkage.slides
            others = {"actuators", "parts"} & self.table.keys()  # which bring pins of their own
            misspelt = name not in known and (not others or get_close_matches(name[:80], known))
            for line in [unknown(what[:-1], name, known)] if misspelt else str(error).splitlines():
                reader.faults.add(place, line)
            return FAILED

    def actuator(self, reader: Reader, item: Any, place: Place) -> Any:
        """An actuator of two bodies whose masses the machine's file says."""
        if not isinstance(item, dict) or item.get("type") != CylinderAndRod.__name__ or len(place) != 2:
            return None
        if self.data is None or place[-1] not in self.data.actuators:
            return None
        return reader.value(CylinderAndRod, item, place, self.data.actuators[place[-1]])

    def drive(self, reader: Reader, item: Any, place: Place) -> Any:
        """A mode of the paper, or a column of a file; in the long form units have to fit what is driven."""
        if not isinstance(item, dict):
            return None
        if "type" in item:
            return FAILED if self._misfits(reader, item, place) else None
        if "mode" in item:
            return self._mode(reader, item["mode"], {k: one for k, one in item.items() if k != "mode"}, place)
        if "table" in item:
            file = reader.value(DriveFile, item, place)
            if file is FAILED:
                return FAILED
            turning = self._turning(place)
            turns = next(iter(turning)) if len(turning) == 1 else None
            read = partial(one_drive, self.folder / file.table, file.column, file.between, turns, file.rate)
            return _read(read, reader.faults, file.table, (*place, "table"))
        kinds = ", ".join(GroupShape((Drive,)).kinds)
        reader.faults.add(
            place, f"says no mode, table or type; allowed: mode = 1 or 2, table = a CSV file, type: {kinds}"
        )
        return FAILED

    def _mode(self, reader: Reader, mode: Any, item: Mapping[str, Any], place: Place) -> Any:
        """A stroke in a drive mode of the paper, by default the stroke of the machine's file."""
        kind = MODES.get(mode) if isinstance(mode, int) and not isinstance(mode, bool) else None
        if kind is None or True in self._turning(place):
            reader.faults.wrong((*place, "mode"), mode, "1, 2" if kind is None else OF_CRANKS)
            return FAILED
        if self._misfits(reader, {**item, "type": kind.__name__}, place) or self.data is None:
            return FAILED
        usual = kind() if self.data.stroke is None else kind(stroke=self.data.stroke)
        return reader.value(kind, item, place, usual)

    def _misfits(self, reader: Reader, item: Mapping[str, Any], place: Place) -> bool:
        """Whether a key of a drive is in a unit that does not fit what it moves, which is noted."""
        kind, kinds = item["type"], GroupShape((Drive,)).kinds
        fields = field_shapes(kinds[kind]).values() if isinstance(kind, str) and kind in kinds else ()
        turning, before = self._turning(place), len(reader.faults.lines)
        for one in fields:
            given = [key for key in one.keys if key in item]
            of_either = one.unit is not None and " or " in one.unit.symbol
            if not given and True in turning and of_either and one.default is not None:
                keys = [key for key in one.keys if one.ending(key) in ANGLES]
                reader.faults.add((*place, keys[0]), f"missing; allowed: {', '.join(keys)}, for cranks turn")
            for key in given:
                wrong = [turns for turns in turning if one.ending(key) in (LENGTHS if turns else ANGLES)]
                if wrong:
                    units, why = (ANGLES, "cranks turn") if wrong[0] else (LENGTHS, "linear actuators extend")
                    fitting = [other for other in one.keys if one.ending(other) in units]
                    both = "; a drive of its own for each kind, [drives.NAME]" if len(turning) > 1 else ""
                    allowed = f"{', '.join(fitting or units)}, for {why}{both}"
                    reader.faults.wrong((*place, key), item[key], allowed)
        return len(reader.faults.lines) > before

    def _turning(self, place: Place) -> set[bool]:
        """Whether what the drive at a place moves turns: cranks do, actuators do not; both, or none known."""
        if self.data is None:
            return set()
        linkage = self.data.machine.linkage()
        if place[0] == "drives":
            return {place[1] in linkage.cranks}
        drives, models = (self.table.get(key) for key in ("drives", "actuators"))
        own = {*self.columns, *(drives if isinstance(drives, dict) else ())}
        if isinstance(models, dict):  # cylinders follow their inlets
            cylinders = HydraulicCylinder.__name__
            own |= {k for k, one in models.items() if isinstance(one, dict) and one.get("type") == cylinders}
        return {name in linkage.cranks for name in linkage.driven if name not in own}

    def _turns(self, name: str) -> bool | None:
        """Whether what a column of this name moves is a crank; None if nothing is known."""
        known = self.data is not None and name in self.data.machine.linkage().driven
        return next(iter(self._turning(("drives", name)))) if known else None

    def drives(self, reader: Reader, table: Mapping[str, Any]) -> dict[str, Any]:
        """The drives that `[drives] table = FILE` gives, by name; empty if it names none."""
        given = table.get("drives")
        if not isinstance(given, dict) or not isinstance(given.get("table"), str):
            return {}
        own = {key: one for key, one in given.items() if not isinstance(one, dict)}
        file = reader.value(DrivesFile, own, ("drives",))
        if file is FAILED:
            return {"": FAILED}
        read = partial(read_drives, self.folder / file.table, file.between, self._turns, file.rate)
        found = _read(read, reader.faults, file.table, ("drives", "table"))
        if found is FAILED:
            return {"": FAILED}
        self.columns = found.keys()
        for name in found.keys() & given.keys():
            reader.faults.add(("drives", name), f"is a column of {file.table} too; allowed: one of them")
        return dict(found)


def _read(read: Callable[[], Any], faults: Faults, name: str, place: Place) -> Any:
    """The content of a file that a place names; FAILED, with the reason among the faults."""
    try:
        return read()
    except InputError as error:  # which names the file itself
        faults.lines += str(error).splitlines()
    except (OSError, ValueError) as error:  # ValueError: of names that no file can have
        reason = getattr(error, "strerror", None) or error
        faults.wrong(place, name, f"a file that can be read ({reason})")
    return FAILED
