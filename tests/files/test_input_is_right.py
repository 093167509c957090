"""Input that has two meanings or none is refused or reported with a number, and never used silently."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from support_exudyn import (
    AppliedTorque,
    Body,
    Gear,
    Linkage,
    Result,
    Scenario,
    SimulationError,
    SuddenOpening,
    simulate,
)
from support_exudyn.__main__ import main
from support_exudyn.files.machines.read import SHIPPED, load_machine
from support_exudyn.files.scenarios.scenario_file import (
    read_scenario,
    read_scenario_file,
    scenario_text,
    simple_scenario,
)
from support_exudyn.machines.check import check_machine
from support_exudyn.machines.check.joint_warnings import joint_warnings
from support_exudyn.machines.planar_linkage import PlanarLinkage
from support_exudyn.model.linkage import pinned
from tests.cases.cylinder_cases import CYLINDER
from tests.formulations.hydraulics.leg_cases import Uprights
from user_forces import InputError

ROCKER = (Path(load_machine.__code__.co_filename).parent / "crank_rocker.toml").read_text(encoding="utf-8")
CUBIC = {"type": "CubicStep", "start_s": 0, "end_s": 1}
COUPLED = {"type": "CoupledDrive", "lowest_rad": 0, "reach_rad": 1, "coefficients_rad": [0, 1]}


@pytest.mark.parametrize(
    ("machine", "drive", "goal"),
    [
        ("crank_rocker", CUBIC | {"stroke_deg": 90}, 0.5 * math.pi),
        ("crank_rocker", COUPLED | {"lead": CUBIC | {"stroke_rad": 0.5}}, 1.0),
        ("excavator_bucket", {"type": "Steady", "rate_mm_per_s": 2}, 2e-3),
    ],
)
def test_drives_in_their_units_are_written_and_read_alike(
    machine: str, drive: Mapping[str, Any], goal: float, tmp_path: Path
) -> None:
    scenario = simple_scenario(machine, duration_s=1, drive=drive)
    assert scenario.drive.extension(1.0) == pytest.approx(goal)
    (tmp_path / "written.toml").write_text(scenario_text(scenario), encoding="utf-8")
    assert read_scenario(tmp_path / "written.toml") == scenario


@pytest.mark.parametrize("name", ["pin.B", "a/b", "a b", "a\0b", "", "naïve!"])
def test_names_that_no_channel_can_have_are_refused(name: str) -> None:
    said = 'allowed: letters of any language, digits, "_" and "-"'
    bodies = load_machine("crank_rocker").machine.linkage().bodies
    moment = AppliedTorque(body="rocker", full_torque=1.0)
    for build in (
        lambda: simple_scenario("crank_rocker", duration_s=1, loads={name: moment}),
        lambda: Scenario(machine=PlanarLinkage(drawing=Linkage(bodies={name: bodies["crank"]})), duration=1.0),
    ):
        with pytest.raises(InputError) as refused:
            build()
        assert said in str(refused.value)


def test_names_have_the_letters_of_any_language(tmp_path: Path) -> None:
    name = "Stütze_连杆-1"
    moment = AppliedTorque(body="rocker", full_torque=1.0)
    run = simulate(simple_scenario("crank_rocker", duration_s=0.01, loads={name: moment}))
    again = Result.load(run.save(tmp_path / "run.h5"))
    np.testing.assert_array_equal(again[f"{name}.moment"], run[f"{name}.moment"])


def machine_of(folder: Path, *changes: tuple[str, str], text: str = ROCKER) -> Path:
    """A machine's file with lines changed."""
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    (folder / "machine.toml").write_text(text, encoding="utf-8")
    return folder / "machine.toml"


SPRING = (
    '\n[springs.s]\nbodies = ["{}", "{}"]\nat = ["{}", "{}"]\nstiffness_N_per_m = 1000\nfree_length_mm = 100\n'
)
TORSION = '\n[torsion_springs.t]\nbodies = ["{}", "{}"]\nstiffness_N_m_per_rad = 9\nfree_turn_deg = {}\n'


