"""Loads in space, in and beside the machine's plane: closed forms, symmetry, energy, and runs in the plane."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from support_exudyn import (
    AppliedForce,
    AppliedTorque,
    BeddedRoof,
    CubicStep,
    FallingBlock,
    Held,
    Load,
    MomentLoad,
    Result,
    Roof,
    Scenario,
    SpringDamper,
    TorsionSpring,
    simulate,
)
from support_exudyn.model.loads.load import ActingLoad
from support_exudyn.model.spatial_linkage import Bearing, SpatialBody, SpatialLinkage
from tests.cases.run_cases import loose_support, support
from tests.cases.spatial_cases import InSpace
from tests.roof_cases import ON_OIL
from tests.roof_cases import OVER_THE_COLUMNS as OVER

TIP = (3.19590271431274, 1.95)  # of the reference support's canopy [m]
INERTIA = (0.03, 0.05, 0.04, 0.0, 0.0, 0.0)
MASS = 2.0
COMES_DOWN = CubicStep(stroke=0.02, start=0.0, end=0.05)


def free(spin: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> InSpace:
    body = SpatialBody(mass=MASS, inertia=INERTIA, centre=(0.0, 0.0, 0.0), spin=spin)
    return InSpace(space=SpatialLinkage(bodies={"a": body}))


def flight(load: Load | MomentLoad, machine: InSpace | None = None, **changes: object) -> Scenario:
    fields: dict[str, object] = {
        "machine": machine or free(),
        "dimensions": 3,
        "loads": {"load": load},
        "duration": 0.1,
        "step": 1e-3,
        "record_period": 1e-2,
        "gravity": (0.0, 0.0),
    }
    return Scenario(**fields | changes)


def pressed(load: Load | MomentLoad, dimensions: int = 3, **more: object) -> Result:
    """The reference support on oil under a load."""
    fields: dict[str, object] = {
        "drive": Held(),
        "duration": 0.1,
        "actuators": ON_OIL,
        "loads": {"load": load},
        "dimensions": dimensions,
    }
    return simulate(support(**fields | more))


# --- a free body ---


def test_a_body_on_a_lengthwise_hinge_swings_under_a_force_beside_it() -> None:
    # J phi'' = F z cos(phi): the force keeps its direction, its point goes with the body
    force, lateral, arm = 40.0, 0.5, 0.3
    hinge = Bearing(
        first="ground",
        second="a",
        first_point=(0.0, 0.0, 0.0),
        second_point=(0.0, 0.0, 0.0),
        first_axis=(1.0, 0.0, 0.0),
        second_axis=(1.0, 0.0, 0.0),
        length=0.1,
        pin="pin",
    )
    body = SpatialBody(mass=MASS, inertia=INERTIA, centre=(0.0, 0.0, arm))
    machine = InSpace(space=SpatialLinkage(bodies={"a": body}, bearings={"pin": hinge}))
    load = AppliedForce(body="a", point=(0.0, 0.0), lateral=lateral, full_force=(0.0, force))
    result = simulate(flight(load, machine, duration=0.2, step=2e-4))
    about = INERTIA[0] + MASS * arm * arm

    def rate(t: float, state: np.ndarray) -> list[float]:
        return [state[1], lateral * force * math.cos(state[0]) / about]

    # the last record may lie an ulp behind the end
    found = solve_ivp(rate, (0.0, 0.2), [0.0, 0.0], t_eval=result.time.clip(max=0.2), rtol=1e-10, atol=1e-12)
    assert found.y[0, -1] > 0.5  # it has swung far
    np.testing.assert_allclose(result["a.y"], arm * np.sin(found.y[0]), atol=1e-6)  # second order in the step
    # the hinge carries what the motion leaves of the force
    moving = arm * (-np.sin(found.y[0]) * found.y[1] ** 2 + np.cos(found.y[0]) ** 2 * lateral * force / about)
    np.testing.assert_allclose(result["pin.pin.force_y"], MASS * moving - force, atol=1e-3 * force)


@pytest.mark.parametrize(
    "load",
    [
        SpringDamper(
            body="a",
            point=(0.2, 0.1),
            lateral=0.3,
            other_point=(0.2, 0.5),
            other_lateral=-0.4,
            stiffness=900.0,
            free_length=0.6,
            damping=3.0,
        ),
        TorsionSpring(body="a", stiffness=4.0, free_turn=0.3, damping=0.05),
        AppliedTorque(body="a", full_torque=0.4),
        AppliedForce(body="a", point=(0.1, 0.0), lateral=-0.2, full_force=(3.0, 2.0)),
        Roof(
            body="a",
            point=(0.1, 0.0),
            lateral=0.2,
            descent=COMES_DOWN,
            stiffness=5e3,
        ),
    ],
    ids=lambda load: type(load).__name__,
)
def test_energy_adds_up_while_a_body_tumbles(load: Load | MomentLoad) -> None:
    def scattered(step: float) -> tuple[float, float]:
        result = simulate(flight(load, free((2.0, 3.0, 4.0)), step=step, record_period=2e-2))
        moved = np.abs(result["energy.work"]) + np.abs(result["energy.elastic"]).max()
        return float(np.abs(result["energy.balance"]).max()), float(moved.max())

    (coarse, _), (fine, size) = scattered(1e-3), scattered(2.5e-4)
    assert size > 1e-3
    assert fine < 1e-4 * size
    assert fine < 0.25 * coarse + 1e-9 * size  # second order of the step, no share that stays


# --- a bed of rock over a stretch of a body ---

BED_COMES_DOWN = CubicStep(stroke=0.05, start=0.0, end=0.1)
ENDS = ((-1.0, 0.1), (1.5, 0.3))
GAPS = (0.002, 0.006)
BEDDING, DAMPING = 2e3, 0.4


def on_a_free_body(loads: dict[str, ActingLoad]) -> Result:
    """A body that spins about all axes, and is pressed beside its centre."""
    body = SpatialBody(
        mass=20.0, inertia=(3.0, 9.0, 8.0, 0.0, 0.0, 0.0), centre=(0.0, 0.0, 0.0), spin=(0.8, 0.5, -0.6)
    )
    scenario = Scenario(
        machine=InSpace(space=SpatialLinkage(bodies={"a": body})),
        dimensions=3,
        loads=loads,
        duration=0.2,
        step=5e-4,
        record_period=1e-2,
        gravity=(0.0, 0.0),
    )
    return simulate(scenario)


def bed(**changes: object) -> BeddedRoof:
    fields: dict[str, object] = {
        "body": "a",
        "points": ENDS,
        "lateral": 0.3,
        "bedding": BEDDING,
        "gaps": GAPS,
        "damping": DAMPING,
        "descent": BED_COMES_DOWN,
    }
    return BeddedRoof(**fields | changes)


def test_many_single_roofs_tend_to_the_bed_with_second_order() -> None:
    whole = on_a_free_body({"roof": bed()})
    length = float(np.hypot(2.5, 0.2))
    channels = ("a.x", "a.y", "a.z", "a.roll", "a.yaw", "a.angle")
    errors = []
    for count in (8, 32):
        loads: dict[str, ActingLoad] = {}
        for n in range(count):
            s = (n + 0.5) / count
            loads[f"roof_{n}"] = Roof(
                body="a",
                point=(-1.0 + 2.5 * s, 0.1 + 0.2 * s),
                lateral=0.3,
                stiffness=BEDDING * length / count,
                gap=GAPS[0] + s * (GAPS[1] - GAPS[0]),
                damping=DAMPING,
                descent=BED_COMES_DOWN,
            )
        run = on_a_free_body(loads)
        errors.append([float(np.abs(run[name] - whole[name]).max()) for name in channels])
    moved = [float(np.ptp(whole[name])) for name in channels]
    assert moved[1] > 1e-2  # it is pressed down, and rolled
    assert np.ptp(whole["roof.pressed"]) > 0.5  # another part of it is pressed all the time
    for coarse, fine, way, name in zip(*errors, moved, channels, strict=True):
        assert fine < 2e-3 * way + 1e-12, name
        assert coarse > 6.0 * fine or fine < 1e-9, name
    assert whole.energy_error < 1e-4 * whole["energy.work"].max()


# --- the support ---

BLOCK = FallingBlock(body="canopy", point=TIP, mass=1e3, height=0.01, speed=2.0, stiffness=1e9, restitution=0.4)
LOADS = {
    "force": AppliedForce(body="canopy", point=TIP, full_force=(0.0, -1e6), start=0.01, end=0.03),
    "torque": AppliedTorque(body="canopy", other="shield", full_torque=1e5, start=0.01, end=0.03),
    "spring": SpringDamper(
        body="canopy",
        point=TIP,
        other_point=(3.3, 0.0),
        stiffness=1e7,
        free_length=2.0,
        damping=1e5,
    ),
    "torsion": TorsionSpring(body="canopy", stiffness=1e7, free_turn=0.01, damping=1e5),
    "roof": Roof(
        body="canopy",
        point=TIP,
        descent=COMES_DOWN,
        stiffness=1e8,
        damping=0.5,
    ),
    "bed": BeddedRoof(
        body="canopy",
        points=((OVER[0] - 0.6, OVER[1]), (OVER[0] + 1.4, OVER[1])),
        bedding=5e8,
        gaps=(0.001, 0.003),
        descent=CubicStep(stroke=0.006, start=0.0, end=0.05),
    ),
    "block": BLOCK,
    "block with a sloping face": replace(BLOCK, slope=0.2),
}


@pytest.mark.parametrize("name", LOADS)
def test_a_load_in_the_middle_acts_as_in_the_plane(name: str) -> None:
    plane, space = pressed(LOADS[name], 2), pressed(LOADS[name])
    for channel in plane.channels:
        if channel.startswith(("load", "canopy.", "pin.rear_base.force", "energy.")):
            size = np.abs(plane[channel]).max()
            scale = 1e4 if channel.startswith("energy.") else 1.0
            np.testing.assert_allclose(
                space[channel], plane[channel], rtol=1e-5, atol=1e-6 * max(size, scale), err_msg=channel
            )
    assert np.abs(space["canopy.roll"]).max() < 1e-9
    for load, blows in plane.onsets.items():
        assert [one.time for one in space.onsets[load]] == pytest.approx([one.time for one in blows])
        assert space.largest_force[load] == pytest.approx(plane.largest_force[load], rel=1e-6)
    if hasattr(LOADS[name], "lateral"):  # a place across counts in space alone
        aside = pressed(replace(LOADS[name], lateral=0.6), 2)
        np.testing.assert_array_equal(aside["tip.y"], plane["tip.y"])


def beside(**loads: Load) -> Result:
    """The support with a loose pin under loads, which rolls as far as the slack lets it."""
    return simulate(loose_support(drive=Held(), duration=0.03, actuators=ON_OIL, loads=loads, dimensions=3))


WHOLE = AppliedForce(body="canopy", point=TIP, full_force=(0.0, -4e5), start=0.0, end=0.02)


@pytest.mark.parametrize("load", [WHOLE, BLOCK], ids=["force", "block"])
def test_left_mirrors_right(load: Load) -> None:
    right, left = (beside(load=replace(load, lateral=z)) for z in (0.5, -0.5))
    roll = np.abs(right["canopy.roll"]).max()
    assert roll > 1e-5
    for what in ("roll", "yaw", "z"):
        np.testing.assert_allclose(left[f"canopy.{what}"], -right[f"canopy.{what}"], atol=1e-3 * roll)
    np.testing.assert_allclose(left["canopy.y"], right["canopy.y"], atol=1e-3 * roll)
    for one, other in (("left", "right"), ("right", "left")):
        wanted = right[f"front_column_{other}.force"]
        np.testing.assert_allclose(left[f"front_column_{one}.force"], wanted, atol=1e-4 * np.abs(wanted).max())


# --- blocks that fall beside the middle ---


STRUCK, ROCK = 50.0, 10.0  # of the body that is struck and of the block [kg]
TENSOR = (6.0, 8.0, 7.0, 0.0, 0.0, 0.0)
E, SPEED, ASIDE, AHEAD = 0.4, 2.0, 0.3, 0.2


def block(**changes: object) -> FallingBlock:
    fields: dict[str, object] = {
        "body": "a",
        "point": (AHEAD, 0.0),
        "lateral": ASIDE,
        "mass": ROCK,
        "height": 0.01,
        "speed": SPEED,
        "stiffness": 1e8,
        "restitution": E,
    }
    return FallingBlock(**fields | changes)


def struck(rock: FallingBlock, **changes: object) -> Scenario:
    """A free body that a block strikes."""
    body = SpatialBody(mass=STRUCK, inertia=TENSOR, centre=(0.0, 0.0, 0.0))
    fields: dict[str, object] = {
        "machine": InSpace(space=SpatialLinkage(bodies={"a": body})),
        "dimensions": 3,
        "loads": {"rock": rock},
        "duration": 0.02,
        "step": 1e-3,
        "record_period": 1e-3,
        "gravity": (0.0, 0.0),
    }
    return Scenario(**fields | changes)


def test_a_blow_beside_the_middle_delivers_restitution_and_impulse() -> None:
    result = simulate(struck(block()))
    (blow,) = result.onsets["rock"]
    # it falls 0.01 m at 2 m/s; of what the body does before, nothing
    assert blow.time == pytest.approx(0.01 / SPEED, rel=1e-9)
    assert blow.speed == pytest.approx(SPEED, rel=1e-9)
    assert blow.separation_velocity == pytest.approx(E * SPEED, rel=1e-3)
    # the body shifts, rolls and pitches under the impulse: 1/m = 1/M + z^2/Jxx + x^2/Jzz + 1/block
    lightness = 1.0 / STRUCK + ASIDE**2 / TENSOR[0] + AHEAD**2 / TENSOR[2] + 1.0 / ROCK
    impulse = (1.0 + E) * SPEED / lightness
    end = {name: result[name][-1] for name in result.channels}
    assert end["rock.velocity_y"] == pytest.approx(-SPEED + impulse / ROCK, rel=1e-3)
    assert end["a.velocity_y"] == pytest.approx(-impulse / STRUCK, rel=1e-3)
    # down on the right turns about +x, which is a positive roll: r x F = z F along x
    assert end["a.angular_velocity_x"] == pytest.approx(ASIDE * impulse / TENSOR[0], rel=1e-3)
    assert end["a.angular_velocity"] == pytest.approx(-AHEAD * impulse / TENSOR[2], rel=1e-3)
    lost = 0.5 * (1.0 - E * E) * SPEED**2 / lightness
    assert end["energy.damping_loss"] == pytest.approx(lost, rel=2e-3)
    assert np.abs(result["energy.balance"]).max() < 1e-3 * lost


@pytest.mark.parametrize("slope", [0.0, 0.6, 1.3])
def test_a_settled_start_leaves_a_sloping_block_where_it_is(slope: float) -> None:
    height, slow = 0.1, 1.3  # of the fall [m], of the time it takes
    fall = math.sqrt(2.0 * height / 9.81)
    rock = block(body="canopy", point=TIP, mass=700.0, height=height, speed=0.0, slope=slope, stiffness=1e9)
    result = simulate(
        support(
            drive=Held(), duration=slow * fall, step=5e-4, loads={"rock": rock}, dimensions=3, start="settled"
        )
    )
    assert result["rock.y"][0] == pytest.approx(rock.centre[1], abs=1e-12)
    blow = result.onsets["rock"][0]
    assert blow.time == pytest.approx(fall, rel=1e-9)
    assert blow.speed == pytest.approx(9.81 * fall * math.cos(slope), rel=1e-6)
