"""Laws, loads and drives that give what no force can be are refused by name, in all formulations."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import pytest
from user_forces.expressions.scalar import tanh, where

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
    SolverSettings,
    bore_area,
    simulate,
)
from support_exudyn.model.loads.load import LoadedPoint, Powers
from tests.cases.run_cases import CRANK_SPEED, PIN, slider_crank, support
from user_forces import Ambrosio, FrictionLaw, InputError, JournalBearing, JournalContact, NormalLaw, value
from user_forces.values.value import Vector2

BEARING = JournalBearing(bore_radius=0.0655, clearance=0.0005)
OIL = OilColumn(bore_area=bore_area(0.25, 2), oil_length=0.5, bulk_modulus=1.5e9)
WAYS: Mapping[str, Mapping[str, Any]] = {
    "python": {"solver": SolverSettings(backend="python")},
    "symbolic": {"solver": SolverSettings(backend="symbolic")},
    "space": {"dimensions": 3},
    "compiled": {"formulation": "compiled", "actuators": {"front_column": OIL, "rear_column": OIL}},
    "accuracy": {"accuracy": "draft"},
}


@value
class Spring(NormalLaw):
    """Linear; a law of one's own."""

    stiffness: float = 1e9

    def __call__(self, depth: float, rate: float, impact_velocity: float) -> float:
        return self.stiffness * depth

    def elastic_force(self, depth: float) -> float:
        return self.stiffness * depth

    def elastic_energy(self, depth: float) -> float:
        return 0.5 * self.stiffness * depth * depth


@value
class NoNumber(Spring):
    def __call__(self, depth: float, rate: float, impact_velocity: float) -> float:
        lost = where(depth > 2e-5, where(depth < 9e-5, 1.0, 0.0), 0.0) > 0.5  # between the depths before a run
        return where(lost, math.nan, self.stiffness * depth)


@value
class Endless(Spring):
    def __call__(self, depth: float, rate: float, impact_velocity: float) -> float:
        lost = where(depth > 2e-5, where(depth < 9e-5, 1.0, 0.0), 0.0) > 0.5  # between the depths before a run
        return where(lost, math.inf, self.stiffness * depth)


@value
class WrongSign(Spring):
    def __call__(self, depth: float, rate: float, impact_velocity: float) -> float:
        return -self.stiffness * depth


@value
class Pulling(WrongSign):
    def elastic_force(self, depth: float) -> float:
        return -self.stiffness * depth


@value
class Driving(Spring):
    def __call__(self, depth: float, rate: float, impact_velocity: float) -> float:
        return self.stiffness * depth * (1.0 - 0.03 * rate)


@value
class Along(FrictionLaw):
    def __call__(self, slip: float, normal_force: float, deflection: float = 0.0) -> float:
        return 0.1 * normal_force * tanh(slip / 1e-3)


@value
class Slippery(FrictionLaw):
    def __call__(self, slip: float, normal_force: float, deflection: float = 0.0) -> float:
        square = slip * slip  # between the slips at which laws are called before a run
        lost = where(square > 4e-6, where(square < 2.5e-3, 1.0, 0.0), 0.0) > 0.5
        return where(lost, math.nan, -0.1 * normal_force * tanh(slip / 1e-3))


@value
class Feeding(FrictionLaw):
    """A law with a state that gives what it never stored."""

    @property
    def has_state(self) -> bool:
        return True

    def next_deflection(self, deflection: float, slip: float, step: float) -> float:
        return 1e-9

    def __call__(self, slip: float, normal_force: float, deflection: float = 0.0) -> float:
        return 0.1 * normal_force * tanh(slip / 1e-3)


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


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize(
    ("normal", "friction", "said"),
    [
        (NoNumber(), None, "NoNumber gives a force of nan N"),
        (Endless(), None, "Endless gives a force of inf N"),
        (WrongSign(), None, "WrongSign drives the motion"),
        (Pulling(), None, "Pulling has an elastic force of -1 N"),
        (Driving(), None, "Driving drives the motion"),
        (Spring(), Along(), "Along pushes along the slip"),
        (Spring(), Slippery(), "Slippery gives a force of nan N"),
    ],
)
def test_a_law_is_refused(normal: NormalLaw, friction: FrictionLaw | None, said: str, way: str) -> None:
    failure = refused(with_clearance(normal, friction, **WAYS[way]), PIN, said)
    # within the impact, which is after 10 ms, or before the run
    within = isinstance(normal, NoNumber | Endless) or isinstance(friction, Slippery)
    assert 0.009 < failure.time < 0.011 if within else failure.time == 0.0


