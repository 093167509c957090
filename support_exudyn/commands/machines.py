"""Commands about machines before a run: `check` draws and checks a machine, `stand` computes its strength."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter
from cyclopts.validators import Number

from support_exudyn.commands.command_line import FIGURES, Json, is_file, put
from support_exudyn.files.machines import SHIPPED
from support_exudyn.files.scenarios.scenario_file import read_machine_in
from user_forces.values.value import InputError

FARTHEST = 1e5  # [mm]
A_MACHINE = (
    "A machine's data file, a path that ends in .toml; or a scenario's file; or a machine that comes with the "
    f"package: {', '.join(SHIPPED)}."
)
MachineFile = Annotated[str, Parameter(help=A_MACHINE)]


def check(
    machine: MachineFile,
    /,
    *,
    out: Annotated[Path | None, FIGURES] = None,
    stroke_mm: Annotated[float | None, Parameter(validator=Number(gte=-FARTHEST, lte=FARTHEST))] = None,
    json: Json = False,
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
        figures = save_figures({name: check_figure(checked.report)}, out, folder, is_file(out))[name]
    put(json, checked.data() | {"figures": figures}, *checked.lines(), "", *figures)


def _stem(machine: str) -> str:
    """The name of a machine's figures."""
    path = Path(machine)
    return path.stem if path.suffix.lower() == ".toml" else machine


def stand(
    machine: MachineFile, /, *, figure: Annotated[Path | None, FIGURES] = None, json: Json = False
) -> None:
    """Print what a support must stand, and draw it. Its file has a section [strength].

    Args:
        figure: Folder, or file (.png, .pdf, .svg), of a figure of the support force over height and canopy,
            and of the forces in pins.
    """
    from support_exudyn.machines.strength import stand as computed  # and scipy
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
            figures = save_figures({name: stand_figure(report)}, figure, Path(), is_file(figure))[name]
    put(json, {**report.data(), "figures": figures}, *page(report), *figures)
