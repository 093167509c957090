"""`schema KIND`: the JSON Schema of a kind of file, for editors."""

import argparse
import json
from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from typing import Any

from support_exudyn.commands.command_line import add_out, say
from support_exudyn.files.whole_file import whole_file

HELP = "the JSON Schema of scenario files, or of machine files, by which editors complete and check them"
# where the schemas are made: module and function
MADE_BY = {
    "scenario": ("support_exudyn.files", "scenario_schema"),
    "machine": ("support_exudyn.files.machines", "machine_schema"),
}
KINDS = tuple(kind for kind, (module, _) in MADE_BY.items() if find_spec(module) is not None)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Which one, and where it goes."""
    parser.add_argument("kind", choices=KINDS, metavar="KIND", help=" or ".join(KINDS))
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
    text = json.dumps(make(), indent=1, ensure_ascii=False)
    if given.out is None:
        say(text)
        return
    with whole_file(given.out) as temporary:
        temporary.write_text(text + "\n", encoding="utf-8")
    say(str(given.out))
