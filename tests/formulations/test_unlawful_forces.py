"""Laws, loads and drives that give what no force can be are refused by name, in all formulations."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import pytest

from support_exudyn import (
    AppliedForce,
    ClearancePin,
    CubicStep,
    Drive,
    Failure,
    Held,
    IdealPin,
    OilColumn,
    Scenario,
    bore_area,
    simulate,
)
from tests.cases.run_cases import PIN, support
from user_forces import (
    FrictionLaw,
    JournalBearing,
    JournalContact,
    NormalLaw,
    friction_law,
    normal_law,
    value,
)
from user_forces.kernel import kernel

BEARING = JournalBearing(bore_radius=0.0655, clearance=0.0005)
OIL = OilColumn(bore_area=bore_area(0.25, 2), oil_length=0.5, bulk_modulus=1.5e9)
WAYS: Mapping[str, Mapping[str, Any]] = {
    "exudyn": {"formulation": "exudyn"},
    "space": {"dimensions": 3},
    "compiled": {"formulation": "compiled", "actuators": {"front_column": OIL, "rear_column": OIL}},
    "accuracy": {"accuracy": "draft"},
}


def spring(depth: float, rate: float, impact_velocity: float) -> float:
    """Linear; a law of one's own."""
    return 1e9 * depth


def no_number(depth: float, rate: float, impact_velocity: float) -> float:
    lost = rate != 0.0 and 2e-5 < depth < 9e-5  # between the depths before a run
    return math.nan if lost else 1e9 * depth


def endless(depth: float, rate: float, impact_velocity: float) -> float:
    return math.inf if 2e-5 < depth < 9e-5 else 1e9 * depth


def pulling(depth: float, rate: float, impact_velocity: float) -> float:
    return -1e9 * depth


def driving(depth: float, rate: float, impact_velocity: float) -> float:
    within = 2e-5 < depth < 9e-5  # between the depths before a run
    return 1e9 * depth * (1.0 - 0.03 * rate if within else 1.0)


def never_a_number(depth: float, rate: float, impact_velocity: float) -> float:
    return 1e9 * depth + math.inf


def dividing(depth: float, rate: float, impact_velocity: float) -> float:
    return 1e9 * depth * (rate / rate)


def along(slip: float, normal_force: float) -> float:
    return 0.1 * normal_force * math.tanh(slip / 1e-3)


def slippery(slip: float, normal_force: float) -> float:
    if 2e-3 < abs(slip) < 5e-2:  # between the slips at which laws are called before a run
        return math.nan
    return -0.1 * normal_force * math.tanh(slip / 1e-3)


@value
class NoElasticForce(NormalLaw):
    force = staticmethod(kernel(spring))

    @staticmethod
    @kernel
    def elastic(depth: float) -> float:
        return 1e9 * depth if depth < 3e-5 else math.nan


@value
class NoEnergy(NormalLaw):
    force = staticmethod(kernel(spring))

    @staticmethod
    @kernel
    def energy(depth: float) -> float:
        return math.nan


@value
class Feeding(FrictionLaw):
    """A law with a state that gives what it never stored."""

    @staticmethod
    @kernel
    def force(slip: float, normal_force: float, deflection: float) -> float:
        return 0.1 * normal_force * math.tanh(slip / 1e-3)

    @staticmethod
    @kernel
    def advance(deflection: float, slip: float, step: float) -> float:
        return 1e-9


Spring: Any = normal_law(spring)


def with_clearance(normal: NormalLaw, friction: FrictionLaw | None = None, **changes: Any) -> Scenario:
    """A support that falls into its clearance pin within 10 ms."""
    laws: dict[str, Any] = {"normal": normal} | ({"friction": friction} if friction else {})
    pin = ClearancePin(contact=JournalContact(bearing=BEARING, **laws))
    return support(**{"pins": {PIN: pin}, "drive": Held(), "duration": 0.03} | changes)


def refused(scenario: Scenario, *said: str) -> Failure:
    failure = simulate(scenario, throw=False)
    assert isinstance(failure, Failure)
    for words in said:
        assert words in failure.reason, failure
    assert failure.advice.startswith("Mend the law")
    return failure


BOTH = ("exudyn", "compiled")


