"""Runs that are kept on disk between sessions of tests: made once for each scenario and program."""

from __future__ import annotations

import hashlib
import json
import shutil
import time
from contextlib import suppress
from pathlib import Path

from support_exudyn.files.whole_file import writing_alone
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.result import Result
from support_exudyn.simulation.simulate import simulate
from support_exudyn.sweeps.key import key, program
from user_forces.values.value import InputError

FILE = "run.h5"
WAIT = 0.05  # [s] between two looks whether another process is done
OLD = 86400.0  # [s] since the runs of another program were made: nobody works with it any more


class RunCache:
    """Runs in a folder, one for each scenario and program.

    The key of a run is that of sweeps: all fields of the scenario, versions of packages, a digest of our
    sources and of modules of one's own. Another program thus never finds a run of this one. Several processes
    may use the folder: one makes a run, others that ask for the same wait for it.

    Arguments:
        folder: where they are kept; made if it is missing. Runs of other programs, a day old, are removed.
    """

    def __init__(self, folder: Path) -> None:
        text = json.dumps(program(), sort_keys=True)
        self.folder = folder / hashlib.sha256(text.encode()).hexdigest()[:16]
        if not self.folder.is_dir():
            self.folder.mkdir(parents=True, exist_ok=True)
            for other in folder.iterdir():
                with suppress(OSError):  # another process may remove it at the same time
                    if time.time() - other.stat().st_mtime > OLD:
                        shutil.rmtree(other, ignore_errors=True)

    def run(self, scenario: Scenario, errors: bool = False) -> Result:
        """The run of a scenario, made if it is not there or damaged; always as it is read from its file.

        errors: whether it is made with estimated errors, see `simulate`.

        Raises InputError and SimulationError as `simulate` does; OSError if it cannot be kept.
        """
        folder = self.folder / key(scenario, errors)
        path = folder / FILE
        while True:
            with suppress(InputError, OSError):  # it is not there, damaged, or removed while it is read
                return Result.load(path)
            folder.mkdir(exist_ok=True)
            try:
                with writing_alone(folder):
                    if not _is_whole(path):  # another process may have made it meanwhile
                        simulate(scenario, errors=errors).save(path)
                    return Result.load(path)
            except BlockingIOError:
                time.sleep(WAIT)


def _is_whole(path: Path) -> bool:
    try:
        Result.load(path)
    except (InputError, OSError):
        return False
    return True
