"""What a support must stand, as a whole: shipped supports, refusals, and on what the verdicts rest."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from importlib import resources
from typing import Any

import pytest

from studies.common.support_legs import PAIRS, legs_data, support_legs
from support_exudyn.files.machines import load_machine, shipped
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.machines.planar_linkage import PlanarLinkage
from support_exudyn.machines.strength import StandReport, stand
from support_exudyn.machines.strength.page import page
from support_exudyn.machines.strength.parts import cylinder_masses, tipping_of
from support_exudyn.machines.strength.strength_data import CylinderStrength, StrengthData
from support_exudyn.model.loads.springs import SpringDamper
from tests.machines.strength.test_roof_forces import beam
from tests.pages import ROOT, listings
from user_forces import InputError

REPORTS: dict[str, StandReport] = {}


def report(name: str) -> StandReport:
    if name not in REPORTS:
        REPORTS[name] = stand(shipped(name))
    return REPORTS[name]


def with_strength(name: str, change: Callable[[StrengthData], StrengthData]) -> MachineData:
    data = shipped(name)
    assert data.strength is not None
    return replace(data, strength=change(data.strength))


# --- shipped supports ---


def test_four_columns_hold_together_what_each_row_pushes() -> None:
    """The links carry little of a vertical force, as long as the roof does not rub."""
    found = report("zf18000")
    for one in found.forces:
        assert one.yielding is not None
        assert one.setting is not None
        assert one.yielding.force == pytest.approx(18e6, rel=0.02)
        assert one.setting.force < one.yielding.force
        # the peak over the canopy is where all columns yield
        assert one.largest.force == pytest.approx(one.yielding.force, rel=1e-9)
        assert one.largest.x == pytest.approx(one.yielding.x, rel=1e-9)
        assert max(roof.force for roof in one.over) <= one.largest.force
        assert (one.pull, one.push) == (None, None)


def test_the_ram_of_a_two_leg_shield_shifts_its_force() -> None:
    for one in report("two_leg_shield").forces:
        assert one.yielding is not None
        assert one.pull is not None
        assert one.push is not None
        assert one.pull.x < one.yielding.x < one.push.x
        assert one.largest.force >= one.yielding.force


def test_pins_are_judged_at_one_and_at_one_point_two_times_yield() -> None:
    for pin in report("two_leg_shield").pins.values():
        for loads in (pin.nominal, pin.worst, pin.rubbed):
            # weight is not multiplied
            assert 1.15 * loads[1.0] < loads[1.2] < 1.25 * loads[1.0]
        assert pin.nominal[1.2] <= pin.worst[1.2] <= pin.rubbed[1.2]
        assert pin.stresses is not None
        assert pin.stresses[0].force == pin.worst[1.2]
        assert pin.stresses[1].force == pin.rubbed[1.2]


# --- refusals and files ---


REFERENCE = shipped("reference")
OWN = with_strength("reference", lambda strength: strength).strength or pytest.fail("has a strength")
SHORT = {
    name: replace(one, stages=(replace(one.stages[0], length=0.5), *one.stages[1:2]))
    for name, one in OWN.cylinders.items()
}
WEAK = {name: replace(one, yield_pressure=1e3, setting_pressure=None) for name, one in OWN.cylinders.items()}
LEG = StrengthData(cylinders={"leg": CylinderStrength(bore=0.2, yield_pressure=30e6)})
SPRING = SpringDamper(body="canopy", point=(1.0, 0.0), other_point=(1.0, 1.0), stiffness=1.0)
REFUSED: dict[str, Any] = {
    r"no actuators that could carry a roof": shipped("watt_six_bar"),
    r"strength: missing; .* for each of leg": shipped("velenje_shield"),
    r"strength\.cylinders\.leg: there is none": {"cylinders": {**OWN.cylinders, **LEG.cylinders}},
    r"strength\.cylinders\.rear_column: missing": {
        "cylinders": {"front_column": OWN.cylinders["front_column"]}
    },
    r"strength\.pins\.hinge: there is none": {"pins": {"hinge": next(iter(OWN.pins.values()))}},
    r"strength\.canopy = 'roof': no such body": {"canopy": "roof"},
    r"strength\.cylinders\.front_column\.stages: together 1\.3 m long": {"cylinders": SHORT},
    r"hold the weight alone in no way with the roof 1\.95 m high": {"cylinders": WEAK},
    "1 actuators and 0 cranks hold it; allowed: two actuators": MachineData(
        PlanarLinkage(drawing=beam(4.0, 2.0, 10.0)), strength=LEG
    ),
    "spring act on it besides weight and roof": MachineData(
        PlanarLinkage(drawing=REFERENCE.machine.linkage(), acting={"spring": SPRING}), strength=OWN
    ),
}


@pytest.mark.parametrize("said", REFUSED)
def test_what_cannot_be_told_is_refused(said: str) -> None:
    wrong = REFUSED[said]
    if not isinstance(wrong, MachineData):
        wrong = replace(REFERENCE, strength=replace(OWN, **wrong))
    with pytest.raises(InputError, match=said):
        stand(wrong)


def test_a_file_without_the_section_is_as_before(tmp_path: Any) -> None:
    from tests.machine_files import OURS, written

    assert load_machine(written(tmp_path)).strength is None
    section = """
[strength.cylinders.front_column]
bore_mm = 200
yield_pressure_MPa = { value = 40, from = 36, to = 44 }

[strength.cylinders.rear_column]
bore_mm = 200
yield_pressure_MPa = 40
"""
    data = load_machine(written(tmp_path, text=OURS + section))
    assert data.strength is not None
    assert data.strength.cylinders["front_column"].yield_pressure == 40e6
    assert data.sourced["strength.cylinders.front_column.yield_pressure_MPa"].low == 36
    with pytest.raises(InputError, match=r"strength\.cylinders\.front_column\.bore_mm"):
        load_machine(written(tmp_path, "bore_mm = 200", "bore_mm = -200", text=OURS + section))


def test_the_section_of_the_page_is_read(tmp_path: Any) -> None:
    page_of_it = ROOT / "support_exudyn" / "machines" / "strength" / "standing.md"
    (shown,) = (one for one in listings(page_of_it) if one.kind == "toml")
    text = (resources.files("support_exudyn.files.machines") / "two_leg_shield.toml").read_text("utf-8")
    path = tmp_path / "ours.toml"
    path.write_text(text.partition("[strength]")[0] + shown.text, encoding="utf-8")
    found = load_machine(path).strength
    assert found is not None
    own = shipped("two_leg_shield").strength
    assert own is not None
    assert found.cylinders["leg"] == own.cylinders["leg"]
    assert found.base == own.base


# --- on what the verdicts rest ---


def said_of(found: StandReport) -> str:
    """The page without its folds."""
    return "\n".join(page(found)).replace("\n    ", " ").replace("\n  ", " ")


def page_of(data: MachineData) -> str:
    return said_of(stand(data))


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
    text = page_of(with_strength("reference", lambda strength: replace(strength, rated_force=23e6)))
    assert "0.315 of 23000 kN: met" in text
    assert "the support reaches only 0.31 of its rated force" in text
    strong = with_strength("reference", lambda strength: replace(strength, rated_force=8.9e6))
    assert "reaches only" not in page_of(strong)
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
