"""How contacts end: when the surfaces part, and how fast."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from support_exudyn import (
    ClearancePin,
    Onset,
    Result,
    Scenario,
    simulate,
)
from support_exudyn.model.spatial_linkage import Bearing, SpatialBody, SpatialLinkage
from tests.cases.spatial_cases import LENGTH, InSpace, contact
from tests.user_forces.test_restitution import scenario
from user_forces import LankaraniNikravesh

LAW = LankaraniNikravesh(stiffness=1e8, restitution=0.7)
SPEED = 0.2  # [m/s], of the approach


def only(result: Result) -> Onset:
    """The only contact of a run."""
    (onset,) = result.onsets["pin"]
    return onset


def seen_parting(result: Result, depth: str) -> float:
    """Time at which the records of a depth pass zero downwards, by the straight line between two [s]."""
    values = result[depth]
    (n,) = np.flatnonzero((values[:-1] > 0.0) & (values[1:] <= 0.0))
    share = values[n] / (values[n] - values[n + 1])
    return float(result.time[n] + share * (result.time[n + 1] - result.time[n]))


def test_the_time_of_a_parting_is_that_of_the_records() -> None:
    tried = scenario(LAW)
    result = simulate(replace(tried, record_period=tried.duration / 4000))
    length = only(result).separation_time - only(result).time
    # a thousandth of the impact's steps, of which it has 512
    assert only(result).separation_time == pytest.approx(
        seen_parting(result, "pin.pin.depth"), abs=1e-4 * length
    )


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
