"""The commands of `support-exudyn`, in groups, and how a command line is carried out.

A command is a function of its name in a module of this room. Its arguments are those of the command line:
positional arguments are names, keyword-only arguments are options, and their help stands in its docstring. It
raises InputError, OSError or SimulationError, and returns an exit code or nothing. Its module is imported when
the command line names it.
"""

import warnings
from collections.abc import Sequence
from difflib import get_close_matches
from typing import Annotated, Any

from cyclopts import CycloptsError, Group, Parameter

from support_exudyn.commands import command_line as cli
from support_exudyn.scene.contract import error_text
from support_exudyn.simulation.at_start import INSTALLED, be_interruptible
from user_forces.values.names import InputError

COMMANDS = {  # by group: of every command its module and a line of what it does
    "Before a run": {
        "init": ("before_runs", "write a commented set of files to start from: machine, scenarios, sweep"),
        "check": ("before_runs", "draw a machine; report mobility, dead centres, static forces, and doubts"),
        "stand": ("before_runs", "what a support must stand: its force, yield, buckling, tipping, on a page"),
        "channels": ("before_runs", "all channels of a scenario or a machine: names, units, meanings"),
        "schema": ("before_runs", "keys of scenario or machine files, as a table or a JSON Schema for editors"),
    },
    "Run": {
        "run": ("runs", "simulate a scenario's file and save the run"),
        "sweep": ("sweeps", "run a scenario with fields of it varied, into a store that can be continued"),
    },
    "Look at runs": {
        "show": ("runs", "tables of what a run or a sweep was and what came out of it"),
        "plot": ("runs", "figures of runs: channels, journal orbit, force spectrum"),
        "report": ("outputs", "a page on runs: what was run, numbers with errors, live figures, a picture"),
        "render": ("outputs", "ray-traced frames and a movie of a run, without a display"),
        "view": ("outputs", "open Exudyn's solution viewer on a run"),
    },
    "Look at sweeps": {
        "chart": ("sweeps", "figure of a sweep: a number over a varied field, a histogram, or a tornado"),
        "table": ("sweeps", "table of a sweep's runs for a text, as Markdown, CSV or LaTeX"),
    },
    "Compare": {
        "compare": ("compare", "by how much runs, measurements and results of other programs differ"),
        "baseline": ("compare", "keep what scenarios come out at, and report what has changed since"),
    },
    "Write for other programs": {
        "export": ("outputs", "moving meshes for ParaView (VTU) and tables of channels (CSV, HDF5)"),
        "measure": ("outputs", "what instruments on the machine read of a run, as a table (CSV)"),
        "scenario": ("before_runs", "the scenario of a run as a TOML file, which `run` takes"),
        "docs": ("before_runs", "build the documentation as a site; needs the extra [docs]"),
    },
}
HELP = (
    "COMMAND --help lists what a command takes; options may stand before, between and behind names. Results "
    "go to standard output, progress and warnings to standard error. Files are written whole or not at all."
)
EPILOGUE = f"""{HELP}

Exit codes:

- 0: done
- 1: not done, for a reason that is printed in one line; of compare: not within tolerance
- 2: the command line cannot be read; of compare: nothing was compared
- 3: a sweep is done, but some of its runs failed
- 130: interrupted
"""


def _versions() -> str:
    from support_exudyn.simulation.provenance import versions

    return "\n".join(map(" ".join, versions().items()))


app = cli.new_app(
    INSTALLED,
    "Dynamics of linkages with clearance in their joints.",
    help_epilogue=EPILOGUE,
    help_format="plaintext",  # the library for markdown takes as long to import as all the rest
    version=_versions,
    version_format="plaintext",
)
MARKDOWN: dict[str, Any] = {"help_epilogue": "", "help_format": "markdown"}  # of a single command
for _title, _commands in COMMANDS.items():
    _group = Group.create_ordered(_title)
    for _name, (_module, _does) in _commands.items():
        _place = f"{__package__}.{_module}:{_name}"
        app.command(_place, name=_name, help=f"{_does[:1].upper()}{_does[1:]}.", group=_group, **MARKDOWN)
app.register_install_completion_command(name="--install-completion", group="Completion")


@app.meta.default
def _launch(
    *words: Annotated[str, Parameter(show=False, allow_leading_hyphen=True)], imports: cli.Imports = ()
) -> int | None:
    """Carry out a command; its libraries are imported before it may be interrupted with an exception.

    A mistyped command is refused here: the library would import all commands to list those that it shows. An
    unexpected error in a module of the user's own is an InputError.
    """
    known = list(app)
    if words and words[0] not in known:
        near = get_close_matches(words[0][:80], known, 1)
        guess = f'Did you mean "{near[0]}"? ' if near else ""
        raise CycloptsError(msg=f'Unknown command "{words[0][:80]}". {guess}Allowed: {", ".join(known)}')
    command, bound, _ = app.parse_args(words)
    be_interruptible()
    cli.import_modules(imports)
    try:
        with warnings.catch_warnings():
            warnings.showwarning = lambda message, *_: cli.warn(f"warning: {message}")
            code: int | None = command(*bound.args, **bound.kwargs)
    except Exception as error:
        if not imports or isinstance(error, (*cli.mendable(), MemoryError)):
            raise
        raise InputError(f"{', '.join(f'--import {name}' for name in imports)}: {error_text(error)}") from error
    return code


def main(argv: Sequence[str] | None = None) -> int:
    """Do what the command line asks for. Returns the exit code."""
    return cli.carry_out(app.meta, argv)
