"""What `which_pin` measures of a run, against ideal pins with the same friction."""

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from studies.common import rise
from studies.common.numbers import Number, compared, measured_all
from studies.which_pin.cases import ROOF, TIP, PinPlan
from studies.which_pin.closed_form import posture_numbers
from support_exudyn import Result

Get = Callable[[Result, Result], float]  # of a run and that of ideal pins
OVER_IDEAL = "largest_peak_over_ideal"


def peaks(plan: PinPlan) -> dict[str, rise.Crest]:
    """The measures of the largest forces in the motion, by name."""
    return {f"largest_force_{name}": plan.watched.peak(channel) for channel, name in plan.forces.items()}


def _departure(
    watched: rise.Watched, run: Result, ideal: Result, channel: str
) -> tuple[rise.Series, rise.Series]:
    return run.time[watched.in_rise(run)], watched.departure(run, ideal, channel)


def _of_posture(plan: PinPlan) -> dict[str, tuple[str, Get]]:
    watched = plan.watched

    def mean_shift(channel: str, scale: float) -> Get:
        return lambda run, ideal: scale * rise.mean(*_departure(watched, run, ideal, channel))

    def largest_shift(run: Result, ideal: Result) -> float:
        along, up = (watched.departure(run, ideal, f"{TIP}.{axis}") for axis in "xy")
        return 1e3 * float(np.hypot(along, up).max())

    return {
        "mean_tip_shift_forward": ("mm", mean_shift(f"{TIP}.x", 1e3)),
        "mean_tip_shift_up": ("mm", mean_shift(f"{TIP}.y", 1e3)),
        "largest_tip_shift": ("mm", largest_shift),
        "mean_canopy_tilt": ("deg", mean_shift(f"{ROOF}.angle", rise.DEGREES)),
        "rms_tip_forward": ("mm", _rms_fluctuation(watched, f"{TIP}.x", 1e3)),
    }


def _rms_fluctuation(watched: rise.Watched, channel: str, scale: float = 1.0) -> Get:
    return lambda run, ideal: scale * watched.rms_fluctuation(run, run[channel])


def measures(plan: PinPlan) -> dict[str, tuple[str, Get]]:
    """Unit and measure of every number of a run against the ideal one, by name."""
    watched = plan.watched

    def mean(channel: str) -> Get:
        return lambda run, ideal: watched.mean(run, channel)

    def change(channel: str) -> Get:
        of = mean(channel)
        return lambda run, ideal: 100.0 * (of(run, ideal) / of(ideal, ideal) - 1.0)

    def all_pins(run: Result, ideal: Result) -> float:
        each = [watched.rms_fluctuation(run, run[f"pin.{name}.force"]) for name in plan.pins]
        return float(np.sqrt(np.mean(np.square(each))))

    def most_changed(run: Result, ideal: Result) -> float:
        return max(abs(change(channel)(run, ideal)) for channel in plan.forces)

    def peak_over_ideal(run: Result, ideal: Result) -> float:
        return max(peak(run) / peak(ideal) for peak in peaks(plan).values())

    def lost(run: Result, ideal: Result) -> float:
        inside = watched.in_rise(run)
        all_lost = (run["energy.damping_loss"] + run["energy.friction_loss"])[inside]
        return float(all_lost[-1] - all_lost[0])

    shaking = {
        f"rms_{body}_angular_acceleration": (
            "deg/s^2", _rms_fluctuation(watched, f"{body}.angular_acceleration", rise.DEGREES)
        )
        for body in plan.shaken
    }  # fmt: skip
    forces = plan.forces.items()
    return {
        **(_of_posture(plan) if plan.has_tip else {}),
        "largest_change_of_a_mean_force": ("%", most_changed),
        OVER_IDEAL: ("1", peak_over_ideal),
        "rms_pin_forces": ("N", all_pins),
        **shaking,
        "energy_lost_in_rise": ("J", lost),
        **{f"mean_force_{name}": ("N", mean(channel)) for channel, name in forces},
        **{f"change_of_mean_force_{name}": ("%", change(channel)) for channel, name in forces},
        **{f"rms_force_{name}": ("N", _rms_fluctuation(watched, channel)) for channel, name in forces},
    }


def _peak_between_records(plan: PinPlan, run: Result, ideal: Result) -> float:
    """By how much that ratio may be off because both forces are taken from records."""
    return max(
        (peak.missed(run) + peak(run) / peak(ideal) * peak.missed(ideal)) / peak(ideal)
        for peak in peaks(plan).values()
    )


def measure(plan: PinPlan, results: Mapping[str, Result]) -> list[Number]:
    """All numbers of the runs, and those of the closed form beside them."""
    numbers = []
    for case, result in results.items():
        ideal = results[plan.ideal_of(case)]
        for name, (unit, get) in measures(plan).items():
            number = compared(name, case, unit, result, ideal, get)
            if result is ideal and number.value == (1.0 if name == OVER_IDEAL else 0.0):
                number = replace(number, numerical_error=0.0)  # of a run against itself, which is exact
            elif name == OVER_IDEAL:
                missed = _peak_between_records(plan, result, ideal)
                number = replace(number, numerical_error=number.numerical_error + missed)
            numbers.append(number)
        if case in plan.loose and plan.subject.is_paper:
            numbers += posture_numbers(case, result.scenario)
    return numbers + measured_all(results, {name: ("N", peak) for name, peak in peaks(plan).items()})
