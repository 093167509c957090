"""Scenes with one clearance pin, drawn at random: what happens in its contact decides what comes out."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from support_exudyn import (
    ClearancePin,
    CubicStep,
    Held,
    Result,
    Scenario,
    SolverSettings,
    Steady,
    UniformSpeed,
    ravn_slider_crank,
    reference_support,
    simulate,
)
from tests.cases.run_cases import CRANK_SPEED, PIN, SLIDER_PIN
from user_forces import (
    STEEL,
    STEEL_35CRMO,
    Ambrosio,
    Exact,
    Frictionless,
    JournalBearing,
    JournalContact,
    LankaraniNikravesh,
    external_contact_stiffness,
)

FINEST = 1e-11  # tolerance of a run that is taken for right
OFF = 5.0  # errors by which a number may be off


def contact(rng: np.random.Generator, radius: float, clearance: float) -> JournalContact:
    """A drawn contact: law, restitution, stiffness, rest velocity, friction."""
    bearing = JournalBearing(bore_radius=radius, clearance=clearance)
    stiffness = external_contact_stiffness(bearing, STEEL, STEEL_35CRMO) * 10.0 ** rng.uniform(-1.0, 1.0)
    law = (Exact, LankaraniNikravesh)[rng.integers(2)]
    rest = (1e-2, 1e-3)[rng.choice(2, p=(0.75, 0.25))]
    rubs = rng.random() < 0.2
    return JournalContact(
        bearing=bearing,
        normal=law(stiffness=stiffness, restitution=round(rng.uniform(0.2, 0.95), 2), rest_velocity=rest),
        friction=Ambrosio(sliding_coefficient=round(rng.uniform(0.05, 0.3), 2)) if rubs else Frictionless(),
    )


def drawn(seed: int, number: int) -> Scenario:
    """The scene of a number."""
    rng = np.random.default_rng([seed, number])
    if rng.random() < 0.2:
        return _slider_crank(rng)
    clearance = 10.0 ** rng.uniform(-4.0, -2.6)
    laws = contact(rng, 0.0655, round(clearance, 6))
    start = round(rng.uniform(0.0, 0.1), 3)
    end = round(start + rng.uniform(0.05, 0.3), 3)
    stroke = round(rng.uniform(-0.06, 0.12), 3)
    kind = rng.choice(3, p=(0.15, 0.7, 0.15))
    drive = (
        Held(),
        CubicStep(start=start, end=end, stroke=stroke),
        UniformSpeed(start=start, end=end, stroke=stroke),
    )
    eccentricity = (0.0, 0.0)
    if rng.random() < 0.3:
        angle, away = rng.uniform(0.0, 2.0 * np.pi), clearance * rng.uniform(0.2, 1.0)
        eccentricity = (round(away * np.cos(angle), 7), round(away * np.sin(angle), 7))
    return Scenario(
        machine=reference_support(),
        pins={PIN: ClearancePin(contact=laws, eccentricity=eccentricity)},
        drive=drive[kind],
        duration=round(end + rng.uniform(0.0, 0.05), 3),
        record_period=1e-3,
        formulation="compiled",
    )


def _slider_crank(rng: np.random.Generator) -> Scenario:
    laws = contact(rng, 0.01, round(10.0 ** rng.uniform(-4.3, -3.3), 6))
    return Scenario(
        machine=ravn_slider_crank(),
        pins={SLIDER_PIN: ClearancePin(contact=laws)},
        drive=Steady(rate=CRANK_SPEED * round(rng.uniform(0.1, 1.0), 2)),
        duration=0.02,
        record_period=1e-4,
        gravity=(0.0, 0.0),
        formulation="compiled",
    )


class Off(NamedTuple):
    """A number of a result: what it says, its error, what is right, and by how many errors it is off."""

    name: str
    value: float
    error: float
    right: float
    errors: float


def off(result: Result, right: Result) -> Iterator[Off]:
    """All numbers of a result beside those of a run that is right."""
    borrowed = replace(right, coarser=right)  # `numbers` asks for one; its errors are not used
    rights = borrowed.numbers()
    for name, number in result.numbers().items():
        if name in rights:
            distance = abs(number.value - rights[name].value)
            share = distance / number.error if number.error else float(distance > 0.0) * np.inf
            yield Off(name, number.value, number.error, rights[name].value, share)


def finely(scenario: Scenario, tolerance: float = FINEST) -> Result:
    """A run that is taken for right."""
    return simulate(
        replace(scenario, accuracy=None, solver=SolverSettings(tolerance=tolerance, most_steps=1_000_000))
    )
