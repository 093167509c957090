"""Machine data files (TOML; mm, kg, degrees) and their readers; those of the package's machines lie here."""

from support_exudyn.files.machines.read import (
    SHIPPED,
    cylinders_and_rods,
    load_machine,
    machine,
    machine_schema,
    read_machine,
    reference_support,
    shipped,
)

__all__ = [
    "SHIPPED",
    "cylinders_and_rods",
    "load_machine",
    "machine",
    "machine_schema",
    "read_machine",
    "reference_support",
    "shipped",
]
