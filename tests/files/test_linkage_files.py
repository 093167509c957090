"""Files of `kind = "linkage"`: where the start posture comes from, and what is said of mistakes."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from support_exudyn import (
    CubicStep,
    Machine,
    PlanarLinkage,
    Scenario,
    Steady,
    load_machine,
    ravn_slider_crank,
    read_scenario,
    simulate,
)
from support_exudyn.files.machines import shipped
from support_exudyn.files.scenarios.scenario_file import scenario_text
from tests.cases.linkage_text import linkage_text
from user_forces import InputError

CRANK_ROCKER = """
kind = "linkage"
name = "crank-rocker"

[drawing_mm]
O = [0, 0]
A = [100, 0]
B = [365, 300]
C = [350, 0]

[bodies.crank]
bar = ["O", "A"]
length_mm = 100
mass_kg = 1

[bodies.coupler]
bar = ["A", "B"]
length_mm = 400
mass_kg = 3

[bodies.rocker]
bar = ["C", "B"]
length_mm = 300
mass_kg = 2.5

[pins]
O = ["ground", "crank"]
A = ["crank", "coupler"]
B = { at = "B", bodies = ["coupler", "rocker"] }
C = ["ground", "rocker"]

[cranks]
motor = "crank"

[traced_points]
tip = ["coupler", "B"]

[start]
angle_deg = { crank = 0 }

[bore_radius_mm]
B = 10

[width_mm.pins]
B = 30
"""

TERNARY = """
[bodies.ternary]
bar = ["C", "B"]
length_mm = 300
points_mm = { D = [160.697, -191.511] }
mass_kg = 4
centre_mm = [140, -60]
inertia_kg_m2 = 0.05
"""

ON_A_GUIDE = """
kind = "linkage"

[drawing_mm]
A = [0, 0]
B = [40, 30]
C = [160, 5]

[bodies.crank]
bar = ["A", "B"]
length_mm = 50
mass_kg = 0.3

[bodies.rod]
bar = ["B", "C"]
length_mm = 120
mass_kg = 0.21

[bodies.slider]
centre_mm = [160, 5]
mass_kg = 0.14
inertia_kg_m2 = 1e-5

[pins]
A = ["ground", "crank"]
B = ["crank", "rod"]
C = ["slider", "rod"]

[guides.guide]
body = "slider"
at = "C"
through = "A"
block_mm = [40, 20]

[start]
angle_deg = { crank = 30 }
"""


def built(folder: Path, text: str) -> PlanarLinkage:
    path = folder / "machine.toml"
    path.write_text(text, encoding="utf-8")
    found = load_machine(path).machine
    assert isinstance(found, PlanarLinkage)
    return found


def test_lengths_are_exact_where_the_drawing_is_rough(tmp_path: Path) -> None:
    linkage = built(tmp_path, CRANK_ROCKER).linkage()
    crank, coupler, rocker = linkage.bodies.values()
    assert crank.angle == 0.0
    assert crank.centre == pytest.approx((0.05, 0.0), abs=1e-15)
    # closed form: the triangle of 250, 400 and 300 mm
    apex = math.acos((0.25**2 + 0.4**2 - 0.3**2) / (2 * 0.25 * 0.4))
    assert coupler.angle == pytest.approx(apex, abs=1e-12)
    assert rocker.angle == pytest.approx(
        math.atan2(0.4 * math.sin(apex), 0.4 * math.cos(apex) - 0.25), abs=1e-12
    )
    assert coupler.inertia == pytest.approx(3 * 0.4**2 / 12)
    assert linkage.points["tip"].point == pytest.approx(linkage.pins["B"].first_point, abs=1e-13)


def test_a_body_with_points_of_its_own_lies_by_the_drawing(tmp_path: Path) -> None:
    text = CRANK_ROCKER.replace('[bodies.rocker]\nbar = ["C", "B"]\nlength_mm = 300\nmass_kg = 2.5\n', TERNARY)
    text = text.replace('"rocker"', '"ternary"').replace("B = 10\n", "").replace("B = 30\n", "")
    text = text.replace('tip = ["coupler", "B"]', 'tip = ["ternary", "D"]')
    linkage = built(tmp_path, text).linkage()
    body, angle = linkage.bodies["ternary"], linkage.bodies["ternary"].angle
    pivot = np.array([0.35, 0.0])
    turned = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    np.testing.assert_allclose(body.centre, pivot + turned @ [0.14, -0.06], atol=1e-15)
    np.testing.assert_allclose(linkage.points["tip"].point, pivot + turned @ [0.160697, -0.191511], atol=1e-15)
    assert (body.mass, body.inertia) == (4.0, 0.05)


def test_a_slider_crank_from_a_file_is_the_slider_crank(tmp_path: Path) -> None:
    linkage = built(tmp_path, ON_A_GUIDE).linkage()
    closed_form = replace(ravn_slider_crank(), start_angle=math.radians(30.0)).linkage()
    assert linkage.bodies["slider"].centre == pytest.approx(closed_form.bodies["slider"].centre, abs=1e-13)
    assert linkage.bodies["rod"].angle == pytest.approx(closed_form.bodies["rod"].angle, abs=1e-12)
    assert load_machine(tmp_path / "machine.toml").blocks == {"guide": (0.04, 0.02)}


def test_velocities_at_the_start_belong_to_each_other(tmp_path: Path) -> None:
    text = ON_A_GUIDE.replace("crank = 30 }", "crank = 30 }\nangular_velocity_rad_per_s = { crank = 150 }")
    linkage, closed_form = built(tmp_path, text).linkage(), ravn_slider_crank()
    expected = closed_form.slider_speed(math.radians(30.0), 150.0)
    assert linkage.bodies["slider"].velocity == pytest.approx((expected, 0.0), abs=1e-11)
    assert linkage.bodies["crank"].spin == pytest.approx(150.0, rel=1e-13)


# --- machines of other kinds as linkages ---


@pytest.mark.parametrize("name", ["reference", "zf18000", "two_leg_shield", "slider_crank"])
def test_every_shipped_machine_can_be_written_as_a_linkage(name: str, tmp_path: Path) -> None:
    own: Machine = shipped(name).machine
    linkage = own.linkage()
    linkage = replace(linkage, points={f"{name}_path": one for name, one in linkage.points.items()})
    written = built(tmp_path, linkage_text(linkage))
    drive = Steady(rate=30.0) if name == "slider_crank" else CubicStep(stroke=0.02, start=0.001, end=0.02)
    drives = {follower: own.coupled_drive(follower, drive, 0.02) for follower in own.leaders}
    runs = [
        simulate(
            Scenario(machine=one, drive=drive, drives=drives, duration=0.02, step=1e-4, record_period=1e-3)
        )
        for one in (own, written)
    ]
    both = [channel for channel in runs[1].channels if channel in runs[0].channels]
    for channel in [channel for channel in both if not channel.startswith("energy")]:
        one, other = (run[channel] - (run[channel][0] if channel.endswith(".angle") else 0.0) for run in runs)
        np.testing.assert_allclose(other, one, atol=1e-7 * np.abs(one).max() + 1e-9)


GEARED = """
kind = "linkage"

