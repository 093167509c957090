"""Loads in scenarios and files: their channels, what is refused, and the times that steps have to follow."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from support_exudyn import (
    AppliedForce,
    CubicStep,
    HarmonicCourse,
    Roof,
    Scenario,
    SpringDamper,
    Steady,
    TableCourse,
    TorsionSpring,
    ravn_slider_crank,
    simulate,
)
from support_exudyn.files.scenarios.scenario_file import scenario_of
from support_exudyn.files.toml.text import parsed
from support_exudyn.model.loads.applied import LoadCourse
from support_exudyn.scenario.timescales import timescales
from tests.roof_cases import TOP, DeadLoad, over_the_canopy, over_the_ram, pressed_support
from user_forces import InputError, Value


def test_a_load_has_its_channels_and_its_energies() -> None:
    loaded, bare = (
        pressed_support(over_the_canopy(0.1)).channel_definitions,
        pressed_support(over_the_canopy(0.1), loads={}),
    )
    assert [name for name in loaded if name not in bare.channel_definitions] == ["roof.force", "roof.gap"]
    assert [loaded[f"roof.{what}"].unit for what in ("force", "gap")] == ["N", "m"]
    assert loaded["energy.elastic"].meaning == "stored in contacts, oil and loads"
    assert bare.channel_definitions["energy.elastic"].meaning == "stored in contacts and oil"
    asked = pressed_support(over_the_canopy(0.1), channels=("roof.gap",), duration=0.01)
    assert list(simulate(asked).channels) == ["time", "roof.gap"]


@pytest.mark.parametrize("name", ["canopy", "front_column", "rear_base", "tip", "pin", "energy", "time"])
def test_a_name_that_is_taken_is_refused(name: str) -> None:
    with pytest.raises(InputError, match=rf"loads\.{name}: the machine has something of this name; allowed:"):
        pressed_support(over_the_canopy(0.1), loads={name: over_the_canopy(0.1)})


SINE = HarmonicCourse(period=0.25)


def coming_on(start: float, end: float, course: LoadCourse | None = None) -> AppliedForce:
    return AppliedForce(body="canopy", point=TOP, full_force=(0.0, -1e5), start=start, end=end, course=course)


REFUSED: dict[str, Callable[[], object]] = {
    r"loads\.roof\.body = 'ram': no such body; allowed: rear_link, ": lambda: pressed_support(over_the_ram()),
    r"Roof\.stiffness = 0\.0: .*allowed: > 0": lambda: replace(over_the_ram(), stiffness=0.0),
    r"Roof\.damping = -1\.0: .*allowed: >= 0": lambda: replace(over_the_ram(), damping=-1.0),
    "3 times and 2 shares": lambda: TableCourse(times=(0.0, 0.1, 0.2), shares=(0.0, 1.0)),
    "the one before": lambda: TableCourse(times=(0.0, 0.2, 0.1), shares=(0.0, 1.0, 2.0)),
    "the course says when": lambda: coming_on(0.1, 0.2, SINE),
    "period": lambda: HarmonicCourse(period=0.0),
    r"end = 0\.1 s: allowed: > start = 0\.1 s, or both 0": lambda: coming_on(0.1, 0.1),
    r"end = 0\.0 s: allowed: > start = 0\.1 s, or both 0": lambda: coming_on(0.1, 0.0),
}


@pytest.mark.parametrize("said", REFUSED)
def test_loads_that_cannot_be_are_refused(said: str) -> None:
    with pytest.raises(InputError, match=said):
        REFUSED[said]()


def test_a_load_on_one_of_two_in_space_is_refused() -> None:
    on_link = over_the_canopy(0.1, body="front_link")
    pressed_support(on_link)
    with pytest.raises(InputError, match=r"loads\.roof\.body = 'front_link': there are two of it in space, "):
        pressed_support(on_link, dimensions=3)


@pytest.mark.parametrize(
    "load", [over_the_canopy(0.1, damping=2.0), DeadLoad(body="canopy", point=TOP, vector=(1.0, 2.0))]
)
def test_a_loaded_scenario_comes_back_from_json(load: Roof | DeadLoad) -> None:
    scene = pressed_support(load)
    assert Value.from_data(json.loads(json.dumps(scene.to_data()))) == scene


# --- the times that steps have to follow ---


def test_steps_follow_the_descent() -> None:
    assert timescales(pressed_support(over_the_canopy(0.1, start=0.03, end=0.07))).drive == pytest.approx(0.04)
    rising = CubicStep(stroke=0.1, start=0.0, end=0.02)
    assert timescales(pressed_support(over_the_canopy(0.1), drive=rising)).drive == 0.02
    # a face that goes on as it does has no time of its own, as a crank has
    crank = ravn_slider_crank()
    press = over_the_canopy(0.1, body="slider", point=crank.linkage().bodies["slider"].centre)
    steady = replace(press, descent=Steady(rate=100.0))
    assert timescales(Scenario(machine=crank, loads={"roof": steady}, duration=0.1)).drive == math.inf


# --- files ---


def test_loads_are_read_from_files() -> None:
    text = """machine = "reference"
duration_s = 1
[loads.spring]
type = "SpringDamper"
body = "canopy"
point_mm = [2000, 1800]
other = "shield"
other_point_mm = [1200, 1400]
stiffness_kN_per_mm = 0.1
free_length_mm = 700
damping_kN_s_per_m = 2
[loads.coil]
type = "TorsionSpring"
body = "canopy"
stiffness_N_m_per_rad = 200
free_turn_deg = 10
[loads.pulse]
type = "AppliedTorque"
body = "rear_link"
full_torque_N_m = 5000
course = { type = "TableCourse", times_s = [0, 0.1], shares = [0, 1] }
"""
    loads = scenario_of(parsed(text, "a"), "a", Path()).loads
    assert loads["spring"] == SpringDamper(
        body="canopy", point=(2.0, 1.8), other="shield", other_point=(1.2, 1.4), stiffness=1e5, free_length=0.7,
        damping=2e3,
    )  # fmt: skip
    assert loads["coil"] == TorsionSpring(body="canopy", stiffness=200.0, free_turn=math.radians(10.0))
    assert loads["pulse"].breaks == (0.0, 0.1)
