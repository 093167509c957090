"""Units of series, and titles that have one."""

from __future__ import annotations

import math

import numpy as np
import pytest

from support_exudyn.files.series.named_series import NamedSeries
from support_exudyn.files.series.units import converted, read_unit, split_title
from user_forces import InputError


def series(unit: str | None) -> NamedSeries:
    return NamedSeries("tip.x", unit, np.zeros(1), np.array([2.0]))


@pytest.mark.parametrize(
    ("given_unit", "wanted", "factor"),
    [
        ("inch", "mm", 25.4),
        ("deg", "rad", math.pi / 180.0),
        ("rpm", "rad/s", math.pi / 30.0),
        ("Nm", "kN*m", 1e-3),
        ("l/min", "m^3/s", 1e-3 / 60.0),
        ("g", "m/s^2", 9.80665),
        ("g", "kg", 1e-3),
        ("t", "N", 9806.65),
    ],
)
def test_values_are_converted(given_unit: str, wanted: str, factor: float) -> None:
    assert converted(series(given_unit), wanted) == pytest.approx(2.0 * factor, rel=1e-14)


@pytest.mark.parametrize(
    ("given_unit", "wanted", "message"),
    [
        ("kN", "mm", "tip.x: is in kN, which cannot be given in mm; allowed: units of one kind"),
        ("deg", "", "an angle is no pure number"),
        ("Hz", "rad/s", "an angle is no pure number"),
        (None, "mm", r"its file gives no unit, and mm is asked for; allowed: .*'tip.x \[mm\]'.*compare.toml"),
        ("mm", "furlongish", "'furlongish': is no unit; allowed: such as mm"),
    ],
)
def test_nothing_is_guessed(given_unit: str | None, wanted: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        converted(series(given_unit), wanted)


@pytest.mark.parametrize(
    ("title", "name", "unit"),
    [
        ("time_s", "time", "s"),
        ("tip.x_mm", "tip.x", "mm"),
        ("rear_link.angular_velocity_deg_per_s", "rear_link.angular_velocity", "deg/s"),
        ("k_kN_per_mm", "k", "kN/mm"),
        ("mu [-]", "mu", ""),
        ("x []", "x", None),
        ("pin_A", "pin_A", None),  # no amperes
        ("force [rear]", "force [rear]", None),
        ("v_m_s", "v_m_s", None),  # metres times or by seconds
        ("Time (Second)", "Time", "second"),
        ("time, s", "time", "s"),
        ("Pressure/MPa", "Pressure", "MPa"),
        ("v / (mm/s)", "v", "mm/s"),
        ("mm/s", "mm/s", None),
        ("Force in kN", "Force", "kN"),
        ("Force kN", "Force", "kN"),
        ("Force min", "Force min", None),  # the least
        ("F_KN", "F", "kN"),
        ("p (mpa)", "p", None),
        ("F (Ton)", "F", "t"),
        ("n [rev/min]", "n", "rpm"),
        ("T (℃)", "T", "degC"),
        ("SPEED [MM/S]", "SPEED", "mm/s"),
        ("压力\uff08MPa\uff09", "压力", "MPa"),
        ("acc_g", "acc", "g"),
        ("M [KN.m]", "M", "kN.m"),
    ],
)
def test_titles_have_a_name_and_a_unit(title: str, name: str, unit: str | None) -> None:
    assert split_title(title)[:2] == (name, unit)


@pytest.mark.parametrize(
    ("written", "unit"),
    [
        ("inch/sec**2", "inch/sec**2"),
        ("newton-meter", "newton*meter"),
        ("pound_mass", "pound"),
        ("knewton", "kilonewton"),
        ("no_units", ""),
        ("furlongish", None),
        ("9**9**9", None),
    ],
)
def test_units_of_programs_are_read(written: str, unit: str | None) -> None:
    assert read_unit(written)[0] == unit
