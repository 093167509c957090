"""A folder of scenarios with what they came out at: made, looked at, changed where that is asked for."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import datetime, timezone
from functools import partial
from pathlib import Path

from support_exudyn.files import ScenarioFile
from support_exudyn.files.scenarios.scenario_file import OTHER_FILES, read_scenario_file
from support_exudyn.files.toml.text import load_toml
from support_exudyn.files.whole_file import writing_alone
from support_exudyn.formulations.contract import Progress, SimulationError
from support_exudyn.postprocessing.baselines.baseline_file import read_baseline, write_baseline
from support_exudyn.postprocessing.baselines.changes import RunChange, changes
from support_exudyn.postprocessing.baselines.kept_run import KeptRun, kept_run
from support_exudyn.simulation.simulate import simulate
from user_forces.values.texts import cleaned
from user_forces.values.value import InputError

FOLDER = "baseline"  # beside the scenarios
ENDING = ".json"
MOST_REASON = 200  # letters that are kept of a reason


@dataclass(frozen=True)
class Looked:
    """A scenario beside its baseline.

    name: of the scenario's file. was: its baseline; None: it has none. now: what it comes out at; None: there
    is no such scenario, or its run cannot be finished. changes: between both. failed: why it was not finished.
    """

    name: str
    was: KeptRun | None
    now: KeptRun | None
    changes: tuple[RunChange, ...] = ()
    failed: str = ""

    @property
    def state(self) -> str:
        """What became of it, in a word: same, changed, new, gone, or failed."""
        if self.failed:
            return "failed"
        if self.was is None:
            return "new"
        if self.now is None:
            return "gone"
        return "changed" if self.changes else "same"


class BaselineFolder:
    """A folder of scenarios, `*.toml`, whose baselines are in the folder `baseline` in it, `NAME.json`.

    Files of machines, sweeps, instruments and comparisons, which may lie there as well, are not run.

    Arguments:
        path: of the folder.

    Raises InputError if it is no folder, if there is no scenario and no baseline in it, or if a scenario cannot
    be read: all of them are read before any runs.
    """

    def __init__(self, path: Path) -> None:
        if not path.is_dir():
            raise InputError(f"{path}: is no folder; allowed: one with scenarios, *.toml")
        self.path = path
        self.kept = path / FOLDER
        self.scenarios: Mapping[str, ScenarioFile] = {
            file.stem: read_scenario_file(file) for file in sorted(path.glob("*.toml")) if _is_scenario(file)
        }
        self.baselines: Mapping[str, Path] = {
            file.stem: file for file in sorted(self.kept.glob(f"*{ENDING}")) if file.is_file()
        }
        if not self.names:
            raise InputError(f"{path}: has no scenario; allowed: a folder with scenarios, *.toml")

    @property
    def names(self) -> list[str]:
        """The names of all scenarios, and of baselines without one."""
        return sorted({*self.scenarios, *self.baselines})

    def check_names(self, names: Sequence[str]) -> None:
        """Raise InputError if one of the names is of no scenario and no baseline."""
        for name in names:
            if name not in self.names:
                raise InputError(f"{name}: no such scenario in {self.path}; allowed: {', '.join(self.names)}")

    def looked_at(self, names: Sequence[str], progress: Progress) -> Iterator[Looked]:
        """Run scenarios of these names, one after the other, and compare each with its baseline.

        All baselines are read before the first run. Raises InputError if one cannot be.
        """
        kept = {name: read_baseline(self.baselines[name]) for name in names if name in self.baselines}
        for n, name in enumerate(names):
            was = kept.get(name)
            if name not in self.scenarios:
                yield Looked(name, was, None)
                continue
            try:
                now = run_kept(self.scenarios[name], partial(_part, progress, n, len(names)))
            except SimulationError as error:
                yield Looked(name, was, None, failed=" ".join(str(error).split()))
                continue
            yield Looked(name, was, now, tuple(changes(was, now)) if was is not None else ())
        progress(1.0)

    def write(self, looked: Looked, reason: str = "") -> Path:
        """Write what a scenario came out at; what is gone is removed. The file tells of its changes.

        Raises OSError if it cannot be written, or if another process writes to the folder.
        """
        path = self.kept / f"{looked.name}{ENDING}"
        self.kept.mkdir(exist_ok=True)
        with writing_alone(self.kept):
            if looked.now is None:
                path.unlink(missing_ok=True)
            else:
                write_with_history(looked, path, reason)
        return path


def run_kept(file: ScenarioFile, progress: Progress) -> KeptRun:
    """Run a scenario, always with errors, and take of it what is kept. Raises SimulationError if it fails."""
    scenario = file.scenario
    result = simulate(scenario, errors=file.errors or scenario.accuracy is None, progress=progress)
    return replace(kept_run(result), scenario=scenario.plain)


def write_with_history(looked: Looked, path: Path, reason: str = "") -> None:
    """Write what something came out at, with what was told of it before and now; it is not gone."""
    now, was = looked.now, looked.was
    assert now is not None
    told = {"date": datetime.now(timezone.utc).isoformat(timespec="seconds")}
    told["changes"] = "first" if was is None else str(len(looked.changes))
    if reason:
        told["reason"] = cleaned(reason)[:MOST_REASON]
    write_baseline(replace(now, history=(*(was.history if was is not None else ()), told)), path)


def _is_scenario(path: Path) -> bool:
    """Whether a file is that of a scenario, or nothing that this program reads, which is then refused."""
    table = load_toml(path)
    return "machine" in table or not OTHER_FILES.keys() & table.keys()


def _part(progress: Progress, n: int, runs: int, share: float) -> None:
    progress((n + share) / runs)
