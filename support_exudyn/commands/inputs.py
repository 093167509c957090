"""Commands about files before a run: `init`, `channels`, `scenario`, `schema`, and `docs`."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from support_exudyn.commands.command_line import Json, among, answer, say, show_table, write_or_say
from support_exudyn.files import scenario_schema, scenario_text
from support_exudyn.files.machines import machine_schema
from support_exudyn.files.starters import KINDS, write_starter
from support_exudyn.postprocessing.known_channels import ALLOWED, HEADER
from support_exudyn.postprocessing.known_channels import channels as known_channels
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

STARTERS = "; ".join(f"{kind}: {what}" for kind, (what, _) in KINDS.items())
SCHEMAS = {"scenario": scenario_schema, "machine": machine_schema}


def init(
    kind: Annotated[str, among(KINDS, STARTERS)] = "four_column_support", /, *, out: Path | None = None
) -> None:
    """Write a set of files, and print their names.

    Args:
        out: Folder for the files (a folder named KIND).
    """
    for path in write_starter(kind, out or Path(kind)):
        say(path)


def channels(
    file: Annotated[str, Parameter(help=f"{ALLOWED[:1].upper()}{ALLOWED[1:]}.")],
    /,
    *channels: str,
    json: Json = False,
) -> None:
    """Print all channels of a scenario or a machine.

    Args:
        channels: Only these: names or patterns, such as `pin.*.force`.
    """
    found = known_channels(file, *channels)
    if json:
        answer({name: channel._asdict() for name, channel in found.items()})
    else:
        show_table(f"{file}: {len(found)} channels", HEADER, found.rows())


def scenario(run: Path, /, *, out: Path | None = None) -> None:
    """Write the scenario of a run, or print it.

    Args:
        run: File of a run.
        out: File for the scenario (standard output).
    """
    again, errors = asked(Result.load(run))
    write_or_say(scenario_text(again, errors=errors), out)


def asked(result: Result) -> tuple[Scenario, bool]:
    """What makes a result again, with its errors: the scenario, and whether `errors` have to be asked for.

    A run to an accuracy is asked for by that again, which chooses the same settings.
    """
    if result.goal is not None:
        return replace(result.scenario, accuracy=result.goal), False
    first = result
    while first.coarser is not None:  # the run at the given settings, of which the others are finer
        first = first.coarser
    return first.scenario, result.coarser is not None


def schema(
    kind: Literal["scenario", "machine"],
    /,
    *,
    list: bool = False,  # noqa: A002, the option's name
    out: Path | None = None,
) -> None:
    """Write the schema of a kind of file, or print it.

    Args:
        kind: Of the file.
        list: Print a table of all keys instead: what they take, their defaults and meanings.
        out: File for the schema (standard output). `#:schema FILE` as the first line of a TOML file then lets
            editors with Taplo (Even Better TOML) complete and check it.
    """
    found = SCHEMAS[kind]()
    if list:
        from support_exudyn.documentation.keys import key_tables

        if out is not None:
            raise InputError(f"--out {out}: is of the schema; allowed with --list: without it")
        for name, rows in key_tables(found).items():
            show_table(name or f"a {kind}'s file", ("key", "default", "meaning"), rows)
        return
    write_or_say(f"{json.dumps(found, indent=1, ensure_ascii=False)}\n", out)


def docs(*, out: Path = Path("site")) -> None:
    """Build the site of the documentation, and print where it begins.

    Args:
        out: Folder of the site (site).
    """
    from support_exudyn.commands.app import app  # which imports this module for this command
    from support_exudyn.documentation.site import build_site

    build_site(out, app.generate_docs())
    say(out / "index.html")
    say(f"next, for its search: python -m http.server --directory {out}")
