"""`python -m studies adams`: the paper's rise, or a scenario of yours, written for ADAMS.

Three files: the dataset and the commands for ADAMS/Solver, and the mapping by which `compare` finds our
channels in the results. The paper's rise is written as a scenario, too; one of yours stays as it is.
"""

from dataclasses import replace
from pathlib import Path

from studies.adams.dataset import adams_dataset, solver_commands
from studies.common.paper_machine import PAPERS_LAW, SLIDING_COEFFICIENT, STEP, clearance_rise
from studies.common.study import work_in_folder
from support_exudyn import Scenario
from support_exudyn.commands.command_line import say
from support_exudyn.files import read_scenario, save_scenario
from support_exudyn.files.whole_file import whole_file
from user_forces.values.value import InputError

CLEARANCE_MM = 1.5
PAPER = "rise"  # name of the paper's files
MAPPING = "compare.toml"
LONGEST_NAME = 40


def paper_rise() -> Scenario:
    """The paper's rise, to the accuracy that is usual."""
    rise = clearance_rise(CLEARANCE_MM, SLIDING_COEFFICIENT, STEP, law=PAPERS_LAW)
    return replace(rise, accuracy="standard")


def write(scenario: Scenario, name: str, out: Path) -> list[Path]:
    """Write the files for ADAMS and the mapping into a folder; returns their paths.

    Raises InputError with a line for everything that there are no statements for; OSError if the folder cannot
    be written to.
    """
    dataset = adams_dataset(scenario, name)
    mapping = [
        "# Our channels, and what they are called in the results of ADAMS (names of requests and components).",
        "# ADAMS writes their units. `compare` takes this file by --map.",
        "",
        f'[files."{name}.res".columns]',
        *(f'"{channel}" = "{column}"' for channel, column in dataset.columns.items()),
    ]
    texts = {
        f"{name}.adm": dataset.text,
        f"{name}.acf": solver_commands(scenario, name),
        MAPPING: "\n".join(mapping) + "\n",
    }
    for file, text in texts.items():
        with whole_file(out / file) as temporary:
            temporary.write_text(text, encoding="ascii", newline="\n")
    return [out / file for file in texts]


def adams(scenario: Path | None = None, /, *, out: Path = Path("results") / "adams") -> int:
    """Write the paper's model, or a scenario of yours, for ADAMS. The command `python -m studies adams`.

    Args:
        scenario: A scenario's TOML file (the paper's rise).
        out: Folder for output (results/adams).
    """

    def work(out: Path) -> None:
        written_for = paper_rise() if scenario is None else read_scenario(scenario)
        name = PAPER if scenario is None else scenario.stem
        if not (name.isascii() and name.isidentifier() and len(name) <= LONGEST_NAME):
            raise InputError(
                f"{scenario}: ADAMS takes names of letters, digits and underscores; allowed: a file of such a "
                f"name, up to {LONGEST_NAME} letters"
            )
        written = write(written_for, name, out)
        if scenario is None:
            written.append(save_scenario(written_for, out / f"{name}.toml"))
        for path in written:
            say(str(path))
        say("not run in ADAMS here; see studies/adams/README.md")

    return work_in_folder(work, out)
