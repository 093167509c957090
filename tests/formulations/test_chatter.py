"""A ball bouncing in a ring: ever shorter bounces end in resting contact, not in ever smaller steps."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from support_exudyn import (
    Body,
    ClearancePin,
    Linkage,
    Machine,
    PinPlace,
    Result,
    Scenario,
    simulate,
)
from support_exudyn.model.linkage import GROUND
from user_forces import (
    AdamsImpact,
    Ambrosio,
    Exact,
    JournalBearing,
    JournalContact,
    KelvinVoigt,
    LankaraniNikravesh,
    NormalLaw,
    value,
)

GRAVITY = 9.81
MASS = 2.0
CLEARANCE = 0.01
STIFFNESS = 1e8


@value
class BallInRing(Machine):
    """One body in a ring of the ground."""

    def linkage(self) -> Linkage:
        return Linkage(
            bodies={"ball": Body(mass=MASS, inertia=1e-3, centre=(0.0, 0.0))},
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
    pytest.param(Exact(stiffness=STIFFNESS, restitution=0.8), marks=pytest.mark.slow),
    pytest.param(Exact(stiffness=STIFFNESS, restitution=0.05), marks=pytest.mark.slow),
    LankaraniNikravesh(stiffness=STIFFNESS, restitution=0.3, rest_velocity=1e-3),
    pytest.param(KelvinVoigt(stiffness=1e7, damping=1e3), marks=pytest.mark.slow),
    pytest.param(
        AdamsImpact(stiffness=STIFFNESS, full_damping=1e4, full_damping_depth=2e-5), marks=pytest.mark.slow
    ),
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
        result["pin.ring.depth"][late], law.resting_depth(MASS * GRAVITY), rtol=2e-3
    )  # what the damping at rest, by the rest velocity, leaves of the vibration
    # steps do not shrink: half a second at rest takes the steps of the grid and no more
    longer = bounce(law, 1.0)
    assert longer.counts.steps - result.counts.steps == round(0.5 / 5e-4)
    assert longer.onsets["ring"] == onsets


def test_speeds_of_bounces_fall_by_the_restitution_till_the_weight_matters() -> None:
    law = Exact(stiffness=STIFFNESS, restitution=0.8)
    onsets = bounce(law, 0.4).onsets["ring"]
    assert onsets[0].speed == pytest.approx(math.sqrt(2.0 * GRAVITY * CLEARANCE), rel=1e-9)  # free fall
    for one, other in pairwise(onsets[:6]):
        # the weight presses during the contact, which takes a share m g depth / (m v^2) of the energy
        depth = law.turning_depth(0.5 * MASS * one.speed**2)
        assert other.speed / one.speed == pytest.approx(0.8, abs=GRAVITY * depth / one.speed**2)
