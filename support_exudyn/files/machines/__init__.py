"""Machine data files (TOML; mm, kg, degrees) and their readers.

Data files of the machines that come with the package lie here, and the file form of each kind of machine, one
a module. A further kind is a module with a subclass of `form.MachineForm` called `Form`, and its name in
`read.KINDS`.
"""

from support_exudyn.files.machines.read import (
    SHIPPED,
    load_machine,
    load_support,
    machine_schema,
    reference_support,
    shipped,
    two_body_columns,
)

__all__ = [
    "SHIPPED",
    "load_machine",
    "load_support",
    "machine_schema",
    "reference_support",
    "shipped",
    "two_body_columns",
]
