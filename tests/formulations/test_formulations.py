"""Formulations by name, and which scenes they cover."""

from __future__ import annotations

from dataclasses import replace

import pytest
from scipy import special

from support_exudyn import (
    Held,
    OilColumn,
    PlanarLinkage,
    Scenario,
    bore_area,
    simulate,
)
from support_exudyn.formulations.registry import formulation
from tests.cases.run_cases import PIN, loose_slider_crank, loose_support, slider_crank, support
from tests.linkages import four_bar
from user_forces import FrictionLaw, InputError, LuGre, NormalLaw, value
from user_forces.kernel import kernel

OIL = OilColumn(bore_area=bore_area(0.25, number=2), oil_length=0.5, bulk_modulus=1.5e9)
BOTH = {"front_column": OIL, "rear_column": OIL}


@value
class Branching(NormalLaw):
    """A law that branches on its arguments."""

    stiffness: float

    @staticmethod
    @kernel
    def force(depth: float, rate: float, impact_velocity: float, stiffness: float) -> float:
        return (1.2 if rate > 0.0 else 1.0) * stiffness * depth**1.5


@value
class ByScipy(NormalLaw):
    """A law that calls scipy, which numba does not know."""

    stiffness: float

    @staticmethod
    @kernel
    def force(depth: float, rate: float, impact_velocity: float, stiffness: float) -> float:
        return stiffness * float(special.cbrt(depth)) ** 4.5


@value
class RubbedByScipy(FrictionLaw):
    """A friction law that calls scipy."""

    coefficient: float = 0.1

    @staticmethod
    @kernel
    def force(slip: float, normal_force: float, coefficient: float) -> float:
        return coefficient * normal_force * (1.0 - 2.0 * float(special.expit(1e3 * slip)))


def with_laws(**laws: NormalLaw | FrictionLaw) -> Scenario:
    """A support on laws of its own."""
    scene = loose_support(drive=Held(), duration=0.02)
    pin = scene.clearance_pins[PIN]
    return replace(scene, pins={PIN: replace(pin, contact=replace(pin.contact, **laws))})


SCENES = {
    "clearance support": loose_support(drive=Held(), duration=0.02),
    "ideal support": support(drive=Held(), duration=0.02),
    "clearance support on oil": loose_support(drive=Held(), duration=0.02, actuators=BOTH),
    "ideal support on oil": support(drive=Held(), duration=0.02, actuators=BOTH),
    "settled support": loose_support(drive=Held(), duration=0.02, start="settled"),
    "friction with a state": with_laws(friction=LuGre(static_coefficient=0.1, sliding_coefficient=0.05)),
    "clearance slider-crank": loose_slider_crank(1e-4),
    "ideal slider-crank": slider_crank(1e-4),
    "a law that branches": with_laws(normal=Branching(stiffness=1e10)),
    "a law that numba cannot compile": with_laws(normal=ByScipy(stiffness=1e10)),
}
COVERED = {"compiled": set(SCENES) - {"a law that numba cannot compile"}, "exudyn": set(SCENES)}


# scenes with what the compiled formulation says of them
NOT_COMPILED = {
    "a law": (
        SCENES["a law that numba cannot compile"],
        r"pins\.rear_base\.contact = a law \(numba cannot compile it",
    ),
    "a friction law": (
        with_laws(friction=RubbedByScipy()),
        r"pins\.rear_base\.contact = a law \(numba cannot compile it",
    ),
    "a start in a dead centre": (
        Scenario(machine=PlanarLinkage(drawing=four_bar(0.1, 0.4, 0.1, 0.4, 0.0)), duration=0.02),
        "machine = its start posture is a dead centre",
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