@value
class AlwaysEndless(Spring):
    def __call__(self, depth: float, rate: float, impact_velocity: float) -> float:
        return self.stiffness * depth + math.inf


@value
class NoElasticForce(Spring):
    def elastic_force(self, depth: float) -> float:
        return self.stiffness * depth if depth < 3e-5 else math.nan


@value
class NoEnergy(Spring):
    def elastic_energy(self, depth: float) -> float:
        return math.nan


@value
class Failing(Spring):
    def __call__(self, depth: float, rate: float, impact_velocity: float) -> float:
        return self.stiffness * depth * (rate / rate)


@pytest.mark.parametrize(
    "law", [AlwaysEndless(), NoElasticForce(), NoEnergy(), Failing()], ids=lambda law: type(law).__name__
)
@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("start", ["concentric", "settled"])
def test_a_law_that_is_none_at_rest_is_refused_before_the_run(law: NormalLaw, way: str, start: str) -> None:
    failure = refused(with_clearance(law, start=start, **WAYS[way]), PIN, type(law).__name__)
    assert failure.time == 0.0


@value
class Nothing(Spring):
    def __call__(self, depth: float, rate: float, impact_velocity: float) -> Any:
        return None


@value
class Worded(Spring):
    def elastic_force(self, depth: float) -> Any:
        return "hard"


@value
class Imaginary(Spring):
    def elastic_energy(self, depth: float) -> Any:
        return 1j * depth


@value
class Raising(Spring):
    def __call__(self, depth: float, rate: float, impact_velocity: float) -> float:
        raise KeyError("stiffness")


@value
class Richer(Spring):
    def elastic_energy(self, depth: float) -> float:
        return 1.1 * self.stiffness * depth * depth  # 2.2 times the integral of the force


@value
class Gripping(FrictionLaw):
    def __call__(self, slip: float, normal_force: float, deflection: float = 0.0) -> Any:
        return -50.0 * normal_force * tanh(slip / 1e-3)


@value
class Silent(FrictionLaw):
    def __call__(self, slip: float, normal_force: float, deflection: float = 0.0) -> Any:
        return None


@pytest.mark.parametrize(
    ("law", "said"),
    [
        (Nothing(), "Nothing gives None at a depth of 1e-09 m and a rate of 0 m/s; allowed: a real number"),
        (Worded(), "Worded.elastic_force gives 'hard' at a depth of 1e-09 m; allowed: a real number"),
        (Imaginary(), "Imaginary.elastic_energy gives 1e-09j at a depth of 1e-09 m"),
        (Raising(), "Raising fails at a depth of 1e-09 m and a rate of 0 m/s: KeyError: 'stiffness'"),
        (Richer(), "1.1e-09 J at a depth of 1e-09 m, and the integral of elastic_force up to there 5e-10 J"),
        (
            Gripping(),
            "Gripping has a coefficient of 38.0797 at a slip of 0.001 m/s and 1000 N; allowed: 0 to 5",
        ),
        (Silent(), "Silent gives None at a slip of 0 m/s and 1000 N; allowed: a real number"),
    ],
    ids=lambda item: type(item).__name__,
)
@pytest.mark.parametrize("way", ["python", "accuracy"])
def test_a_law_is_refused_in_a_sentence_before_the_run(law: Any, said: str, way: str) -> None:
    laws = (law, None) if isinstance(law, NormalLaw) else (Spring(), law)
    assert refused(with_clearance(*laws, **WAYS[way]), PIN, said).time == 0.0
    if isinstance(law, FrictionLaw):
        pins = {"rear_base": IdealPin(friction=law, radius=0.06)}
        refused(support(pins=pins, drive=Held(), duration=0.02, **WAYS[way]), "rear_base", said)


