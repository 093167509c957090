"""Baselines of the scenarios in a folder: made, compared, and changed where that is asked for."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from support_exudyn.files import ScenarioFile
from support_exudyn.files.scenarios.scenario_file import OTHER_FILES, read_scenario_file
from support_exudyn.files.toml.text import load_toml
from support_exudyn.files.whole_file import writing_alone
from support_exudyn.postprocessing.comparing.in_tests import ENDING, FOLDER
from support_exudyn.postprocessing.comparing.kept_run import (
    KeptRun,
    RunChange,
    changes,
    kept_run,
    read_baseline,
    write_baseline,
)
from support_exudyn.scene.contract import Progress, SimulationError
from support_exudyn.simulation.simulate import simulate
from user_forces.values.value import InputError


@dataclass(frozen=True)
class CheckedScenario:
    """A scenario against its baseline.

    name: of the scenario's file. was: its baseline; None: it has none. now: the results of its run; None: there
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
        if self.was is None or self.now is None:
            return "new" if self.was is None else "gone"
        return "changed" if self.changes else "same"


class BaselineFolder:
    """A folder of scenarios, `*.toml`, whose baselines are in the folder `baseline` in it, `NAME.json`.

    Files of machines, sweeps, instruments and comparisons, which may lie there as well, are not run.

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
        self.names = sorted({*self.scenarios, *self.baselines})  # of scenarios, and of baselines without one
        if not self.names:
            raise InputError(f"{path}: has no scenario; allowed: a folder with scenarios, *.toml")

    def check(self, names: Sequence[str], progress: Progress) -> Iterator[CheckedScenario]:
        """Run scenarios of these names, each after the other, and compare each with its baseline.

        All baselines are read before the first run. Raises InputError if a baseline cannot be, or if a name is
        of no scenario and no baseline.
        """
        for name in names:
            if name not in self.names:
                raise InputError(f"{name}: no such scenario in {self.path}; allowed: {', '.join(self.names)}")
        kept = {name: read_baseline(self.baselines[name]) for name in names if name in self.baselines}
        for n, name in enumerate(names):
            was, file = kept.get(name), self.scenarios.get(name)
            if file is None:
                yield CheckedScenario(name, was, None)
                continue

            def part(share: float, n: int = n) -> None:
                progress((n + share) / len(names))

            try:
                run = simulate(
                    file.scenario, errors=file.errors or file.scenario.accuracy is None, progress=part
                )
            except SimulationError as error:
                yield CheckedScenario(name, was, None, failed=" ".join(str(error).split()))
                continue
            now = replace(kept_run(run), scenario=file.scenario.plain)
            yield CheckedScenario(name, was, now, tuple(changes(was, now)) if was is not None else ())
        progress(1.0)

    def write(self, checked: CheckedScenario) -> Path:
        """Write the results of a scenario; of a scenario that is gone remove them.

        Raises OSError if the file cannot be written, or if another process writes to the folder.
        """
        path = self.kept / f"{checked.name}{ENDING}"
        self.kept.mkdir(exist_ok=True)
        with writing_alone(self.kept):
            if checked.now is None:
                path.unlink(missing_ok=True)
            else:
                write_baseline(checked.now, path)
        return path


def _is_scenario(path: Path) -> bool:
    """Whether a file is that of a scenario, or nothing that this program reads, which is then refused."""
    table = load_toml(path)
    return "machine" in table or not OTHER_FILES.keys() & table.keys()
