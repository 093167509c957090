"""How studies are run: where, by how many processes, how large, and on whose machine."""

import argparse
import os
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

from studies.common.subject import Subject, own_subject, paper_subject
from support_exudyn.commands.command_line import count, folder, warn
from support_exudyn.commands.parser import add_imports, import_modules
from support_exudyn.sweeps.workers import Workers
from user_forces.values.value import InputError

MOST_WORKERS, MOST_MACHINES, MOST_RUNS = 1024, 100_000, 1_000_000
KEPT, WITNESSES = "kept", "witness"  # folders of runs, beside those of the studies


@dataclass(frozen=True)
class Options:
    """How studies are run.

    out: folder for output. workers: number of processes, or the pool that all studies share. kept: folder of
    runs that are made once and kept, see `studies.common.runs`; None: none is. machines: number of plausible
    machines that claims draws; runs: number of scenes that extremes draws; with any blow runs its small form;
    None: their own choice. subject: the machine and pin that the study is about. thorough: whether all studies
    are run, so that there is time for more machines.
    """

    out: Path
    workers: int | Workers = 1
    kept: Path | None = None
    machines: int | None = None
    runs: int | None = None
    subject: Subject = field(default_factory=paper_subject)
    thorough: bool = False

    @property
    def witnesses(self) -> Path | None:
        """The folder of runs of witnesses, beside that of kept runs; None: none is kept."""
        return None if self.kept is None else self.kept.with_name(WITNESSES)

    def of_study(self, name: str, workers: Workers) -> "Options":
        """These options for one of several studies, in a folder of its own."""
        return replace(self, out=self.out / name, workers=workers)


def add_options(parser: argparse.ArgumentParser, out: Path) -> None:
    """Add the options of studies to a command line; out: the default of the folder for output."""
    add = parser.add_argument
    add("--out", type=folder, default=out, metavar="DIR", help=f"folder for output ({out})")
    workers = partial(count, most=MOST_WORKERS)
    add("--workers", type=workers, default=os.cpu_count() or 1, metavar="N", help="processes (all cores)")
    machines = partial(count, most=MOST_MACHINES)
    add("--machines", type=machines, metavar="N", help="machines that claims draws (80; with --all more)")
    add(
        "--runs",
        type=partial(count, most=MOST_RUNS),
        metavar="N",
        help="scenes that extremes draws; blow: its small form",
    )
    own = "your machine or scenario in place of the paper's: a TOML file, or a shipped machine's name"
    add("--machine", type=folder, metavar="FILE", help=own)
    add_imports(parser)
    add("--pin", metavar="PIN", help="the pin of your machine that gets clearance (rear_base)")


def read_options(given: argparse.Namespace) -> Options:
    """The options of a command line.

    Raises InputError or OSError if the machine cannot be read.
    """
    if given.machine is None and given.pin is not None:
        raise InputError(f"--pin {given.pin}: allowed: together with --machine FILE")
    import_modules(given.imports)
    subject = own_subject(given.machine, given.pin) if given.machine else paper_subject()
    if subject.is_slow:
        only = "only the Exudyn formulation covers it: minutes where --list tells seconds"
        warn(f"--machine {given.machine}: {only}")
    return Options(given.out, given.workers, given.out / KEPT, given.machines, given.runs, subject)
