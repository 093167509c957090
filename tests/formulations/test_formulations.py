"""Formulations by name, and which scenes they cover."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from user_forces.expressions.scalar import power

from support_exudyn import (
    Held,
    IdealPin,
    OilColumn,
    PlanarLinkage,
    Scenario,
    SolverSettings,
    bore_area,
    simulate,
)
from support_exudyn.formulations.registry import formulation
from tests.cases.run_cases import PIN, loose_slider_crank, loose_support, slider_crank, support
from tests.linkages import four_bar
from user_forces import FrictionLaw, InputError, LankaraniNikravesh, LuGre, NormalLaw, value

OIL = OilColumn(bore_area=bore_area(0.25, number=2), oil_length=0.5, bulk_modulus=1.5e9)
BOTH = {"front_column": OIL, "rear_column": OIL}


@value
class Branching(LankaraniNikravesh):
    """A law that branches on its arguments."""

    def __call__(self, depth: float, rate: float, impact_velocity: float) -> float:
        return super().__call__(depth, rate, impact_velocity) if rate > 0.0 else self.elastic_force(depth)


@value
class ByMath(LankaraniNikravesh):
    """A law whose elastic part takes floats alone."""

    def __call__(self, depth: float, rate: float, impact_velocity: float) -> float:
        return self.stiffness * power(depth, 1.5)

    def elastic_force(self, depth: float) -> float:
        return self.stiffness * math.pow(depth, 1.5)


@value
class BranchingFriction(FrictionLaw):
    """A friction law that branches on its arguments."""

    def __call__(self, slip: float, normal_force: float, deflection: float = 0.0) -> float:
        return -0.1 * normal_force * slip if abs(slip) < 1.0 else 0.0


def with_laws(**laws: NormalLaw | FrictionLaw) -> Scenario:
    """A support on laws of its own."""
    scene = loose_support(drive=Held(), duration=0.02)
    pin = scene.clearance_pins[PIN]
    return replace(scene, pins={PIN: replace(pin, contact=replace(pin.contact, **laws))})


@value
class Walked(IdealPin):
    """A kind of pin that no formulation but the engine's knows."""


SCENES = {
    "clearance support": loose_support(drive=Held(), duration=0.02),
    "ideal support": support(drive=Held(), duration=0.02),
    "clearance support on oil": loose_support(drive=Held(), duration=0.02, actuators=BOTH),
    "ideal support on oil": support(drive=Held(), duration=0.02, actuators=BOTH),
    "settled support": loose_support(drive=Held(), duration=0.02, start="settled"),
    "friction with a state": with_laws(friction=LuGre(static_coefficient=0.1, sliding_coefficient=0.05)),
    "clearance slider-crank": loose_slider_crank(1e-4),
    "ideal slider-crank": slider_crank(1e-4),
    "a law that branches": with_laws(normal=Branching(stiffness=1e10, restitution=0.5)),
}
COVERED = {"compiled": set(SCENES) - {"a law that branches"}, "exudyn": set(SCENES)}


# scenes with what the compiled formulation says of them
NOT_COMPILED = {
    "a law that branches": (
        SCENES["a law that branches"],
        r"pins\.rear_base\.contact = Branching, which cannot be written out",
    ),
    "an elastic part that needs floats": (
        with_laws(normal=ByMath(stiffness=1e10, restitution=0.5)),
        r"pins\.rear_base\.contact = ByMath, which cannot be written out",
    ),
    "a friction law that branches": (
        with_laws(friction=BranchingFriction()),
        r"pins\.rear_base\.contact = BranchingFriction, which cannot be written out",
    ),
    "a kind of pin of one's own": (
        support(drive=Held(), duration=0.02, pins={PIN: Walked()}),
        r"pins\.rear_base = Walked",
    ),
    "a start in a dead centre": (
        Scenario(machine=PlanarLinkage(drawing=four_bar(0.1, 0.4, 0.1, 0.4, 0.0)), duration=0.02),
        "machine = its start posture is a dead centre",
    ),
    "a backend of the engine": (
        replace(SCENES["clearance support"], solver=SolverSettings(backend="python")),
        r"solver\.backend = 'python'",
    ),
}


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("name", COVERED)
def test_a_formulation_covers_what_it_says(name: str, scene: str) -> None:
    assert formulation(name).covers(SCENES[scene]) == (scene in COVERED[name])
    # whatever the scenario asks for
    assert formulation(name).covers(replace(SCENES[scene], formulation="exudyn")) == (scene in COVERED[name])


@pytest.mark.parametrize("scene", NOT_COMPILED)
@pytest.mark.parametrize("accuracy", [None, "draft"])
def test_what_is_not_covered_is_refused_before_anything_runs(scene: str, accuracy: str | None) -> None:
    heard: list[float] = []
    given, said = NOT_COMPILED[scene]
    asked = replace(given, formulation="compiled")
    # what, why, and what to do
    with pytest.raises(InputError, match=rf"{said}.*: .*allowed: .*exudyn.* covers it"):
        simulate(asked, accuracy=accuracy, progress=heard.append, throw=False)
    assert heard == []


def test_space_is_refused() -> None:
    with pytest.raises(InputError, match=r"formulation = 'compiled': is planar.*'exudyn'"):
        support(dimensions=3, formulation="compiled")
    assert not formulation("compiled").covers(support(dimensions=3))


@pytest.mark.parametrize("law", [Branching, ByMath])
def test_a_law_that_cannot_be_compiled_is_left_to_the_engine(law: type[LankaraniNikravesh]) -> None:
    result = simulate(with_laws(normal=law(stiffness=1e10, restitution=0.5)), accuracy="draft")
    assert result.scenario.formulation == "exudyn"
    assert result.counts.user_function_calls > 0


@pytest.mark.parametrize("accuracy", [None, "draft"])
def test_settings_that_no_formulation_takes_are_refused_with_the_reason(accuracy: str | None) -> None:
    scene = replace(SCENES["a law that branches"], solver=SolverSettings(backend="compiled"))
    assert not any(formulation(name).covers(scene) for name in COVERED)
    with pytest.raises(InputError, match=r"solver\.backend = 'compiled': .*allowed: .*'python'"):
        simulate(scene, accuracy=accuracy)


def test_an_unknown_formulation_is_refused() -> None:
    with pytest.raises(InputError, match=r"Scenario\.formulation = 'fastest': .*'auto'.*'compiled'"):
        support(formulation="fastest")
