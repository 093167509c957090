"""Courses of forces and torques as data: values, breaks, what is refused; springs in files and pictures."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import (
    AppliedForce,
    AppliedTorque,
    BeddedRoof,
    GroundReaction,
    HarmonicCourse,
    LoadedPoint,
    MomentLoad,
    Roof,
    Scenario,
    SpringDamper,
    Steady,
    TableCourse,
    TorsionSpring,
    TurnedBody,
    reference_support,
)
from support_exudyn.files.scenarios.scenario_file import scenario_of
from support_exudyn.files.toml.text import parsed
from support_exudyn.mechanics.acting_loads import MANY, actions
from support_exudyn.model.loads.load import ActingLoad
from support_exudyn.postprocessing.look import looks
from support_exudyn.postprocessing.summary import what_is_run
from tests.linkage_cases import CrankRocker
from user_forces.values.value import InputError

TABLE = TableCourse(times=(0.1, 0.2, 0.4), shares=(2.0, 1.0, -0.5))
SINE = HarmonicCourse(period=0.25, phase=0.2, mean=0.5)
FORCE = AppliedForce(body="crank", point=(0.1, 0.0), full_force=(2e3, -5e4), course=TABLE)
TORQUE = AppliedTorque(body="crank", full_torque=40.0, course=SINE)
SPRING = SpringDamper(
    body="rocker", point=(0.3, 0.1), other_point=(0.0, 0.0), stiffness=3e3, free_length=0.2, damping=40.0
)
COIL = TorsionSpring(body="rocker", other="crank", stiffness=30.0, free_turn=0.3, damping=0.4)


def test_a_table_is_constant_outside_and_meets_its_points() -> None:
    assert [TABLE.share(t) for t in (0.0, 0.1, 0.2, 0.4, 1.0)] == [2.0, 2.0, 1.0, -0.5, -0.5]
    assert 1.0 < TABLE.share(0.15) < 2.0
    assert TABLE.breaks == FORCE.breaks == (0.1, 0.2, 0.4)
    assert TABLE.largest(1.0) == 2.0
    assert replace(TABLE, between="linear").share(0.3) == pytest.approx(0.25, rel=1e-12)
    assert replace(TABLE, shares=(0.0, 1.0, -3.0)).largest(1.0) == -3.0
    assert replace(TABLE, shares=(0.0, 1.0, -3.0)).largest(0.2) == 1.0


def test_a_sine_swings_about_its_mean() -> None:
    assert SINE.share(0.0) == pytest.approx(0.5 + math.sin(0.2), rel=1e-12)
    assert SINE.share(100.0 * 0.25 + 0.1) == pytest.approx(SINE.share(0.1), rel=1e-9)
    assert SINE.largest(1.0) == 1.5
    assert replace(SINE, mean=-2.0).largest(1.0) == -3.0
    assert TORQUE.shortest_time == pytest.approx(0.25 / (2.0 * math.pi))


@given(
    load=st.sampled_from([SPRING, replace(SPRING, stiffness=0.0), FORCE]),
    x=st.floats(0.05, 0.5), y=st.floats(-0.5, 0.5), vx=st.floats(-2.0, 2.0), vy=st.floats(-3.0, 3.0),
    t=st.floats(0.0, 0.5),
)  # fmt: skip
def test_energy_stored_by_forces_changes_by_the_powers(
    load: AppliedForce | SpringDamper, x: float, y: float, vx: float, vy: float, t: float
) -> None:
    small = 1e-6

    def stored(at: float) -> float:
        return load.stored(LoadedPoint(t + at, x + at * vx, y + at * vy, vx, vy))

    at = LoadedPoint(t, x, y, vx, vy)
    (fx, fy), powers = load.force(at), load.powers(at)
    rate = (stored(small) - stored(-small)) / (2.0 * small)
    assert rate == pytest.approx(powers.work - powers.loss - fx * vx - fy * vy, rel=1e-5, abs=1e-2)
    assert powers.loss >= 0.0


@given(
    load=st.sampled_from([COIL, TORQUE]),
    turn=st.floats(-3.0, 3.0),
    spin=st.floats(-9.0, 9.0),
    t=st.floats(0.0, 0.5),
)
def test_energy_stored_by_moments_changes_by_the_powers(
    load: MomentLoad, turn: float, spin: float, t: float
) -> None:
    small = 1e-6
    at, powers = TurnedBody(t, turn, spin), load.powers(TurnedBody(t, turn, spin))
    ends = [load.stored(TurnedBody(t + h, turn + h * spin, spin)) for h in (-small, small)]
    rate = (ends[1] - ends[0]) / (2.0 * small)
    assert rate == pytest.approx(powers.work - powers.loss - load.moment(at) * spin, rel=1e-5, abs=1e-3)
    assert powers.loss >= 0.0


BED = BeddedRoof(
    body="rocker", points=((0.3, 0.1), (0.5, 0.2)), descent=Steady(rate=0.3), bedding=1e5, damping=0.2
)
ROOF = Roof(body="rocker", point=(0.3, 0.1), descent=Steady(rate=0.3), stiffness=1e5, damping=0.2)
CURVE = GroundReaction(
    body="rocker", point=(0.3, 0.1), convergences=(0.0, 0.2, 0.5), forces=(3e4, 1e4, 2e4), between="smooth"
)


@pytest.mark.parametrize("load", [FORCE, TORQUE, SPRING, COIL, BED, ROOF, CURVE], ids=lambda load: type(load))
def test_compiled_actions_are_those_of_python(load: ActingLoad) -> None:
    motion = np.random.default_rng(3).uniform(-1.0, 1.0, (MANY, len(load.MOTION._fields)))
    forces, stored, observed = actions(load, motion)
    acts = np.array([load.acts(load.MOTION(*row)) for row in motion.tolist()])
    work_and_loss = load.FORCES + np.array([1, 2])
    wanted = np.delete(acts, work_and_loss, axis=1)
    # the same operations; a hypotenuse may be rounded otherwise
    np.testing.assert_allclose(np.column_stack([forces, stored, *observed.values()]), wanted, rtol=1e-13)
    assert np.any(acts[:, work_and_loss] != 0.0)


def test_a_spring_whose_ends_meet_has_no_force() -> None:
    assert all(map(math.isnan, SPRING.force(LoadedPoint(0.0, 0.0, 0.0, 1.0, 0.0))))


def test_courses_that_cannot_be_are_refused() -> None:
    with pytest.raises(InputError, match="3 times and 2 shares"):
        TableCourse(times=(0.0, 0.1, 0.2), shares=(0.0, 1.0))
    with pytest.raises(InputError, match="the one before"):
        TableCourse(times=(0.0, 0.2, 0.1), shares=(0.0, 1.0, 2.0))
    with pytest.raises(InputError, match="the course says when"):
        replace(FORCE, start=0.1, end=0.2)
    with pytest.raises(InputError, match="period"):
        HarmonicCourse(period=0.0)


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


def test_springs_of_a_machine_are_told_and_drawn() -> None:
    dashpot = replace(SPRING, other="crank", other_point=(0.05, 0.0), stiffness=0.0)
    machine = CrankRocker(springs={"spring": SPRING, "coil": COIL})
    scene = Scenario(machine=machine, loads={"pot": dashpot}, duration=0.1)
    assert tuple(scene.acting_loads) == ("spring", "coil", "pot")
    assert {"spring.force", "spring.length", "coil.angle", "coil.moment"} <= set(scene.channel_definitions)
    assert {"spring", "coil", "pot"} <= {name for name, _ in what_is_run(scene)}
    struts = {strut.name: strut for strut in looks.look(scene).struts}
    assert set(struts) == {"spring", "pot"}
    drawn = struts["spring"]
    assert (drawn.foot, drawn.head, drawn.foot_point[:2]) == ("ground", "rocker", (0.0, 0.0))
    # zigzag and rod meet at the start
    reached = drawn.cylinder.bounds[1, 0] - (SPRING.start_length + drawn.rod.bounds[0, 0])
    assert 0.0 <= reached < 0.05 * SPRING.start_length
    on_support = Scenario(
        machine=reference_support(),
        loads={"spring": replace(SPRING, body="canopy", point=(2.0, 1.8))},
        duration=0.1,
    )
    assert "spring" in {strut.name for strut in looks.look(on_support).struts}
