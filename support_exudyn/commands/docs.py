"""`docs`: the documentation as a site."""

import argparse
from importlib import import_module
from pathlib import Path

from support_exudyn.commands.command_line import Parser, add_out, folder, say


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Where it goes, and what the studies have left."""
    add_out(parser, "folder of the site (site)")
    parser.add_argument(
        "--results",
        type=folder,
        metavar="DIR",
        help="folder of a run of the studies, for the page on their findings",
    )


def run(given: argparse.Namespace) -> None:
    """Build it, and say where it begins."""
    from support_exudyn.documentation.site import build_site

    out = given.out or Path("site")
    build_site(out, _commands(), given.results)
    say(str(out / "index.html"))
    say(f"next, for its search: python -m http.server --directory {out}")


def _commands() -> str:
    """The page on commands: the help of each."""
    names: dict[str, str] = import_module("support_exudyn.commands.parser").NAMES
    parts = ["# Commands\n\n`support-exudyn COMMAND ...`, or `python -m support_exudyn COMMAND ...`"]
    for name, does in names.items():
        one = import_module(f"support_exudyn.commands.{name}")
        parser = Parser(prog=f"support-exudyn {name}", description=f"{does[:1].upper()}{does[1:]}.")
        one.add_arguments(parser)
        parts.append(f"## {name}\n\n```text\n{parser.format_help().strip()}\n```")
    return "\n\n".join(parts) + "\n"
