"""Runs and measures of all machines.

Nine scenes a machine, by the compiled formulation: the ideal pin and four clearances in drive mode 2, the ideal
pin and 1.5 mm in mode 1 on rigid columns and on columns of oil. The ideal pin has the friction of the pin with
clearance. Every scene is run at two tolerances; the numerical error of a measure comes from the distance of
both runs and from that of fewer records.
"""

import hashlib
import json
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import cast

import numpy as np
from pydantic import BaseModel, ValidationError

import studies
from studies.claims.evidence import Evidence, Measured
from studies.claims.plausible import Sample, ideal_pin, machine, number, oil_columns, pin
from studies.common import paper_machine, rise
from studies.common.numbers import Thinned, error_of_records
from studies.common.runs import halvings, with_coarser
from support_exudyn import (
    CubicStep,
    HydraulicSupport,
    Pin,
    Result,
    Scenario,
    SimulationError,
    SolverSettings,
    UniformSpeed,
    simulate,
)
from support_exudyn.files.whole_file import contents, remove_leftovers, whole_file
from support_exudyn.mechanics.trajectory import Impulse
from support_exudyn.simulation.to_accuracy import with_measured
from support_exudyn.sweeps.key import program
from support_exudyn.sweeps.warm_up import warm_up
from support_exudyn.sweeps.workers import ProcessEndedError, Workers, worker_pool
from user_forces.values.value import InputError

IDEAL = "ideal"
CLEARANCES = tuple(f"{size:.1f} mm" for size in paper_machine.SIZES_MM)
MODE_1, MODE_1_IDEAL = "1.5 mm, mode 1", "ideal, mode 1"
OIL, OIL_IDEAL = "1.5 mm, mode 1, oil", "ideal, mode 1, oil"
PARTNERS = {
    **dict.fromkeys((IDEAL, *CLEARANCES), IDEAL),
    **dict.fromkeys((MODE_1_IDEAL, MODE_1), MODE_1_IDEAL),
    **dict.fromkeys((OIL_IDEAL, OIL), OIL_IDEAL),
}  # the ideal pin's case by the case that is compared with it
CASES = tuple(PARTNERS)
POSTURE = ("tip.x", "tip.y", "front_column.angle", "rear_column.angle")  # channels that measures are made from
RECORDS = 5e-4  # time between records of a rise of 2 s; of a longer rise as many records [s]
TOLERANCE = 1e-6  # in the first of both runs
THINNED = (2, 4, 5)  # every so many records are left for the error of records
LARGEST = "largest_force"
Values = dict[str, float]
Data = dict[str, dict[str, list[float]]]  # case, name, [value, numerical error]


def watched(sample: Sample) -> rise.Watched:
    """The pin, its link, and when the machine of a sample rises."""
    return rise.Watched(rise.PAPER.pin, rise.PAPER.body, rise.START, rise.START + number(sample, "stroke_time"))


def scenario(sample: Sample, case: str, support: HydraulicSupport) -> Scenario:
    """A case of a sample and its machine, the first of two runs.

    Raises InputError if the machine cannot rise by 500 mm.
    """
    during = watched(sample)
    ideal = case.startswith(IDEAL)
    loose: Pin = ideal_pin(sample) if ideal else pin(sample, float(case.split()[0]), support)
    drive = (UniformSpeed if "mode 1" in case else CubicStep)(start=during.start, end=during.end)
    watched_channels = (during.force, during.speed, during.acceleration, *POSTURE)
    whole = Scenario(
        machine=support,
        drive=drive,
        duration=during.end,
        record_period=RECORDS * (during.end / rise.END),
        pins={paper_machine.CLEARANCE_PIN: loose},
        actuators=oil_columns(sample) if case.endswith("oil") else {},
        formulation="compiled",
        solver=SolverSettings(tolerance=TOLERANCE),
        channels=watched_channels,
    )
    return with_measured(whole)


