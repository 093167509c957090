"""What `which_pin` measures of a run, against the one with ideal pins."""

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from studies.common import rise
from studies.common.numbers import Number, compared, measured_all
from studies.which_pin.cases import FORCES, IDEAL, SHAKEN
from studies.which_pin.posture import posture_numbers
from support_exudyn import Result
from support_exudyn.machines.four_bar_shield import PINS

Get = Callable[[Result, Result], float]  # of a run and that of ideal pins
PEAKS = {f"largest_force_{name}": rise.Peak(channel) for channel, name in FORCES.items()}
OVER_IDEAL = "largest_peak_over_ideal"


def _mean_shift(channel: str, scale: float) -> Get:
    return lambda run, ideal: scale * float(rise.departure(run, ideal, channel).mean())


def _largest_shift(run: Result, ideal: Result) -> float:
    along, up = (rise.departure(run, ideal, name) for name in ("tip.x", "tip.y"))
    return 1e3 * float(np.hypot(along, up).max())


def _mean(channel: str) -> Get:
    return lambda run, ideal: float(run[channel][rise.in_rise(run)].mean())


def _change(channel: str) -> Get:
    return lambda run, ideal: 100.0 * (_mean(channel)(run, ideal) / _mean(channel)(ideal, ideal) - 1.0)


def _rms_fluctuation(channel: str, scale: float = 1.0) -> Get:
    return lambda run, ideal: scale * rise.rms_fluctuation(run, run[channel])


def _pin_rms_fluctuation(run: Result, ideal: Result) -> float:
    """Root mean square of the RMS fluctuations of all five pin forces [N]."""
    return float(np.sqrt(np.mean([rise.rms_fluctuation(run, run[f"pin.{name}.force"]) ** 2 for name in PINS])))


def _most_changed(run: Result, ideal: Result) -> float:
    return max(abs(_change(channel)(run, ideal)) for channel in FORCES)


def _peak_over_ideal(run: Result, ideal: Result) -> float:
    return max(peak(run) / peak(ideal) for peak in PEAKS.values())


def _peak_between_records(run: Result, ideal: Result) -> float:
    """By how much that ratio may be off because both forces are taken from records."""
    return max(
        (peak.missed(run) + peak(run) / peak(ideal) * peak.missed(ideal)) / peak(ideal)
        for peak in PEAKS.values()
    )


def _lost(run: Result, ideal: Result) -> float:
    inside = rise.in_rise(run)
    lost = (run["energy.damping_loss"] + run["energy.friction_loss"])[inside]
    return float(lost[-1] - lost[0])


MEASURES: dict[str, tuple[str, Get]] = {
    "mean_tip_shift_forward": ("mm", _mean_shift("tip.x", 1e3)),
    "mean_tip_shift_up": ("mm", _mean_shift("tip.y", 1e3)),
    "largest_tip_shift": ("mm", _largest_shift),
    "mean_canopy_tilt": ("deg", _mean_shift("canopy.angle", rise.DEGREES)),
    "largest_change_of_a_mean_force": ("%", _most_changed),
    OVER_IDEAL: ("1", _peak_over_ideal),
    "rms_pin_forces": ("N", _pin_rms_fluctuation),
    **{
        f"rms_{body}_angular_acceleration": (
            "deg/s^2",
            _rms_fluctuation(f"{body}.angular_acceleration", rise.DEGREES),
        )
        for body in SHAKEN
    },
    "rms_tip_forward": ("mm", _rms_fluctuation("tip.x", 1e3)),
    "energy_lost_in_rise": ("J", _lost),
    **{f"mean_force_{name}": ("N", _mean(channel)) for channel, name in FORCES.items()},
    **{f"change_of_mean_force_{name}": ("%", _change(channel)) for channel, name in FORCES.items()},
    **{f"rms_force_{name}": ("N", _rms_fluctuation(channel)) for channel, name in FORCES.items()},
}


def measure(results: Mapping[str, Result]) -> list[Number]:
    """All numbers of the runs, and those of the closed form beside them."""
    ideal = results[IDEAL]
    numbers = [
        compared(name, case, unit, result, ideal, get)
        for case, result in results.items()
        for name, (unit, get) in MEASURES.items()
    ]
    numbers = [
        replace(n, numerical_error=n.numerical_error + _peak_between_records(results[n.case], ideal))
        if n.name == OVER_IDEAL
        else n
        for n in numbers
    ]
    numbers += measured_all(results, {name: ("N", peak) for name, peak in PEAKS.items()})
    for case, result in results.items():
        if case != IDEAL:
            numbers += posture_numbers(case, result.scenario)
    return numbers
