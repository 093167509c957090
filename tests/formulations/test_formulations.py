"""Formulations by name, and which scenes they cover."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import ModuleType
from typing import get_args, get_type_hints

import pytest

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
from support_exudyn.files import read_scenario, save_scenario
from support_exudyn.formulations.registry import FORMULATIONS, Formulation, formulation
from support_exudyn.scenario.solver_settings import ERROR_CONTROLLED
from tests.cases.run_cases import PIN, loose_slider_crank, loose_support, slider_crank, support
from tests.linkages import four_bar
from user_forces import InputError, LankaraniNikravesh, LuGre, value
from user_forces.values.value import Value

OIL = OilColumn(bore_area=bore_area(0.25, number=2), oil_length=0.5, bulk_modulus=1.5e9)
BOTH = {"front_column": OIL, "rear_column": OIL}


def with_a_state() -> Scenario:
    """A support whose friction has a state of its own."""
    scene = loose_support(drive=Held(), duration=0.02)
    pin = scene.clearance_pins[PIN]
    friction = LuGre(static_coefficient=0.1, sliding_coefficient=0.05)
    return replace(scene, pins={PIN: replace(pin, contact=replace(pin.contact, friction=friction))})


@value
class Branching(LankaraniNikravesh):
    """A law that branches on its arguments."""

    def __call__(self, depth: float, rate: float, impact_velocity: float) -> float:
        return super().__call__(depth, rate, impact_velocity) if rate > 0.0 else self.elastic_force(depth)


def with_a_branch() -> Scenario:
    """A support whose contact law is no formula."""
    scene = loose_support(drive=Held(), duration=0.02)
    pin = scene.clearance_pins[PIN]
    law = Branching(stiffness=1e10, restitution=0.5)
    return replace(scene, pins={PIN: replace(pin, contact=replace(pin.contact, normal=law))})


@value
class Walked(IdealPin):
    """A kind of pin that no formulation but the engine's knows."""


SCENES = {
    "clearance support": loose_support(drive=Held(), duration=0.02),
    "ideal support": support(drive=Held(), duration=0.02),
    "clearance support on oil": loose_support(drive=Held(), duration=0.02, actuators=BOTH),
    "ideal support on oil": support(drive=Held(), duration=0.02, actuators=BOTH),
    "settled support": loose_support(drive=Held(), duration=0.02, start="settled"),
    "friction with a state": with_a_state(),
    "clearance slider-crank": loose_slider_crank(1e-4),
    "ideal slider-crank": slider_crank(1e-4),
    "a law that branches": with_a_branch(),
}
COVERED = {"compiled": set(SCENES) - {"a law that branches"}, "exudyn": set(SCENES)}
# scenes with what the compiled formulation says of them
NOT_COMPILED = {
    "a law that branches": (
        SCENES["a law that branches"],
        r"pins\.rear_base\.contact = Branching, which cannot be written out",
    ),
    "a kind of pin of one's own": (
        support(drive=Held(), duration=0.02, pins={PIN: Walked()}),
        r"pins\.rear_base = Walked",
    ),
    "a start in a dead centre": (
        Scenario(machine=PlanarLinkage(drawing=four_bar(0.1, 0.4, 0.1, 0.4, 0.0)), duration=0.02),
        "machine = its start posture is a dead centre",
    ),
}


def test_every_formulation_offers_a_check_and_a_run() -> None:
    for one in FORMULATIONS.values():
        assert isinstance(one.program, ModuleType)
        assert callable(one.program.check)
        assert callable(one.program.run)
    names = set(FORMULATIONS)
    assert set(ERROR_CONTROLLED) < names
    assert {"auto", *names} == set(get_args(get_type_hints(Scenario)["formulation"]))
    assert formulation("auto") is formulation("exudyn")


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


@pytest.mark.parametrize("backend", ["symbolic", "python"])
def test_a_backend_of_the_engine_is_refused(backend: str) -> None:
    scene = replace(SCENES["clearance support"], formulation="compiled", solver=SolverSettings(backend=backend))
    with pytest.raises(InputError, match=rf"solver\.backend = '{backend}'.*allowed: 'auto', 'compiled'"):
        simulate(scene)


def test_space_is_refused() -> None:
    with pytest.raises(InputError, match=r"formulation = 'compiled': is planar.*'exudyn'"):
        support(dimensions=3, formulation="compiled")
    assert not formulation("compiled").covers(support(dimensions=3))


@pytest.mark.parametrize("accuracy", [None, "draft"])
def test_settings_that_no_formulation_takes_are_refused_with_the_reason(accuracy: str | None) -> None:
    scene = replace(SCENES["a law that branches"], solver=SolverSettings(backend="compiled"))
    assert not any(formulation(name).covers(scene) for name in COVERED)
    with pytest.raises(InputError, match=r"solver\.backend = 'compiled': .*allowed: .*'python'"):
        simulate(scene, accuracy=accuracy)


def test_an_unknown_formulation_is_refused() -> None:
    with pytest.raises(InputError, match=r"Scenario\.formulation = 'fastest': .*'auto'.*'compiled'"):
        support(formulation="fastest")


def test_what_cannot_be_imported_is_no_matter_of_coverage() -> None:
    broken = Formulation("compiled", "support_exudyn.there_is_none", cost=1, safety=1.0)
    with pytest.raises(ModuleNotFoundError, match="there_is_none"):
        broken.covers(SCENES["clearance support"])


def test_the_earlier_name_of_the_exudyn_formulation_is_read(tmp_path: Path) -> None:
    scene = replace(SCENES["ideal support"], formulation="exudyn")
    assert replace(scene, formulation="redundant") == scene
    assert Value.from_data({**scene.to_data(), "formulation": "redundant"}) == scene
    assert formulation("redundant") is formulation("exudyn")
    save_scenario(scene, tmp_path / "scene.toml")
    text = (tmp_path / "scene.toml").read_text().replace('"exudyn"', '"redundant"')
    (tmp_path / "earlier.toml").write_text(text)
    assert '"redundant"' in text
    assert read_scenario(tmp_path / "earlier.toml") == scene
