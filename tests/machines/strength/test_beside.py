"""A roof force beside the middle is told where all widths that it needs are known, and only there."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from support_exudyn.files.machines import shipped
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.machines.strength import stand
from support_exudyn.machines.strength.off_middle import untold
from support_exudyn.model.to_space import Width

COLUMNS = ("front_column", "rear_column")


def with_width(**changes: Any) -> MachineData:
    """The reference support with other lateral dimensions."""
    data = shipped("reference")
    machine: Any = data.machine
    return replace(data, machine=replace(machine, width=replace(machine.width, **changes)))


def without(kind: str, *names: str) -> MachineData:
    width = shipped("reference").machine.widths()
    assert width is not None
    left = {name: size for name, size in getattr(width, kind).items() if name not in names}
    return with_width(**{kind: left})


def with_counts(data: MachineData, **counts: int) -> MachineData:
    assert data.strength is not None
    cylinders = {
        name: replace(one, count=counts.get(name, one.count)) for name, one in data.strength.cylinders.items()
    }
    return replace(data, strength=replace(data.strength, cylinders=cylinders))


def why(data: MachineData) -> str:
    assert data.strength is not None
    return untold(data, data.strength)


@pytest.mark.parametrize(
    ("kind", "names", "said"),
    [
        ("actuators", COLUMNS, "width_mm.columns.front_column, width_mm.columns.rear_column are missing"),
        ("actuators", ("rear_column",), "width_mm.columns.rear_column is missing"),
        ("pairs", ("front_link",), "width_mm.pairs.front_link is missing"),
    ],
)
def test_a_missing_width_is_named_and_nothing_is_told(kind: str, names: tuple[str, ...], said: str) -> None:
    assert why(shipped("reference")) == ""
    assert why(without(kind, *names)) == said


def test_all_that_is_missing_is_named_and_the_other_sections_stay() -> None:
    """The canopy's width alone once made the whole page an error, and all bodies' made numbers up."""
    width = shipped("reference").machine.widths()
    assert width is not None
    data = with_width(spreads={"canopy": width.spreads["canopy"]}, pairs={}, actuators={})
    found = stand(data)
    assert isinstance(found.off_middle, str)
    for key in ("bodies.rear_link", "bodies.front_link", "bodies.shield", "pairs.front_link"):
        assert f"width_mm.{key}" in found.off_middle
    for name in COLUMNS:
        assert f"width_mm.columns.{name}" in found.off_middle


def test_one_cylinder_stands_in_the_middle() -> None:
    """Three legs carry no force outside their triangle, but what the weight holds down."""
    found = stand(with_counts(without("actuators", "rear_column"), rear_column=1))
    two = stand(shipped("reference"))
    assert not isinstance(found.off_middle, str)
    assert not isinstance(two.off_middle, str)
    for one, other in zip(found.off_middle, two.off_middle, strict=True):
        assert 0.0 <= one.legs_alone < 0.3 * other.legs_alone


def test_a_machine_without_any_is_told_so() -> None:
    data = shipped("reference")
    machine: Any = data.machine
    for width in (None, Width(lengths={"rear_base": 0.7})):
        bare = replace(data, machine=replace(machine, width=width))
        assert why(bare) == "no lateral dimensions of its bodies are known"
