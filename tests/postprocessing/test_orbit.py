"""Journal orbit of runs that are known."""

from __future__ import annotations

import math

import numpy as np
import pytest
from matplotlib.axes import Axes

from support_exudyn import Onset
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.journal import clearance_joints, journal
from support_exudyn.postprocessing.figures.orbit import orbit
from tests import figure_checks, synthetic
from tests.cases.run_cases import loose_support, support
from user_forces import InputError

CLEARANCE = 1.5e-3  # [m]
SCENARIO = loose_support(1.5)
# a journal that falls at 0.1 m/s, impacts at 15 ms, is pressed in 0.3 mm deep at 20 ms and parts at 25 ms
TIME = np.arange(0.0, 40.0) * 1e-3
BOUNCE = Onset(15e-3, 0.1, 25e-3, 0.08)
DOWN = np.where(
    TIME < 15e-3,
    -0.1 * TIME,
    np.where(
        TIME < 25e-3,
        -CLEARANCE - 0.3e-3 * np.sin(np.pi * (TIME - 15e-3) / 10e-3),
        -CLEARANCE + 0.08 * (TIME - 25e-3),
    ),
)


def bouncing() -> synthetic.Result:
    return synthetic.journal(SCENARIO, TIME, np.zeros_like(TIME), DOWN, [BOUNCE])


def lines(axes: Axes) -> dict[str, np.ndarray]:
    return {line.get_label(): np.array(line.get_data()) for line in axes.lines}


def test_flight_and_contact_are_parted_at_the_touches() -> None:
    path = orbit(bouncing()).axes[0]
    flight, contact = lines(path)["free flight"], lines(path)["contact"]
    # in millimetres; the impact lies on the circle though no record does
    assert np.nanmin(contact[1]) == pytest.approx(-1.8)
    assert np.nanmax(contact[1]) == pytest.approx(-1.5)
    assert np.nanmin(flight[1]) == pytest.approx(-1.5)
    assert np.nanmax(flight[1]) == pytest.approx(0.0)
    colours = {line.get_label(): line.get_color() for line in path.lines}
    assert (colours["free flight"], colours["contact"]) == (style.FLIGHT, style.CONTACT)


def test_an_impact_between_two_records_is_drawn_as_contact() -> None:
    y = np.where(TIME < 15.2e-3, -0.1 * TIME, -CLEARANCE + 0.05 * (TIME - 15.6e-3))
    run = synthetic.journal(SCENARIO, TIME, np.zeros_like(TIME), y, [Onset(15.2e-3, 0.1, 15.6e-3, 0.05)])
    drawing = orbit(run)
    contact = lines(drawing.axes[0])["contact"]
    # both ends of it lie on the circle; hypot rounds in the last digit
    assert np.nanmin(contact[1]) == pytest.approx(-1.5, rel=1e-12)
    assert "400 µs" in figure_checks.words_below(drawing)


def test_the_direction_of_a_touch_is_that_of_the_flight_carried_on() -> None:
    # along a straight line that misses the middle by 1 mm; it meets the circle of 1.5 mm between two records
    reached = math.sqrt(1.25) * 1e-3
    time = (reached + 0.75e-3) / 0.1
    assert 18e-3 < time < 19e-3
    x = 0.1 * TIME - 0.75e-3
    x[19:] = 1.5e-3  # it is hit aside afterwards
    run = synthetic.journal(SCENARIO, TIME, x, np.full_like(TIME, -1e-3), [Onset(time, 0.1)])
    assert journal(run).directions == pytest.approx([math.atan2(-1e-3, reached)], abs=1e-9)  # rounding of times


def test_what_cannot_be_drawn_is_refused() -> None:
    ideal = synthetic.result(support(), TIME, {"pin.rear_base.force": (TIME, "N")})
    assert clearance_joints(ideal) == ()
    with pytest.raises(InputError, match="no clearance pin"):
        orbit(ideal)
    with pytest.raises(InputError, match="rear_base"):
        orbit(bouncing(), "rear_bsae")
    with pytest.raises(InputError, match="0 records lie between"):
        orbit(bouncing(), after=1.0)
