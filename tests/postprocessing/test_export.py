"""What is exported is what was computed, read back by programs that know nothing of this one."""

from __future__ import annotations

import csv
import dataclasses
from pathlib import Path

import numpy as np
import pytest

from support_exudyn import Result, simulate
from support_exudyn.postprocessing.export import meshes
from support_exudyn.postprocessing.export.mesh_files import to_vtu, to_xdmf
from support_exudyn.postprocessing.export.meshes import pin_points
from support_exudyn.postprocessing.export.sampling import Sampling
from support_exudyn.postprocessing.render.pin_views import pin_views
from tests.cases.export_cases import (
    Read,
    by_vtk,
    look_of,
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
KINDS = ("plane", "space", "tilted", "slider-crank")
EVERY = {"plane": 33, "space": 10, "tilted": 15, "slider-crank": 40}


class Exported:
    """A run and its files."""

    def __init__(self, kind: str, folder: Path) -> None:
        self.kind, self.result = kind, run(kind)
        self.sampling = Sampling(every=EVERY[kind])
        self.records = self.sampling.records(self.result.time)
        self.xdmf = to_xdmf(self.result, folder / "run.xdmf", self.sampling)
        self.vtu = to_vtu(self.result, folder / "vtu", self.sampling)

    def names(self, field: str) -> list[str]:
        """Of the numbers of a field, from the table beside the files."""
        with self.xdmf[-1].open(newline="", encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file) if row["field"] == field]
        assert [int(row["id"]) for row in rows] == list(range(len(rows)))
        return [row["name"] for row in rows]

    def indexes(self, form: str) -> tuple[Path, Path]:
        """Of machine and pins."""
        return self.xdmf[:2] if form == "xdmf" else self.vtu[:2]


# in space, but for tilting, which the next one does
SHOWN = [pytest.param(kind, marks=[pytest.mark.slow] * (kind == "space")) for kind in KINDS]


