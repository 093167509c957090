"""The JSON Schema of scenarios' files."""

from __future__ import annotations

from typing import Any

from support_exudyn.files.machines.read import SHIPPED
from support_exudyn.files.scenarios.short_forms import DriveFile, DriveMode, DrivesFile
from support_exudyn.files.scenarios.short_pin import ShortPin
from support_exudyn.files.toml.schema import Schemas, without
from support_exudyn.files.toml.shapes import Group
from support_exudyn.model.columns import ColumnModel, TwoBodyColumn
from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.machine import Machine
from support_exudyn.model.pins import IdealPin, Pin
from support_exudyn.scenario.scenario import Scenario

HEAD = {
    "name": {"type": "string", "description": "what the scenario is called"},
    "description": {"type": "string", "description": "what it is for"},
    "errors": {
        "type": "boolean",
        "default": False,
        "description": "run it at half and at a quarter of its steps, too, so that every number has its error",
    },
}
MACHINE = {
    "type": "string",
    "description": f"path of a machine's file from the folder of this one on, or one of {', '.join(SHIPPED)}",
}


def scenario_schema() -> dict[str, Any]:
    """The JSON Schema (2020-12) of a scenario's TOML file, with all classes that are known by then.

    What only a whole scenario can tell (whether the machine has such a pin) is left to the reader.
    """
    schemas = Schemas()
    schemas.besides[Machine] = [MACHINE]
    schemas.besides[Pin] = [_short(schemas.table(ShortPin)), _ideal(schemas)]
    schemas.besides[Drive] = [_short(schemas.table(DriveMode)), _short(schemas.table(DriveFile))]
    top = schemas.table(Scenario)
    properties = top["properties"]
    drives = _short(schemas.table(DrivesFile))["properties"]
    properties["drives"] = {**properties["drives"], "properties": drives}
    properties["columns"] = {
        **properties["columns"],
        "additionalProperties": _columns(schemas),
    }
    return schemas.whole("scenario of support-exudyn", {**top, "properties": {**HEAD, **properties}})


def _short(table: dict[str, Any]) -> dict[str, Any]:
    """That of a short form, which says no type."""
    return without(table, "type")


def _ideal(schemas: Schemas) -> dict[str, Any]:
    table = _short(schemas.table(IdealPin))
    ideal = {"const": True, "description": "an ideal pin, as all are that no table speaks of"}
    return {**table, "properties": {"ideal": ideal, **table["properties"]}, "required": ["ideal"]}


def _columns(schemas: Schemas) -> dict[str, Any]:
    """Of columns: those of two bodies may leave out what the machine's file says."""
    kinds = Group((ColumnModel,)).kinds.values()
    tables = [
        schemas.table(kind, all_optional=True) if kind is TwoBodyColumn else schemas.value(kind)
        for kind in kinds
    ]
    return {"oneOf": [{"allOf": [table], "required": ["type"]} for table in tables]}