[drawing_mm]
A = [0, 0]
B = [100, 0]

[bodies.wheel]
centre_mm = [0, 0]
mass_kg = 2
inertia_kg_m2 = 0.01

[bodies.pinion]
centre_mm = [100, 0]
mass_kg = 1
inertia_kg_m2 = 0.001

[pins]
A = ["ground", "wheel"]
B = ["ground", "pinion"]

[gears.mesh]
bodies = ["wheel", "pinion"]
ratio = -3

[cranks]
motor = "wheel"

[start]
angle_deg = { wheel = 10 }
"""


def test_gears_turn_both_bodies_to_the_start(tmp_path: Path) -> None:
    bodies = built(tmp_path, GEARED).linkage().bodies
    assert [math.degrees(body.angle) for body in bodies.values()] == pytest.approx([10.0, -30.0])


# --- what acts by springs, dampers, torques and forces ---

DRIVEN_BY_FORCES = """
[springs.between]
bodies = ["crank", "coupler"]
at = ["O", "M"]
stiffness_N_per_m = 3000
damping_N_s_per_m = 40

[torsion_springs.twist]
bodies = ["ground", "rocker"]
stiffness_N_m_per_rad = 5
free_turn_deg = 10

[torques.pull]
body = "rocker"
torque_N_m = 6

[forces.push]
body = "coupler"
at = "M"
force_N = [0, -20]
course = { type = "HarmonicCourse", period_s = 0.5, mean = 1 }
"""
FREE = CRANK_ROCKER.replace('[cranks]\nmotor = "crank"\n', "").replace(
    "length_mm = 400", "length_mm = 400\npoints_mm = { M = [200, 0] }"
)


def test_springs_torques_and_forces_act_where_the_linkage_starts(tmp_path: Path) -> None:
    found = built(tmp_path, FREE + DRIVEN_BY_FORCES)
    assert set(found.loads) == {"between", "twist", "pull", "push"}
    middle = np.array(found.linkage().bodies["coupler"].centre)
    np.testing.assert_allclose(found.loads["push"].point, middle, atol=1e-15)
    assert found.loads["between"].free_length == pytest.approx(float(np.hypot(*middle)))  # slack at the start
    assert list(found.linkage().points) == ["tip"]
    result = simulate(Scenario(machine=found, duration=0.2, step=1e-4))
    assert result["between.force"][0] == pytest.approx(0.0, abs=1e-9)
    turned = result["rocker.angle"] - result["rocker.angle"][0]
    np.testing.assert_allclose(result["twist.moment"], -5 * (turned - math.radians(10)), atol=1e-9)
    np.testing.assert_allclose(result["push.force_y"], -20 * (1 + np.sin(4 * np.pi * result.time)), atol=1e-9)
    assert np.abs(result["energy.balance"]).max() < 1e-5 * result["energy.kinetic"].max()
    path = tmp_path / "whole.toml"
    path.write_text(scenario_text(result.scenario), encoding="utf-8")
    assert read_scenario(path) == result.scenario


def test_drives_that_the_linkage_cannot_follow_are_refused(tmp_path: Path) -> None:
    # a double rocker: the longest and the shortest together are longer than the other two
    text = CRANK_ROCKER.replace("length_mm = 300", "length_mm = 200").replace(
        "B = [365, 300]", "B = [300, 250]"
    )
    text = text.replace("{ crank = 0 }", "{ crank = 90 }").replace("length_mm = 400", "length_mm = 200")
    with pytest.raises(InputError, match="drive"):
        Scenario(machine=built(tmp_path, text), drive=Steady(rate=-60.0), duration=0.1)
