"""`schema KIND`: the keys of a kind of file, as JSON Schema for editors or as a table."""

import argparse
import json
from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from typing import Any

from rich.console import Console

from support_exudyn.commands.command_line import add_out, say
from support_exudyn.commands.tables import printed, show_table
from support_exudyn.files.whole_file import whole_file
from user_forces.values.value import InputError

# where the schemas are made: module and function
MADE_BY = {
    "scenario": ("support_exudyn.files", "scenario_schema"),
    "machine": ("support_exudyn.files.machines", "machine_schema"),
}
KINDS = tuple(kind for kind, (module, _) in MADE_BY.items() if find_spec(module) is not None)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Which one, and where it goes."""
    parser.add_argument("kind", choices=KINDS, metavar="KIND", help=" or ".join(KINDS))
    parser.add_argument(
        "--list", action="store_true", help="a table of all keys: what they take, their defaults and meanings"
    )
    add_out(
        parser,
        "write it there, not to standard output; `#:schema FILE` as the first line of a TOML file then "
        "lets editors with Taplo (Even Better TOML) complete and check it",
        "FILE",
    )


def run(given: argparse.Namespace) -> None:
    """Write it, or print it."""
    module, function = MADE_BY[given.kind]
    make: Callable[[], dict[str, Any]] = getattr(import_module(module), function)
    if given.list:
        if given.out is not None:
            raise InputError(f"--out {given.out}: is of the schema; allowed with --list: without it")
        printed(lambda console: _tell(console, f"a {given.kind}'s file", make()))
        return
    text = json.dumps(make(), indent=1, ensure_ascii=False)
    if given.out is None:
        say(text)
        return
    with whole_file(given.out) as temporary:
        temporary.write_text(text + "\n", encoding="utf-8")
    say(str(given.out))


def _tell(console: Console, file: str, schema: dict[str, Any]) -> None:
    """Print a table of keys for the file, and one for every class that its tables can be."""
    from support_exudyn.documentation.keys import key_tables

    for name, rows in key_tables(schema).items():
        if rows:
            show_table(console, name or file, ("key", "default", "meaning"), rows)
