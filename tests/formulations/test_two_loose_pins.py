"""A crank-rocker with two loose pins, without friction and with, beside an independent solution by scipy."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from support_exudyn import ClearancePin, Scenario, SolverSettings, Steady, simulate
from tests.linkage_cases import LENGTHS, MASSES, CrankRocker, closed, rates
from user_forces import Ambrosio, Frictionless, JournalBearing, JournalContact, LankaraniNikravesh

SPEED, BORE, CLEARANCE, STIFFNESS, RESTITUTION = 60.0, 0.01, 5e-4, 1e10, 0.9
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
        along, crank, rocker = 0.5 * b * turned(theta), a * turned(START + SPEED * t), c * turned(phi)
        return {
            "A": (place - along - crank, speed - spin * across(along) - SPEED * across(crank), SPEED),
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
        spin, middle = SPEED * by_coupler, 0.5 * b * turned(coupler)
        crank = a * turned(START)
        s = np.array(
            [*(crank + middle), coupler, rocker, *(SPEED * across(crank) + spin * across(middle)), spin,
             SPEED * by_rocker]
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


WAYS: dict[str, dict[str, object]] = {
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
        drive=Steady(rate=SPEED),
        duration=until,
        record_period=1e-4,
    )
    for formulation, settings in WAYS.items():
        onsets = simulate(replace(scene, formulation=formulation, **settings)).onsets
        # each impact multiplies the errors of those before
        time, speed = (1e-6, 1e-3) if formulation == "exudyn" else (1e-6 * until, 1e-6)
        for name, impacts in known.items():
            found = np.array([(one.time, one.speed) for one in onsets[name]])
            np.testing.assert_allclose(found[:, 0], np.array(impacts)[:, 0], rtol=0.0, atol=time)
            np.testing.assert_allclose(found[:, 1], np.array(impacts)[:, 1], rtol=speed)