def measures(sample: Sample) -> Data:
    """All measures of a sample as plain data: case, name, [value, numerical error].

    Raises InputError or SimulationError if a case cannot be run.
    """
    support, during = machine(sample), watched(sample)
    scenes = {case: scenario(sample, case, support) for case in CASES}
    coarse = {case: simulate(scene) for case, scene in scenes.items()}
    fine = {case: simulate(scene.refined()) for case, scene in scenes.items()}
    thinned = {n: {case: cast(Result, Thinned(run, n)) for case, run in fine.items()} for n in THINNED}
    found = {n: _measures(runs, during) for n, runs in {0: coarse, 1: fine, **thinned}.items()}
    return {
        case: _with_errors([coarse[case], fine[case]], {n: each[case] for n, each in found.items()}, during)
        for case in CASES
    }


def _with_errors(
    runs: Sequence[Result], values: Mapping[int, Values], during: rise.Watched
) -> dict[str, list[float]]:
    """The values of the finer of two runs with their errors: of steps, of records, and of equations.

    The last is the tolerance, by which formulations agree, times the size of what a value is made from.

    values: by how many records there is one that is used; 0: of the coarser run.
    """
    result = with_coarser(runs)
    of_run = {id(run): values[n] for n, run in enumerate(halvings(result))}
    sizes = {"mean_acceleration": values[1]["speed_middle"] / (during.end - during.start)}

    def of_records(name: str) -> float:
        missed = sum(peak.missed(result) for peak in extremes(during).get(name, ()))
        return missed if name == LARGEST else missed + error_of_records(lambda n: values[n][name])

    def measured(name: str) -> list[float]:
        estimate = result.estimate(lambda run: of_run[id(run)][name])
        of_equations = TOLERANCE * max(abs(estimate.value), sizes.get(name, 0.0))
        return [estimate.value, estimate.error + of_records(name) + of_equations]

    return {name: measured(name) for name in values[1]}


def extremes(during: rise.Watched) -> dict[str, tuple[rise.Crest, ...]]:
    """The extremes from which a measure is made, by its name: records may miss them."""
    tip = during.peak("tip.x", 1e3)
    ends = replace(tip, extreme="min"), replace(tip, extreme="max")
    return {LARGEST: (during.peak(during.force),), "tip_range": ends}


def evidence(data: Mapping[str, Mapping[str, Sequence[float]]]) -> Evidence:
    """The evidence of the runs, for judging."""
    return Evidence(
        {
            case: {name: Measured(value, error) for name, (value, error) in row.items()}
            for case, row in data.items()
        }
    )


def _measures(runs: Mapping[str, Result], during: rise.Watched) -> dict[str, Values]:
    found = {}
    for case, run in runs.items():
        found[case] = _run_measures(run, runs[PARTNERS[case]], during)
        if run.impulses:
            found[case]["impulse"] = _total(run.impulses[0])
    return found


def _total(impulse: Impulse) -> float:
    """The sum of the magnitudes of all columns' impulses [N s]."""
    return sum(abs(value) for value in impulse.actuators.values())


def _run_measures(run: Result, ideal: Result, during: rise.Watched) -> Values:
    """All measures of a run over the rise; forces in N, angles in degrees, lengths in mm."""
    inside = during.in_rise(run)
    time, speed = run.time[inside], rise.DEGREES * run[during.speed][inside]
    found = {
        LARGEST: during.peak(during.force)(run),
        "mean_force": during.mean(run, during.force),
        "std_force": during.spread(run, during.force),
        "mean_acceleration": float((speed[-1] - speed[0]) / (time[-1] - time[0])),
        "mean_tip_shift": 1e3 * rise.mean(time, during.departure(run, ideal, "tip.x")),
        "tip_range": 1e3 * float(np.ptp(run["tip.x"][inside])),
    }
    for name, channel, scale in (
        ("force", during.force, 1.0),
        ("speed", during.speed, rise.DEGREES),
        ("acceleration", during.acceleration, rise.DEGREES),
    ):
        found[f"rms_{name}"] = scale * during.rms_fluctuation(run, run[channel])
        found[f"rms_from_start_{name}"] = scale * during.rms_fluctuation(run, run[channel], during.start)
        if run is ideal:
            found[f"range_{name}"] = scale * float(np.ptp(run[channel][inside]))
        found[f"likeness_{name}"] = during.likeness(run, ideal, channel)
    found["likeness_tip"] = min(during.likeness(run, ideal, name) for name in ("tip.x", "tip.y"))
    for stage, times in during.stages.items():
        found[f"rms_speed_{stage}"] = rise.DEGREES * during.rms_fluctuation(run, run[during.speed], *times)
        found[f"speed_{stage}"] = rise.DEGREES * during.stage_mean(run, during.speed, stage)
    for side in ("front", "rear"):
        column = f"{side}_column"
        for name, angle in (("angle", rise.rearward_angle), ("lean", rise.lean)):
            found[f"{side}_{name}"] = rise.DEGREES * during.mean(run, angle(run, column))
    return found


