"""Differences against the numerical errors of both numbers or curves.

Errors of runs are estimates from coarser runs (`simulation.estimate`), and some are too small: of 16 481
numbers that were judged by far finer runs 91 had larger errors than estimated, the worst 7.1 times
(`accuracy.md`). So a difference that is larger than both errors is given as a multiple of them, and only from
ten times on it is certain that both are different.
"""

import math
from collections.abc import Iterable, Mapping

import numpy as np
import numpy.typing as npt
from scipy import ndimage

from support_exudyn.postprocessing.comparing.compared_channel import ComparedColumn
from support_exudyn.postprocessing.figures.channels import error_over_time
from support_exudyn.scenario.timescales import timescales
from support_exudyn.simulation.recorded_run import RecordedRun
from support_exudyn.simulation.reported_numbers import ROUNDING, left_by_newton
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

Values = npt.NDArray[np.float64]
# Of a single record, coarser runs can agree by chance. Draft, standard and reference runs of 36 drawn scenes
# were compared: with these, 49 of 7701 curves differ anywhere by more than both errors, the worst 9.7 times.
AROUND = 5  # records to either side of which the largest error is taken
SINGLE = 3.0  # times what is estimated of numbers, which average
ARM = 1.0  # [m], of a body, by which places become angles
# Share of the largest value of a unit, of the whole run, that a safe error is at least: what is nothing in
# truth, as the force of a pin that carries nothing or what is missing of an energy, is rounding of others.
ROUNDED = 1e-12


def recorded_columns(result: Result, names: Iterable[str] | None = None) -> dict[str, ComparedColumn]:
    """Channels of a run with their errors; None: all but time."""
    if names is None:
        names = [name for name in result.channels if name != "time"]
    errors = curve_errors(result, names)
    return {
        name: ComparedColumn(result.unit(name), result.time, result[name], error)
        for name, error in errors.items()
    }


def curve_errors(result: Result, names: Iterable[str]) -> dict[str, Values]:
    """Numerical errors of channels at each of their records, (n,), in their units, by name.

    Record by record as `error_over_time` estimates them from the coarser runs; then of each the largest one of
    the `AROUND` records to either side, and no less than a step may be wrong by; all of it `SINGLE` times. An
    error is at least the largest before: of thousands of records none is to differ by chance, and in chaos
    what is behind an impact is not more certain than that is. Rounding on other processors is added. From the
    horizon on errors are infinite; NaN if the run has none.
    """
    if result.coarser is None:
        return {name: np.full(result.time.size, math.nan) for name in names}
    least, beyond, largest = least_errors(result), result.time >= result.horizon, _largest_values(result)
    found = {}
    for name in names:
        single = error_over_time(result, name)
        if single is None:
            found[name] = np.full(result.time.size, math.nan)
            continue
        unit = result.unit(name)
        near = ndimage.maximum_filter1d(single, 2 * AROUND + 1) + least.get(unit, 0.0)
        errors = np.where(beyond, math.inf, SINGLE * near)
        found[name] = np.maximum.accumulate(errors) + ROUNDED * largest[unit]
    return found


def _largest_values(result: RecordedRun) -> Mapping[str, float]:
    """The largest magnitude of all channels of a unit, by unit."""
    largest: dict[str, float] = {}
    for channel in result.channels.values():
        size = float(np.abs(channel.values[np.isfinite(channel.values)]).max(initial=0.0))
        largest[channel.unit] = max(largest.get(channel.unit, 0.0), size)
    return largest


def least_errors(result: RecordedRun) -> Mapping[str, float]:
    """What coarser runs cannot tell less of than, by unit: a share of the sizes of a run's motion and forces.

    The share is the tolerance that steps are chosen by, else what Newton's method leaves, or rounding. A step
    is wrong by so much of the smallest clearance d, of d/T and d/T^2 in speed and acceleration, T being the
    shortest time in which anything moves (`Timescales`), and of the largest force F, of F d in energy.
    Angles: per 1 m. A scene at rest can be the same to the bit in all of its runs, whatever it is in the
    limit. Without the contact's law, whose module is not imported, the mean step stands for T.
    """
    scenario = result.scenario
    try:
        times = timescales(scenario)
        shortest = min(times.flight, times.resting, times.drive, scenario.duration)
    except InputError:
        shortest = scenario.duration / max(1, result.counts.steps)
    share = scenario.solver.tolerance if scenario.chooses_steps else max(left_by_newton(scenario), ROUNDING)
    clearances = [place.play for place in scenario.contact_places.values()]
    length = min(clearances, default=0.0)
    largest = _largest_values(result)
    moving = {
        unit + per: length / arm / shortest**power
        for unit, arm in (("m", 1.0), ("rad", ARM))
        for per, power in (("", 0), ("/s", 1), ("/s^2", 2))
    }
    moving["J"] = largest.get("N", 0.0) * length
    return {unit: share * moving.get(unit, size) for unit, size in largest.items()}
