"""The slider-crank and the crank-rocker with clearance, against independent solutions."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from support_exudyn import ClearancePin, Result, Scenario, SolverSettings, Steady, simulate
from tests.cases.run_cases import CRANK_SPEED, SLIDER_PIN, loose_slider_crank, slider_crank
from tests.linkage_cases import LENGTHS, MASSES, CrankRocker, closed, rates
from user_forces import Ambrosio, Frictionless, JournalBearing, JournalContact, LankaraniNikravesh

TIMES = (227.286e-6, 637.056e-6, 749.700e-6, 1085.947e-6, 1205.816e-6)  # [s]
SPEEDS = (4.385783, 2.756949, 1.826699, 1.101851, 0.823801)  # [m/s]
REVOLUTION = 2.0 * math.pi / CRANK_SPEED  # [s]


@pytest.fixture(scope="module")
def ideal() -> Result:
    return simulate(slider_crank(REVOLUTION, record_period=REVOLUTION / 7200))


def test_ideal_values(ideal: Result) -> None:
    # asked for: 1e-6; printed to 2e-7 and finer; records every 0.05 degrees miss a maximum by 1e-7
    assert np.abs(ideal["slider.velocity_x"]).max() == pytest.approx(28.4113, rel=2e-6)
    assert ideal["crank.moment"].max() == pytest.approx(138.5217, rel=1e-6)
    assert ideal["crank.moment"].min() == pytest.approx(-138.5217, rel=1e-6)
    assert ideal[f"pin.{SLIDER_PIN}.force"].max() == pytest.approx(2718.71, rel=2e-6)
    # the slider's acceleration is its force by its mass of 0.14 kg, largest at the outer dead centre
    assert ideal[f"pin.{SLIDER_PIN}.force_x"][-1] / -0.14 == pytest.approx(-19419.36, rel=1e-6)


def test_ideal_motion_is_the_closed_form(ideal: Result) -> None:
    machine = ideal.scenario.machine
    angle = CRANK_SPEED * ideal.time
    position = np.array([machine.slider_position(a) for a in angle])
    speed = np.array([machine.slider_speed(a, CRANK_SPEED) for a in angle])
    # constraints hold to rounding
    np.testing.assert_allclose(ideal["slider.x"], position, atol=1e-12)
    # asked for, of 28 m/s
    np.testing.assert_allclose(ideal["slider.velocity_x"], speed, atol=28e-6)
    # the guide holds the slider
    assert np.abs(ideal["slider.y"]).max() < 1e-12
    assert np.abs(ideal["slider.angle"]).max() < 1e-12


# formulation, tolerance, and how close times [s] and speeds [m/s] are. The engine's error is of second order in
# the step: asked for are shares of 1e-5 and 1e-3. Compiled at a tolerance of 1e-12 it is half of the last digit
# printed, at 1e-8 five impacts multiply it
Close = dict[str, float]
WAYS: dict[str, tuple[str, float, Close, Close]] = {
    "engine": ("exudyn", 1e-7, {"rtol": 1e-5}, {"rtol": 1e-4}),
    "compiled, fine": ("compiled", 1e-12, {"rtol": 0.0, "atol": 6e-10}, {"rtol": 0.0, "atol": 6e-7}),
    "compiled": ("compiled", 1e-8, {"rtol": 0.0, "atol": 5e-9}, {"rtol": 0.0, "atol": 5e-5}),
}


@pytest.mark.parametrize("way", WAYS)
def test_first_five_onsets(way: str) -> None:
    formulation, tolerance, time, speed = WAYS[way]
    solver = SolverSettings(tolerance=tolerance)
    result = simulate(loose_slider_crank(1.3e-3, formulation=formulation, solver=solver))
    onsets = result.onsets[SLIDER_PIN]
    np.testing.assert_allclose([one.time for one in onsets], TIMES, **time)
    np.testing.assert_allclose([one.speed for one in onsets], SPEEDS, **speed)
    # printed as "about 4.59e4 N near 7.55 degrees"
    force = result[f"pin.{SLIDER_PIN}.force"]
    assert result.largest_force[SLIDER_PIN] == pytest.approx(4.59e4, rel=1e-3)
    assert np.degrees(CRANK_SPEED * result.time[force.argmax()]) == pytest.approx(7.55, abs=0.2)  # records


# --- two loose pins of a crank-rocker, by scipy ---


TURNING, BORE, CLEARANCE, STIFFNESS, RESTITUTION = 60.0, 0.01, 5e-4, 1e10, 0.9
START = 0.0  # of the crank [rad]
STATIC, DYNAMIC = 1e-4, 1e-2  # of Ambrosio's ramp [m/s]
Onsets = dict[str, list[tuple[float, float]]]


def turned(angle: float) -> np.ndarray:
    return np.array([math.cos(angle), math.sin(angle)])


def across(vector: np.ndarray) -> np.ndarray:
    return np.array([-vector[1], vector[0]])


def cross(a: np.ndarray, b: np.ndarray) -> float:
    return float(a[0] * b[1] - a[1] * b[0])


class Equations:
    """Coupler with three coordinates, rocker with one, under the forces in both pins; the crank is driven."""

    def __init__(self, friction: float) -> None:
        self.friction = friction
        self.speeds: dict[str, float | None] = {"A": None, "B": None}  # of impacts that last

    def pins(self, t: float, s: np.ndarray) -> dict[str, tuple[np.ndarray, np.ndarray, float]]:
        """Of each pin journal's centre minus bore's, its rate, and the bore's angular velocity."""
        a, b, c, d = LENGTHS
        place, theta, phi, speed, spin, swing = s[0:2], s[2], s[3], s[4:6], s[6], s[7]
        along, crank, rocker = 0.5 * b * turned(theta), a * turned(START + TURNING * t), c * turned(phi)
        return {
            "A": (place - along - crank, speed - spin * across(along) - TURNING * across(crank), TURNING),
            "B": (
                place + along - rocker - np.array([d, 0.0]),
                speed + spin * across(along) - swing * across(rocker),
                swing,
            ),
        }

    def depth(self, name: str, t: float, s: np.ndarray) -> float:
        return float(np.linalg.norm(self.pins(t, s)[name][0])) - CLEARANCE

    def slope(self, t: float, s: np.ndarray) -> np.ndarray:
        _, b, c, _ = LENGTHS
        _, coupler_mass, rocker_mass = MASSES
        theta, phi, speed, spin, swing = s[2], s[3], s[4:6], s[6], s[7]
        down = np.array([0.0, -9.81])
        force, moment = coupler_mass * down, 0.0
        rocking = 0.5 * c * cross(turned(phi), rocker_mass * down)
        for name, (apart, rate, bore_spin) in self.pins(t, s).items():
            v0 = self.speeds[name]
            if v0 is None:
                continue
            away = float(np.linalg.norm(apart))
            n, depth = apart / away, away - CLEARANCE
            inwards = float(rate @ n)
            damping = 0.75 * (1.0 - RESTITUTION**2) / v0
            push = max(0.0, STIFFNESS * max(depth, 0.0) ** 1.5 * (1.0 + damping * inwards))
            bore_arm = BORE + 0.5 * depth
            journal_arm = bore_arm - away
            slip = float(rate @ across(n)) + spin * journal_arm - bore_spin * bore_arm
            share = min(1.0, max(0.0, (abs(slip) - STATIC) / (DYNAMIC - STATIC)))
            rub = -self.friction * share * push * math.copysign(1.0, slip)
            on_journal = -push * n + rub * across(n)
            force = force + on_journal
            side = -1.0 if name == "A" else 1.0
            moment += cross(side * 0.5 * b * turned(theta), on_journal) + journal_arm * rub
            if name == "B":
                rocking -= cross(c * turned(phi), on_journal) + bore_arm * rub
        return np.array(
            [*speed, spin, swing, *(force / coupler_mass), 12.0 * moment / (coupler_mass * b**2),
             3.0 * rocking / (rocker_mass * c**2)]
        )  # fmt: skip

    def impacts(self, until: float) -> Onsets:
        """Times and initial velocities of all impacts, by pin."""
        a, b, *_ = LENGTHS
        coupler, rocker = closed(START)
        by_coupler, by_rocker = rates(START)
        spin, middle = TURNING * by_coupler, 0.5 * b * turned(coupler)
        crank = a * turned(START)
        s = np.array(
            [*(crank + middle), coupler, rocker, *(TURNING * across(crank) + spin * across(middle)), spin,
             TURNING * by_rocker]
        )  # fmt: skip
        found: Onsets = {"A": [], "B": []}
        t = 0.0
        while t < until:
            events = [self._event(name) for name in found]
            run = solve_ivp(
                self.slope, (t, until), s, "DOP853", rtol=1e-12, atol=1e-15, events=events, max_step=1e-5
            )
            t, s = float(run.t[-1]), run.y[:, -1]
            for name, times in zip(found, run.t_events, strict=True):
                if len(times):
                    apart, rate, _ = self.pins(t, s)[name]
                    speed = float(rate @ apart) / float(np.linalg.norm(apart))
                    began = self.speeds[name] is None
                    self.speeds[name] = speed if began else None
                    if began:
                        found[name].append((t, speed))
        return found

    def _event(self, name: str) -> object:
        """An impact of a pin that is apart, or the separation of one that is not."""
        apart = self.speeds[name] is None

        def event(t: float, s: np.ndarray) -> float:
            return self.depth(name, t, s)

        event.terminal = True  # type: ignore[attr-defined]
        event.direction = 1.0 if apart else -1.0  # type: ignore[attr-defined]
        return event


