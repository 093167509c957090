"""How studies are run: where, by how many processes, how large, and on whose machine."""

from dataclasses import dataclass, field
from pathlib import Path

from studies.common.subject import Subject, paper_subject
from support_exudyn.sweeps.workers import Workers

KEPT, WITNESSES = "kept", "witness"  # folders of runs and of those of witnesses, beside those of the studies


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