# --- all machines, side by side ---

FOLDER = "machines"
LARGEST_FILE = 100_000_000  # bytes


class MachineRow(BaseModel):
    """A machine: its factors, and its measures or why there are none."""

    sample: dict[str, str | float]
    measures: Data | None
    failure: str | None


Progress = Callable[[Sequence[float]], None]


def run_machines(
    samples: Sequence[Sample], out: Path, workers: int | Workers, progress: Progress
) -> list[MachineRow]:
    """Rows of all samples, in their order; only those are run that DIR does not hold yet.

    A finished machine is a file DIR/machines/KEY.json, by its inputs and the program's sources: a study that
    was killed resumes. A machine that cannot be run is a row, too, with the reason.

    Arguments:
        samples: the machines.
        out: DIR.
        workers: number of processes, >= 1, or the pool to use.
        progress: receives the completed share of each machine that is run.
    """
    folder = out / FOLDER
    folder.mkdir(parents=True, exist_ok=True)
    remove_leftovers(folder, older=0.0)
    places = [folder / f"{key(sample)}.json" for sample in samples]
    rows = [_read(place) for place in places]
    missing = [n for n, row in enumerate(rows) if row is None]
    if missing:
        warm_up(with_legs=False)  # compile once, for all processes

        def ended(error: ProcessEndedError) -> MachineRow:  # not kept, so that it is tried again
            return MachineRow(sample=dict(samples[missing[error.place]]), measures=None, failure=error.reason)

        with worker_pool(workers) as pool:
            jobs = [(places[n], samples[n]) for n in missing]
            for n, row in zip(missing, pool.run(jobs, _run_one, progress, ended), strict=True):
                rows[n] = row
    return [row for row in rows if row is not None]


def key(sample: Sample) -> str:
    """Name of a machine's file: a digest of its factors and of the program."""
    text = json.dumps([dict(sample), program(), _own_sources()], sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:24]


@cache
def _own_sources() -> str:
    """Digest of the sources of all studies, and of their data."""
    digest, root = hashlib.sha256(), Path(studies.__path__[0])
    for path in sorted([*root.rglob("*.py"), *root.rglob("*.toml")]):
        digest.update(path.read_bytes())
    return digest.hexdigest()


def _run_one(number: int, place: Path, sample: Sample) -> MachineRow:
    """In a worker: run a machine and keep it."""
    del number
    row = MachineRow(sample=dict(sample), measures=None, failure=None)
    try:
        found = measures(sample)
        for case, named in found.items():
            for name, pair in named.items():
                if not all(map(math.isfinite, pair)):
                    raise InputError(f"{name} of {case} = {pair}: allowed: finite numbers")
        row.measures = found
    except (InputError, SimulationError) as error:
        row.failure = str(error)
    with whole_file(place) as temporary:
        temporary.write_text(row.model_dump_json() + "\n", encoding="utf-8")
    return row


def _read(place: Path) -> MachineRow | None:
    """A row; None if it is not there or not whole."""
    try:
        return MachineRow.model_validate_json(contents(place, LARGEST_FILE))
    except (FileNotFoundError, ValidationError):
        return None
