"""Commands before a run: `init`, `check`, `stand`, `channels`, `schema`; of files: `scenario`, and `docs`."""

import json as texts
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter
from cyclopts.validators import Number

from support_exudyn.commands import command_line as cli
from support_exudyn.files.machines import SHIPPED
from support_exudyn.files.starters import KINDS, write_starter
from support_exudyn.postprocessing import known_channels
from user_forces.values.value import InputError

STARTERS = "; ".join(f"{kind}: {what}" for kind, (what, _) in KINDS.items())
A_MACHINE = (
    "A machine's data file, a path that ends in .toml; or a scenario's file; or a machine that comes with the "
    f"package: {', '.join(SHIPPED)}."
)
MachineFile = Annotated[str, Parameter(help=A_MACHINE)]
Stroke = Annotated[float, Parameter(validator=Number(gte=-1e5, lte=1e5))]  # [mm]
A_SCENE = f"{known_channels.ALLOWED[:1].upper()}{known_channels.ALLOWED[1:]}."


def init(
    kind: Annotated[str, cli.among(KINDS, STARTERS)] = "four_column_support", /, *, out: Path | None = None
) -> None:
    """Write a set of files, and print their names.

    Args:
        out: Folder for the files (a folder named KIND).
    """
    for path in write_starter(kind, out or Path(kind)):
        cli.say(path)


def check(
    machine: MachineFile,
    /,
    *,
    out: Annotated[Path | None, cli.FIGURES] = None,
    stroke_mm: Stroke | None = None,
    json: cli.Json = False,
) -> None:
    """Print what is known of a machine, and draw it.

    Args:
        out: Folder of the figure (next to the file, or here), or its file (.png, .pdf, .svg).
        stroke_mm: By how much the actuators extend from the start on [mm] (that of the file).
    """
    from support_exudyn.postprocessing.checked_machine import CheckedMachine
    from support_exudyn.postprocessing.figures import style
    from support_exudyn.postprocessing.figures.linkage_check import check_figure
    from support_exudyn.postprocessing.figures.of_runs import save_figures

    checked = CheckedMachine.of(machine, None if stroke_mm is None else stroke_mm / 1e3)
    folder = Path(machine).parent if Path(machine).suffix.lower() == ".toml" else Path()
    name = f"{_stem(machine)}_check"
    with style.look():
        figures = save_figures({name: check_figure(checked.report)}, out, folder, cli.is_file(out))[name]
    cli.put(json, checked.data() | {"figures": figures}, *checked.lines(), "", *figures)


def stand(
    machine: MachineFile,
    /,
    *,
    figure: Annotated[Path | None, cli.FIGURES] = None,
    json: cli.Json = False,
) -> None:
    """Print what a support must stand, and draw it. Its file has a section [strength].

    Args:
        figure: Folder, or file (.png, .pdf, .svg), of a figure of the support force over height and canopy,
            and of the forces in pins.
    """
    from support_exudyn.files.scenarios.scenario_file import read_machine_in
    from support_exudyn.machines.strength import stand as computed
    from support_exudyn.machines.strength.page import page
    from support_exudyn.postprocessing.figures import style
    from support_exudyn.postprocessing.figures.of_runs import save_figures
    from support_exudyn.postprocessing.figures.stand import stand_figure

    data = read_machine_in(machine)
    try:
        report = computed(data)
    except InputError as error:
        raise InputError(f"{machine}: {error}") from None
    figures: list[Path] = []
    if figure:
        name = f"{_stem(machine)}_stand"
        with style.look():
            drawings = {name: stand_figure(report)}
            figures = save_figures(drawings, figure, Path(), cli.is_file(figure))[name]
    cli.put(json, {**report.data(), "figures": figures}, *page(report), *figures)


def _stem(machine: str) -> str:
    """The name of a machine's figures."""
    path = Path(machine)
    return path.stem if path.suffix.lower() == ".toml" else machine


def channels(
    file: Annotated[str, Parameter(help=A_SCENE)],
    /,
    *channels: str,
    json: cli.Json = False,
) -> None:
    """Print all channels of a scenario or a machine.

    Args:
        channels: Only these: names or patterns, such as `pin.*.force`.
    """
    known = known_channels.channels(file, *channels)
    if json:
        cli.answer({name: channel._asdict() for name, channel in known.items()})
    else:
        cli.show_table(f"{file}: {len(known)} channels", known_channels.HEADER, known.rows())


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
    from support_exudyn.documentation.keys import key_tables
    from support_exudyn.files import scenario_schema
    from support_exudyn.files.machines import machine_schema

    known = scenario_schema() if kind == "scenario" else machine_schema()
    if not list:
        cli.write_or_say(f"{texts.dumps(known, indent=1, ensure_ascii=False)}\n", out)
        return
    if out is not None:
        raise InputError(f"--out {out}: is of the schema; allowed with --list: without it")
    for name, rows in key_tables(known).items():
        cli.show_table(name or f"a {kind}'s file", ("key", "default", "meaning"), rows)


def scenario(run: Path, /, *, out: Path | None = None) -> None:
    """Write the scenario of a run, or print it.

    A run to an accuracy is asked for by that again, which chooses the same settings.

    Args:
        run: File of a run.
        out: File for the scenario (standard output).
    """
    from support_exudyn.files import scenario_text
    from support_exudyn.simulation.result import Result

    result = Result.load(run)
    if result.goal is not None:
        again, errors = replace(result.scenario, accuracy=result.goal), False
    else:
        first = result
        while first.coarser is not None:  # the run at the given settings, of which the others are finer
            first = first.coarser
        again, errors = first.scenario, result.coarser is not None
    cli.write_or_say(scenario_text(again, errors=errors), out)


def docs(*, out: Path = Path("site")) -> None:
    """Build the site of the documentation, and print where it begins.

    Args:
        out: Folder of the site (site).
    """
    from support_exudyn.commands.app import app  # which imports this module for this command
    from support_exudyn.documentation.site import build_site

    build_site(out, app.generate_docs())
    cli.say(out / "index.html")
    cli.say(f"next, for its search: python -m http.server --directory {out}")
