"""How studies are run: where, by how many processes, how large, and on whose machine."""

import os
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from studies.common.subject import Subject, own_subject, paper_subject
from support_exudyn.commands.command_line import Imports, at_most, import_modules, warn
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


@Parameter(name="*")
@dataclass(frozen=True)
class OptionWords:
    """How studies are run, as their command line says it.

    Args:
        out: Folder for output (results).
        workers: Processes (all cores).
        machines: Machines that claims draws (80; with --all more).
        runs: Scenes that extremes draws; blow: its small form.
        machine: Your machine or scenario in place of the paper's: a TOML file, or a shipped machine's name.
        pin: The pin of your machine that gets clearance (rear_base).
    """

    out: Path = Path("results")
    workers: Annotated[int, at_most(MOST_WORKERS)] = os.cpu_count() or 1
    machines: Annotated[int | None, at_most(MOST_MACHINES)] = None
    runs: Annotated[int | None, at_most(MOST_RUNS)] = None
    machine: Path | None = None
    pin: str | None = None
    imports: Imports = ()

    def options(self) -> Options:
        """The options that are meant. Raises InputError or OSError if the machine cannot be read."""
        if self.machine is None and self.pin is not None:
            raise InputError(f"--pin {self.pin}: allowed: together with --machine FILE")
        import_modules(self.imports)
        subject = own_subject(self.machine, self.pin) if self.machine else paper_subject()
        if subject.is_slow:
            only = "only the Exudyn formulation covers it: minutes, where --list prints seconds"
            warn(f"--machine {self.machine}: {only}")
        return Options(self.out, self.workers, self.out / KEPT, self.machines, self.runs, subject)
