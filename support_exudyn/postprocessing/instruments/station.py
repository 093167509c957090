"""A measuring station: the instruments on a machine, by name; their samples of a run; its file and table."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated
from zlib import crc32

import numpy as np
from pydantic import Field

from support_exudyn.files.series.named_series import NamedSeries
from support_exudyn.files.toml.reading import read_value
from support_exudyn.files.toml.text import load_toml
from support_exudyn.files.whole_file import missing_file, whole_file
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND
from support_exudyn.postprocessing.export.whole_set import check_is_no_run
from support_exudyn.postprocessing.instruments.sensors import (
    CLOSE,
    ExtensionSensor,
    Inclinometer,
    Instrument,
    PressureGauge,
    machine_of,
)
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.result import Result
from user_forces.values.units import Seconds
from user_forces.values.value import InputError, Real, Value, Whole, value

BASE = "base"  # what mines call the ground of the model
WRITTEN = {"Pa": ("MPa", 1e-6), "m": ("mm", 1e3), "rad": ("deg", 180.0 / math.pi)}
DIGITS = 10  # of a number: far more than instruments have
DECIMALS = 7  # of MPa, mm, deg: smaller is what rounding of a run leaves of nothing


@value
class MeasuringStation(Value):
    """Instruments and the clock that they share.

    Arguments:
        instruments: by the names of what they measure, such as "front_column.pressure" or "canopy.tilt".
        clock_offset: what the station's clock shows at the start of the run [s], 0 by default.
        seed: of all noise, >= 0; every instrument has its own from it and its name.
    """

    instruments: Annotated[Mapping[str, Instrument], Field(min_length=1)]
    clock_offset: Seconds[Real] = 0.0
    seed: Annotated[Whole, Field(ge=0)] = 0


def measure(result: Result, station: MeasuringStation) -> dict[str, NamedSeries]:
    """The readings of the instruments of a run, by their names, in SI; times are those of the station's clock.

    Raises InputError that names the instrument if the run has not recorded what it needs, or too coarsely; if
    the machine lacks its column, body or place; or if the bore of a column is not known.
    """
    readings = {}
    for name, instrument in station.instruments.items():
        try:
            own = np.random.default_rng([station.seed, crc32(name.encode())])
            time, values = _samples(instrument, result, own)
        except InputError as error:
            raise InputError(f"{name}: {error}") from None
        readings[name] = NamedSeries(name, instrument.UNIT, time + station.clock_offset, values)
    return readings


def _samples(instrument: Instrument, result: Result, random: np.random.Generator) -> tuple[Series, Series]:
    """The samples of an instrument: times (k,) [s] and readings (k,) in SI; random: of its noise.

    Between two records a reading is on the straight line. A last record at a shorter distance is left out.

    Raises InputError if the records are too far apart for the filter or the samples, or are not evenly spaced.
    """
    time, steps = result.time, np.diff(result.time)
    if time.size < 3:
        raise InputError(f"the run has {time.size} records; allowed: at least 3")
    period = float(steps[0])
    uneven = np.flatnonzero(np.abs(steps - period) > CLOSE * period)
    if uneven.size and uneven[0] < steps.size - 1:
        raise InputError(
            f"the records are {period:g} s apart, and {steps[uneven[0]]:g} s at t = {time[uneven[0]]:g} s; "
            "allowed: runs with one record_period"
        )
    time = time[: time.size - uneven.size]
    if instrument.low_pass is not None:
        instrument.low_pass.check(period)
    if instrument.rate * period > 1.0 + CLOSE:
        raise InputError(
            f"rate = {instrument.rate:g} Hz: the records are {period:g} s apart; allowed: up to "
            f"{1.0 / period:g} Hz, or runs with a shorter record_period"
        )
    signals = instrument.signals(result)[: len(time)]
    if instrument.low_pass is not None:
        signals = instrument.low_pass.filtered(signals, period)
    count = int(np.floor((time[-1] - time[0]) * instrument.rate * (1.0 + 1e-12))) + 1
    when = time[0] + np.arange(count) / instrument.rate
    values = np.interp(when, time, instrument.reading(signals))
    if instrument.noise:
        values = values + instrument.noise * random.standard_normal(values.size)
    if instrument.resolution:
        values = instrument.resolution * np.round(values / instrument.resolution) + 0.0  # no -0
    return when, values


def usual_station(scenario: Scenario) -> tuple[MeasuringStation, dict[str, InputError]]:
    """The usual instruments of mines, on any machine, 10 times a second, without errors.

        COLUMN.pressure, COLUMN.extension     of every actuator
        BODY.tilt                             of every body, at its centre of mass
        base.tilt                             of the ground

    Returns:
        the station, and what is left out: pressures of columns whose bore the scenario does not say, by name,
        each with the reason.
    """
    instruments: dict[str, Instrument] = {}
    refused: dict[str, InputError] = {}
    for column in scenario.linkage.actuators:
        gauge = PressureGauge(column=column)
        try:
            gauge.area(scenario)
            instruments[f"{column}.pressure"] = gauge
        except InputError as error:
            refused[f"{column}.pressure"] = error
        instruments[f"{column}.extension"] = ExtensionSensor(column=column)
    instruments[f"{BASE}.tilt"] = Inclinometer(body=GROUND)
    instruments |= {f"{body}.tilt": Inclinometer(body=body) for body in machine_of(scenario).bodies}
    return MeasuringStation(instruments=instruments), refused


def read_station(path: str | Path) -> MeasuringStation:
    """The station of a TOML file; `looking_at_runs.md` has one.

    Raises InputError with a line for each thing that is wrong: file, key, value and what is allowed; OSError if
    the file cannot be read.
    """
    path = Path(path)
    try:
        table = load_toml(path)
    except FileNotFoundError as error:
        raise missing_file(path, "the TOML file of instruments") from error
    return read_value(MeasuringStation, table, str(path))


def write_measured(measured: Mapping[str, NamedSeries], path: str | Path) -> Path:
    """Write readings as a CSV table with columns such as `front_column.pressure_MPa`, which `compare` reads.

    A row for every time of any of them. Numbers have ten digits, and readings at most seven decimals; a cell is
    empty where an instrument with another rate has no sample.

    Raises InputError if a run is at the path; OSError if it cannot be written.
    """
    import pandas as pd  # which readings alone have no use for

    path = Path(path)
    check_is_no_run(path)
    columns = {}
    for name, series in measured.items():
        unit, scale = WRITTEN[series.unit or ""]
        rounded = np.round(scale * series.values, DECIMALS) + 0.0  # no -0
        columns[f"{name}_{unit}"] = pd.Series(rounded, series.time)
    table = pd.concat(columns, axis=1, sort=True).rename_axis("time_s").reset_index()
    with whole_file(path) as temporary:
        table.to_csv(temporary, index=False, float_format=f"%.{DIGITS}g")
    return path
