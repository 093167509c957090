"""Machine files of all kinds: those that come with the package, and what is said of others."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from support_exudyn import HydraulicSupport, SliderCrank, reference_support
from support_exudyn.files.machines import load_machine, read_machine
from support_exudyn.machines.two_leg_shield import TwoLegShield
from support_exudyn.model.linkage import lumped
from tests.machine_files import written

# --- those that come with the package ---


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("reference", HydraulicSupport),
        ("zf18000", HydraulicSupport),
        ("two_leg_shield", TwoLegShield),
        ("slider_crank", SliderCrank),
    ],
)
def test_shipped_machines_are_of_their_kind_and_say_where_they_come_from(name: str, kind: type) -> None:
    data = read_machine(name)
    assert isinstance(data.machine, kind)
    assert data.sources
    assert data.bore_radii
    assert data.name


def test_the_full_size_support_has_the_published_pivots() -> None:
    published = {  # height and distance to the face [m]
        "front_base": (0.953, -0.947),
        "rear_base": (0.461, -1.862),
        "rear_shield": (1.787, -2.745),
        "front_shield": (2.212, -2.381),
        "front_head": (3.477, 1.035),
        "front_foot": (0.310, 0.708),
        "rear_head": (3.464, -0.479),
        "hinge": (3.488, -1.218),
        "rear_foot": (0.264, -0.446),  # read off the drawing
    }
    large = load_machine("zf18000").machine
    for name, (height, ahead) in published.items():
        assert tuple(1e3 * x for x in getattr(large, name)) == pytest.approx(
            (1e3 * ahead + 1862, 1e3 * height), abs=1e-9
        )
    for one, other, length in (  # which the publication states, to 1 cm; the last as an end of a cylinder
        ("front_base", "front_shield", 1.91),
        ("rear_base", "rear_shield", 1.59),
        ("rear_shield", "front_shield", 0.56),
        ("front_shield", "hinge", 1.73),
        ("hinge", "front_head", 2.25),
        ("hinge", "rear_head", 0.74),
    ):
        assert math.dist(getattr(large, one), getattr(large, other)) == pytest.approx(length, abs=0.00501)
    columns = read_machine("zf18000").actuators
    assert 2.0 * columns["front_column"].cylinder_centre == pytest.approx(1.49, abs=0.00501)
    ends = {"front_column": ((0.310, 0.708), (1.787, 0.859)), "rear_column": ((0.264, -0.446), (1.701, -0.465))}
    for name, (foot, end) in ends.items():
        assert 2.0 * columns[name].cylinder_centre == pytest.approx(math.dist(foot, end), abs=5.01e-4)


def test_the_reference_is_the_full_size_support_times_0_65() -> None:
    large, small = load_machine("zf18000").machine, reference_support()
    for name in HydraulicSupport.pivots():
        off = 3.0e-3 if name == "rear_foot" else 5.001e-4  # read off a drawing; rounded to 1 mm
        assert getattr(small, name) == pytest.approx(tuple(0.65 * x for x in getattr(large, name)), abs=off)
    for body, parts in small.parts.items():
        for one, other in zip(large.parts[body], parts, strict=True):
            assert one.mass == pytest.approx(other.mass / 0.65**3, abs=5.001)  # rounded to 10 kg


# --- a pivot table and some masses make a machine ---


def test_masses_alone_are_bars_between_pivots(tmp_path: Path) -> None:
    data = load_machine(written(tmp_path))
    machine = data.machine
    assert isinstance(machine, HydraulicSupport)
    (link,) = machine.parts["rear_link"]
    assert (link.mass, link.centre) == (900.0, pytest.approx((-0.345, 0.855)))
    # m l^2 / 12, rounding
    assert link.inertia == pytest.approx(900.0 * (0.69**2 + 0.95**2) / 12.0, rel=1e-14)
    canopy = machine.parts["canopy"]
    assert [part.name for part in canopy] == ["", "front_column_rods", "rear_column_rods"]
    assert canopy[1].centre == machine.front_head
    assert lumped(canopy).mass == 5900.0
    assert any("canopy" in said and "hinge to tip" in said for said in data.assumed)
    assert data.stroke == 0.6
