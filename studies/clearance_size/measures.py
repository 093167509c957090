"""What is measured of the rise with each clearance."""

from collections.abc import Callable, Mapping

import numpy as np

from studies.common import paper_machine, rise
from studies.common.numbers import Number, compared, measured
from studies.common.paper_machine import ideal_of
from studies.common.subject import Subject
from support_exudyn import Result

COLUMNS = ("front_column", "rear_column")
Against = Callable[[rise.MeasuredRun, rise.MeasuredRun], float]  # of a run and that of the ideal pin


def measures(subject: Subject, ideal: Result) -> dict[str, tuple[str, Against]]:
    """Unit and measure of everything that this machine has, by name."""
    watched, degrees = subject.watched, rise.DEGREES

    def mean(channel: str, scale: float = 1.0) -> Against:
        return lambda run, ideal: scale * watched.mean(run, channel)

    def spread(channel: str, scale: float = 1.0) -> Against:
        return lambda run, ideal: scale * watched.spread(run, channel)

    def shaking(channel: str, scale: float, *times: float) -> Against:
        return lambda run, ideal: scale * watched.rms_fluctuation(run, run[channel], *times)

    def stage_mean(stage: str) -> Against:
        return lambda run, ideal: degrees * watched.stage_mean(run, watched.speed, stage)

    def angle(of: Callable[[rise.MeasuredRun, str], rise.Series], column: str) -> Against:
        return lambda run, ideal: degrees * watched.mean(run, of(run, column))

    def extent(run: rise.MeasuredRun, ideal: rise.MeasuredRun) -> float:
        return 1e3 * float(np.ptp(run["tip.x"][watched.in_rise(run)]))

    def shift(run: rise.MeasuredRun, ideal: rise.MeasuredRun) -> float:
        return 1e3 * rise.mean(run.time[watched.in_rise(run)], watched.departure(run, ideal, "tip.x"))

    force, speed, acceleration = watched.force, watched.speed, watched.acceleration
    found: dict[str, tuple[str, Against]] = {
        "mean_pin_force": ("N", mean(force)),
        "std_pin_force": ("N", spread(force)),
        "rms_pin_force": ("N", shaking(force, 1.0)),
        "mean_angular_acceleration": ("deg/s^2", mean(acceleration, degrees)),
        "std_angular_acceleration": ("deg/s^2", spread(acceleration, degrees)),
        "rms_angular_acceleration": ("deg/s^2", shaking(acceleration, degrees)),
        "rms_angular_velocity": ("deg/s", shaking(speed, degrees)),
    }
    for stage, times in watched.stages.items():
        found[f"rms_angular_velocity_{stage}"] = ("deg/s", shaking(speed, degrees, *times))
        found[f"mean_angular_speed_{stage}"] = ("deg/s", stage_mean(stage))
    if "tip.x" in ideal.channels:
        found |= {"mean_tip_shift": ("mm", shift), "tip_range": ("mm", extent)}
    for column in COLUMNS:
        if f"{column}.angle" in ideal.channels:
            found[f"mean_{column}_angle"] = ("deg", angle(rise.rearward_angle, column))
            found[f"mean_{column}_lean"] = ("deg", angle(rise.lean, column))
    return found


def measure(subject: Subject, results: Mapping[str, Result]) -> list[Number]:
    """All numbers of the study, each case compared with the ideal pin of the same friction."""
    numbers = []
    if subject.is_paper:
        numbers = [
            Number("stiffness_coefficient", f"{size:.1f} mm", paper_machine.stiffness(size) / 1e3**1.5,
                   "N/mm^1.5", 0.0, paper_machine.STIFFNESS[size])
            for size in paper_machine.SIZES_MM
        ]  # fmt: skip
    for case, result in results.items():
        ideal = results[ideal_of(case)]
        for name, (unit, get) in measures(subject, ideal).items():
            paper = of_paper(name, case) if subject.is_paper else None
            numbers.append(compared(name, case, unit, result, ideal, get, paper))
        if result is not ideal:
            largest = measured("largest_pin_force_any_step", case, "N", result, _largest(subject.pin))
            numbers.append(largest)
    return numbers


def _largest(pin: str) -> Callable[[Result], float]:
    return lambda run: float(run.largest_force[pin])


def of_paper(name: str, case: str) -> float | None:
    """What the paper prints; its friction is not known, so it stands beside the cases with friction."""
    tables = {
        "mean_pin_force": paper_machine.MEAN_FORCE,
        "std_pin_force": paper_machine.FORCE_SPREAD,
        "mean_angular_acceleration": paper_machine.MEAN_ACCELERATION,
    }
    friction = paper_machine.SLIDING_COEFFICIENT
    sizes = {paper_machine.case_name(size, friction): size for size in paper_machine.SIZES_MM}
    return tables[name][sizes[case]] if name in tables and case in sizes else None
