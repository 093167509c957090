"""Where pins are, and which body carries their bores, in the plane and in space."""

from __future__ import annotations

from dataclasses import replace

import pytest

from support_exudyn import ClearancePin, Scenario
from support_exudyn.postprocessing.look.poses import PlacedPin, placed_pins
from tests.cases.run_cases import PIN, loose_support, paper_contact

FRONT = "front_base"  # of the left and the right front link


def pins_of(scenario: Scenario) -> dict[str, PlacedPin]:
    return {pin.name: pin for pin in placed_pins(scenario)}


@pytest.mark.parametrize("dimensions", [2, 3])
@pytest.mark.parametrize(("bore", "journal"), [("first", "second"), ("second", "first")])
def test_the_bore_is_on_the_body_that_the_scenario_says(dimensions: int, bore: str, journal: str) -> None:
    with_clearance = ClearancePin(contact=paper_contact(1.5, 0.0), bore=bore, eccentricity=(0.0, -0.0015))
    scenario = replace(loose_support(dimensions=dimensions), pins={PIN: with_clearance})
    pin = pins_of(scenario)[PIN]
    place = scenario.linkage.pins[PIN]
    assert pin.bore.body == getattr(place, bore)
    assert pin.journal.body == getattr(place, journal)
    assert pin.bore.point[:2] == pytest.approx(getattr(place, f"{bore}_point"))
    assert pin.journal.point[:2] == pytest.approx(getattr(place, f"{journal}_point"))
    # the journal starts at the bottom of its bore; rounding of places of some metres
    apart = [pin.journal.point[k] - pin.bore.point[k] for k in range(2)]
    assert apart == pytest.approx([0.0, -0.0015], abs=1e-12)


def test_bearings_of_a_pair_are_both_loose() -> None:
    scenario = replace(loose_support(dimensions=3), pins={FRONT: ClearancePin(contact=paper_contact(1.5, 0.0))})
    found = pins_of(scenario)
    assert [name for name, pin in found.items() if pin.with_clearance is not None] == [
        f"{FRONT}_left",
        f"{FRONT}_right",
    ]
    left, right = (found[f"{FRONT}_{side}"].bore.point[2] for side in ("left", "right"))
    assert left == -right < 0.0
