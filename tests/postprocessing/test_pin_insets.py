"""Clearance pins beside the machine in the viewer."""

from __future__ import annotations

import numpy as np
import pytest

from support_exudyn.postprocessing.render.pin_views import Bore, PinView
from support_exudyn.postprocessing.viewer.pin_insets import RADIUS, PinInsets
from tests.cases.run_cases import loose_support

TIME = np.array([0.0, 0.1, 0.2])
LOW, HIGH = np.array([-1.0, 0.0, -0.5]), np.array([3.0, 2.0, 0.5])
SIZE = RADIUS * 4.0


def insets(eccentricity: list[tuple[float, float]], force: list[tuple[float, float]]) -> PinInsets:
    pin = loose_support(1.31).clearance_pins["rear_base"]  # a fiftieth of its bore's radius
    size = np.hypot(*np.array(force).T)
    bore = Bore(pin, np.array(eccentricity), size > 0.0, "base")
    view = PinView("rear_base", "journal", np.array(force), np.zeros((3, 3)), bore)
    return PinInsets([view], TIME, LOW, HIGH)


def test_the_journal_is_where_the_record_next_to_the_time_has_it() -> None:
    found = insets([(0.0, 0.0), (0.0, -1.31e-3), (0.0, 0.0)], [(0.0, 0.0), (0.0, 5e4), (0.0, 0.0)])
    for now, down in ((0.0, 0.0), (0.11, 1.0), (0.2, 0.0)):
        disc, bore, journal, *rest = found.graphics(now)
        assert bore["radius"] == pytest.approx(SIZE)
        # in contact the circles meet
        assert bore["position"][1] - journal["position"][1] == pytest.approx(
            down * (bore["radius"] - journal["radius"])
        )
        assert np.mean(disc["points"].reshape(-1, 3), axis=0)[:2] == pytest.approx(journal["position"][:2])
        lines = [one for one in rest if one["type"] == "Line"]
        assert len(lines) == 3 * down  # the arrow, where there is a force
        if down:
            tail, tip = lines[0]["data"].reshape(2, 3)
            assert tip - tail == pytest.approx([0.0, SIZE, 0.0])  # it is the usual one
        assert rest[-1]["text"].startswith("50.0 kN" if down else "0.0 kN")
