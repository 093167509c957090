"""A block that falls on a machine: closed forms of bounces, an independent integrator, the support."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from studies.common import paper_machine
from support_exudyn import (
    FallingBlock,
    Scenario,
    SolverSettings,
    reference_support,
    simulate,
)
from tests.roof_cases import MASS, OVER_THE_COLUMNS, TOP, Ram

G = 9.81
HEIGHT = 0.5
FORMULATIONS = ("exudyn", "compiled")
EXACT = SolverSettings(tolerance=1e-9)  # of the compiled formulation
# support on oil: what the paper's machine has, and a soft rock
ON_OIL = paper_machine.oil_columns()


def block(**changes: object) -> FallingBlock:
    fields: dict[str, object] = {
        "body": "canopy", "point": OVER_THE_COLUMNS, "mass": MASS, "height": HEIGHT, "stiffness": 1e9,
        "restitution": 0.5,
    }  # fmt: skip
    return FallingBlock(**fields | changes)


def on_the_held(rock: FallingBlock, **changes: object) -> Scenario:
    """The block over the reference support on rigid actuators and ideal pins, which nothing moves."""
    fields: dict[str, object] = {"machine": reference_support(), "loads": {"rock": rock}, "duration": 0.5}
    return Scenario(**fields | changes)


def weightless(rock: FallingBlock, **changes: object) -> Scenario:
    known: dict[str, object] = {"gravity": (0.0, 0.0), "duration": 0.05}
    return on_the_held(replace(rock, height=0.01, speed=3.0), **known | changes)


# --- on what stands still ---


@pytest.mark.parametrize(
    ("exponent", "stiffness", "restitution"),
    [(1.0, 1e8, 0.5), (1.5, 1e9, 0.1), (1.5, 1e9, 1.0), (2.2, 3e10, 0.5)],
)
@pytest.mark.parametrize(("formulation", "share"), [("exudyn", 2e-5), ("compiled", 1e-9)])
def test_a_blow_gives_back_what_was_asked(
    formulation: str, share: float, restitution: float, exponent: float, stiffness: float
) -> None:
    rock = block(restitution=restitution, exponent=exponent, stiffness=stiffness)
    result = simulate(weightless(rock, formulation=formulation, solver=EXACT))
    # of the formulation on Exudyn: second order in 512 steps an impact
    (onset,) = result.onsets["rock"]
    assert onset.time == pytest.approx(0.01 / 3.0, rel=1e-9)
    assert onset.speed == pytest.approx(3.0, rel=1e-9)
    assert onset.separation_velocity == pytest.approx(3.0 * restitution, rel=share)
    assert result["rock.velocity_y"][-1] == pytest.approx(3.0 * restitution, rel=share)
    lost = 0.5 * MASS * 9.0 * (1.0 - restitution**2)
    assert result["energy.damping_loss"][-1] == pytest.approx(lost, rel=1e-4, abs=1e-9 * MASS)
    assert result.energy_error < 1e-4 * 0.5 * MASS * 9.0


def test_a_sloping_face_is_struck_along_its_normal() -> None:
    # the guide carries what is forward; along the normal the block has the speed v cos and the mass m/cos^2
    slope = 0.6
    rock = block(slope=slope)
    for formulation, share in (("exudyn", 2e-5), ("compiled", 1e-9)):
        result = simulate(weightless(rock, formulation=formulation, solver=EXACT))
        (onset,) = result.onsets["rock"]
        assert onset.time == pytest.approx(0.01 / 3.0, rel=1e-9)
        assert onset.speed == pytest.approx(3.0 * math.cos(slope), rel=1e-9)
        assert result["rock.velocity_y"][-1] == pytest.approx(1.5, rel=share)
        deepest = (2.5 * 0.5 * MASS * 9.0 / 1e9) ** 0.4  # undamped
        assert 0.5 * deepest < -result["rock.gap"].min() < deepest
        push, carried = result["rock.force"], result["rock_guide.force"]
        np.testing.assert_allclose(carried, push * math.sin(slope), atol=1e-6 * push.max())


def bounced(rock: FallingBlock, duration: float) -> list[tuple[float, float, float]]:
    """Time, speed and speed of separation of each blow [s], [m/s], by an explicit method of eighth order.

    The law is told the speed of the blow that is under way.
    """
    law, found = rock.contact.normal, []
    t, y, v = 0.0, rock.height, -rock.speed
    while True:
        land = t + (v + math.sqrt(v * v + 2.0 * G * y)) / G
        if land > duration:
            return found
        struck = math.sqrt(v * v + 2.0 * G * y)

        told = struck

        def rates(_: float, state: np.ndarray, told: float = told) -> list[float]:
            depth = max(-state[0], 1e-30)
            return [state[1], max(0.0, law(depth, -state[1], told)) / rock.mass - G]

        def parts(_: float, state: np.ndarray) -> float:
            return float(state[0])

        parts.terminal, parts.direction = True, 1.0  # type: ignore[attr-defined]
        ran = solve_ivp(
            rates, (land, land + 0.2), [0.0, -struck], "DOP853", rtol=1e-12, atol=1e-13, events=parts,
            max_step=1e-3,
        )  # fmt: skip
        t, (y, v) = float(ran.t[-1]), (0.0, float(ran.y[1, -1]))
        found.append((land, struck, v))


def test_weight_and_all_bounces_are_as_in_an_independent_solution() -> None:
    rock = block(restitution=0.7)
    # without what rounding makes of a block that rests
    told = [one for one in bounced(rock, 0.95) if one[1] > 1e-3]
    assert len(told) >= 2
    for formulation, share in (("exudyn", 3e-5), ("compiled", 1e-7)):
        scene = on_the_held(rock, duration=0.95, formulation=formulation, solver=EXACT)
        onsets = simulate(scene).onsets["rock"]
        assert len(onsets) == len(told)
        for onset, (time, speed, parting) in zip(onsets, told, strict=True):
            assert onset.time == pytest.approx(time, rel=share)
            assert onset.speed == pytest.approx(speed, rel=share)
            if math.isfinite(onset.separation_time):
                assert onset.separation_velocity == pytest.approx(parting, rel=2.0 * share)


# --- on what gives ---


@pytest.mark.parametrize("formulation", FORMULATIONS)
def test_momentum_and_energy_balance_where_two_move(formulation: str) -> None:
    # a ram of 1 t that nothing holds up, without weight: restitution of both masses, momentum of both
    rock = block(body="ram", point=TOP, mass=400.0, height=0.01, speed=3.0, restitution=0.4, stiffness=2e8)
    result = simulate(
        Scenario(
            machine=Ram(), loads={"rock": rock}, duration=0.05, gravity=(0.0, 0.0), formulation=formulation,
            solver=EXACT,
        )
    )  # fmt: skip
    (onset,) = result.onsets["rock"]
    momentum = 400.0 * result["rock.velocity_y"] + MASS * result["ram.velocity_y"]
    np.testing.assert_allclose(momentum, -1200.0, rtol=1e-9)
    assert onset.separation_velocity == pytest.approx(1.2, rel=3e-5)
    reduced = 400.0 * MASS / (400.0 + MASS)
    lost = 0.5 * reduced * 9.0 * (1.0 - 0.16)
    assert result["energy.damping_loss"][-1] == pytest.approx(lost, rel=1e-4)
    assert result.energy_error < 1e-4 * lost


# --- at rest ---


@pytest.mark.parametrize("formulation", FORMULATIONS)
@pytest.mark.parametrize("rock", [block(), block(height=0.1, speed=1.0, slope=-0.3)], ids=["dropped", "thrown"])
def test_it_hangs_while_the_support_settles(rock: FallingBlock, formulation: str) -> None:
    with_clearance = {paper_machine.CLEARANCE_PIN: paper_machine.clearance_joint(1.5, 0.0)}
    scene = on_the_held(
        rock, actuators=ON_OIL, pins=with_clearance, start="settled", duration=0.06, formulation=formulation
    )
    result, alone = simulate(scene), simulate(replace(scene, loads={}))
    # before it strikes the support stands as without it; Newton's tolerance of the static solution
    assert result["tip.y"] == pytest.approx(alone["tip.y"], abs=1e-9)
    assert result["front_column.force"] == pytest.approx(alone["front_column.force"], rel=1e-5)
    # and it falls from where it hung: the canopy gives by less than a millimetre, and it went along
    assert result["rock.gap"][0] == pytest.approx(-rock.start_depth, abs=1e-9)
    fallen = (result["rock.gap"][0] - result["rock.gap"]) / math.cos(rock.slope)
    expected = rock.speed * result.time + 0.5 * G * result.time**2
    np.testing.assert_allclose(fallen, expected, atol=1e-7)
    assert result.energy_error < 1e-3
