"""A measuring station: the instruments on a machine, by name; what they read of a run; its file."""

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated

from pydantic import Field

from support_exudyn.files.series.named_series import NamedSeries
from support_exudyn.files.toml.reading import read_value
from support_exudyn.files.toml.text import load_toml
from support_exudyn.files.whole_file import missing_file
from support_exudyn.model.linkage import GROUND
from support_exudyn.postprocessing.instruments.column_sensors import ExtensionSensor, PressureGauge
from support_exudyn.postprocessing.instruments.inclinometer import Inclinometer
from support_exudyn.postprocessing.instruments.instrument import Instrument, samples
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.result import Result
from user_forces.values.units import Seconds
from user_forces.values.value import InputError, Real, Value, Whole, value

BASE = "base"  # what mines call the ground of the model


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
    """What the instruments read of a run, by their names, in SI; times are those of the station's clock.

    Raises InputError that names the instrument if the run has not recorded what it needs, or too coarsely; if
    the machine lacks its column, body or place; or if the bore of a column is not known.
    """
    found = {}
    for name, instrument in station.instruments.items():
        try:
            time, values = samples(instrument, name, result, station.seed)
        except InputError as error:
            said = str(error)
            raise InputError(said if said.startswith(name) else f"{name}: {said}") from None
        found[name] = NamedSeries(name, instrument.UNIT, time + station.clock_offset, values)
    return found


def usual_station(scenario: Scenario) -> tuple[MeasuringStation, dict[str, InputError]]:
    """What mines measure, on any machine, 10 times a second, by perfect instruments.

        COLUMN.pressure, COLUMN.extension     of every actuator
        BODY.tilt                             of every body, at its centre of mass
        base.tilt                             of the ground

    Returns:
        the station, and what is left out: pressures of columns whose bore the scenario does not say, by name,
        each with the reason.
    """
    linkage = scenario.linkage
    bodies = scenario.space.bodies if scenario.dimensions == 3 else linkage.bodies
    found: dict[str, Instrument] = {}
    refused: dict[str, InputError] = {}
    for column in linkage.actuators:
        gauge = PressureGauge(column=column)
        try:
            gauge.area(scenario)
            found[f"{column}.pressure"] = gauge
        except InputError as error:
            refused[f"{column}.pressure"] = error
        found[f"{column}.extension"] = ExtensionSensor(column=column)
    found[f"{BASE}.tilt"] = Inclinometer(body=GROUND)
    found |= {f"{body}.tilt": Inclinometer(body=body) for body in bodies}
    return MeasuringStation(instruments=found), refused


def read_station(path: str | Path) -> MeasuringStation:
    """The station of a TOML file.

        clock_offset_s = 0.4
        [instruments."front_column.pressure"]
        type = "PressureGauge"
        column = "front_column"
        bore_mm = 250
        cylinders = 2
        low_pass = { order = 2, corner_Hz = 5 }

    Raises InputError with a line for each thing that is wrong: file, key, value and what is allowed; OSError if
    the file cannot be read.
    """
    path = Path(path)
    try:
        table = load_toml(path)
    except FileNotFoundError as error:
        raise missing_file(path, "the TOML file of instruments") from error
    return read_value(MeasuringStation, table, str(path))