@pytest.mark.parametrize(
    ("normal", "friction", "said", "way"),
    [
        *((no_number, None, "NoNumber gives a force of nan N", way) for way in WAYS),
        *((endless, None, "Endless gives a force of inf N", way) for way in BOTH),
        *((pulling, None, "Pulling has an elastic force of -1 N", way) for way in BOTH),
        *((driving, None, "Driving drives the motion", way) for way in BOTH),
        *((spring, along, "Along pushes along the slip", way) for way in BOTH),
        *((spring, slippery, "Slippery gives a force of nan N", way) for way in WAYS),
    ],
)
def test_a_law_is_refused(normal: Any, friction: Any, said: str, way: str) -> None:
    laws = normal_law(normal)(), friction_law(friction)() if friction else None
    failure = refused(with_clearance(*laws, **WAYS[way]), PIN, said)
    # within the impact, which is after 10 ms, or before the run
    within = normal in (no_number, endless, driving) or friction is slippery
    assert 0.009 < failure.time < 0.011 if within else failure.time == 0.0


@pytest.mark.parametrize(
    "law",
    [normal_law(never_a_number)(), normal_law(dividing)(), NoElasticForce(), NoEnergy()],
    ids=lambda law: type(law).__name__,
)
@pytest.mark.parametrize("way", BOTH)
def test_a_law_that_is_none_at_rest_is_refused_before_the_run(law: NormalLaw, way: str) -> None:
    failure = refused(with_clearance(law, **WAYS[way]), PIN, type(law).__name__)
    assert failure.time == 0.0


@pytest.mark.parametrize("way", WAYS)
def test_the_law_that_they_are_made_from_passes(way: str) -> None:
    assert not isinstance(simulate(with_clearance(Spring(), **WAYS[way]), throw=False), Failure)


@pytest.mark.parametrize("way", ["exudyn", "space"])  # `compiled` takes the laws' own states
def test_a_state_that_feeds_is_refused_by_what_is_lost(way: str) -> None:
    refused(
        with_clearance(Spring(), Feeding(), **WAYS[way]),
        "friction_loss becomes less by",
        f"pins.{PIN} = Feeding",
    )


@pytest.mark.parametrize("law", [friction_law(along)(), friction_law(slippery)()], ids=repr)
def test_friction_of_an_ideal_pin_is_refused(law: FrictionLaw) -> None:
    pins = {"rear_base": IdealPin(friction=law, radius=0.06)}
    rise = support(pins=pins, drive=CubicStep(start=0.0, end=0.05, stroke=0.01), duration=0.02)
    refused(rise, "rear_base", type(law).__name__)


@value
class Lost(Drive):
    """Smooth at first, then no number."""

    def extension(self, t: float) -> float:
        return math.nan if t > 0.012 else t * t

    def speed(self, t: float) -> float:
        return math.nan if t > 0.012 else 2.0 * t

    @property
    def breaks(self) -> tuple[float, ...]:
        return ()

    def span(self, duration: float) -> tuple[float, float]:
        return 0.0, duration**2


def test_a_drive_of_ideal_pins_is_refused() -> None:
    refused(support(drive=Lost(), duration=0.03), "Lost has an extension of nan")


@value
class Pushing(AppliedForce):
    """A load that gives what it should lose."""

    @staticmethod
    @kernel
    def action(t: float, *numbers: float) -> tuple[float, ...]:
        return 0.0, -1e4, 0.0, 0.0, 0.0, -1e4, 0.0, -1e4


@value
class NoLoad(AppliedForce):
    @staticmethod
    @kernel
    def action(t: float, *numbers: float) -> tuple[float, ...]:
        up = math.nan if t > 5e-3 else -1e4
        return 0.0, up, 0.0, 0.0, up * numbers[3], 0.0, 0.0, up


@pytest.mark.parametrize("kind", [Pushing, NoLoad])
@pytest.mark.parametrize("clearance", [False, True])
def test_a_load_is_refused(kind: type[AppliedForce], clearance: bool) -> None:
    press = kind(body="canopy", point=(0.5, 3.0), full_force=(0.0, -1e4))
    scene = with_clearance(Spring()) if clearance else support(drive=Held())
    refused(replace(scene, loads={"press": press}, duration=0.01), "press", kind.__name__)
