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
from contextlib import suppress
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import cast

import numpy as np
from pydantic import BaseModel, ValidationError

import studies
from studies.claims.evidence import Evidence, Measured
from studies.claims.plausible import Sample, ideal_pin, machine, oil_columns, pin
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
# Two runs can agree in the mean force by chance while their impacts differ: its error is at least this share of
# that of the spread (measured against runs at a hundredth of the tolerance: up to 0.1).
MEAN_OF_SPREAD = 0.2
Values = dict[str, float]
Data = dict[str, dict[str, list[float]]]  # case, name, [value, numerical error]


def watched(sample: Sample) -> rise.Watched:
    """The pin, its link, and when the machine of a sample rises."""
    return rise.Watched(rise.PAPER.pin, rise.PAPER.body, rise.START, rise.START + sample["stroke_time"])


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

    The error is that of steps, of records, and of equations: the tolerance, by which formulations agree, times
    the size of what a value is made from.

    Raises InputError or SimulationError if a case cannot be run.
    """
    support, during = machine(sample), watched(sample)
    scenes = {case: scenario(sample, case, support) for case in CASES}
    coarse = {case: simulate(scene) for case, scene in scenes.items()}
    fine = {case: simulate(scene.refined()) for case, scene in scenes.items()}
    thinned = {n: {case: cast(Result, Thinned(run, n)) for case, run in fine.items()} for n in THINNED}
    found = {n: run_measures(runs, during) for n, runs in {0: coarse, 1: fine, **thinned}.items()}
    data: Data = {}
    for case in CASES:
        result = with_coarser([coarse[case], fine[case]])
        values = {n: each[case] for n, each in found.items()}
        of_run = {id(run): values[n] for n, run in enumerate(halvings(result))}
        sizes = {"mean_acceleration": values[1]["speed_middle"] / (during.end - during.start)}
        data[case] = {}
        for name in values[1]:
            estimate = result.estimate(lambda run, of_run=of_run, name=name: of_run[id(run)][name])  # type: ignore[misc]
            missed: float = sum(peak.missed(result) for peak in extremes(during).get(name, ()))
            if name != LARGEST:
                missed += error_of_records(lambda n, values=values, name=name: values[n][name])  # type: ignore[misc]
            of_equations = TOLERANCE * max(abs(estimate.value), sizes.get(name, 0.0))
            data[case][name] = [estimate.value, estimate.error + missed + of_equations]
        mean, spread = data[case]["mean_force"], data[case]["std_force"]
        mean[1] = max(mean[1], MEAN_OF_SPREAD * spread[1])
    return data


def extremes(during: rise.Watched) -> dict[str, tuple[rise.Crest, ...]]:
    """The extremes from which a measure is made, by its name: records may miss them."""
    tip = during.peak("tip.x", 1e3)
    ends = replace(tip, extreme="min"), replace(tip, extreme="max")
    return {LARGEST: (during.peak(during.force),), "tip_range": ends}


def evidence(data: Mapping[str, Mapping[str, Sequence[float]]]) -> Evidence:
    """The evidence of the runs, for judging."""
    return {case: {name: Measured(*pair) for name, pair in row.items()} for case, row in data.items()}


def run_measures(runs: Mapping[str, Result], during: rise.Watched) -> dict[str, Values]:
    """All measures over the rise by case; forces in N, impulses in N s, angles in degrees, lengths in mm."""
    found = {}
    for case, run in runs.items():
        found[case] = _of_run(run, runs[PARTNERS[case]], during)
        if run.impulses:
            found[case]["impulse"] = sum(map(abs, run.impulses[0].actuators.values()))
    return found


def _of_run(run: Result, ideal: Result, during: rise.Watched) -> Values:
    inside = during.in_rise(run)
    time, speed = run.time[inside], rise.DEGREES * run[during.speed][inside]
    found = {
        LARGEST: during.peak(during.force)(run),
        "mean_force": during.mean(run, during.force),
        "std_force": during.spread_of(during.force)(run),
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
        found[f"speed_{stage}"] = during.stage_mean_of(during.speed, stage, rise.DEGREES)(run)
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


def run_machines(
    samples: Sequence[Sample], out: Path, workers: int | Workers, progress: Callable[[Sequence[float]], None]
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
    rows: dict[int, MachineRow] = {}
    for n, place in enumerate(places):
        with suppress(FileNotFoundError, ValidationError):  # not there, or not whole
            rows[n] = MachineRow.model_validate_json(contents(place, LARGEST_FILE))
    missing = [n for n in range(len(samples)) if n not in rows]
    if missing:
        warm_up()  # compile once, for all processes

        def ended(error: ProcessEndedError) -> MachineRow:  # not kept, so that it is tried again
            return MachineRow(sample=dict(samples[missing[error.place]]), measures=None, failure=error.reason)

        with worker_pool(workers) as pool:
            jobs = [(places[n], samples[n]) for n in missing]
            rows |= dict(zip(missing, pool.run(jobs, _run_one, progress, ended), strict=True))
    return [rows[n] for n in range(len(samples))]


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
    row = MachineRow(sample=dict(sample), measures=None, failure=None)
    try:
        row.measures = measures(sample)
        for case, named in row.measures.items():
            for name, pair in named.items():
                if not all(map(math.isfinite, pair)):
                    raise InputError(f"{name} of {case} = {pair}: allowed: finite numbers")
    except (InputError, SimulationError) as error:
        row.measures, row.failure = None, str(error)
    with whole_file(place) as temporary:
        temporary.write_text(row.model_dump_json() + "\n", encoding="utf-8")
    return row
