"""Scenarios as TOML files, and the JSON Schema of these files."""

import numbers
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from support_exudyn.files.machines.read import SHIPPED, load_machine, read_machine
from support_exudyn.files.scenarios.own_classes import without_places
from support_exudyn.files.scenarios.short_forms import (
    DriveFile,
    DrivesFile,
    ShortForms,
    read_machine_of,
)
from support_exudyn.files.scenarios.short_joints import ShortGuide, ShortPin
from support_exudyn.files.toml.faults import Faults
from support_exudyn.files.toml.reading import FAILED, Reader, plain_numbers
from support_exudyn.files.toml.schema import Schemas
from support_exudyn.files.toml.shapes import GroupShape, field_shapes
from support_exudyn.files.toml.text import load_toml, toml_text
from support_exudyn.files.toml.writing import table_of
from support_exudyn.files.whole_file import missing_file, whole_file
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.model.actuators import ActuatorModel, CylinderAndRod
from support_exudyn.model.drives.drive import Drive, Held, UniformSpeed
from support_exudyn.model.guides import Guide, IdealGuide
from support_exudyn.model.machine import Machine
from support_exudyn.model.pins import IdealPin, Pin
from support_exudyn.scenario.scenario import Scenario
from user_forces.values.sourced import SourcedNumber
from user_forces.values.units import ANGLES, LENGTHS
from user_forces.values.value import InputError, Value, value

OTHER_FILES = {  # by a key that they have
    "kind": "is the file of a machine; allowed: a scenario, which names it, `machine = FILE`; or `check` it",
    "scenario": "is the file of a sweep; allowed: a scenario; or `sweep` it",
    "instruments": "is a file of instruments; allowed: a scenario; or `measure RUN` with it",
    **dict.fromkeys(
        ("files", "units", "tolerances"),
        "is the file of a comparison; allowed: a scenario; or `compare` with it as --map",
    ),
}


@value
class ScenarioHead(Value):
    """The head of a scenario's file: all but the scenario.

    Arguments:
        name: what the scenario is called.
        description: what it is for.
        errors: run it at half and at a quarter of its steps, too, so that every number has its error.
    """

    name: str = ""
    description: str = ""
    errors: bool = False


HEAD = tuple(field_shapes(ScenarioHead))


@dataclass(frozen=True)
class ScenarioFile:
    """A scenario's file, read.

    scenario: what is run. name, description: of people, for people. errors: whether it is run with estimated
    errors, see `simulate`. assumed: of the machine, because its file does not say it, in sentences. warnings:
    what the files leave open or say twice, in sentences. bore_radii:
    that the machine's file says of its pins [m]. sourced: numbers of the file that say their range or their
    source, by their dotted keys, such as "actuators.leg.bulk_modulus_MPa", in the units of these.
    """

    scenario: Scenario
    name: str = ""
    description: str = ""
    errors: bool = False
    assumed: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()
    bore_radii: Mapping[str, float] = field(default_factory=dict)
    sourced: Mapping[str, SourcedNumber] = field(default_factory=dict)


def read_scenario(path: str | Path) -> Scenario:
    """The scenario of a TOML file.

    Raises InputError with a line for each thing that is wrong: file, key, value and what is allowed; OSError if
    the file cannot be read.
    """
    return read_scenario_file(path).scenario


def read_scenario_file(path: str | Path) -> ScenarioFile:
    """All that the TOML file of a scenario says. Raises as `read_scenario` does."""
    path = Path(path)
    try:
        table = load_toml(path)
    except FileNotFoundError as error:
        raise missing_file(path, "the TOML file of a scenario") from error
    return scenario_file_of(table, str(path), path.parent)


def read_machine_in(path: str | Path) -> MachineData:
    """The machine of a TOML file: of that of a machine, or of that of a scenario, whose rest is not read.

    Raises InputError that names file, key, value and what is allowed; OSError if a file cannot be read.
    """
    if str(path) in SHIPPED or not str(path).lower().endswith(".toml"):
        return read_machine(str(path))
    path = Path(path)
    try:
        table = load_toml(path)
    except FileNotFoundError:
        return load_machine(path)  # which says what there is
    if "machine" not in table:
        return load_machine(path)
    faults = Faults(str(path))
    table = without_places({"machine": table["machine"]}, faults, path.parent)
    table = plain_numbers(table, (), faults, {})
    faults.check()
    found = read_machine_of(table, faults, path.parent)
    faults.check()
    if found is None:
        raise InputError(f"{path}: machine: cannot be read")
    return found


