"""The slider-crank in the compiled formulation against printed onsets and the engine."""

from __future__ import annotations

import numpy as np
import pytest

from support_exudyn import ClearancePin, CubicStep, Drive, Held, Result, Scenario, Steady
from tests.cases.run_cases import (
    CRANK_SPEED,
    SLIDER_PIN,
    loose_slider_crank,
    slider_crank,
    slider_crank_contact,
)
from tests.compiled_runs import same_channels, simulate_compiled, simulate_redundant
from tests.formulations.test_slider_crank import SPEEDS, TIMES

GRAVITY = (300.0, -981.0)  # so strong that what is forgotten of it shows [m/s^2]
DRIVES: dict[str, Drive] = {
    "steady": Steady(rate=CRANK_SPEED),
    "from rest": CubicStep(stroke=1.0, start=1e-4, end=2e-3),
    "held": Held(),
}
EVERY_DRIVE = pytest.mark.parametrize("drive", DRIVES)
BORES = pytest.mark.parametrize("bore", ["first", "second"])
FRICTIONS = pytest.mark.parametrize("mu", [0.0, 0.1])


def scene(drive: str, bore: str, mu: float) -> Scenario:
    """2 ms, or 20 ms of a crank that is held while the slider knocks."""
    pin = ClearancePin(contact=slider_crank_contact(mu), bore=bore)
    held = drive == "held"
    changes = {"drive": DRIVES[drive], "gravity": GRAVITY, "step": 1e-5 if held else 1e-6}
    return slider_crank(0.02 if held else 2e-3, pins={SLIDER_PIN: pin}, **changes)


SLOW = (
    ("steady", "first"),
    ("from rest", "second"),
    ("held", "first"),
    ("held", "second"),
)  # others show as much


def check_onsets(result: Result, time: float, speed: float) -> None:
    onsets = np.array(result.onsets[SLIDER_PIN])
    np.testing.assert_allclose(onsets[:, 0], TIMES, rtol=0, atol=time)
    np.testing.assert_allclose(onsets[:, 1], SPEEDS, rtol=0, atol=speed)


def test_printed_onsets() -> None:
    result = simulate_compiled(loose_slider_crank(1.3e-3), 1e-12)
    # half of the last printed digit: 1e-9 s, 1e-6 m/s
    check_onsets(result, 6e-10, 6e-7)
    # printed as "about 4.59e4 N"
    assert result.largest_force[SLIDER_PIN] == pytest.approx(4.59e4, rel=1e-3)


def test_onsets_at_the_usual_tolerance() -> None:
    # five impacts at 1e-7; measured 9e-10 s and 1.6e-5 m/s
    check_onsets(simulate_compiled(loose_slider_crank(1.3e-3), 1e-8), 5e-9, 5e-5)


@pytest.mark.parametrize(
    ("drive", "bore"),
    [
        ("steady", "second"),
        ("from rest", "first"),
        *(pytest.param(*case, marks=pytest.mark.slow) for case in SLOW),
    ],
)
def test_all_channels_are_the_engines(drive: str, bore: str) -> None:
    mu = 0.0 if (drive, bore) == ("from rest", "first") else 0.1
    scenario = scene(drive, bore, mu)
    ours, theirs = simulate_compiled(scenario, 1e-10), simulate_redundant(scenario)
    one, other = np.array(ours.onsets[SLIDER_PIN]), np.array(theirs.onsets[SLIDER_PIN])
    # the engine's errors at 512 steps an impact, magnified from impact to impact; measured 2e-7 s, 4e-4 m/s
    assert one.shape == other.shape
    np.testing.assert_allclose(one[:, 0], other[:, 0], rtol=0, atol=1e-6)
    np.testing.assert_allclose(one[:, 1], other[:, 1], rtol=0, atol=2e-3)
    assert ours.largest_force[SLIDER_PIN] == pytest.approx(theirs.largest_force[SLIDER_PIN], rel=1e-4)
    wrong = same_channels(ours, theirs)
    assert wrong.keys() >= {"crank.moment", "guide.force", "pin.main.force", "pin.crank_pin.force"}
    assert ("energy.work" in wrong) == (drive != "held")
    assert ("guide.moment" in wrong) == (mu > 0.0)
    for name, item in wrong.items():
        # measured 9e-6 in the middle and 9e-3 at most, in the friction force after twenty knocks; a record
        # beside an impact may see it before in one and after it in the other
        assert np.median(item) < 1e-4, name
        assert np.quantile(item, 0.999) < 5e-2, name
    # the guide leaves the slider no motion but along it; in the engine to the tolerance of Newton's method, in
    # general to rounding of what is projected
    for name in ("slider.y", "slider.velocity_y", "slider.angular_velocity", "slider.angular_acceleration"):
        assert np.abs(ours[name]).max() <= 1e-9
        assert name not in wrong


def test_a_steady_crank_is_not_accelerated_at_any_instant() -> None:
    scenario = scene("steady", "first", 0.0)
    ours, theirs = simulate_compiled(scenario, 1e-9), simulate_redundant(scenario)
    assert np.abs(ours["crank.angular_acceleration"]).max() < 1e-5
    # rounding of the engine's angle by the square of the step: measured 0.4 rad/s^2 where the rod has 1.9e6
    assert np.abs(theirs["crank.angular_acceleration"]).max() < 10.0


def test_the_moment_of_the_crank_does_the_work() -> None:
    # by the trapezoidal rule over records that do not see the impacts' kinks: measured 3e-6
    scenario = loose_slider_crank(1.3e-3, gravity=GRAVITY, record_period=2e-8)
    result = simulate_compiled(scenario, 1e-10)
    power = CRANK_SPEED * result["crank.moment"]
    work = np.concatenate([[0.0], np.cumsum(0.5 * np.diff(result.time) * (power[1:] + power[:-1]))])
    largest = np.abs(work).max()
    assert largest > 10.0
    np.testing.assert_allclose(result["energy.work"], work, rtol=0, atol=1e-4 * largest)
