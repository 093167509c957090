"""Commands about files before a run: `init`, `channels`, `scenario`, `schema`, and `docs`."""

import argparse
import json
from collections.abc import Callable
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Any

from rich.console import Console

from support_exudyn.commands.command_line import Parser, add_json, add_out, add_run, answer, say
from support_exudyn.commands.tables import printed, show_table
from support_exudyn.files import save_scenario, scenario_text
from support_exudyn.files.starters import KINDS, write_starter
from support_exudyn.files.whole_file import whole_file
from support_exudyn.postprocessing.known_channels import ALLOWED, HEADER, channels
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

# --- init ---


def add_init(parser: argparse.ArgumentParser) -> None:
    """Which set, and where it goes."""
    parser.add_argument(
        "kind",
        nargs="?",
        choices=tuple(KINDS),
        default="four_column_support",
        metavar="KIND",
        help="; ".join(f"{kind}: {what}" for kind, (what, _) in KINDS.items()),
    )
    add_out(parser, "write the files there (a folder named KIND)")


def run_init(given: argparse.Namespace) -> None:
    """Write them, and say what they are."""
    for path in write_starter(given.kind, given.out or Path(given.kind)):
        say(str(path))


# --- channels ---


def add_channels(parser: argparse.ArgumentParser) -> None:
    """The file, and which channels."""
    parser.add_argument("file", metavar="FILE", help=ALLOWED)
    parser.add_argument(
        "channels",
        nargs="*",
        default=[],
        metavar="CHANNEL",
        help="only these: names or patterns, such as 'pin.*.force'",
    )
    add_json(parser)


def run_channels(given: argparse.Namespace) -> None:
    """Print the table, or the object."""
    found = channels(given.file, *given.channels)
    if given.json:
        answer({name: one._asdict() for name, one in found.items()})
        return
    title = f"{given.file}: {len(found)} channels"
    printed(lambda console: show_table(console, title, HEADER, found.rows()))


# --- scenario ---


def add_scenario(parser: argparse.ArgumentParser) -> None:
    """The run's file, and where the scenario goes."""
    add_run(parser)
    add_out(parser, "write it there, not to standard output", "FILE")


def run_scenario(given: argparse.Namespace) -> None:
    """Write it, or print it."""
    result = Result.load(given.run)
    scenario, errors = asked(result)
    if given.out is None:
        say(scenario_text(scenario, errors=errors).rstrip("\n"))
    else:
        say(str(save_scenario(scenario, given.out, errors=errors)))


def asked(result: Result) -> tuple[Scenario, bool]:
    """What makes a result again, with its errors: the scenario, and whether `errors` have to be asked for.

    A run to an accuracy is asked for by that again: it then finds the same settings.
    """
    if result.goal is not None:
        return replace(result.scenario, accuracy=result.goal), False
    first = result
    while first.coarser is not None:  # the one that was given, of which the others are finer
        first = first.coarser
    return first.scenario, result.coarser is not None


# --- schema ---

# where the schemas are made: module and function
MADE_BY = {
    "scenario": ("support_exudyn.files", "scenario_schema"),
    "machine": ("support_exudyn.files.machines", "machine_schema"),
}


def add_schema(parser: argparse.ArgumentParser) -> None:
    """Which one, and where it goes."""
    parser.add_argument("kind", choices=tuple(MADE_BY), metavar="KIND", help=" or ".join(MADE_BY))
    parser.add_argument(
        "--list", action="store_true", help="a table of all keys: what they take, their defaults and meanings"
    )
    add_out(
        parser,
        "write it there, not to standard output; `#:schema FILE` as the first line of a TOML file then "
        "lets editors with Taplo (Even Better TOML) complete and check it",
        "FILE",
    )


def run_schema(given: argparse.Namespace) -> None:
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


# --- docs ---


def add_docs(parser: argparse.ArgumentParser) -> None:
    """Where it goes."""
    add_out(parser, "folder of the site (site)")


def run_docs(given: argparse.Namespace) -> None:
    """Build it, and say where it begins."""
    from support_exudyn.documentation.site import build_site

    out = given.out or Path("site")
    build_site(out, _commands())
    say(str(out / "index.html"))
    say(f"next, for its search: python -m http.server --directory {out}")


def _commands() -> str:
    """The page on commands: the help of each."""
    commands = import_module("support_exudyn.commands.parser")  # which imports this when it is asked for
    names: dict[str, str] = commands.NAMES
    parts = ["# Commands\n\n`support-exudyn COMMAND ...`, or `python -m support_exudyn COMMAND ...`"]
    for name, does in names.items():
        line = Parser(prog=f"support-exudyn {name}", description=f"{does[:1].upper()}{does[1:]}.")
        commands.command(name).add_arguments(line)
        parts.append(f"## {name}\n\n```text\n{line.format_help().strip()}\n```")
    return "\n\n".join(parts) + "\n"
