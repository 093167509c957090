"""Plausible machines whose runs were once not finished."""

from __future__ import annotations

import pytest

from studies.claims.plausible import Choice, machine
from studies.claims.plausible_runs import scenario
from tests.compiled_runs import simulate_compiled

# no. 695 of 1024: the contact's force comes down to the cut of tension and turns there
GRAZING: dict[str, Choice] = {
    "scale": 0.600259773267435,
    "mass_rear_link": 0.9686913733946889,
    "mass_front_link": 1.3459330188045806,
    "mass_shield_beam": 0.6231681436106974,
    "mass_tail_beam": 1.3190353315703065,
    "mass_canopy": 0.8690828113900252,
    "centre_along_rear_link": -0.014132576921149526,
    "centre_along_front_link": -0.05061904532942514,
    "centre_along_shield": 0.08031159912872984,
    "centre_along_canopy": 0.09335252600903754,
    "centre_across_shield": -0.08113909473836131,
    "centre_across_canopy": 0.032759117498826235,
    "start_height": 0.9871989071781346,
    "restitution": 0.39352379318192465,
    "law": "lankarani_nikravesh",
    "rest_velocity": 0.01,
    "contact": "paper",
    "backing": 1.0,
    "stroke_time": 2.0,
    "bulk_modulus": 1.5,
    "line_volume": 10.0,
    "line_drop": 1.0,
    "sliding_coefficient": 0.22666592400795427,
    "static_speed": 0.0002803680591307704,
    "dynamic_speed": 0.001518162330165804,
    "bore": "rear link",
}


def test_a_contact_that_only_grazes_the_cut_of_tension_goes_on() -> None:
    case = scenario(GRAZING, "1.5 mm", machine(GRAZING))
    coarse, fine = (simulate_compiled(case, tolerance=tolerance) for tolerance in (1e-6, 1e-8))
    # landing on the cut went back and forth for ever; now 14000 steps
    assert coarse.counts.steps < 30_000
    forces = [run["pin.rear_base.force"].mean() for run in (coarse, fine)]
    # contact vibration with friction, at tolerances a hundredfold apart
    assert forces[0] == pytest.approx(forces[1], rel=1e-5)
