"""Any pin of a linkage is ideal or with clearance by one field."""

from __future__ import annotations

import numpy as np
import pytest

from support_exudyn import ClearancePin, Held, IdealPin, reference_support, simulate
from tests.cases.run_cases import paper_contact, support

PINS = tuple(reference_support().linkage().pins)


def test_an_ideal_pin_is_the_default() -> None:
    said = simulate(support(duration=0.05, drive=Held(), pins=dict.fromkeys(PINS, IdealPin())))
    unsaid = simulate(support(duration=0.05, drive=Held()))
    for name in PINS:
        np.testing.assert_array_equal(said[f"pin.{name}.force"], unsaid[f"pin.{name}.force"])


@pytest.mark.parametrize("name", PINS)
@pytest.mark.parametrize("bore", ["first", "second"])
def test_a_tight_loose_pin_carries_what_the_ideal_one_does(name: str, bore: str) -> None:
    ideal = simulate(support(duration=0.01, drive=Held()))
    pin = ClearancePin(contact=paper_contact(0.01, 0.0), bore=bore)
    with_clearance = simulate(support(duration=0.01, drive=Held(), pins={name: pin}, start="settled"))
    for part in ("force_x", "force_y"):
        # the posture moves by 0.01 mm and the depth of 0.1 to 0.2 mm, of lengths of 400 mm and more
        scale = ideal[f"pin.{name}.force"][0]
        assert with_clearance[f"pin.{name}.{part}"][0] == pytest.approx(
            ideal[f"pin.{name}.{part}"][0], abs=5e-3 * scale
        )


def test_all_pins_can_be_loose_at_once() -> None:
    pins = {name: ClearancePin(contact=paper_contact(0.5, 0.1)) for name in PINS}
    result = simulate(support(duration=0.02, drive=Held(), pins=pins))
    assert set(result.onsets) == set(PINS)
    assert all(len(result.onsets[name]) >= 1 for name in PINS)
    # energy of impacts in five pins at the default step
    assert result.energy_error < 1e-3 * result.dissipated