def scenario_of(table: Mapping[str, Any], where: str, folder: Path) -> Scenario:
    """The scenario of a table that has been read already.

    Arguments:
        table: as `load_toml` gives it; a program may have put numbers of its own there, also floats.
        where: what errors call it: the name of its file.
        folder: from which the files lie that it names.

    Raises InputError as `read_scenario` does.
    """
    return scenario_file_of(table, where, folder).scenario


def scenario_file_of(
    table: Mapping[str, Any], where: str, folder: Path, sourced: dict[str, SourcedNumber] | None = None
) -> ScenarioFile:
    """All that a table says. Arguments and errors as of `scenario_of`.

    sourced: takes the numbers that say their range or their source, also where others are wrong or missing.
    """
    faults = Faults(where)
    sourced = {} if sourced is None else sourced
    table = without_places(table, faults, folder)
    faults.check()  # without these classes more would be wrong that is not
    table = plain_numbers(table, (), faults, sourced)
    head = Reader(faults).value(ScenarioHead, {key: table[key] for key in HEAD if key in table}, ())
    rest = {key: item for key, item in table.items() if key not in HEAD}
    other = next((said for key, said in OTHER_FILES.items() if key in rest and "machine" not in rest), "")
    if other:
        raise InputError(f"{where}: {other}")
    if rest.get("type", "Scenario") != "Scenario":
        faults.wrong(("type",), rest["type"], '"Scenario", or to leave it out')
    machine = read_machine_of(rest, faults, folder)
    scenario = _scenario(rest, faults, folder, machine, sourced)
    faults.check()
    assert machine is not None  # else it is among the faults
    warnings = list(machine.warnings)
    still = [name for name in scenario.driven if isinstance(scenario.drive_of(name), Held)]
    if still and "drive" not in rest and not any(name in scenario.drives for name in still):
        warnings.append(
            f"{', '.join(still)}: held, for the scenario has no [drive]; allowed: [drive], [drives.NAME], or "
            '[drive] type = "Held" for parts that are to stand still'
        )
    return ScenarioFile(
        scenario,
        head.name,
        head.description,
        head.errors,
        machine.assumed,
        tuple(warnings),
        machine.bore_radii,
        sourced,
    )


def _scenario(
    table: dict[str, Any],
    faults: Faults,
    folder: Path,
    machine: MachineData | None,
    sourced: Mapping[str, SourcedNumber],
) -> Any:
    """A scenario, or FAILED."""
    forms = ShortForms(folder, machine, table)
    shorts = {Pin: forms.pin, Guide: forms.guide, ActuatorModel: forms.actuator, Drive: forms.drive}
    reader = Reader(faults, {**shorts, Machine: forms.machine}, sourced)
    apart = forms.drives(reader, table)
    if apart:
        own = {name: one for name, one in table["drives"].items() if isinstance(one, dict)}
        table = {**table, "drives": {**apart, **own}}
    found = reader.value(Scenario, {"machine": "", **table}, (), also=HEAD)  # that it is missing has been said
    return FAILED if FAILED in apart.values() else found


def simple_scenario(machine: str | Path | Machine | MachineData, **keys: Any) -> Scenario:
    """A scenario in few words: the keys of a scenario's file, which say their units.

        pins = {"rear_base": {"clearance_mm": 0.5, "friction": 0.1}}
        simple_scenario("zf18000", duration_s=5, drive={"mode": 2}, pins=pins)

    Radii of bores and the stroke come from the machine's file, as they do for a scenario's file.

    Arguments:
        machine: the name of one that comes with the package, the path of a machine data file, or the machine.
        keys: as in files; what is a table there is a dictionary, or the value itself, such as `CubicStep()`.
            Files that are named lie from the working directory on.

    Raises InputError with a line for each thing that is wrong: key, value and what is allowed.
    """
    return scenario_of({"machine": _written(machine), **_written(keys)}, "", Path())


