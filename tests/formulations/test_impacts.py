"""Impacts of one journal: located in time, bounces that end in rest, and how contacts end."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from support_exudyn import (
    Body,
    ClearancePin,
    Held,
    Linkage,
    Machine,
    Onset,
    PinPlace,
    Result,
    Scenario,
    SolverSettings,
    simulate,
)
from support_exudyn.model.linkage import GROUND
from support_exudyn.model.spatial_linkage import Bearing, SpatialBody, SpatialLinkage
from tests.cases.run_cases import PIN, loose_support
from tests.cases.spatial_cases import LENGTH, InSpace, contact
from user_forces import (
    Ambrosio,
    Exact,
    JournalBearing,
    JournalContact,
    LankaraniNikravesh,
    NormalLaw,
    value,
)

# --- the fall of the support: an independent integrator with the impact speed at zero depth ---


TIMES = (0.01744754, 0.03958171, 0.07192809)  # [s]
SPEEDS = (0.17192479, 0.07643214, 0.07207929)  # [m/s]


def dropping(step: float, duration: float = 0.08, impact_steps: int = 512) -> Scenario:
    solver = SolverSettings(impact_steps=impact_steps)
    return loose_support(drive=Held(), duration=duration, step=step, record_period=1e-3, solver=solver)


def drop(step: float, duration: float = 0.08) -> Result:
    return simulate(dropping(step, duration))


@pytest.mark.parametrize("step", [1e-3, 1e-4, 1e-5])
def test_first_onset_does_not_depend_on_the_step(step: float) -> None:
    first = drop(step, duration=0.02).onsets[PIN][0]
    # asked for: 1e-6 s and 1e-3; the cubic through a step of free flight is right to 1e-8
    assert first.time == pytest.approx(TIMES[0], abs=2e-8)
    assert first.speed == pytest.approx(SPEEDS[0], rel=1e-7)


def test_all_onsets_of_the_compiled_formulation_are_those_printed() -> None:
    solver = SolverSettings(tolerance=1e-12)
    onsets = simulate(replace(dropping(5e-4), formulation="compiled", solver=solver)).onsets[PIN]
    # half of the last printed digit
    np.testing.assert_allclose([onset.time for onset in onsets], TIMES, rtol=0.0, atol=6e-9)
    np.testing.assert_allclose([onset.speed for onset in onsets], SPEEDS, rtol=0.0, atol=6e-9)


def test_later_onsets_converge_with_second_order() -> None:
    coarse = dropping(5e-4, impact_steps=64)
    runs = [simulate(coarse.refined(factor)).onsets[PIN] for factor in (1, 2, 4)]
    for n, enough in ((1, 1e-3), (2, 1e-2)):
        errors = np.array([abs(run[n].speed / SPEEDS[n] - 1.0) for run in runs])
        # asked for at the finest step
        assert errors[-1] < enough
        # at least the square of the step; impacts cut the steps unevenly, hence the 0.3
        assert np.log2(errors[0] / errors[-1]) / 2 > 1.7
        # times to 1e-6 of a flight of 20 ms (their print is rounded to 5e-9 s)
        assert runs[-1][n].time == pytest.approx(TIMES[n], abs=2e-6)


# --- a ball in a ring: ever shorter bounces end in resting contact ---


GRAVITY = 9.81
BALL = 2.0
CLEARANCE = 0.01
STIFFNESS = 1e8


@value
class BallInRing(Machine):
    """One body in a ring of the ground."""

    def linkage(self) -> Linkage:
        return Linkage(
            bodies={"ball": Body(mass=BALL, inertia=1e-3, centre=(0.0, 0.0))},
            pins={"ring": PinPlace(first=GROUND, second="ball", first_point=(0, 0), second_point=(0, 0))},
        )


def bounce(law: NormalLaw, duration: float, **changes: Any) -> Result:
    contact = JournalContact(
        bearing=JournalBearing(bore_radius=0.1, clearance=CLEARANCE),
        normal=law,
        friction=changes.pop("friction", Ambrosio(sliding_coefficient=0.0)),
    )
    fields: dict[str, Any] = {"step": 5e-4, "record_period": 1e-3} | changes
    return simulate(
        Scenario(
            machine=BallInRing(), pins={"ring": ClearancePin(contact=contact)}, duration=duration, **fields
        )
    )


LAWS = [
    Exact(stiffness=STIFFNESS, restitution=0.5),
    LankaraniNikravesh(stiffness=STIFFNESS, restitution=0.3, rest_velocity=1e-3),
]


@pytest.mark.parametrize("law", LAWS, ids=lambda law: f"{type(law).__name__}-{vars(law).get('restitution')}")
def test_bounces_end_in_resting_contact(law: NormalLaw) -> None:
    result = bounce(law, 0.5)
    onsets = result.onsets["ring"]
    assert len(onsets) >= 1
    late = result.time > 0.45
    # at rest: no impact any more, and the depth is that of the weight
    assert onsets[-1].time < 0.4
    np.testing.assert_allclose(
        result["pin.ring.depth"][late], law.resting_depth(BALL * GRAVITY), rtol=2e-3
    )  # what the damping at rest, by the rest velocity, leaves of the vibration
    # steps do not shrink: half a second at rest takes the steps of the grid and no more
    longer = bounce(law, 1.0)
    assert longer.counts.steps - result.counts.steps == round(0.5 / 5e-4)
    assert longer.onsets["ring"] == onsets


# --- separations ---


SPEED = 0.2  # [m/s], of the approach


def only(result: Result) -> Onset:
    """The only contact of a run."""
    (onset,) = result.onsets["pin"]
    return onset


# --- formulations ---


def test_a_journal_in_space_has_parted_when_its_last_section_has() -> None:
    # the right edge flies ahead, impacts first, and is thrown back last
    ball = (0.02, 0.02, 0.02, 0.0, 0.0, 0.0)
    middle, across = (0.0, 0.0, 0.0), (0.0, 0.0, 1.0)
    bodies = {
        "one": SpatialBody(mass=3.0, inertia=ball, centre=middle),
        "two": SpatialBody(
            mass=2.0, inertia=ball, centre=middle, velocity=(SPEED, 0.0, 0.0), spin=(0.0, 0.1, 0.0)
        ),
    }
    bearing = Bearing(
        first="one",
        second="two",
        first_point=middle,
        second_point=middle,
        first_axis=across,
        second_axis=across,
        length=LENGTH,
        holds=frozenset(),
        pin="pin",
    )
    result = simulate(
        Scenario(
            machine=InSpace(space=SpatialLinkage(bodies=bodies, bearings={"pin": bearing})),
            pins={"pin": ClearancePin(contact=contact())},
            duration=0.008,
            gravity=(0.0, 0.0),
            dimensions=3,
        )
    )
    whole, left, right = (result.onsets[name][0] for name in ("pin", "pin.left", "pin.right"))
    assert right.time < left.time < left.separation_time < right.separation_time  # else the test says nothing
    assert len(result.onsets["pin"]) == 1
    assert whole == right
    ended = simulate(replace(result.scenario, duration=0.0062))  # the right one alone is in contact
    assert ended.onsets["pin.left"][0].separation_time == pytest.approx(left.separation_time, rel=1e-9)
    assert ended.onsets["pin"][0].separation_time == math.inf
