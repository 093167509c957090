"""Machines, pins and scenarios in a line of Python are those that files make."""

from pathlib import Path

import numpy as np
import pytest

from support_exudyn import (
    ClearancePin,
    CubicStep,
    Scenario,
    load_machine,
    machine,
    read_scenario,
    simple_scenario,
)
from user_forces import InputError

FILE = """
machine = "zf18000"
duration_s = 5
drive = { mode = 2 }
pins.rear_base = { clearance_mm = 0.5, friction = 0.1, restitution = 0.8 }
"""


def test_a_scenario_in_a_line_is_that_of_a_file(tmp_path: Path) -> None:
    (tmp_path / "one.toml").write_text(FILE)
    pins = {"rear_base": {"clearance_mm": np.float64(0.5), "friction": 0.1, "restitution": 0.8}}
    made = simple_scenario("zf18000", duration_s=5, drive={"mode": 2}, pins=pins)
    assert made == read_scenario(tmp_path / "one.toml")


def test_a_scenario_in_a_line_takes_values_where_files_have_tables() -> None:
    data = load_machine("zf18000")
    pin = ClearancePin.simple(
        clearance=0.5e-3, bore_radius=data.bore_radii["rear_base"], friction=0.1, restitution=0.8
    )
    drive = CubicStep(stroke=data.stroke or 0.0)
    said = simple_scenario(data, duration_s=5, drive={"mode": 2}, pins={"rear_base": {"clearance_mm": 0.5}})
    made = simple_scenario(data.machine, duration_s=5, drive=drive, pins={"rear_base": pin})
    assert made == Scenario(machine=machine("zf18000"), duration=5.0, drive=drive, pins={"rear_base": pin})
    assert said.drive == drive


def test_what_does_not_fit_a_scenario_in_a_line_is_told_by_its_key() -> None:
    with pytest.raises(InputError, match=r"duration: is written with its unit; allowed: duration_s"):
        simple_scenario("zf18000", duration=5)
    with pytest.raises(InputError, match=r"did you mean 'zf18000'"):
        simple_scenario("zf1800", duration_s=5)
    with pytest.raises(InputError, match=r"drive = ClearancePin.*allowed: a table of type"):
        simple_scenario("zf18000", duration_s=5, drive=ClearancePin.simple(clearance=1e-3, bore_radius=0.06))


def test_machines_are_taken_by_name_and_by_path(tmp_path: Path) -> None:
    assert load_machine("reference").machine == machine("reference")
    with pytest.raises(FileNotFoundError, match=r"a machine data file, or one of reference, .*'zf18000'"):
        machine("zf1800")
    with pytest.raises(FileNotFoundError, match=r"nor a folder"):
        machine(tmp_path / "none" / "mine.toml")
    (tmp_path / "mine.toml").write_text("")
    with pytest.raises(FileNotFoundError, match=r"did you mean 'mine\.toml'\?"):
        machine(tmp_path / "mina.toml")
    with pytest.raises(FileNotFoundError, match=r"the TOML file of a scenario; did you mean 'mine\.toml'\?"):
        read_scenario(tmp_path / "mina.toml")