def _written(item: Any) -> Any:
    """An item as a file would have it: tables, lists, texts and plain numbers; values stay."""
    if isinstance(item, Mapping):
        return {key: _written(one) for key, one in item.items()}
    if isinstance(item, (list, tuple)):
        return [_written(one) for one in item]
    if isinstance(item, bool) or not isinstance(item, (numbers.Real, Path)):
        return item.tolist() if hasattr(item, "tolist") else item
    if isinstance(item, Path):
        return str(item)
    return int(item) if isinstance(item, numbers.Integral) else float(item)


def scenario_text(scenario: Scenario, name: str = "", description: str = "", errors: bool = False) -> str:
    """A scenario as TOML, in full: `read_scenario` gives an equal one, to the bit.

    Raises InputError if it holds a value of a class that files have no form for.
    """
    head = table_of(ScenarioHead(name=name, description=description, errors=errors), says_type=False)
    table = table_of(scenario, says_type=False)
    linkage = scenario.machine.linkage()
    table["drives"] = {
        name: table_of(one, endings=ANGLES if name in linkage.cranks else LENGTHS)
        for name, one in scenario.drives.items()
    }
    turning = {name in linkage.cranks for name in linkage.driven if name not in scenario.drives}
    table["drive"] = table_of(scenario.drive, endings=ANGLES if True in turning else LENGTHS)
    table = {key: item for key, item in table.items() if item != {}}
    return toml_text({key: item for key, item in head.items() if item} | table)


def save_scenario(
    scenario: Scenario, path: str | Path, name: str = "", description: str = "", errors: bool = False
) -> Path:
    """Write a scenario as TOML, whole or not at all.

    Raises InputError as `scenario_text` does, OSError that names the file if it cannot be written.
    """
    text = scenario_text(scenario, name, description, errors)
    with whole_file(path) as temporary:
        temporary.write_text(text, encoding="utf-8", newline="\n")
    return Path(path)


def scenario_schema() -> dict[str, Any]:
    """The JSON Schema (2020-12) of a scenario's TOML file, with all classes that are known by then.

    What only a whole scenario can tell (whether the machine has such a pin) is left to the reader.
    """
    schemas = Schemas()
    about = f"path of a machine's file from the folder of this one on, or one of {', '.join(SHIPPED)}"
    schemas.besides[Machine] = [{"type": "string", "description": about}]
    ideal = {"ideal": {"const": True, "description": "ideal, as all are that no table speaks of"}}
    for base, kind, short in ((Pin, IdealPin, ShortPin), (Guide, IdealGuide, ShortGuide)):
        schemas.besides[base] = [schemas.table(short, typed=False), _with_key(schemas, kind, ideal)]
    modes = "1: constant speed from rest, without transition (`UniformSpeed`); 2: a smooth inlet (`CubicStep`)."
    mode = _with_key(schemas, UniformSpeed, {"mode": {"enum": [1, 2], "description": modes}})
    mode["description"] = (
        "A stroke in one of the paper's drive modes, by default the stroke of the machine's file."
    )
    schemas.besides[Drive] = [mode, schemas.table(DriveFile, typed=False)]
    top = schemas.table(Scenario)
    properties = {**schemas.table(ScenarioHead, typed=False)["properties"], **top["properties"]}
    drives = schemas.table(DrivesFile, typed=False)["properties"]
    properties["drives"] = {**properties["drives"], "properties": drives}
    tables = [  # those of two bodies may leave out what the machine's file has
        schemas.table(kind, all_optional=True) if kind is CylinderAndRod else schemas.value(kind)
        for kind in GroupShape((ActuatorModel,)).kinds.values()
    ]
    actuators = {"oneOf": [{"allOf": [table], "required": ["type"]} for table in tables]}
    properties["actuators"] = {**properties["actuators"], "additionalProperties": actuators}
    return schemas.whole("scenario of support-exudyn", {**top, "properties": properties})


def _with_key(schemas: Schemas, kind: type[Value], key: dict[str, Any]) -> dict[str, Any]:
    """The schema of a short form that a key marks, in place of its type."""
    table = schemas.table(kind, typed=False)
    return {**table, "properties": {**key, **table["properties"]}, "required": list(key)}
