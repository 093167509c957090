"""What is run and measured of one plausible machine.

Seven scenes by the reduced formulation, each at two tolerances: the ideal pin and four clearances in drive
mode 2, the ideal pin and 1.5 mm in mode 1. The distance of the two runs tells the numerical error of every
measure, as it does of runs to an accuracy.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from studies.claims.evidence import Evidence, Measured
from studies.claims.plausible import REFERENCE, Sample, machine, pin
from studies.common import paper_machine, rise
from studies.common.runs import halvings, with_coarser
from support_exudyn import (
    CubicStep,
    Drive,
    HydraulicSupport,
    Result,
    Scenario,
    SolverSettings,
    UniformSpeed,
    reference_support,
    simulate,
)
from support_exudyn.mechanics.trajectory import Impulse

IDEAL = "ideal"
CLEARANCES = tuple(f"{size:.1f} mm" for size in paper_machine.SIZES_MM)
MODE_1, MODE_1_IDEAL = "1.5 mm, mode 1", "ideal, mode 1"
OIL, OIL_IDEAL = "1.5 mm, mode 1, oil", "ideal, mode 1, oil"
CASES = (IDEAL, *CLEARANCES, MODE_1_IDEAL, MODE_1)
IDEALS = (IDEAL, MODE_1_IDEAL)
OIL_START = 0.8  # of mode 1 on columns of oil, when the journal has come to rest [s]
TOLERANCE = 1e-6  # of the reduced formulation in the first of both runs
OIL_TOLERANCE = 1e-5  # of the tree formulation in the first of three runs
OIL_STEP = 5e-4  # and time between records: twice that may miss 1 % of a peak [s]
Values = dict[str, float]


def scenario(sample: Sample, case: str, support: HydraulicSupport) -> Scenario:
    """A case of a sample and its machine. Raises InputError if the machine cannot rise by 500 mm."""
    drive: Drive = UniformSpeed() if "mode 1" in case else CubicStep()
    pins = {}
    if not case.startswith("ideal"):
        pins = {paper_machine.CLEARANCE_PIN: pin(sample, float(case.split()[0]))}
    return Scenario(machine=support, drive=drive, duration=rise.END, pins=pins)


def measures(sample: Sample) -> dict[str, dict[str, list[float]]]:
    """All measures of a sample as plain data: case, name, [value, numerical error].

    Raises InputError or SimulationError if a case cannot be run.
    """
    support = machine(sample)
    scenarios = {case: scenario(sample, case, support) for case in CASES}
    solver = SolverSettings(tolerance=TOLERANCE)
    coarse = {case: replace(item, formulation="reduced", solver=solver) for case, item in scenarios.items()}
    fine = {case: item.refined() for case, item in coarse.items()}
    # with the ideal pin nothing is integrated: there both are the same to the bit
    ideal = {case: simulate(coarse[case]) for case in IDEALS}
    runs = [{case: ideal.get(case) or simulate(item) for case, item in each.items()} for each in (coarse, fine)]
    found = [_measures(each, str(sample["window"])) for each in runs]
    return {case: _with_errors([each[case] for each in runs], [each[case] for each in found]) for case in CASES}


def _with_errors(runs: Sequence[Result], values: Sequence[Values]) -> dict[str, list[float]]:
    """Values of the last of the runs with their errors; what is compared with another run is so at each."""
    result = with_coarser(runs)
    of_run = {id(run): found for run, found in zip(halvings(result), values, strict=True)}

    def number(name: str) -> list[float]:
        found = result.estimate(lambda run: of_run[id(run)][name])
        return [found.value, found.error]

    return {name: number(name) for name in values[-1]}


def evidence(data: Mapping[str, Mapping[str, list[float]]]) -> Evidence:
    """The evidence of the runs, for judging."""
    return Evidence(
        {
            case: {name: Measured(value, error) for name, (value, error) in row.items()}
            for case, row in data.items()
        }
    )


def oil_scenarios() -> dict[str, Scenario]:
    """Mode 1 on columns of oil: the reference support, ideal pin and 1.5 mm, by what is cheapest for each."""
    drive = UniformSpeed(start=OIL_START, end=OIL_START + 2.0)
    found = {}
    for case in (OIL, OIL_IDEAL):
        ideal = case == OIL_IDEAL
        found[case] = replace(
            scenario(REFERENCE, case, reference_support()),
            drive=drive,
            duration=OIL_START + 0.4,
            step=OIL_STEP,
            record_period=OIL_STEP,
            actuators=paper_machine.oil_columns(),
            formulation="redundant" if ideal else "tree",
            solver=SolverSettings(backend="symbolic") if ideal else SolverSettings(tolerance=OIL_TOLERANCE),
        )
    return found


LARGEST_FORCE = rise.Peak(rise.FORCE, begin=OIL_START)  # of the pin after the start of mode 1 on oil [N]


def _measures(runs: Mapping[str, Result], window: str) -> dict[str, Values]:
    found = {}
    for case, run in runs.items():
        ideal = runs[MODE_1_IDEAL if "mode 1" in case else IDEAL]
        found[case] = _run_measures(run, ideal, window)
        if run.impulses:
            found[case]["impulse"] = _struck(run.impulses[0])
    return found


def _struck(impulse: Impulse) -> float:
    """Sum of magnitudes over the columns [N s]."""
    return sum(abs(value) for value in impulse.actuators.values())


def _run_measures(run: rise.MeasuredRun, ideal: rise.MeasuredRun, window: str) -> Values:
    """All measures of one run; forces in N, angles in degrees, lengths in mm."""
    averaged = rise.in_rise(run) if window == "rise" else rise.between(run, 0.0, rise.END)
    force, acceleration = run[rise.FORCE], rise.DEGREES * run[rise.ACCELERATION]
    inside = rise.in_rise(run)
    found = {
        "mean_force": float(force[averaged].mean()),
        "std_force": float(force[averaged].std()),
        "largest_force": float(force[inside].max()),
        "mean_acceleration": float(acceleration[averaged].mean()),
        "mean_tip_shift": 1e3 * float(rise.departure(run, ideal, "tip.x").mean()),
        "tip_range": 1e3 * float(np.ptp(run["tip.x"][inside])),
    }
    for name, channel, scale in (
        ("force", rise.FORCE, 1.0),
        ("speed", rise.SPEED, rise.DEGREES),
        ("acceleration", rise.ACCELERATION, rise.DEGREES),
    ):
        found[f"rms_{name}"] = scale * rise.rms_fluctuation(run, run[channel])
        found[f"rms_from_start_{name}"] = scale * rise.rms_fluctuation(run, run[channel], rise.START)
        found[f"range_{name}"] = scale * float(np.ptp(run[channel][inside]))
        found[f"likeness_{name}"] = rise.likeness(run, ideal, channel)
    found["likeness_tip"] = min(rise.likeness(run, ideal, name) for name in ("tip.x", "tip.y"))
    for stage, times in rise.STAGES.items():
        found[f"rms_speed_{stage}"] = rise.DEGREES * rise.rms_fluctuation(run, run[rise.SPEED], *times)
        found[f"speed_{stage}"] = rise.DEGREES * rise.stage_mean(run, rise.SPEED, stage)
    for side in ("front", "rear"):
        column = f"{side}_column"
        found[f"{side}_angle"] = rise.DEGREES * float(rise.rearward_angle(run, column)[inside].mean())
        found[f"{side}_lean"] = rise.DEGREES * float(rise.lean(run, column)[inside].mean())
        found[f"{side}_upright"] = float(np.sin(run[f"{column}.angle"][inside]).mean())
    return found
