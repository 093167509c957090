"""What is run and measured of one plausible machine.

Seven scenes by the compiled formulation, each at two tolerances: the ideal pin and four clearances in drive
mode 2, the ideal pin and 1.5 mm in mode 1. The distance of the two runs tells the numerical error of every
measure, as it does of runs to an accuracy. One machine in some is asked on columns of oil, too.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from studies.claims.evidence import Evidence, Measured
from studies.claims.plausible import COLUMNS, ON_OIL, REFERENCE, Sample, machine, number, oil_columns, pin
from studies.common import paper_machine, rise
from studies.common.runs import halvings, with_coarser
from support_exudyn import (
    ClearancePin,
    CubicStep,
    HydraulicSupport,
    OilColumn,
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
RECORDS = 1e-3  # time between records of a rise of 2 s; of a longer one as many records [s]
TOLERANCE = 1e-6  # in the first of both runs
# when mode 1 starts on columns of oil [s]: the journal has to come to rest first
OIL_START = {OIL: 0.8, OIL_IDEAL: 0.02}
OIL_AFTER = 0.4  # that is looked at [s]
OIL_RECORDS = 5e-4  # time between records: twice that may miss 1 % of a peak [s]
Values = dict[str, float]


def watched(sample: Sample) -> rise.Watched:
    """The pin, its link, and when the machine of a sample rises."""
    return rise.Watched(rise.PAPER.pin, rise.PAPER.body, rise.START, rise.START + number(sample, "stroke_time"))


def scenario(sample: Sample, case: str, support: HydraulicSupport) -> Scenario:
    """A case of a sample and its machine. Raises InputError if the machine cannot rise by 500 mm."""
    during = watched(sample)
    kind = UniformSpeed if "mode 1" in case else CubicStep
    return Scenario(
        machine=support,
        drive=kind(start=during.start, end=during.end),
        duration=during.end,
        record_period=RECORDS * (during.end / rise.END),
        pins=_pins(sample, case, support),
    )


def _pins(sample: Sample, case: str, support: HydraulicSupport) -> dict[str, ClearancePin]:
    """The clearance pin of a case, by its name; none if it is ideal."""
    if case.startswith("ideal"):
        return {}
    return {paper_machine.CLEARANCE_PIN: pin(sample, float(case.split()[0]), support)}


def measures(sample: Sample) -> dict[str, dict[str, list[float]]]:
    """All measures of a sample as plain data: case, name, [value, numerical error].

    Raises InputError or SimulationError if a case cannot be run.
    """
    support, during = machine(sample), watched(sample)
    scenarios = {case: scenario(sample, case, support) for case in CASES}
    solver = SolverSettings(tolerance=TOLERANCE)
    coarse = {case: replace(item, formulation="compiled", solver=solver) for case, item in scenarios.items()}
    fine = {case: item.refined() for case, item in coarse.items()}
    # with the ideal pin nothing is integrated: there both are the same to the bit
    ideal = {case: simulate(coarse[case]) for case in IDEALS}
    runs = [{case: ideal.get(case) or simulate(item) for case, item in each.items()} for each in (coarse, fine)]
    found = [_measures(each, during) for each in runs]
    known = {
        case: _with_errors([each[case] for each in runs], [each[case] for each in found]) for case in CASES
    }
    return known | (_on_oil(sample, support) if sample[COLUMNS] == ON_OIL else {})


def _on_oil(sample: Sample, support: HydraulicSupport) -> dict[str, dict[str, list[float]]]:
    """The largest pin force at the start of mode 1 on columns of oil, with and without clearance."""
    found = {}
    for case in (OIL, OIL_IDEAL):
        coarse = on_oil(sample, case, support, oil_columns(sample))
        known = with_coarser([simulate(coarse), simulate(coarse.refined())]).estimate(LARGEST_FORCE[case])
        found[case] = {"largest_force": [known.value, known.error]}
    return found


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


def on_oil(sample: Sample, case: str, support: HydraulicSupport, columns: Mapping[str, OilColumn]) -> Scenario:
    """The start of mode 1 on columns of oil, the first of some runs."""
    start = OIL_START[case]
    return Scenario(
        machine=support,
        drive=UniformSpeed(start=start, end=start + number(sample, "stroke_time")),
        duration=start + OIL_AFTER,
        record_period=OIL_RECORDS,
        pins=_pins(sample, case, support),
        actuators=columns,
        formulation="compiled",
        solver=SolverSettings(tolerance=TOLERANCE),
    )


def oil_scenarios() -> dict[str, Scenario]:
    """Mode 1 on columns of oil: the reference support, ideal pin and 1.5 mm, the first of three runs."""
    columns, support = paper_machine.oil_columns(), reference_support()
    return {case: on_oil(REFERENCE, case, support, columns) for case in (OIL, OIL_IDEAL)}


LARGEST_FORCE = {  # of the pin after the start of mode 1 on oil [N], by case
    case: rise.Peak(rise.FORCE, begin=start) for case, start in OIL_START.items()
}


def _measures(runs: Mapping[str, Result], during: rise.Watched) -> dict[str, Values]:
    found = {}
    for case, run in runs.items():
        ideal = runs[MODE_1_IDEAL if "mode 1" in case else IDEAL]
        found[case] = _run_measures(run, ideal, during)
        if run.impulses:
            found[case]["impulse"] = _struck(run.impulses[0])
    return found


def _struck(impulse: Impulse) -> float:
    """Sum of magnitudes over the columns [N s]."""
    return sum(abs(value) for value in impulse.actuators.values())


def _run_measures(run: rise.MeasuredRun, ideal: rise.MeasuredRun, during: rise.Watched) -> Values:
    """All measures of one run; forces in N, angles in degrees, lengths in mm."""
    force, acceleration = run[during.force], rise.DEGREES * run[during.acceleration]
    inside = during.in_rise(run)
    found = {
        "mean_force": float(force[inside].mean()),
        "std_force": float(force[inside].std()),
        "largest_force": float(force[inside].max()),
        "mean_acceleration": float(acceleration[inside].mean()),
        "mean_tip_shift": 1e3 * float(during.departure(run, ideal, "tip.x").mean()),
        "tip_range": 1e3 * float(np.ptp(run["tip.x"][inside])),
    }
    for name, channel, scale in (
        ("force", during.force, 1.0),
        ("speed", during.speed, rise.DEGREES),
        ("acceleration", during.acceleration, rise.DEGREES),
    ):
        found[f"rms_{name}"] = scale * during.rms_fluctuation(run, run[channel])
        found[f"rms_from_start_{name}"] = scale * during.rms_fluctuation(run, run[channel], during.start)
        found[f"range_{name}"] = scale * float(np.ptp(run[channel][inside]))
        found[f"likeness_{name}"] = during.likeness(run, ideal, channel)
    found["likeness_tip"] = min(during.likeness(run, ideal, name) for name in ("tip.x", "tip.y"))
    for stage, times in during.stages.items():
        found[f"rms_speed_{stage}"] = rise.DEGREES * during.rms_fluctuation(run, run[during.speed], *times)
        found[f"speed_{stage}"] = rise.DEGREES * during.stage_mean(run, during.speed, stage)
    for side in ("front", "rear"):
        column = f"{side}_column"
        found[f"{side}_angle"] = rise.DEGREES * float(rise.rearward_angle(run, column)[inside].mean())
        found[f"{side}_lean"] = rise.DEGREES * float(rise.lean(run, column)[inside].mean())
        found[f"{side}_upright"] = float(np.sin(run[f"{column}.angle"][inside]).mean())
    return found