def test_a_coefficient_of_friction_has_a_bound() -> None:
    with pytest.raises(InputError, match="sliding_coefficient = 50"):
        Ambrosio(sliding_coefficient=50.0)


@value
class Branching(Spring):
    """Written for numbers only."""

    def elastic_force(self, depth: float) -> float:
        return self.stiffness * depth if depth > 0.0 else 0.0

    def elastic_energy(self, depth: float) -> float:
        return 0.5 * self.stiffness * depth * depth if depth > 0.0 else 0.0


@pytest.mark.parametrize("way", sorted(WAYS.keys() - {"compiled"}))  # which refuse what cannot be compiled
def test_an_elastic_part_that_branches_is_one(way: str) -> None:
    assert not isinstance(simulate(with_clearance(Branching(), **WAYS[way]), throw=False), Failure)


@pytest.mark.parametrize("way", WAYS)
def test_the_law_that_they_are_made_from_passes(way: str) -> None:
    assert not isinstance(simulate(with_clearance(Spring(), **WAYS[way]), throw=False), Failure)


@pytest.mark.parametrize("way", ["python", "symbolic", "space"])  # `compiled` takes the laws' own states
def test_a_state_that_feeds_is_refused_by_what_is_lost(way: str) -> None:
    refused(
        with_clearance(Spring(), Feeding(), **WAYS[way]),
        "friction_loss becomes less by",
        f"pins.{PIN} = Feeding",
    )


@pytest.mark.parametrize("law", [Along(), Slippery()])
def test_friction_of_an_ideal_pin_is_refused(law: FrictionLaw) -> None:
    pins = {"rear_base": IdealPin(friction=law, radius=0.06)}
    rise = support(pins=pins, drive=CubicStep(start=0.0, end=0.05, stroke=0.01), duration=0.02)
    refused(rise, "rear_base", type(law).__name__)


@value
class Lost(Drive):
    """Smooth at first, then no number."""

    def extension(self, t: float) -> float:
        return t * t if t <= 0.012 else math.nan

    def speed(self, t: float) -> float:
        return 2.0 * t if t <= 0.012 else math.nan

    @property
    def breaks(self) -> tuple[float, ...]:
        return ()

    def span(self, duration: float) -> tuple[float, float]:
        return 0.0, duration**2


@pytest.mark.parametrize("way", WAYS)
def test_a_drive_is_refused(way: str) -> None:
    refused(with_clearance(Spring(), drive=Lost(), **WAYS[way]), "Lost has an extension of nan")


def test_a_drive_of_ideal_pins_is_refused() -> None:
    refused(support(drive=Lost(), duration=0.03), "Lost has an extension of nan")


@value
class LostCrank(Lost):
    def extension(self, t: float) -> float:
        return CRANK_SPEED * t if t <= 4e-4 else math.nan

    def speed(self, t: float) -> float:
        return CRANK_SPEED

    @property
    def initial_speed(self) -> float:
        return CRANK_SPEED


def test_a_crank_that_turns_by_itself_is_refused() -> None:
    refused(slider_crank(1e-3, drive=LostCrank()), "LostCrank has an extension of nan")


@value
class Pushing(AppliedForce):
    """A load that gives what it should lose."""

    def powers(self, at: LoadedPoint) -> Powers:
        return Powers(0.0, -1e4)


@value
class NoLoad(AppliedForce):
    def force(self, at: LoadedPoint) -> Vector2:
        return 0.0, -1e4 if at.time <= 5e-3 else math.nan


@pytest.mark.parametrize("kind", [Pushing, NoLoad])
@pytest.mark.parametrize("clearance", [False, True])
def test_a_load_is_refused(kind: type[AppliedForce], clearance: bool) -> None:
    press = kind(body="canopy", point=(0.5, 3.0), full_force=(0.0, -1e4))
    scene = with_clearance(Spring()) if clearance else support(drive=Held())
    refused(replace(scene, loads={"press": press}, duration=0.01), "press", kind.__name__)