def test_the_ground_may_stand_second(tmp_path: Path) -> None:
    runs = []
    for spring, torsion in (
        (("ground", "rocker", "O", "B"), ("ground", "rocker", 20)),
        (("rocker", "ground", "B", "O"), ("rocker", "ground", -20)),
    ):
        path = machine_of(tmp_path, text=ROCKER + SPRING.format(*spring) + TORSION.format(*torsion))
        runs.append(simulate(Scenario(machine=load_machine(path).machine, duration=0.05)))
    for name in ("s.force", "t.moment", "crank.moment"):
        np.testing.assert_allclose(runs[0][name], runs[1][name], rtol=1e-12)


CHAIN = ('crank = "crank"', 'crank = "crank"\nelbow = "coupler"')


def test_a_crank_turns_against_the_ground_and_check_says_so(tmp_path: Path) -> None:
    opened = ('B = ["coupler", "rocker"]\n', ""), ("B = 10\n", "")
    report = check_machine(load_machine(machine_of(tmp_path, CHAIN, *opened)))
    assert 'elbow: turns coupler against the ground (on = "ground")' in report.facts
    assert report.numbers["cranks"]["elbow"] == {"body": "coupler", "on": "ground"}
    warned = [one for one in report.warnings if one.startswith("cranks.")]
    assert len(warned) == 1
    assert "cranks.elbow: turns coupler against the ground" in warned[0]
    assert "not against crank" in warned[0]


def test_a_point_drawn_elsewhere_is_reported_with_its_distance(tmp_path: Path) -> None:
    drawn = ("C = [350, 0]", "C = [350, 0]\nM = [250, 173]")
    exact = load_machine(machine_of(tmp_path)).machine.linkage().points
    found = load_machine(machine_of(tmp_path, drawn))
    assert len(found.warnings) == 1
    assert "bodies.coupler.points_mm.M: lies " in found.warnings[0]
    assert found.warnings[0] in check_machine(found).warnings
    assert not any(load_machine(name).warnings for name in SHIPPED)
    assert exact  # the drawing of the shipped machine has no M


