"""Instruments read what closed forms say: filters, pressures, noise, digits, times."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from support_exudyn import HydraulicCylinder, OilColumn, Result, Scenario, bore_area, reference_support
from support_exudyn.__main__ import main
from support_exudyn.files.machines.read import machine
from support_exudyn.files.series.read import read_series
from support_exudyn.files.series.units import converted
from support_exudyn.postprocessing.instruments.sensors import (
    ExtensionSensor,
    Inclinometer,
    Instrument,
    LowPass,
    PressureGauge,
)
from support_exudyn.postprocessing.instruments.station import (
    MeasuringStation,
    measure,
    read_station,
    usual_station,
    write_measured,
)
from tests import synthetic
from user_forces.values.value import InputError

REST = Scenario(machine=reference_support(), duration=1.0)
TIME = np.arange(1001) * 1e-3
OIL = OilColumn(bore_area=bore_area(0.25, 2), oil_length=0.5, bulk_modulus=1.96e9)
CYLINDER = HydraulicCylinder(
    bore_area=0.1, rod_side_area=0.02, oil_length=0.5, rod_side_length=0.5, bulk_modulus=1.5e9,
    system_pressure=3e7, nominal_flow=6e-3,
)  # fmt: skip


def pushed(force: np.ndarray, scenario: Scenario = REST, time: np.ndarray = TIME) -> Result:
    """A run in which the front column has this force, and is as long as at the start."""
    length = scenario.linkage.actuators["front_column"].start_length
    channels = {"front_column.force": (force, "N"), "front_column.length": (np.full(time.size, length), "m")}
    return synthetic.result(scenario, time, channels)


def read(result: Result, instrument: Instrument, seed: int = 0) -> np.ndarray:
    station = MeasuringStation(instruments={"one": instrument}, seed=seed)
    return measure(result, station)["one"].values


# --- filter ---


def first_order(t: np.ndarray, w: float) -> np.ndarray:
    """The integral of the step response of 1 / (1 + s/w)."""
    return np.where(t > 0.0, t - (1.0 - np.exp(-w * t)) / w, 0.0)


def second_order(t: np.ndarray, w: float) -> np.ndarray:
    """The same of the Butterworth filter of second order, damped by 1/sqrt(2)."""
    a = w / math.sqrt(2.0)
    return np.where(t > 0.0, t + (np.exp(-a * t) * np.cos(a * t) - 1.0) / a, 0.0)


@pytest.mark.parametrize(("order", "response"), [(1, first_order), (2, second_order)])
@pytest.mark.parametrize("corner", [0.7, 5.0, 40.0])
def test_a_filter_answers_a_step_as_its_closed_form(order: int, response: object, corner: float) -> None:
    # a straight line between two records: the step is a ramp, whose answer is a difference of integrals
    h = 1e-3
    step = np.where(TIME > 0.2, 3.0, 1.0)
    found = LowPass(order=order, corner=corner).filtered(step[:, None], h)[:, 0]
    w, t = 2.0 * math.pi * corner, TIME - 0.2
    exact = 1.0 + 2.0 * (response(t, w) - response(t - h, w)) / h
    np.testing.assert_allclose(found, exact, rtol=0.0, atol=1e-10)


@pytest.mark.parametrize("order", [1, 2, 4, 8])
def test_a_wave_at_the_corner_loses_three_decibels_and_a_constant_nothing(order: int) -> None:
    time = np.arange(20000) * 1e-3
    wave = np.stack([np.sin(2.0 * math.pi * 2.0 * time), np.full(time.size, -7.0)], axis=-1)
    late = LowPass(order=order, corner=2.0).filtered(wave, 1e-3)
    assert np.abs(late[10000:, 0]).max() == pytest.approx(1.0 / math.sqrt(2.0), rel=2e-4)
    np.testing.assert_array_equal(late[:, 1], -7.0)


UNEVEN = np.array([0.0, 0.1, 0.3, 0.4])
BORE = {"column": "front_column", "bore": 0.25}


@pytest.mark.parametrize(
    ("chosen", "time", "said"),
    [
        ({"low_pass": LowPass(corner=60.0)}, TIME, r"corner = 60 Hz.*<= 0.000833333 s, or a corner up to 50"),
        ({"rate": 2000.0}, TIME, r"rate = 2000 Hz: the records are 0.001 s apart; allowed: up to 1000"),
        ({}, UNEVEN, r"0.1 s apart, and 0.2 s at t = 0.1"),
    ],
)
def test_too_coarse_records_are_refused(chosen: dict[str, object], time: np.ndarray, said: str) -> None:
    with pytest.raises(InputError, match=said):
        read(pushed(time, time=time), PressureGauge(**BORE, **chosen))


# --- columns ---


def test_pressure_times_area_is_force() -> None:
    force = np.linspace(-2e5, 8e5, TIME.size)
    run = pushed(force)
    shown = read(run, PressureGauge(column="front_column", bore=0.25, cylinders=2, rate=1000.0))
    np.testing.assert_allclose(shown * 2 * math.pi / 4 * 0.25**2, np.maximum(force, 0.0), rtol=1e-14)
    rod = PressureGauge(column="front_column", side="rod", bore=0.25, rod=0.23, cylinders=2, rate=1000.0)
    ring = 2 * math.pi / 4 * (0.25**2 - 0.23**2)
    np.testing.assert_allclose(read(run, rod) * ring, np.maximum(-force, 0.0), rtol=1e-13)


def test_the_bore_of_an_oil_column_is_its_own() -> None:
    scenario = Scenario(machine=reference_support(), actuators={"front_column": OIL}, duration=1.0)
    run = pushed(np.full(TIME.size, 5e5), scenario)
    for gauge in (
        PressureGauge(column="front_column"),
        PressureGauge(column="front_column", bore=0.25, cylinders=2),
    ):
        np.testing.assert_allclose(read(run, gauge) * OIL.bore_area, 5e5, rtol=1e-14)


def test_in_space_each_side_has_its_share_of_the_bore() -> None:
    scenario = Scenario(
        machine=reference_support(), actuators={"front_column": OIL}, duration=1.0, dimensions=3
    )
    force = np.full(TIME.size, 2e5)
    run = synthetic.result(
        scenario, TIME, {"front_column_left.force": (force, "N"), "front_column.force": (2.0 * force, "N")}
    )
    left, both = (read(run, PressureGauge(column=name))[0] for name in ("front_column_left", "front_column"))
    assert left == pytest.approx(2e5 / (0.5 * OIL.bore_area), rel=1e-14)
    assert both == pytest.approx(left, rel=1e-14)


def test_a_hydraulic_cylinder_tells_its_pressures() -> None:
    scenario = Scenario(machine=reference_support(), actuators={"front_column": CYLINDER}, duration=1.0)
    pressures = {"front_column.pressure": (1e7 + TIME, "Pa"), "front_column.rod_pressure": (2e6 + TIME, "Pa")}
    run = synthetic.result(scenario, TIME, pressures)
    np.testing.assert_array_equal(read(run, PressureGauge(column="front_column", rate=1000.0)), 1e7 + TIME)
    rod = PressureGauge(column="front_column", side="rod", rate=1000.0)
    np.testing.assert_array_equal(read(run, rod), 2e6 + TIME)


@pytest.mark.parametrize(
    ("gauge", "said"),
    [
        (PressureGauge(column="front_column"), "allowed: bore_mm of the gauge"),
        (PressureGauge(column="front_colum", bore=0.25), "no such actuator; did you mean 'front_column'"),
        (PressureGauge(column="rear_column", bore=0.25), "'rear_column.force': was not recorded"),
        (Inclinometer(body="canopy", at="front_base"), "no such place on canopy"),
        (Inclinometer(body="canopy"), "'canopy.angle': was not recorded"),
    ],
)
def test_what_is_missing_is_asked_for(gauge: Instrument, said: str) -> None:
    with pytest.raises(InputError, match=said) as told:
        read(pushed(TIME), gauge)
    assert str(told.value).startswith("one: ")


def test_extension_is_measured_from_the_start() -> None:
    start = REST.linkage.actuators["front_column"].start_length
    run = synthetic.result(REST, TIME, {"front_column.length": (start + TIME, "m")})
    extension = read(run, ExtensionSensor(column="front_column", rate=1000.0))
    np.testing.assert_allclose(extension, TIME, atol=1e-14)


# --- samples, noise, digits, clock ---


def test_noise_is_seeded_and_has_its_rms() -> None:
    gauge = PressureGauge(column="front_column", bore=0.25, rate=1000.0, noise=5e4)
    run = pushed(np.zeros(TIME.size))
    found = read(run, gauge)
    np.testing.assert_array_equal(found, read(run, gauge))
    assert not np.array_equal(found, read(run, gauge, seed=1))
    # of 1001 samples: five standard errors of the RMS and of the mean
    assert np.std(found) == pytest.approx(5e4, rel=5.0 / math.sqrt(2.0 * 1001))
    assert abs(np.mean(found)) < 5.0 * 5e4 / math.sqrt(1001)
    both = measure(run, MeasuringStation(instruments={"another": gauge, "one": gauge}))
    np.testing.assert_array_equal(both["one"].values, found)  # whatever else is there
    assert abs(np.corrcoef(both["one"].values, both["another"].values)[0, 1]) < 5.0 / math.sqrt(1001)


def test_samples_are_taken_at_their_rates_and_told_by_the_clock(tmp_path: Path) -> None:
    slow, fast = (PressureGauge(column="front_column", bore=0.25, rate=rate) for rate in (4.0, 16.0))
    station = MeasuringStation(instruments={"slow": slow, "fast": fast}, clock_offset=0.5)
    found = measure(pushed(1e6 * TIME), station)
    np.testing.assert_allclose(found["slow"].time, 0.5 + np.arange(5) / 4.0)
    np.testing.assert_allclose(found["fast"].values * bore_area(0.25), 1e6 * np.arange(17) / 16.0, rtol=1e-9)
    series = read_series(write_measured(found, tmp_path / "measured.csv")).series
    assert {name: one.unit for name, one in series.items()} == {"slow": "MPa", "fast": "MPa"}
    np.testing.assert_allclose(series["slow"].time, found["fast"].time)
    again = converted(series["slow"], "Pa")
    np.testing.assert_array_equal(np.isnan(again), np.arange(17) % 4 != 0)
    np.testing.assert_allclose(again[::4], found["slow"].values, rtol=0.0, atol=0.1)


# --- what mines measure, the file, the command ---


@pytest.mark.parametrize(
    ("name", "columns"), [("reference", ("front_column", "rear_column")), ("two_leg_shield", ("leg", "ram"))]
)
def test_every_support_has_the_channels_of_mines(name: str, columns: tuple[str, ...]) -> None:
    station, refused = usual_station(Scenario(machine=machine(name), duration=1.0))
    tilts = {f"{body}.tilt" for body in ("canopy", "rear_link", "base")}
    assert station.instruments.keys() >= tilts | {f"{column}.extension" for column in columns}
    assert list(refused) == [f"{column}.pressure" for column in columns]
    oil = Scenario(machine=machine(name), actuators=dict.fromkeys(columns, OIL), duration=1.0)
    station, refused = usual_station(oil)
    assert station.instruments.keys() >= {f"{column}.pressure" for column in columns}
    assert not refused


FILE = """\
clock_offset_s = 0.25
seed = 3

