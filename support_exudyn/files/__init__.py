"""Scenarios and values as TOML files: read, with messages that name file, key, value and range; written."""

from typing import TYPE_CHECKING

from user_forces.values.places import for_types, offered

if TYPE_CHECKING:
    from support_exudyn.files.scenarios.drive_table import read_drives as read_drives
    from support_exudyn.files.scenarios.scenario_file import ScenarioFile as ScenarioFile
    from support_exudyn.files.scenarios.scenario_file import read_scenario as read_scenario
    from support_exudyn.files.scenarios.scenario_file import read_scenario_file as read_scenario_file
    from support_exudyn.files.scenarios.scenario_file import save_scenario as save_scenario
    from support_exudyn.files.scenarios.scenario_file import scenario_file_of as scenario_file_of
    from support_exudyn.files.scenarios.scenario_file import scenario_of as scenario_of
    from support_exudyn.files.scenarios.scenario_file import scenario_schema as scenario_schema
    from support_exudyn.files.scenarios.scenario_file import scenario_text as scenario_text
    from support_exudyn.files.toml.reading import read_value as read_value
    from support_exudyn.files.toml.text import load_toml as load_toml
    from support_exudyn.files.toml.text import parsed as parsed
    from support_exudyn.files.toml.text import toml_text as toml_text
    from support_exudyn.files.toml.writing import table_of as table_of

__getattr__, __dir__ = offered(__name__, for_types(__file__))
