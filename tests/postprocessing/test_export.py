"""What is exported is what was computed, read back by programs that know nothing of this one."""

from __future__ import annotations

import csv
import dataclasses
from pathlib import Path

import numpy as np
import pytest

from support_exudyn import Result, simulate
from support_exudyn.postprocessing.export.meshes import pin_points, to_vtu
from support_exudyn.postprocessing.export.sampling import Sampling
from support_exudyn.postprocessing.render.pin_views import pin_views
from tests.cases.export_cases import (
    Read,
    by_vtk,
    moving_bodies,
    points_of,
    rigid,
    run,
    start_points,
)
from tests.cases.run_cases import PIN, loose_support, support
from user_forces import InputError

# rounding of a rotation and a shift of points up to 5 m from the origin, and of the fit to them
ROUNDING = 1e-12
EVERY = {"plane": 33, "tilted": 15, "slider-crank": 40}


class Exported:
    """A run and its files."""

    def __init__(self, kind: str, folder: Path) -> None:
        self.kind, self.result = kind, run(kind)
        self.sampling = Sampling(every=EVERY[kind])
        self.records = self.sampling.records(self.result.time)
        self.machine, self.pins, self.table, *_ = to_vtu(self.result, folder, self.sampling)

    def names(self, field: str) -> list[str]:
        """Of the numbers of a field, from the table beside the files."""
        with self.table.open(newline="", encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file) if row["field"] == field]
        assert [int(row["id"]) for row in rows] == list(range(len(rows)))
        return [row["name"] for row in rows]


