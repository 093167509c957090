"""What a roof does to the point under it, by its formulas, and which loads a scenario takes."""

from __future__ import annotations

import json
import math
from dataclasses import replace

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from support_exudyn import (
    CubicStep,
    Drive,
    Held,
    LoadedPoint,
    Roof,
    Scenario,
    Steady,
    ravn_slider_crank,
    simulate,
)
from support_exudyn.scenario.timescales import timescales
from tests.roof_cases import (
    MASS,
    STIFFNESS,
    TOP,
    DeadLoad,
    over_the_canopy,
    over_the_ram,
    pressed_support,
    thrown,
)
from user_forces import InputError, Value

DESCENTS: list[Drive] = [Held(), Steady(rate=0.3), CubicStep(stroke=0.1, start=0.2, end=1.2)]
descents = st.sampled_from(DESCENTS)
dampings = st.sampled_from([0.0, 0.5, 3.0])
times = st.floats(0.3, 1.1)
ways = st.floats(-0.2, 0.2)
speeds = st.floats(-2.0, 2.0)


def roof(descent: Drive, damping: float, gap: float = 0.02) -> Roof:
    return Roof(body="ram", point=TOP, gap=gap, stiffness=2e8, damping=damping, descent=descent)


def at(t: float = 0.0, y: float = 0.0, vy: float = 0.0) -> LoadedPoint:
    return LoadedPoint(t, 0.0, y, 0.0, vy)


# --- the formulas ---


def test_a_roof_by_hand() -> None:
    held = Roof(body="ram", point=TOP, gap=0.25, stiffness=1000.0, descent=Held())
    # all of it exact in binary: 0.25 m deep after 0.5 m up through a gap of 0.25 m
    assert held.force(at(y=0.5)) == (0.0, -250.0)
    assert held.stored(at(y=0.5)) == 31.25
    assert held.observed(at(y=0.5)) == {"force": 250.0, "gap": -0.25}
    assert held.observed(at(y=0.125)) == {"force": 0.0, "gap": 0.125}
    assert held.stored(at(y=0.125)) == 0.0
    # damped with 2 s/m: doubled at 0.5 m/s, nothing from -0.5 m/s on
    damped = replace(held, damping=2.0)
    pushes = [damped.observed(at(y=0.5, vy=speed))["force"] for speed in (0.5, 0.0, -0.25, -0.5, -1.0)]
    assert pushes == [500.0, 250.0, 125.0, 0.0, 0.0]


@given(descent=descents, damping=dampings, t=times, x=ways, y=ways, vx=speeds, vy=speeds)
def test_a_roof_pushes_down_or_not_at_all(
    descent: Drive, damping: float, t: float, x: float, y: float, vx: float, vy: float
) -> None:
    chosen = roof(descent, damping)
    point = LoadedPoint(t, x, y, vx, vy)
    forward, up = chosen.force(point)
    assert (forward, up) == (0.0, -chosen.observed(point)["force"])
    assert up <= 0.0
    # and only where there is no gap
    assert up == 0.0 or chosen.observed(point)["gap"] < 0.0


@given(descent=descents, damping=dampings, t=times, y=ways, vy=speeds)
def test_energy_stored_is_work_minus_loss_minus_what_the_point_gets(
    descent: Drive, damping: float, t: float, y: float, vy: float
) -> None:
    chosen, h = roof(descent, damping), 1e-7
    point = at(t, y, vy)
    gap = chosen.observed(point)["gap"]
    assume(abs(gap) > 1e-6)  # the stored energy has a kink in its slope's slope
    later, earlier = (chosen.stored(at(t + s * h, y + s * h * vy, vy)) for s in (1.0, -1.0))
    work, loss = chosen.powers(point)
    balance = work - loss - chosen.force(point)[1] * vy
    # rounding of up to 2e8 N/m (0.3 m)^2/2 over 0.2 us; the cubic's second derivative is of order h^2
    assert (later - earlier) / (2.0 * h) == pytest.approx(balance, rel=1e-6, abs=0.2)
    assert loss >= 0.0


# --- what a scenario takes ---


def test_breaks_of_the_descent_are_breaks_of_the_run() -> None:
    lowered = over_the_canopy(0.1, start=0.03, end=0.07)
    drive = CubicStep(stroke=0.01, start=0.05, end=0.1)
    assert pressed_support(lowered, drive=drive).breaks == (0.03, 0.05, 0.07, 0.1)
    assert pressed_support(lowered, drive=drive, loads={}).breaks == (0.05, 0.1)


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


def test_a_body_that_is_not_there_is_refused() -> None:
    with pytest.raises(InputError, match=r"loads\.roof\.body = 'ram': no such body; allowed: rear_link, "):
        pressed_support(over_the_ram())


def test_a_load_on_one_of_two_in_space_is_refused() -> None:
    on_link = over_the_canopy(0.1, body="front_link")
    pressed_support(on_link)
    with pytest.raises(InputError, match=r"loads\.roof\.body = 'front_link': there are two of it in space, "):
        pressed_support(on_link, dimensions=3)


@pytest.mark.parametrize(
    ("field", "number", "allowed"),
    [("stiffness", 0.0, "> 0"), ("damping", -1.0, ">= 0")],
)
def test_numbers_that_make_no_sense_are_refused(field: str, number: float, allowed: str) -> None:
    with pytest.raises(InputError, match=rf"Roof\.{field} = {number}: .*allowed: {allowed}"):
        replace(over_the_ram(), **{field: number})


@pytest.mark.parametrize(
    "load", [over_the_canopy(0.1, damping=2.0), DeadLoad(body="canopy", point=TOP, vector=(1.0, 2.0))]
)
def test_a_loaded_scenario_comes_back_from_json(load: Roof | DeadLoad) -> None:
    scene = pressed_support(load)
    assert Value.from_data(json.loads(json.dumps(scene.to_data()))) == scene


# --- the times that steps have to follow ---


def test_a_ram_on_its_roof_vibrates_with_its_mass() -> None:
    # rounding
    assert timescales(thrown(0.01, 1e-3)).resting == pytest.approx(math.sqrt(MASS / STIFFNESS), rel=1e-12)


def test_steps_follow_the_descent() -> None:
    assert timescales(pressed_support(over_the_canopy(0.1, start=0.03, end=0.07))).drive == pytest.approx(0.04)
    rising = CubicStep(stroke=0.1, start=0.0, end=0.02)
    assert timescales(pressed_support(over_the_canopy(0.1), drive=rising)).drive == 0.02
    # a face that goes on as it does has no time of its own, as a crank has
    crank = ravn_slider_crank()
    press = over_the_canopy(0.1, body="slider", point=crank.linkage().bodies["slider"].centre)
    steady = replace(press, descent=Steady(rate=100.0))
    assert timescales(Scenario(machine=crank, loads={"roof": steady}, duration=0.1)).drive == math.inf
