"""Joints that repeat each other, change points, light links and point masses, in both formulations."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipj, ellipk

from support_exudyn import (
    ClearancePin,
    Held,
    IdealPin,
    PlanarLinkage,
    Result,
    Scenario,
    Steady,
    simulate,
)
from support_exudyn.machines.check.freedoms import shared
from support_exudyn.model.linkage import GROUND, Body, Crank, Linkage, Slide, TracePoint, pinned
from support_exudyn.postprocessing.summary import how
from support_exudyn.scene.contract import SimulationError
from tests.linkages import bar_of, four_bar, towards
from user_forces import Ambrosio, JournalBearing, JournalContact, LankaraniNikravesh
from user_forces.values.value import InputError

FORMULATIONS = ("exudyn", "compiled")
GRAVITY = 9.81
TURN = 2.0 * math.pi


def run(linkage: Linkage, formulation: str, duration: float, record: float = 0.01, **more: Any) -> Result:
    """A run of a linkage, whose crank turns once a second."""
    drive = Steady(rate=TURN) if linkage.cranks else Held()
    made = Scenario(
        machine=PlanarLinkage(drawing=linkage),
        duration=duration,
        record_period=record,
        step=5e-4,
        drive=drive,
        formulation=formulation,
        **more,
    )
    return simulate(made)


def hangers(places: Sequence[float], length: float, degrees: float, mass: float) -> Linkage:
    """A platform on equal bars of 1 kg each, side by side, `degrees` from straight down."""
    tops = [towards(degrees - 90.0, length, (x, 0.0)) for x in places]
    bodies = {f"bar{n}": bar_of((x, 0.0), top) for n, (x, top) in enumerate(zip(places, tops, strict=True))}
    pins = {f"G{n}": pinned(GROUND, f"bar{n}", (x, 0.0)) for n, x in enumerate(places)}
    pins |= {f"P{n}": pinned(f"bar{n}", "platform", top) for n, top in enumerate(tops)}
    bodies["platform"] = bar_of(tops[0], tops[-1], mass)
    return Linkage(bodies=bodies, pins=pins, points={"T": TracePoint(body="platform", point=tops[0])})


def swing(count: int, length: float, degrees: float, mass: float, until: float) -> Any:
    """The same as one pendulum, by scipy: angle from straight down and its rate."""
    pull = GRAVITY / length * (mass + 0.5 * count) / (mass + count / 3.0)
    return solve_ivp(
        lambda t, y: (y[1], -pull * math.sin(y[0])), (0.0, until), (math.radians(degrees), 0.0),
        rtol=1e-11, atol=1e-12, dense_output=True,
    )  # fmt: skip


@pytest.mark.parametrize("formulation", FORMULATIONS)
def test_a_platform_on_three_hangers_swings_as_a_pendulum(formulation: str) -> None:
    linkage = hangers([0.0, 1.0, 2.0], 1.0, 30.0, 20.0)
    result, right = run(linkage, formulation, 2.0), swing(3, 1.0, 30.0, 20.0, 2.0).sol
    time = result.channels["time"].values
    x, y = (1e3 * result.channels[f"T.{axis}"].values for axis in "xy")
    assert [x.mean(), y.mean()] == pytest.approx([-1.77007, -932.66701], abs=5e-3)
    assert x == pytest.approx(1e3 * np.sin(right(time)[0]), abs=2e-3)
    assert y == pytest.approx(-1e3 * np.cos(right(time)[0]), abs=2e-3)
    # by symmetry the least forces are equal
    forces = [result.channels[f"pin.G{n}.force"].values for n in range(3)]
    assert np.ptp(forces, axis=0) == pytest.approx(0.0, abs=1e-6)
    assert shared(result.scenario.held)[0].startswith(
        "pins.G0, pins.G1, pins.G2, pins.P0, pins.P1 and pins.P2: one"
    )
    assert any("bushing" in said for name, said in how(result) if name == "not determined")


@pytest.mark.parametrize("formulation", FORMULATIONS)
def test_a_block_on_two_guides_in_line_slides_down_and_they_share_its_weight(formulation: str) -> None:
    slope = math.radians(-20.0)
    ends = towards(-20.0, 0.2), towards(160.0, 0.2)
    linkage = Linkage(
        bodies={"block": Body(mass=3.0, inertia=0.1, centre=(0.0, 0.0))},
        pins={},
        slides={f"guide{n}": Slide(body="block", point=at, direction=slope) for n, at in enumerate(ends)},
    )
    channels = run(linkage, formulation, 0.5).channels
    assert channels["block.x"].values[-1] == pytest.approx(
        0.5 * 0.25 * GRAVITY * math.sin(-slope) * math.cos(slope), rel=1e-5
    )
    for n in (0, 1):
        assert channels[f"guide{n}.force"].values == pytest.approx(
            0.5 * 3.0 * GRAVITY * math.cos(slope), rel=1e-6
        )
        assert channels[f"guide{n}.moment"].values == pytest.approx(0.0, abs=1e-6)


def test_friction_in_a_pin_that_shares_its_force_is_of_the_formulation_that_takes_the_least() -> None:
    linkage = hangers([0.0, 1.0, 2.5], 1.0, 30.0, 20.0)
    pins = {"G0": IdealPin(friction=Ambrosio(sliding_coefficient=0.3), radius=0.05)}
    with pytest.raises(
        InputError, match=r"pins\.G0\.friction: not covered .*; allowed: formulation = 'compiled'"
    ):
        run(linkage, "exudyn", 0.2, pins=pins)
    result = run(linkage, "auto", 0.2, pins=pins)
    assert result.scenario.formulation == "compiled"
    assert "exudyn does not cover pins.G0.friction" in dict(how(result))["formulation"]
    # its own force, times radius, coefficient and the way that it has turned
    force = result.channels["pin.G0.force"].values
    lost = result.channels["energy.friction_loss"].values[-1]
    turned = np.abs(np.diff(result.channels["bar0.angle"].values))
    assert lost == pytest.approx(0.3 * 0.05 * float(force[1:] @ turned), rel=0.05)


# --- change points ---

PARALLELOGRAM = replace(four_bar(0.1, 0.4, 0.1, 0.4, 60.0), cranks={"crank": Crank(body="crank")})
DOUBLE = replace(hangers([0.0, 0.2, 0.4], 0.1, 150.0, 2.0), cranks={"bar0": Crank(body="bar0")})
KITE = replace(four_bar(0.1, 0.3, 0.3, 0.1, 60.0), cranks={"crank": Crank(body="crank")})
EQUAL = Linkage(
    bodies={
        "crank": bar_of((0.0, 0.0), (0.1, 0.1)),
        "rod": bar_of((0.1, 0.1), (0.2, 0.0), 2.0),
        "slider": Body(mass=1.0, inertia=1e-3, centre=(0.2, 0.0)),
    },
    pins={
        "O": pinned(GROUND, "crank", (0.0, 0.0)),
        "A": pinned("crank", "rod", (0.1, 0.1)),
        "B": pinned("rod", "slider", (0.2, 0.0)),
    },
    slides={"guide": Slide(body="slider", point=(0.2, 0.0))},
    cranks={"crank": Crank(body="crank")},
)


@pytest.mark.parametrize("formulation", FORMULATIONS)
@pytest.mark.parametrize(
    ("linkage", "stands", "time"),
    [
        pytest.param(PARALLELOGRAM, "crank at (180|179.9..|180.0..) degrees", 1.0 / 3.0, id="parallelogram"),
        pytest.param(DOUBLE, "bar0 at (180|179.9..|180.0..) degrees", 1.0 / 3.0, id="double parallelogram"),
        pytest.param(KITE, "crank at (0|360|359.9..|0.0..) degrees", 5.0 / 6.0, id="kite"),
        pytest.param(EQUAL, "crank at (90|89.9..|90.0..) degrees", 0.125, id="equal crank and rod"),
    ],
)
def test_a_driven_linkage_ends_at_its_change_point(
    linkage: Linkage, stands: str, time: float, formulation: str
) -> None:
    with pytest.raises(SimulationError, match=rf"change point or dead centre \({stands}") as error:
        run(linkage, formulation, 1.0, 1.0 / 360.0)  # a record is in the point itself
    assert error.value.failure.time == pytest.approx(time, abs=1e-4)


@pytest.mark.parametrize("formulation", FORMULATIONS)
def test_bars_that_swing_freely_through_a_change_point_are_no_failure(formulation: str) -> None:
    linkage = hangers([0.0, 1.0], 1.0, 80.0, 5.0)
    spun = {
        name: replace(body, spin=4.0 if name != "platform" else 0.0) for name, body in linkage.bodies.items()
    }
    for name in spun:
        arm = 4.0 if name == "platform" else 2.0
        spun[name] = replace(spun[name], velocity=towards(80.0, arm))
    result = run(replace(linkage, bodies=spun), formulation, 0.1, record=1e-3)
    assert math.radians(90.0 - 80.0) < np.ptp(result.channels["bar0.angle"].values)
    assert np.ptp(result.channels["energy.balance"].values) < 1e-3


# --- light links and point masses ---


def double_pendulum(bodies: Sequence[Body]) -> Linkage:
    """Two bodies in a row from the origin, released as they lie along x, joined at (0.5, 0)."""
    return Linkage(
        bodies=dict(zip(("one", "two"), bodies, strict=True)),
        pins={"O": pinned(GROUND, "one", (0.0, 0.0)), "P": pinned("one", "two", (0.5, 0.0))},
        points={"T": TracePoint(body="one", point=(0.5, 0.0))},
    )


def two_angles(masses: tuple[float, float], arm: float, inertia: float, until: float) -> np.ndarray:
    """The turns by scipy: a point mass at the end of a rod, and a body whose centre is `arm` further."""
    (one, two), length = masses, 0.5

    def rates(t: float, y: np.ndarray) -> np.ndarray:
        apart = y[0] - y[1]
        coupled = two * length * arm
        matrix = [
            [(one + two) * length**2, coupled * math.cos(apart)],
            [coupled * math.cos(apart), two * arm**2 + inertia],
        ]
        force = [
            -coupled * math.sin(apart) * y[3] ** 2 - (one + two) * GRAVITY * length * math.cos(y[0]),
            coupled * math.sin(apart) * y[2] ** 2 - two * GRAVITY * arm * math.cos(y[1]),
        ]
        return np.array([y[2], y[3], *np.linalg.solve(matrix, force)])

    return solve_ivp(rates, (0.0, until), np.zeros(4), rtol=1e-11, atol=1e-12).y[:2, -1]


@pytest.mark.parametrize("formulation", FORMULATIONS)
@pytest.mark.parametrize("light", [1e-5, 1e-6])
def test_a_heavy_body_swings_on_a_light_rod(formulation: str, light: float) -> None:
    linkage = double_pendulum(
        [bar_of((0.0, 0.0), (0.5, 0.0), light), Body(mass=10.0, inertia=0.1, centre=(0.7, 0.0))]
    )
    result = run(linkage, formulation, 0.8)
    found = [result.channels[f"{name}.angle"].values[-1] for name in ("one", "two")]
    assert found == pytest.approx(two_angles((0.0, 10.0), 0.2, 0.1, 0.8), abs=1e-4)


@pytest.mark.parametrize("formulation", FORMULATIONS)
def test_a_point_mass_on_a_rod_is_the_mathematical_pendulum(formulation: str) -> None:
    bob = Body(mass=10.0, inertia=0.0, centre=(1.0, 0.0))
    linkage = Linkage(bodies={"bob": bob}, pins={"O": pinned(GROUND, "bob", (0.0, 0.0))})
    accurate = {"accuracy": "reference"} if formulation == "compiled" else {}
    result = run(linkage, formulation, 10.0, **accurate)
    frequency, module = math.sqrt(GRAVITY), math.sin(0.25 * math.pi) ** 2
    sine = math.sqrt(module) * ellipj(ellipk(module) - frequency * result.channels["time"].values, module)[0]
    right = 2.0 * np.arcsin(sine) - 0.5 * math.pi
    assert result.channels["bob.angle"].values == pytest.approx(right, abs=1e-7 if accurate else 2e-4)
    # it carries 3 cos(angle from straight down) times its weight
    tension = 3.0 * 10.0 * GRAVITY * np.cos(2.0 * np.arcsin(sine))
    assert result.channels["pin.O.force"].values == pytest.approx(tension, abs=1e-5 if accurate else 0.1)


@pytest.mark.parametrize("loose", [False, True], ids=["pinned at its centre", "with clearance"])
def test_a_point_mass_whose_turn_nothing_holds_is_refused(loose: bool) -> None:
    centre = (0.3, 0.0) if loose else (0.0, 0.0)
    linkage = Linkage(
        bodies={"bob": Body(mass=1.0, inertia=0.0, centre=centre)},
        pins={"O": pinned(GROUND, "bob", (0.0, 0.0))},
    )
    contact = JournalContact(
        bearing=JournalBearing(bore_radius=0.01, clearance=1e-4),
        normal=LankaraniNikravesh(stiffness=1e9, restitution=0.5),
    )
    pins = {"O": ClearancePin(contact=contact)} if loose else {}
    with pytest.raises(
        InputError, match=r"bodies\.bob: its inertia is 0, .*; allowed: an inertia > 0, or such"
    ):
        Scenario(machine=PlanarLinkage(drawing=linkage), pins=pins, duration=1.0)


@pytest.mark.parametrize("formulation", FORMULATIONS)
def test_point_masses_swing_one_on_the_other(formulation: str) -> None:
    bodies = [Body(mass=m, inertia=0.0, centre=(x, 0.0)) for m, x in ((10.0, 0.5), (3.0, 0.9))]
    result = run(double_pendulum(bodies), formulation, 0.8)
    found = [result.channels[f"{name}.angle"].values[-1] for name in ("one", "two")]
    assert found == pytest.approx(two_angles((10.0, 3.0), 0.4, 0.0, 0.8), abs=1e-4)
    # released from the horizontal each falls freely
    assert [result.channels[f"pin.{pin}.force"].values[0] for pin in "OP"] == pytest.approx(
        [0.0, 0.0], abs=1e-9
    )
