"""Guides with clearance in scenario files: short forms, what the machine's file says, and what is wrong."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from support_exudyn import Scenario, ravn_slider_crank
from support_exudyn.files import parsed, scenario_of
from support_exudyn.files.scenarios.short_joints import ShortGuide
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.model.guides import ClearanceGuide
from user_forces import Ambrosio, CubicCoulomb, Exact, Flores
from user_forces.materials import STEEL, STEEL_35CRMO, plane_contact_stiffness

TOP = 'machine = "slider_crank"\nduration_s = 0.1\ndrive = { type = "Steady", rate_rpm = 100 }\n'
BLOCK = "block_mm = [40, 20]\n"
SHAPE = (0.04, 0.02)
ONE = "clearance_mm = 1\n"


def read(text: str) -> Scenario:
    return scenario_of(parsed(TOP + text, "a.toml"), "a.toml", Path())


def test_few_words_are_enough() -> None:
    scene = read(f"[guides.guide]\nclearance_mm = 0.1\n{BLOCK}")
    stiffness = plane_contact_stiffness(0.002, STEEL, STEEL_35CRMO)
    assert scene.guides == {
        "guide": ClearanceGuide(
            gaps=(1e-4, 1e-4), normal=Exact(stiffness=stiffness, restitution=0.9), block=SHAPE
        )
    }


def test_all_can_be_said() -> None:
    found = read(
        f"[guides.guide]\nclearance_mm = [0.2, 0]\n{BLOCK}restitution = 0.4\nfriction = 0.1\n"
        'friction_law = "CubicCoulomb"\nlaw = "Flores"\nstiffness_N_per_m_to_n = 1e9\n'
    )
    assert found.guides["guide"] == ClearanceGuide(
        gaps=(2e-4, 0.0),
        normal=Flores(stiffness=1e9, restitution=0.4),
        friction=CubicCoulomb(sliding_coefficient=0.1),
        block=SHAPE,
    )


def test_a_block_is_that_of_the_machines_file() -> None:
    short = ShortGuide(clearance=1e-4, friction=0.1)
    found = short.guide(SHAPE)
    assert found == ClearanceGuide.simple(gaps=1e-4, block=SHAPE, friction=Ambrosio(sliding_coefficient=0.1))
    data = replace(MachineData(ravn_slider_crank()), blocks={"guide": SHAPE})
    table = parsed(TOP + "[guides.guide]\nclearance_mm = 0.1\n", "a.toml") | {"machine": data}
    assert scenario_of(table, "a.toml", Path()).guides["guide"] == ClearanceGuide.simple(gaps=1e-4, block=SHAPE)
    assert ShortGuide(clearance=1e-4, pin_radius=0.01).guide(SHAPE) == ClearanceGuide.simple(
        gaps=1e-4, pin_radius=0.01
    )