[instruments."front_column.pressure"]
type = "PressureGauge"
column = "front_column"
bore_mm = 250
cylinders = 2
rate_Hz = 5
low_pass = { order = 1, corner_Hz = 2.5 }
noise_MPa = 0.05
resolution_MPa = 0.1
"""


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("corner_Hz = 2.5", "corner_Hz = 0", "corner_Hz = 0: allowed: > 0"),
        ("noise_MPa", "noise", "is written with its unit; allowed: noise_MPa"),
        ("seed = 3", "seed = -1", "seed = -1: allowed: a whole number >= 0"),
    ],
)
def test_a_wrong_file_is_told_with_its_key(tmp_path: Path, old: str, new: str, said: str) -> None:
    path = tmp_path / "instruments.toml"
    path.write_text(FILE.replace(old, new))
    with pytest.raises(InputError) as told:
        read_station(path)
    assert str(told.value).startswith(str(path))
    assert said in str(told.value)


def test_the_command_writes_the_table(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    run = pushed(np.full(TIME.size, 1e6)).save(tmp_path / "run.h5")
    (tmp_path / "instruments.toml").write_text(FILE)
    assert main(["measure", str(run), str(tmp_path / "instruments.toml")]) == 0
    assert "1 instrument, 6 samples" in capsys.readouterr().out
    series = read_series(tmp_path / "run_measured.csv").series
    exact = 1.0 / bore_area(0.25, 2)
    assert np.abs(converted(series["front_column.pressure"], "MPa") - exact).max() < 5 * 0.05 + 0.05
    assert next(iter(series.values())).time[0] == 0.25
    assert main(["measure", str(run), "--json"]) == 1
    assert "'rear_column.length': was not recorded" in capsys.readouterr().err