@pytest.fixture(scope="module", params=EVERY)
def exported(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Exported:
    return Exported(request.param, tmp_path_factory.mktemp(request.param))


@pytest.fixture(scope="module")
def machine(exported: Exported) -> list[Read]:
    return by_vtk(exported.machine)


@pytest.fixture(scope="module")
def pins(exported: Exported) -> list[Read]:
    return by_vtk(exported.pins)


# --- VTK's readers, and the channels ---


def test_bodies_are_where_the_channels_say(exported: Exported, machine: list[Read]) -> None:
    result, names = exported.result, exported.names("body")
    scenario = result.scenario
    known = scenario.space.bodies if scenario.dimensions == 3 else scenario.linkage.bodies
    for step, record in zip(machine, exported.records, strict=True):
        for body in moving_bodies(exported.kind):
            start = start_points(exported.kind, body)
            now = step.points[points_of(step, names.index(body))]
            turn, shift = rigid(start, now)
            assert now == pytest.approx(start @ turn.T + shift, abs=ROUNDING)  # it stays rigid
            centre = turn @ [*known[body].centre, 0.0][:3] + shift
            for axis, value in zip("xyz"[: scenario.dimensions], centre, strict=False):
                assert value == pytest.approx(result[f"{body}.{axis}"][record], abs=ROUNDING)
            turned = np.arctan2(turn[1, 0], turn[0, 0])
            assert turned == pytest.approx(result[f"{body}.angle"][record] - known[body].angle, abs=ROUNDING)
            if scenario.dimensions == 3:
                roll, yaw = np.arctan2(turn[2, 1], turn[1, 1]), np.arctan2(turn[0, 2], turn[2, 2])
                assert roll == pytest.approx(result[f"{body}.roll"][record], abs=ROUNDING)
                assert yaw == pytest.approx(result[f"{body}.yaw"][record], abs=ROUNDING)


def test_velocities_are_those_of_the_channels(exported: Exported, machine: list[Read]) -> None:
    result, names = exported.result, exported.names("body")
    for step, record in zip(machine, exported.records, strict=True):
        for body in moving_bodies(exported.kind):
            at = points_of(step, names.index(body))
            axes = "xyz" if result.scenario.dimensions == 3 else "xy"
            centre = np.zeros(3)
            centre[: len(axes)] = [result[f"{body}.{axis}"][record] for axis in axes]
            centre_velocity = np.zeros(3)
            centre_velocity[: len(axes)] = [result[f"{body}.velocity_{axis}"][record] for axis in axes]
            spin = np.array([0.0, 0.0, result[f"{body}.angular_velocity"][record]])
            if result.scenario.dimensions == 3:
                spin[:2] = [result[f"{body}.angular_velocity_{axis}"][record] for axis in "xy"]
            expected = centre_velocity + np.cross(spin, step.points[at] - centre)
            # rounding of arms times up to 600 rad/s of the crank
            assert step.point_data["velocity_m_s"][at] == pytest.approx(expected, abs=600 * ROUNDING)


def test_pins_have_the_force_depth_and_slip_of_the_channels(exported: Exported, pins: list[Read]) -> None:
    result, names = exported.result, exported.names("pin")
    space = result.scenario.dimensions == 3
    expected_names = {name.split(".")[1] for name in result.channels if name.startswith("pin.")}
    if space:  # of pairs there are the force of both under one name, too
        expected_names = {n for n, b in result.scenario.space.bearings.items() if not b.is_guide}
    assert set(names) == expected_names
    for step, record in zip(pins, exported.records, strict=True):
        data = step.point_data
        assert data["pin"].tolist() == list(range(len(names)))
        assert step.cells.tolist() == [[number] for number in data["pin"]]
        for number, name in enumerate(names):
            for k, axis in enumerate("xyz" if space else "xy"):
                assert data["force_N"][number, k] == result[f"pin.{name}.force_{axis}"][record]
            size = result[f"pin.{name}.force"][record]
            # rounding of a root
            assert data["force_magnitude_N"][number] == pytest.approx(size, rel=1e-14)
            with_clearance = f"pin.{name}.depth" in result.channels
            assert data["with_clearance"][number] == with_clearance
            if with_clearance:
                assert data["depth_m"][number] == result[f"pin.{name}.depth"][record]
                assert data["slip_m_s"][number] == result[f"pin.{name}.slip"][record]
            else:
                assert np.isnan(data["depth_m"][number])
                assert np.isnan(data["slip_m_s"][number])
    assert sum(pins[0].point_data["with_clearance"]) >= 1


@pytest.mark.parametrize("bore", ["first", "second"])
def test_a_loose_pin_is_at_its_journal_and_pressed_back_into_its_bore(bore: str) -> None:
    """Whichever body has the bore: the eccentricity that was recorded lies between both bodies' points."""
    scenario = loose_support(1.5, 0.0, duration=0.06)
    pin = dataclasses.replace(scenario.clearance_pins[PIN], bore=bore)
    result = simulate(dataclasses.replace(scenario, pins={PIN: pin}))
    points, (view,) = pin_points(result), pin_views(result, PIN)
    assert points is not None
    number = points.names["pin"].index(PIN)
    pressed = 0
    for record in range(result.time.size):
        apart = points.frame(record)[0][number] - view.path[record]
        assert apart[:2] == pytest.approx(view.eccentricity[record], abs=ROUNDING)
        if view.closed[record]:
            pressed += 1
            # without friction the force on the journal is along the line of centres, into the bore
            size = view.size[record] * np.linalg.norm(apart)
            assert view.force[record] @ apart[:2] == pytest.approx(-size, rel=1e-9)
    assert pressed > 3
    # the ground stands still: the journal on it, or the bore in it
    still = view.path if bore == "first" else np.array([points.frame(k)[0][number] for k in (0, 20, 60)])
    assert np.ptp(still, axis=0) == pytest.approx([0.0, 0.0, 0.0], abs=ROUNDING)


# --- files ---


def test_an_export_removes_its_earlier_files_and_nothing_of_others(tmp_path: Path) -> None:
    result = run("plane")
    to_vtu(result, tmp_path, Sampling(every=10))
    for name in ("machine_0.vtu", "machine_99999.vtu"):
        (tmp_path / name).write_text("of others", encoding="utf-8")
    to_vtu(result, tmp_path, Sampling(every=20))
    steps = len(Sampling(every=20).records(result.time))
    own = {f"{mesh}_{n:05d}.vtu" for mesh in ("machine", "pins") for n in range(steps)}
    others = {"machine_0.vtu", "machine_99999.vtu", "machine.pvd", "pins.pvd", "names.csv"}
    assert {path.name for path in tmp_path.iterdir()} == own | others


# --- what is refused ---


def with_channels(*channels: str) -> Result:
    return simulate(
        support(drive=dataclasses.replace(run("plane").scenario.drive), duration=0.01, channels=channels)
    )


def test_a_run_without_the_motion_of_its_bodies_is_refused(tmp_path: Path) -> None:
    for channels, lacking in (
        (("tip.*", "pin.*"), r"\w+\.angle"),
        (("tip.*", "*.x", "*.y", "*angle", "*velocity*"), r"pin\.\w+\.force_x"),
    ):
        with pytest.raises(InputError, match=f"'{lacking}': was not recorded"):
            to_vtu(with_channels(*channels), tmp_path)
    assert list(tmp_path.iterdir()) == []
