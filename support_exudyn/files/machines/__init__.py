"""Machine data files (TOML; mm, kg, degrees) and their readers; those of the package's machines lie here."""

from support_exudyn.files.machines.read import (
    SHIPPED,
    load_machine,
    load_support,
    machine_schema,
    read_machine,
    reference_support,
    shipped,
    two_body_columns,
)

__all__ = [
    "SHIPPED",
    "load_machine",
    "load_support",
    "machine_schema",
    "read_machine",
    "reference_support",
    "shipped",
    "two_body_columns",
]
