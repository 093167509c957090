"""The findings on the drive modes, and the study on machines of one's own."""

from __future__ import annotations

from pathlib import Path

import pytest

from studies.common import paper_machine
from studies.common.options import Options
from studies.common.subject import Subject, own_subject
from studies.common.words import Chapter
from studies.drive_mode import cases as study
from studies.drive_mode.cases import COLUMNS, MODES, OIL, PINS, START_PINS, case_name
from studies.drive_mode.run import DriveMode
from support_exudyn import ClearancePin, OilColumn
from support_exudyn.model.drives.coupled_drive import CoupledDrive
from tests.studies.forms import ONLY_WHOLE, Numbers, numbers_of, results, written
from user_forces import Ambrosio

IDEAL, WITH_CLEARANCE = PINS


@pytest.fixture(scope="module", params=ONLY_WHOLE)
def out(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return results("drive_mode", request.param, tmp_path_factory)


@pytest.fixture(scope="module")
def numbers(out: Path) -> Numbers:
    return numbers_of(out)


@pytest.mark.parametrize(
    ("name", "share"),
    [
        ("largest_pin_force_in_motion", 0.5),  # 0.42 and 0.37
        ("largest_pin_force_after_stop", 0.5),  # 0.42, 0.23 and 0.32
        ("std_pin_force", 0.25),  # 0.17 to 0.23
        ("rms_pin_force", 0.1),  # 0.03
        ("largest_angular_acceleration", 0.25),  # 0.12 and 0.09; an impulse on rigid columns
    ],
)
def test_the_gentle_drive_saves_most_of_the_shock(numbers: Numbers, name: str, share: float) -> None:
    for columns in COLUMNS[1:] if name == "largest_angular_acceleration" else COLUMNS:
        sudden, gentle = (numbers[name, case_name(mode, WITH_CLEARANCE, columns)]["value"] for mode in MODES)
        assert gentle < share * sudden


def test_the_sudden_start_strikes_rigid_columns_only(numbers: Numbers) -> None:
    struck = {case for name, case in numbers if name.startswith("impulse")}
    assert struck == {case_name("mode 1", pin, "rigid") for pin in PINS}
    for pin in PINS:
        case = case_name("mode 1", pin, "rigid")
        for column in ("front_column", "rear_column"):
            # pushed at the start, held back at the end
            assert numbers[f"impulse_{column}_start", case]["value"] > 0.0
            assert numbers[f"impulse_{column}_end", case]["value"] < 0.0
            # where velocities jump, no largest value is printed
            assert (f"largest_{column}_force", case) not in numbers
        assert ("largest_angular_acceleration", case) not in numbers
    ideal, loose = (case_name("mode 1", pin, "rigid") for pin in PINS)
    assert numbers["impulse_pin_start", ideal]["value"] > 0.0
    for name in ("largest_pin_force_in_motion", "largest_pin_force_after_stop", "std_pin_force"):
        assert (name, ideal) not in numbers
        assert (name, loose) in numbers  # its contact gives way


def test_the_band_is_of_the_oil_that_it_says() -> None:
    runs = DriveMode(Options(Path())).starts
    assert len(runs) == len(START_PINS) * len(OIL)
    column = {run.actuators["rear_column"] for run in runs.values()}
    found = {(one.bulk_modulus, one.line) for one in column if isinstance(one, OilColumn)}
    assert found == set(OIL.values())
    oil = paper_machine.oil_columns()["rear_column"]
    assert (oil.bulk_modulus, oil.line) == OIL[study.USUAL]


def test_an_inlet_is_not_a_displacement(numbers: Numbers) -> None:
    def value(name: str, mode: str, pin: str = IDEAL) -> float:
        return float(numbers[name, case_name(mode, pin, "cylinder")]["value"])

    for mode in MODES:
        # sized for 500 mm, at the loads of the rise
        assert value("settled_extension_front", mode) == pytest.approx(500.0, abs=5.0)
        # the rear columns carry more: by half a per cent slower
        assert 0.99 < value("speed_in_mid_rise_rear", mode) / value("speed_in_mid_rise_front", mode) < 0.997
        # pressure at rest carries the weight: 45 kN on 0.098 m^2
        assert 0.3 < value("pressure_after_rear", mode) < 0.7
    # by what the oil gives; and where no liquid would follow
    assert value("overshoot_front", "mode 1") > 10.0 * value("overshoot_front", "mode 2")
    assert value("least_pressure_front", "mode 1") < 0.0 < value("least_pressure_front", "mode 2")
    closed_at_once, ramped = (value("largest_pin_force_after_stop", mode, WITH_CLEARANCE) for mode in MODES)
    assert ramped < 0.5 * closed_at_once


# --- machines of one's own ---

OWN = """
machine = "zf18000"
duration_s = 1.0
[drive]
mode = 2
stroke_mm = 100
start_s = 0.2
end_s = 0.8
[pins.front_base]
clearance_mm = 1
bore_radius_mm = 65.5
restitution = 0.9
friction = 0.1
"""
ON_OIL = """
[actuators.front_column]
type = "OilColumn"
bore_area_mm2 = 98174.77
oil_length_mm = 500
bulk_modulus_MPa = 1500
"""


def planned(subject: Subject) -> DriveMode:
    return DriveMode(Options(Path(), subject=subject))


def own(folder: Path, text: str) -> Path:
    path = folder / "my_support.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_modes_of_ones_own_machine_have_its_stroke_and_pin(tmp_path: Path) -> None:
    plan = planned(own_subject(own(tmp_path, OWN)))
    assert plan.pins == ("ideal pin", "1 mm")
    assert len(plan.rises) == 4  # rigid only: no oil is given
    for name, case in plan.rises.items():
        assert case.drive.span(case.duration) == (0.0, 0.1)
        assert case.drive.breaks == (0.2, 0.8)
        (pin,) = case.pins.values()
        assert case.pins.keys() == {"front_base"}
        friction = pin.contact.friction if isinstance(pin, ClearancePin) else pin.friction
        assert isinstance(pin, ClearancePin) == ("1 mm" in name)
        assert friction == Ambrosio(sliding_coefficient=0.1)  # ideal or not
    plan = planned(own_subject(own(tmp_path, OWN + ON_OIL)))
    assert plan.columns == ("rigid", "oil")
    assert set(plan.rises["mode 1, 1 mm, oil columns"].compliant_actuators) == {"front_column"}
    assert not plan.rises["mode 1, 1 mm, rigid columns"].compliant_actuators


def test_the_ram_of_a_two_leg_shield_follows_its_leg() -> None:
    plan = planned(own_subject(Path("two_leg_shield"), "rear_base"))
    assert (plan.leading, plan.actuators) == (("leg",), ("leg", "ram"))
    for name, case in plan.rises.items():
        leg, ram = (case.drive_of(one) for one in plan.actuators)
        assert (type(leg), leg.span(case.duration)) == (MODES[name.partition(",")[0]], (0.0, 1.15))
        assert isinstance(ram, CoupledDrive)
        assert ram.lead == leg


def test_the_study_of_ones_own_machine_leaves_the_paper_out(tmp_path: Path) -> None:
    folder = tmp_path / "out"
    folder.mkdir()
    chapter = Chapter.load(written("drive_mode", "rough", folder, subject=own_subject(own(tmp_path, OWN))))
    assert "my support" in chapter.title
    assert "paper" not in " ".join((*chapter.method, *chapter.findings, chapter.answer)).lower()
    assert [picture.stem for picture in chapter.pictures] == ["fig13_rigid_columns"]
