"""Formulations by name, and which scenes they cover."""

from __future__ import annotations

from dataclasses import replace
from types import ModuleType
from typing import get_args, get_type_hints

import pytest

from support_exudyn import Held, OilColumn, Scenario, SolverSettings, bore_area, simulate
from support_exudyn.formulations.registry import FORMULATIONS, Formulation, formulation
from support_exudyn.scenario.solver_settings import ERROR_CONTROLLED
from tests.cases.run_cases import PIN, loose_slider_crank, loose_support, slider_crank, support
from user_forces import InputError, LuGre

OIL = OilColumn(bore_area=bore_area(0.25, number=2), oil_length=0.5, bulk_modulus=1.5e9)
BOTH = {"front_column": OIL, "rear_column": OIL}


def with_a_state() -> Scenario:
    """A support whose friction has a state of its own."""
    scene = loose_support(drive=Held(), duration=0.02)
    pin = scene.clearance_pins[PIN]
    friction = LuGre(static_coefficient=0.1, sliding_coefficient=0.05)
    return replace(scene, pins={PIN: replace(pin, contact=replace(pin.contact, friction=friction))})


SCENES = {
    "clearance support": loose_support(drive=Held(), duration=0.02),
    "ideal support": support(drive=Held(), duration=0.02),
    "clearance support on oil": loose_support(drive=Held(), duration=0.02, actuators=BOTH),
    "ideal support on oil": support(drive=Held(), duration=0.02, actuators=BOTH),
    "settled support": loose_support(drive=Held(), duration=0.02, start="settled"),
    "friction with a state": with_a_state(),
    "clearance slider-crank": loose_slider_crank(1e-4),
    "ideal slider-crank": slider_crank(1e-4),
}
COVERED = {
    "compiled": {"clearance support", "ideal support", "clearance slider-crank"},
    "compiled": {"clearance support on oil"},
    "redundant": set(SCENES),
}


def test_every_formulation_offers_a_check_and_a_run() -> None:
    for one in FORMULATIONS.values():
        assert isinstance(one.program, ModuleType)
        assert callable(one.program.check)
        assert callable(one.program.run)
    names = set(FORMULATIONS)
    assert set(ERROR_CONTROLLED) < names
    assert {"auto", *names} == set(get_args(get_type_hints(Scenario)["formulation"]))
    assert formulation("auto") is formulation("redundant")


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("name", COVERED)
def test_a_formulation_covers_what_it_says(name: str, scene: str) -> None:
    assert formulation(name).covers(SCENES[scene]) == (scene in COVERED[name])
    # whatever the scenario asks for
    assert formulation(name).covers(replace(SCENES[scene], formulation="redundant")) == (scene in COVERED[name])


@pytest.mark.parametrize(
    ("name", "scene"), [(n, s) for n in ("compiled", "compiled") for s in SCENES if s not in COVERED[n]]
)
@pytest.mark.parametrize("accuracy", [None, "draft"])
def test_what_is_not_covered_is_refused_before_anything_runs(
    name: str, scene: str, accuracy: str | None
) -> None:
    heard: list[float] = []
    # what, why, and what to do
    with pytest.raises(InputError, match=r" = .*: .*allowed: .*redundant.* covers it"):
        simulate(
            replace(SCENES[scene], formulation=name), accuracy=accuracy, progress=heard.append, throw=False
        )
    assert heard == []


@pytest.mark.parametrize("accuracy", [None, "draft"])
def test_settings_that_no_formulation_takes_are_refused_with_the_reason(accuracy: str | None) -> None:
    scene = replace(SCENES["settled support"], solver=SolverSettings(backend="compiled"))
    assert not any(formulation(name).covers(scene) for name in COVERED)
    with pytest.raises(InputError, match=r"solver\.backend = 'compiled': .*reduced.*allowed: .*'python'"):
        simulate(scene, accuracy=accuracy)


def test_an_unknown_formulation_is_refused() -> None:
    with pytest.raises(InputError, match=r"Scenario\.formulation = 'fastest': .*'auto'.*'compiled'"):
        support(formulation="fastest")


def test_what_cannot_be_imported_is_no_matter_of_coverage() -> None:
    broken = Formulation("compiled", "support_exudyn.there_is_none", cost=1, safety=1.0)
    with pytest.raises(ModuleNotFoundError, match="there_is_none"):
        broken.covers(SCENES["clearance support"])
