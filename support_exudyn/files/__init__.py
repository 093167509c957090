"""Scenarios and values as TOML files: read, with messages that name file, key, value and range; written."""

from typing import TYPE_CHECKING

from user_forces.values.places import offered

if TYPE_CHECKING:
    from support_exudyn.files.scenarios.drive_table import read_drives
    from support_exudyn.files.scenarios.scenario_file import (
        ScenarioFile,
        read_scenario,
        read_scenario_file,
        save_scenario,
        scenario_file_of,
        scenario_of,
        scenario_schema,
        scenario_text,
    )
    from support_exudyn.files.toml.reading import read_value
    from support_exudyn.files.toml.text import load_toml, parsed, toml_text
    from support_exudyn.files.toml.writing import table_of

__all__ = [
    "ScenarioFile",
    "load_toml",
    "parsed",
    "read_drives",
    "read_scenario",
    "read_scenario_file",
    "read_value",
    "save_scenario",
    "scenario_file_of",
    "scenario_of",
    "scenario_schema",
    "scenario_text",
    "table_of",
    "toml_text",
]

__getattr__, __dir__ = offered(
    __name__,
    {
        ".scenarios.drive_table": ("read_drives",),
        ".scenarios.scenario_file": (
            "ScenarioFile",
            "read_scenario",
            "read_scenario_file",
            "save_scenario",
            "scenario_file_of",
            "scenario_of",
            "scenario_schema",
            "scenario_text",
        ),
        ".toml.reading": ("read_value",),
        ".toml.text": ("load_toml", "parsed", "toml_text"),
        ".toml.writing": ("table_of",),
    },
)
