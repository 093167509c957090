"""The page says on what its verdicts rest: yield stresses, pins judged, masses, sources, and what is weak."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from studies.common.support_legs import PAIRS, legs_data, support_legs
from support_exudyn.files.machines import shipped
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.machines.strength import StandReport, stand
from support_exudyn.machines.strength.page import page
from support_exudyn.machines.strength.parts import cylinder_masses, tipping_of
from support_exudyn.machines.strength.strength_data import StrengthData
from tests.machines.strength.test_stand import report


def said_of(found: StandReport) -> str:
    """The page without its folds."""
    return "\n".join(page(found)).replace("\n    ", " ").replace("\n  ", " ")


def told(data: MachineData) -> str:
    return said_of(stand(data))


def with_strength(name: str, change: Callable[[StrengthData], StrengthData]) -> MachineData:
    data = shipped(name)
    assert data.strength is not None
    return replace(data, strength=change(data.strength))


# --- one name has one set of legs ---


@pytest.mark.parametrize("name", ["reference", "zf18000"])
def test_legs_are_those_of_the_studies(name: str) -> None:
    data = shipped(name)
    assert data.strength is not None
    about = legs_data().about(name)
    for column in PAIRS:
        own, studied = data.strength.cylinders[column], support_legs(name)[column]
        assert own.area == pytest.approx(studied.bore_area, rel=1e-7)
        assert studied.yield_valve is not None
        assert own.yield_pressure == pytest.approx(studied.yield_valve.opening_pressure, rel=1e-12)
        assert own.setting_pressure == pytest.approx(studied.setting_pressure, rel=1e-12)
        assert own.stages[0].inner_diameter == own.bore
        for key, other, source in (
            ("yield_pressure_MPa", "cylinder.yield_valve.opening_pressure_MPa", "printed rated force"),
            ("setting_pressure_MPa", "cylinder.setting_pressure_MPa", "printed setting force"),
        ):
            one = data.sourced[f"strength.cylinders.{column}.{key}"]
            assert (one.value, one.low, one.high) == (about[other].value, about[other].low, about[other].high)
            assert one.source.startswith(source)
            assert about[other].source.startswith(source)
        bore, area = (
            data.sourced[f"strength.cylinders.{column}.bore_mm"],
            about["cylinder.bore_area_mm2"],
        )
        for diameter, both in ((bore.low, area.low), (bore.high, area.high)):
            assert diameter is not None
            assert both is not None
            assert 0.5 * math.pi * float(diameter) ** 2 == pytest.approx(float(both), rel=1e-6)
        # around the rod of the studies
        ring = 0.5 * math.pi * (own.bore**2 - own.stages[1].outer_diameter ** 2)
        assert ring == pytest.approx(studied.rod_side_area, rel=1e-6)
    (printed,) = (one for one in legs_data().file.published if one.model in data.sources["strength"])
    assert data.strength.rated_force == printed.rated
    assert sum(one.push for one in data.strength.cylinders.values()) == pytest.approx(printed.rated, rel=1e-3)


# --- how far a verdict goes ---


def test_a_weak_support_is_told_though_the_rule_is_met() -> None:
    text = told(with_strength("reference", lambda strength: replace(strength, rated_force=23e6)))
    assert "0.315 of 23000 kN: met" in text
    assert "the support reaches only 0.31 of its rated force" in text
    strong = with_strength("reference", lambda strength: replace(strength, rated_force=8.9e6))
    assert "reaches only" not in told(strong)
    assert "reaches only" not in said_of(report("reference"))


# --- masses of cylinders ---


@pytest.mark.parametrize(
    ("name", "more"), [("zf18000", 2180.0), ("reference", 600.0), ("two_leg_shield", 1120.0)]
)
def test_cylinders_weigh_where_the_file_says_it(name: str, more: float) -> None:
    data = shipped(name)
    assert data.strength is not None
    assert data.strength.base is not None
    linkage = data.machine.linkage()
    bare = tipping_of(linkage, data.strength.base)
    found = report(name)
    assert found.tipping is not None
    assert found.tipping[0].mass == pytest.approx(bare.mass + more)
    assert "left out of section 6" not in said_of(found)


def test_a_cylinder_hangs_between_foot_and_head_and_brings_rods_that_nothing_else_has() -> None:
    data = shipped("reference")
    linkage = data.machine.linkage()
    column = data.actuators["front_column"]
    place = linkage.actuators["front_column"]
    ((mass, centre), _) = cylinder_masses(data, linkage)
    assert mass == column.cylinder_mass == 300.0
    assert math.dist(place.foot_point, centre) == pytest.approx(column.cylinder_centre)
    assert math.dist(place.foot_point, centre) + math.dist(centre, place.head_point) == pytest.approx(
        place.start_length
    )
    machine: Any = data.machine
    rodless = {
        body: tuple(part for part in parts if not part.name.endswith("_rods"))
        for body, parts in machine.parts.items()
    }
    found = cylinder_masses(replace(data, machine=replace(machine, parts=rodless)), linkage)
    assert [mass for mass, _ in found] == [300.0, 200.0, 300.0, 200.0]
    assert math.dist(found[1][1], place.head_point) == pytest.approx(column.rod_centre)
