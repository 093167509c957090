"""Contacts that meet at one instant: symmetric scenes stay symmetric, and results have one limit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from support_exudyn import (
    ClearanceGuide,
    ClearancePin,
    PlanarLinkage,
    Result,
    Scenario,
    SolverSettings,
    machine,
    simulate,
)
from support_exudyn.model.linkage import Body, Linkage, PinPlace
from tests.cases.law_cases import NORMAL_LAWS, kind_of
from tests.compiled_runs import simulate_compiled
from tests.metamorphic.moving import MIRROR, moved
from user_forces import HuGuo, JournalBearing, JournalContact, NormalLaw

BEARING = JournalBearing(bore_radius=0.0655, clearance=3e-4)
SOME = [law for law in NORMAL_LAWS if kind_of(law) in ("Exact", "Johnson", "KelvinVoigt", "AdamsImpact")]
OF_WALLS = [law for law in SOME if not hasattr(law, "bearing")]


def table(links: int, law: NormalLaw, duration: float = 0.03) -> Scenario:
    """A table of 5 kg that falls on equal, parallel links of 1 kg with clearance in all pins."""
    bodies = {"table": Body(mass=5.0, inertia=5.0 * 0.4**2 / 12.0, centre=(0.3, 0.15))}
    pins = {}
    for n in range(links):
        foot = 0.4 * n / (links - 1)
        head = foot + 0.1, 0.15
        bodies[f"link{n}"] = Body(mass=1.0, inertia=(0.1**2 + 0.15**2) / 12.0, centre=(foot + 0.05, 0.075))
        pins[f"G{n}"] = PinPlace(
            first="ground", second=f"link{n}", first_point=(foot, 0.0), second_point=(foot, 0.0)
        )
        pins[f"T{n}"] = PinPlace(first=f"link{n}", second="table", first_point=head, second_point=head)
    clearance = replace(law, bearing=BEARING) if hasattr(law, "bearing") else law  # type: ignore[call-arg]
    pin = ClearancePin(contact=JournalContact(bearing=BEARING, normal=clearance))
    return Scenario(
        machine=PlanarLinkage(drawing=Linkage(bodies=bodies, pins=pins)),
        pins=dict.fromkeys(pins, pin),
        duration=duration,
        record_period=1e-3,
    )


def guided(law: NormalLaw, duration: float = 0.02) -> Scenario:
    """The slider-crank left to itself: nothing turns its block, which meets a wall by two corners."""
    guide = ClearanceGuide(gaps=(1e-3, 1e-3), block=(0.1, 0.05), normal=law)
    return Scenario(
        machine=machine("slider_crank_guide"), guides={"slot": guide}, duration=duration, record_period=1e-4
    )


@pytest.mark.parametrize("law", SOME, ids=kind_of)
def test_a_table_on_equal_links_does_not_turn(law: NormalLaw) -> None:
    mirror = SOME.index(law) % 2 == 1  # every other law of three links, in a mirror
    links = 3 if mirror else 2
    scenario = table(links, law)
    result = simulate_compiled(moved(scenario, MIRROR) if mirror else scenario, 1e-9)
    assert all(result.onsets[name] for name in scenario.pins)
    # the tolerance, which impacts magnify, as a share of what one link alone would do; measured up to 1e-3
    turning = max(result.largest_force.values()) * 0.2 / scenario.linkage.bodies["table"].inertia
    assert np.abs(result["table.angular_acceleration"]).max() < 1e-3 * turning
    for kind in "GT":
        forces = [result[f"pin.{kind}{n}.force"] for n in range(links)]
        assert np.ptp(forces, axis=0).max() < 1e-2 * result.largest_force[f"{kind}0"]


@pytest.mark.parametrize("law", OF_WALLS, ids=kind_of)
def test_a_block_that_nothing_turns_keeps_its_angle(law: NormalLaw) -> None:
    mirror = OF_WALLS.index(law) % 2 == 1
    scenario = guided(law)
    result = simulate_compiled(moved(scenario, MIRROR) if mirror else scenario, 1e-10)
    sides = ("upper", "lower")
    assert any(result.onsets[f"slot.{side}_left"] for side in sides)
    for side in sides:
        left, right = (result.largest_force[f"slot.{side}_{end}"] for end in ("left", "right"))
        assert left == pytest.approx(right, rel=1e-5)
    angle = result["slider.angle"]
    assert np.abs(angle - angle[0]).max() < 1e-7


def limits(scenario: Scenario, tolerances: tuple[float, ...]) -> list[np.ndarray]:
    """Largest forces of all contacts and spreads of pin forces, by tolerance."""
    runs = [simulate_compiled(scenario, tolerance) for tolerance in tolerances]
    return [measured(run) for run in runs]


def measured(run: Result) -> np.ndarray:
    names = [name for name in run.channels if name.startswith("pin.") and name.endswith(".force")]
    return np.array([*run.largest_force.values(), *(run[name].std() for name in names)])


def test_a_block_has_one_limit_and_the_engines() -> None:
    scenario = guided(HuGuo(stiffness=1e9, restitution=0.3), 0.05)
    *coarse, finest = limits(scenario, (1e-7, 1e-9, 1e-11))
    for found, close in zip(coarse, (1e-5, 1e-7), strict=True):
        np.testing.assert_allclose(found, finest, rtol=0.0, atol=close * finest.max())
    solver = SolverSettings(impact_steps=256)
    theirs = simulate(replace(scenario, formulation="exudyn", step=2e-5, solver=solver))
    # the engine's steps in flight: measured 8e-6
    assert theirs.largest_force["slot.upper_left"] == pytest.approx(727.0643, rel=2e-5)
    np.testing.assert_allclose(measured(theirs), finest, rtol=0.0, atol=1e-4 * finest.max())
