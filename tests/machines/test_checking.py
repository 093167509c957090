"""What `check` says of a machine: against the paper's support, and statics against equilibrium written here."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from support_exudyn.files.machines import load_machine
from support_exudyn.files.machines.read import read_machine
from support_exudyn.machines.check import CheckReport as Report
from support_exudyn.machines.check import check_machine
from support_exudyn.machines.check.drive_way import Moved
from support_exudyn.machines.four_bar_shield import FourBarShield
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.model.linkage import lumped
from support_exudyn.model.plane_geometry import moved
from tests.machine_files import OURS, written
from user_forces import InputError

G = 9.81
SHIELDS = ("reference", "zf18000", "two_leg_shield")


@pytest.fixture(scope="module")
def reference() -> Report:
    return check_machine(read_machine("reference"))


# --- the reference support: numbers from elsewhere, to the digits that are given ---


@pytest.mark.parametrize(
    ("at", "tip", "front", "rear", "force"),
    [
        (0, 3195.9, 83.19, 91.64, 58.8),
        (2, 3199.4, 83.47, 91.42, 55.7),
        (5, 3207.4, 83.76, 91.07, 51.2),
        (8, 3216.1, 83.98, 90.74, 46.8),
        (10, 3220.0, 84.16, 90.60, 44.0),
    ],
)
def test_the_reference_support(
    reference: Report, at: int, tip: float, front: float, rear: float, force: float
) -> None:
    station = reference.data()["stations"][at]
    assert station["travel"] == pytest.approx(0.05 * at, abs=1e-12)
    assert 1e3 * station["points_m"]["tip"][0] == pytest.approx(tip, abs=0.051)
    columns = {name: math.degrees(angle) for name, angle in station["actuators_rad"].items()}
    assert columns["front_column"] == pytest.approx(front, abs=0.0051)
    assert columns["rear_column"] == pytest.approx(rear, abs=0.0051)
    # "about": the force is told to 0.1 kN
    assert 1e-3 * math.hypot(*station["pins_N"]["rear_base"]) == pytest.approx(force, abs=0.1)
    assert abs(math.degrees(station["angles_rad"]["canopy"])) < 0.022


def test_the_reference_support_passes(reference: Report) -> None:
    assert reference.warnings == []
    assert reference.numbers["degrees_of_freedom"] == {"counted": 2, "free": 2, "driven": 2, "left": 0}
    assert reference.numbers["tip_wander_m"] == pytest.approx(0.0241, abs=1e-4)
    assert "24.1 mm; MT/T 556-1996, 4.6.4 allows 80.0 mm: met" in "\n".join(reference.lines())


@pytest.mark.parametrize("name", [*SHIELDS, "slider_crank"])
def test_shipped_machines_give_nothing_to_worry_about(name: str) -> None:
    assert check_machine(read_machine(name)).warnings == []


# --- statics, independently ---


def centres(machine: FourBarShield, posture: Any) -> dict[str, np.ndarray]:
    """Centres of mass of all bodies in a posture [m]."""
    anchors = {
        "rear_link": (machine.rear_base, machine.rear_base, posture.rear_link),
        "front_link": (machine.front_base, machine.front_base, posture.front_link),
        "shield": (machine.rear_shield, posture.rear_shield, posture.shield),
        "canopy": (machine.hinge, posture.hinge, posture.canopy),
    }
    return {name: np.array(moved(lumped(machine.parts[name]).centre, *to)) for name, to in anchors.items()}


def postures(data: MachineData) -> Iterator[tuple[Moved, Any]]:
    """Every tenth posture of a check, each with that of the closed form at the same travel."""
    machine: Any = data.machine
    (way,) = check_machine(data).ways
    near = machine.start()
    for number, one in enumerate(way.moved):
        near = machine.extended(one.travel, near)
        if number % 10 == 0:
            yield one, near


def equilibrium(machine: FourBarShield, p: Any) -> dict[str, Any]:
    """Forces from three equations a body, written body by body, in a posture."""
    at = {
        "rear_base": np.array(machine.rear_base),
        "front_base": np.array(machine.front_base),
        "rear_shield": np.array(p.rear_shield),
        "front_shield": np.array(p.front_shield),
        "shield_canopy": np.array(p.hinge),
    }
    joins = {  # on the second body
        "rear_base": (None, "rear_link"),
        "front_base": (None, "front_link"),
        "rear_shield": ("rear_link", "shield"),
        "front_shield": ("front_link", "shield"),
        "shield_canopy": ("shield", "canopy"),
    }
    bodies = ("rear_link", "front_link", "shield", "canopy")
    centre = centres(machine, p)
    matrix, right = np.zeros((12, 12)), np.zeros(12)

    def act(body: str | None, column: int, force: np.ndarray, point: np.ndarray) -> None:
        if body is None or body == "ground":
            return
        row, arm = 3 * bodies.index(body), point - centre[body]
        matrix[row : row + 2, column] += force
        matrix[row + 2, column] += arm[0] * force[1] - arm[1] * force[0]

    for n, (pin, (first, second)) in enumerate(joins.items()):
        for axis in range(2):
            unit = np.eye(2)[axis]
            act(second, 2 * n + axis, unit, at[pin])
            act(first, 2 * n + axis, -unit, at[pin])
    for n, strut in enumerate(machine.STRUTS.values()):
        foot, head = (np.array(machine.place(*end, p)) for end in strut)
        along = (head - foot) / np.linalg.norm(head - foot)
        act(strut.head[0], 10 + n, along, head)
        act(strut.foot[0], 10 + n, -along, foot)
    for n, body in enumerate(bodies):
        right[3 * n + 1] = G * lumped(machine.parts[body]).mass
    found = np.linalg.solve(matrix, right)
    pins = {pin: found[2 * n : 2 * n + 2] for n, pin in enumerate(joins)}
    return pins | dict(zip(machine.STRUTS, found[10:], strict=True))


@pytest.mark.parametrize("name", [*SHIELDS, "ours"])
def test_pin_and_column_forces_are_those_of_equilibrium(name: str, tmp_path: Path) -> None:
    data = load_machine(written(tmp_path)) if name == "ours" else read_machine(name)
    machine: Any = data.machine
    for moved_one, posture in postures(data):
        exact = equilibrium(machine, posture)
        # rounding of systems whose condition is some thousand; forces of 1e5 N
        margin = 1e-6
        assert moved_one.forces.error < margin
        for pin, force in moved_one.forces.pins.items():
            assert force == pytest.approx(exact[pin], abs=margin), pin
        for column, push in moved_one.forces.actuators.items():
            assert push == pytest.approx(exact[column], abs=margin), column


def test_a_slider_crank_by_hand() -> None:
    """Moment of the drive by virtual work; the guide has no moment to bear since the pin is in its middle."""
    data = read_machine("slider_crank")
    machine: Any = data.machine
    for one in check_machine(data).data()["stations"]:
        a = one["travel"]  # from 0 on, where the crank starts
        lift = 0.5 * machine.crank_length * math.cos(a) * G * (machine.crank_mass + machine.rod_mass)
        # rounding of 1 N m
        assert one["cranks_N_m"]["crank"] == pytest.approx(lift, abs=1e-12)
        assert one["pins_N"]["slider_pin"][0] == pytest.approx(0.0, abs=1e-3)


# --- limits of the way ---


@pytest.mark.parametrize("name", SHIELDS)
def test_the_way_up_ends_where_no_posture_is_beyond(name: str) -> None:
    """By the closed form: at the dead centre the columns are as long as they can be."""
    data = read_machine(name)
    machine: Any = data.machine
    limit = check_machine(data).ways[0].beyond[1]
    assert limit is not None
    near = machine.start()
    for share in (1.0 - np.geomspace(1.0, 1e-6, 400)).tolist():
        near = machine.extended(share * limit.travel, near)
        assert near is not None
    beyond = machine.extended(limit.travel + math.copysign(1e-4, limit.travel), near)
    assert beyond is None or abs(beyond.rear_link - near.rear_link) > 0.05


# --- what a colleague would say ---


def places(**points: str) -> dict[str, str]:
    """Pivots at other places, over a stroke that the machine then can go."""
    return {"stroke_mm = 600": "stroke_mm = 530"} | {
        rf"\n{name} = \[.*\]": f"\n{name} = {place}" for name, place in points.items()
    }


DOUBTS: dict[str, tuple[dict[str, str], str]] = {
    "tip": ({r"front_base = \[560, 700\]": "front_base = [560, 1100]"}, "the tip wanders"),
    "tonnes": (
        {
            r"rear_link = 900\nfront_link = 700\nshield = 4200\ncanopy = 5200(\n\w+_rods = 350)+": (
                "rear_link = 0.9\nfront_link = 0.7\nshield = 4.2\ncanopy = 5.2"
            )
        },
        "are they in tonnes?",
    ),
    "pull": (
        {r"front_head = \[2300, 2480\]": "front_head = [1400, 2480]"},
        "rear_column pulls instead of pushing",
    ),
    "bores": (
        {r"\[masses_kg\]": "[bore_radius_mm]\nrear_shield = 120\nfront_shield = 120\n[masses_kg]"},
        "diameters?",
    ),
    # the shortest column is 1.8 m: of one stage it would have to be longer than the other
    "stages": (
        places(rear_foot="[1150, 1900]"),
        "times as long; a cylinder of one stage manages less than 1.9 times",
    ),
    "head below foot": (places(front_foot="[2050, 3260]"), "front_column: its head is below its foot"),
    "crossed": (
        places(rear_base="[700, 500]", front_base="[-300, 600]"),
        "rear and front link cross each other",
    ),
}


@pytest.mark.parametrize("doubt", DOUBTS)
def test_doubts(tmp_path: Path, doubt: str) -> None:
    (changes, said), text = DOUBTS[doubt], OURS
    for old, new in changes.items():
        assert re.search(old, text)
        text = re.sub(old, new, text)
    report = check_machine(load_machine(written(tmp_path, text=text)))
    assert any(said in warning for warning in report.warnings), report.warnings


def test_a_stroke_may_be_asked_for_and_may_be_too_long() -> None:
    data = read_machine("reference")
    assert check_machine(data, 0.1).numbers["stroke_m"] == 0.1
    report = check_machine(data, 5.0)
    assert report.numbers["locks"]
    assert report.numbers["travel"][1] == pytest.approx(1.1128, abs=1e-4)
    assert any("the linkage locks or opens there" in warning for warning in report.warnings)
    with pytest.raises(InputError, match="no single actuator drives this machine"):
        check_machine(read_machine("slider_crank"), 1.0)


def test_metres_in_place_of_millimetres(tmp_path: Path) -> None:
    text = OURS.replace("= 2050", "= 2.05").replace("= 600", "= 0.6")
    for line in OURS.splitlines():
        if " = [" in line:
            name, x, y = line.replace(" = [", ", ").rstrip("]").split(", ")
            text = text.replace(line, f"{name} = [{float(x) / 1e3}, {float(y) / 1e3}]")
    report = check_machine(load_machine(written(tmp_path, text=text)))
    assert any("are they given in metres?" in warning for warning in report.warnings)
