"""The machines, run one by one in parallel processes, each kept as soon as it is finished.

A finished machine is a file DIR/machines/KEY.json, written whole by the process that ran it. The key is made
of its inputs and of the program's sources: a run that was killed resumes where it stopped, and a changed
program starts anew. A machine that cannot be run is a row too, with the reason.
"""

import hashlib
import json
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import studies
import support_exudyn
import user_forces
from studies.claims.plausible import Sample
from studies.claims.plausible_runs import Data, measures
from support_exudyn import SimulationError
from support_exudyn.files.whole_file import contents, remove_leftovers, whole_file
from support_exudyn.simulation.provenance import installed
from support_exudyn.sweeps.warm_up import warm_up
from support_exudyn.sweeps.workers import ProcessEndedError, Workers, worker_pool
from user_forces.values.value import InputError

FOLDER = "machines"
LARGEST_FILE = 100_000_000  # bytes
LIBRARIES = ("numpy", "scipy", "numba")  # whose versions may change a number


@dataclass(frozen=True)
class MachineRow:
    """A machine: its factors, and its measures or why there are none."""

    sample: Sample
    measures: Data | None
    failure: str | None


def run(
    samples: Sequence[Sample], out: Path, workers: int | Workers, progress: Callable[[int, int], None]
) -> list[MachineRow]:
    """Rows of all samples, in their order; only those are run that DIR does not hold yet.

    Arguments:
        samples: the machines.
        out: DIR.
        workers: number of processes, >= 1, or the pool to use.
        progress: receives how many are done, of how many.
    """
    folder = out / FOLDER
    folder.mkdir(parents=True, exist_ok=True)
    remove_leftovers(folder, older=0.0)
    places = [folder / f"{key(sample)}.json" for sample in samples]
    missing = [(place, s) for place, s in zip(places, samples, strict=True) if _read(place) is None]
    before = len(samples) - len(missing)
    progress(before, len(samples))
    ended: dict[
        Path, MachineRow
    ] = {}  # whose process was killed or crashed; not kept, so that they are tried again

    def note(error: ProcessEndedError) -> None:
        place, sample = missing[error.place]
        ended[place] = MachineRow(sample, None, error.reason)

    if missing:
        warm_up()  # compile once, for all processes
        with worker_pool(workers) as pool:
            pool.run(missing, _run_one, lambda shares: progress(before + int(sum(shares)), len(samples)), note)
    rows = [ended.get(place) or _read(place) for place in places]
    gone = [place.name for place, row in zip(places, rows, strict=True) if row is None]
    if gone:
        raise OSError(f"{folder}: {', '.join(gone)} vanished while others were run; run the study once more")
    return [row for row in rows if row is not None]


def key(sample: Sample) -> str:
    """Name of a machine's file: a digest of its factors and of the program."""
    text = json.dumps([dict(sample), _program()], sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:24]


@cache
def _program() -> str:
    """Digest of all sources, and versions of what computes."""
    digest = hashlib.sha256()
    for package in (user_forces, support_exudyn, studies):
        root = Path(package.__path__[0])
        for path in sorted(root.rglob("*.py")) + sorted(root.rglob("*.toml")):
            digest.update(path.relative_to(root).as_posix().encode())
            digest.update(path.read_bytes())
    return digest.hexdigest() + " ".join(str(installed(name)) for name in LIBRARIES)


def _run_one(number: int, place: Path, sample: Sample) -> None:
    """In a worker: run a machine and keep it."""
    del number
    row: dict[str, Any] = {"sample": dict(sample), "measures": None, "failure": None}
    try:
        row["measures"] = found = measures(sample)
        for case, named in found.items():
            for name, pair in named.items():
                if not all(math.isfinite(value) for value in pair):
                    raise InputError(
                        f"{name} of {case} = {pair}: allowed: numbers; the run is good for nothing"
                    )
    except (InputError, SimulationError) as error:
        row["measures"], row["failure"] = None, str(error)
    with whole_file(place) as temporary:
        temporary.write_text(json.dumps(row, sort_keys=True, allow_nan=False) + "\n", encoding="utf-8")


def _read(place: Path) -> MachineRow | None:
    """A row; None if it is not there or not whole."""
    try:
        data = json.loads(contents(place, LARGEST_FILE).decode("utf-8"))
        return MachineRow(data["sample"], data["measures"], data["failure"])
    except (FileNotFoundError, json.JSONDecodeError, KeyError, TypeError, UnicodeDecodeError):
        return None