def test_a_scenario_without_a_drive_is_warned_of(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    machine_of(tmp_path)
    head = 'machine = "machine.toml"\nduration_s = 0.01\n'
    (tmp_path / "run.toml").write_text(head, encoding="utf-8")
    assert main(["run", str(tmp_path / "run.toml")]) == 0
    assert "warning: crank: held, for the scenario has no [drive]" in capsys.readouterr().err
    (tmp_path / "held.toml").write_text(head + '[drive]\ntype = "Held"\n', encoding="utf-8")
    assert read_scenario_file(tmp_path / "held.toml").warnings == ()


GENEVA = """
kind = "linkage"

[drawing_mm]
O = [0, 0]
A = [60, 0]
C = [100, 0]
S = [20, 0]

[bodies.crank]
bar = ["O", "A"]
mass_kg = 1

[bodies.wheel]
centre_mm = [100, 0]
mass_kg = 2
inertia_kg_m2 = 0.02

[pins]
O = ["ground", "crank"]
C = ["ground", "wheel"]

[guides.slot]
body = "crank"
at = "A"
on = "wheel"
along = ["C", "S"]
turns = true

[cranks]
crank = "crank"
"""


def test_a_pin_does_not_leave_its_slot(tmp_path: Path) -> None:
    """The pin is sqrt(100^2 + 60^2 - 2 100 60 cos a) mm from C: 80 mm at cos a = 0.6, and 160 mm at most."""
    machine = load_machine(machine_of(tmp_path, text=GENEVA))
    turning = {"type": "Steady", "rate_deg_per_s": 360}
    short, whole = (simple_scenario(machine, duration_s=t, drive=turning) for t in (0.14, 1.0))
    assert simulate(short)["crank.angle"][-1] == pytest.approx(math.radians(50.4))
    with pytest.raises(SimulationError, match=r"guides.slot: its pin leaves the slot at .* up to 80 mm beyond"):
        simulate(whole)
    with pytest.raises(SimulationError) as refused:
        simulate(whole)
    assert refused.value.failure.time == pytest.approx(math.acos(0.6) / (2.0 * math.pi), abs=1e-3)
    warned = check_machine(machine).warnings
    assert any("goes 80 mm beyond an end of its line, which is 80 mm long" in one for one in warned)
    endless = load_machine(machine_of(tmp_path, ('along = ["C", "S"]', 'through = "C"'), text=GENEVA))
    said = "guides.slot: crank moves from -120 to 0 mm along its line; its ends are not known"
    assert any(one.startswith(said) for one in check_machine(endless).warnings)


WHEELS = {
    "first": Body(mass=1.0, inertia=0.01, centre=(0.0, 0.0)),
    "second": Body(mass=1.0, inertia=0.01, centre=(0.3, 0.0)),
    "arm": Body(mass=1.0, inertia=0.01, centre=(0.1, 0.0)),
}


@pytest.mark.parametrize(
    ("pins", "gear", "carrier", "radius"),
    [
        (("ground first", "ground second"), {"ratio": -2.0}, "ground", 0.1),
        (("ground first", "arm second", "ground arm"), {"ratio": -2.0}, "arm", 0.1),
        (("arm first", "arm second"), {"ratio": 4.0}, "arm", 0.1),
        (("ground first",), {"ratio": -2.0}, "no body carries the axes of both first and second", None),
        (("ground first",), {"ratio": 1.0}, "ground", None),
        (("ground first",), {"ratio": -2.0, "carrier": "arm"}, "arm", None),
        (("ground first",), {"ratio": -2.0, "carrier": "first"}, "is a wheel", None),
    ],
)
def test_gears_know_their_carrier(
    pins: tuple[str, ...], gear: Mapping[str, Any], carrier: str, radius: float | None
) -> None:
    places = {name: body.centre for name, body in WHEELS.items()} | {"arm": (0.0, 0.0)}
    joints = {}
    for names in pins:
        one, other = names.split()
        joints[names.replace(" ", "_")] = pinned(one, other, places[other])
    made = Gear(first="first", second="second", **gear)
    if carrier not in ("ground", *WHEELS):
        with pytest.raises(InputError, match=carrier):
            Linkage(bodies=WHEELS, pins=joints, gears={"mesh": made})
        return
    linkage = Linkage(bodies=WHEELS, pins=joints, gears={"mesh": made})
    assert linkage.gears["mesh"].carrier == carrier
    assert linkage.pitch_radius(linkage.gears["mesh"]) == (None if radius is None else pytest.approx(radius))


def test_tooth_forces_are_reported_for_pins_do_not_carry_them() -> None:
    """Wheels of 200 and 100 mm, 6 N m on the second: 60 N along the pitch line, 63.85 N at 20 degrees."""
    pins = {name: pinned("ground", name, WHEELS[name].centre) for name in ("first", "second")}
    bodies = {name: WHEELS[name] for name in pins}
    linkage = Linkage(
        bodies=bodies, pins=pins, gears={"mesh": Gear(first="first", second="second", ratio=-2.0)}
    )
    (said,) = joint_warnings(linkage, {"mesh": -6.0})
    assert "their pins carry no tooth force" in said
    assert "tooth force up to 60 N along the pitch line, 63.85 N at a pressure angle of 20 degrees" in said


@pytest.mark.parametrize("duration", [0.4, 3.0])
def test_a_jack_past_its_stroke_is_refused_at_any_duration(duration: float) -> None:
    short = replace(CYLINDER, rod_side_length=0.05, inlet=SuddenOpening(start=0.1, end=99.0))
    scenario = Scenario(
        machine=Uprights(),
        actuators={"leg0": short},
        duration=duration,
        formulation="compiled",
        record_period=0.01,
    )
    with pytest.raises(SimulationError, match=r"leg0 is extended by 0.* m, beyond its cylinder's end"):
        simulate(scenario)