@pytest.fixture(scope="module", params=SHOWN)
def exported(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Exported:
    return Exported(request.param, tmp_path_factory.mktemp(request.param))


@pytest.fixture(scope="module", params=["xdmf", "pvd"])
def machine(exported: Exported, request: pytest.FixtureRequest) -> list[Read]:
    return by_vtk(exported.indexes(request.param)[0])


@pytest.fixture(scope="module", params=["xdmf", "pvd"])
def pins(exported: Exported, request: pytest.FixtureRequest) -> list[Read]:
    return by_vtk(exported.indexes(request.param)[1])


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


def test_columns_reach_from_foot_to_head(exported: Exported, machine: list[Read]) -> None:
    result, names = exported.result, exported.names("body")
    parts = [shape for shape in look_of(exported.kind).shapes if shape.strut]
    for cylinder, rod in zip(parts[::2], parts[1::2], strict=True):
        strut = cylinder.strut
        assert strut is not None
        assert (strut, cylinder.end, rod.end) == (rod.strut, 0, 1)
        # in the plane a pair is drawn twice and has the channels of one
        channel = strut.name if f"{strut.name}.length" in result.channels else strut.name.rpartition("_")[0]
        for step, record in zip(machine, exported.records, strict=True):
            ends = []
            for part in (cylinder, rod):
                now = step.points[points_of(step, names.index(part.body))]
                turn, shift = rigid(np.asarray(part.mesh.vertices), now)
                assert now == pytest.approx(part.mesh.vertices @ turn.T + shift, abs=ROUNDING)
                ends.append(shift)
            way = ends[1] - ends[0]
            assert np.linalg.norm(way) == pytest.approx(result[f"{channel}.length"][record], abs=ROUNDING)
            assert turn[:, 0] == pytest.approx(way / np.linalg.norm(way), abs=ROUNDING)
            angle = np.arctan2(way[1], way[0])
            assert angle == pytest.approx(result[f"{channel}.angle"][record], abs=ROUNDING)


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


def test_pins_are_on_their_bodies(exported: Exported) -> None:
    result, bodies = exported.result, exported.names("body")
    scenario = result.scenario
    space = scenario.dimensions == 3
    places = scenario.space.bearings if space else scenario.linkage.pins
    machine, pins = (by_vtk(path) for path in exported.indexes("xdmf"))  # which hold the same as the others

    def place_of(step: Read, body: str, point: tuple[float, ...]) -> tuple[np.ndarray, np.ndarray]:
        """Where a point of the start posture is, and where the body's z shows, by the body's surface."""
        start = start_points(exported.kind, body)
        turn, shift = rigid(start, step.points[points_of(step, bodies.index(body))])
        return turn @ [*point, 0.0][:3] + shift, turn[:, 2]

    for of_machine, step, record in zip(machine, pins, exported.records, strict=True):
        for name, point in zip(exported.names("pin"), step.points, strict=True):
            place = places[name]
            first, along = place_of(of_machine, place.first, place.first_point)
            second, _ = place_of(of_machine, place.second, place.second_point)
            pin = scenario.clearance_pins.get(place.pin if space else name)
            if pin is None:
                assert point == pytest.approx(first, abs=ROUNDING)
                apart = second - first
                if space and "along" not in place.holds:
                    apart -= (apart @ along) * along
                # ideal pins are closed to Newton's tolerance of positions
                assert apart == pytest.approx(np.zeros(3), abs=1e-9)
                continue
            bore, journal = (first, second) if pin.bore == "first" else (second, first)
            assert point == pytest.approx(journal, abs=ROUNDING)
            # in the plane along x and y; in space in axes across the bore, which lean by up to 1e-2 rad: a part
            # 1e-4 of 1.6 mm
            eccentricity = np.hypot(*(result[f"pin.{name}.eccentricity_{axis}"][record] for axis in "xy"))
            tolerance = 2e-7 if space else ROUNDING
            assert np.hypot(*(journal - bore)[:2]) == pytest.approx(eccentricity, abs=tolerance)


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


# --- velocities, and differences of positions ---


# --- meshio ---


# --- files ---


def test_an_export_removes_its_earlier_files_and_nothing_of_others(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    result = run("plane")
    to_vtu(result, tmp_path, Sampling(every=10))
    (tmp_path / "machine_99999.vtu").write_text("of others", encoding="utf-8")
    to_vtu(result, tmp_path, Sampling(every=20))
    steps = len(Sampling(every=20).records(result.time))
    own = {f"{mesh}_{n:05d}.vtu" for mesh in ("machine", "pins") for n in range(steps)}
    others = {"machine_99999.vtu", "machine.pvd", "pins.pvd", "names.csv"}
    assert {path.name for path in tmp_path.iterdir()} == own | others
    index, stranger = tmp_path / "a_pins.xdmf", tmp_path / "b_pins.xdmf"
    for path, store in ((index, "a_mesh.h5"), (stranger, "other_mesh.h5")):
        path.write_text(f"<Xdmf>{store}:/data0</Xdmf>", encoding="utf-8")
    monkeypatch.setattr(meshes, "pin_points", lambda result: None)  # of a machine without pins
    for name in ("a", "b"):
        to_xdmf(run("ideal"), tmp_path / f"{name}.xdmf", Sampling(every=20))
    assert not index.exists()
    assert stranger.exists()


# --- what is refused ---


def with_channels(*channels: str) -> Result:
    return simulate(
        support(drive=dataclasses.replace(run("plane").scenario.drive), duration=0.01, channels=channels)
    )


def test_a_run_without_the_motion_of_its_bodies_is_refused(tmp_path: Path) -> None:
    result = with_channels("tip.*", "pin.*")
    with pytest.raises(InputError, match="was not recorded, and without it nobody knows where the body is"):
        to_xdmf(result, tmp_path / "run.xdmf")
    result = with_channels("tip.*", "*.x", "*.y", "*angle", "*velocity*")
    with pytest.raises(
        InputError, match=r"'pin\.\w+\.force_x': was not recorded, and pins are written with it"
    ):
        to_vtu(result, tmp_path)
    assert list(tmp_path.iterdir()) == []