BOTH_WAYS: dict[str, dict[str, object]] = {
    "exudyn": {"step": 2e-6, "solver": SolverSettings(impact_steps=1024)},
    "compiled": {"solver": SolverSettings(tolerance=1e-10)},
}


@pytest.mark.parametrize("friction", [0.0, 0.1])
def test_impacts_of_two_pins_are_those_of_an_independent_solution(friction: float) -> None:
    until = 0.006
    known = Equations(friction).impacts(until)
    assert sum(map(len, known.values())) >= 5
    contact = JournalContact(
        bearing=JournalBearing(bore_radius=BORE, clearance=CLEARANCE),
        normal=LankaraniNikravesh(stiffness=STIFFNESS, restitution=RESTITUTION, rest_velocity=1e-9),
        friction=Ambrosio(sliding_coefficient=friction) if friction else Frictionless(),
    )
    scene = Scenario(
        machine=CrankRocker(angle=START, driven=True),
        pins={"A": ClearancePin(contact=contact), "B": ClearancePin(contact=contact, bore="second")},
        drive=Steady(rate=TURNING),
        duration=until,
        record_period=1e-4,
    )
    for formulation, settings in BOTH_WAYS.items():
        onsets = simulate(replace(scene, formulation=formulation, **settings)).onsets
        # each impact multiplies the errors of those before
        time, speed = (1e-6, 1e-3) if formulation == "exudyn" else (1e-6 * until, 1e-6)
        for name, impacts in known.items():
            found = np.array([(one.time, one.speed) for one in onsets[name]])
            np.testing.assert_allclose(found[:, 0], np.array(impacts)[:, 0], rtol=0.0, atol=time)
            np.testing.assert_allclose(found[:, 1], np.array(impacts)[:, 1], rtol=speed)
