"""Frames and movies of short runs, small so that they are quick."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from studies.common.paper_machine import clearance_rise, ideal_rise
from support_exudyn import CubicStep, Held, Result, simulate
from support_exudyn.__main__ import main
from support_exudyn.model.loads.roofs import Roof
from support_exudyn.postprocessing.export.meshes import machine_mesh
from support_exudyn.postprocessing.render import render
from support_exudyn.postprocessing.render.frame import Painter, Times
from support_exudyn.postprocessing.render.pin_views import PinView, pin_views
from support_exudyn.postprocessing.render.stage import Stage
from tests import synthetic
from tests.cases.run_cases import PIN, loose_slider_crank, loose_support
from user_forces import InputError

SIZE = (320, 180)


@pytest.fixture(scope="module")
def bouncing() -> Result:
    """A journal that falls and bounces."""
    return simulate(replace(clearance_rise(1.5, 0.25, 5e-4), duration=0.2, record_period=1e-3))


# --- what is seen ---


def test_the_ray_tracer_draws_the_machine_where_the_camera_and_the_exported_mesh_have_it() -> None:
    run = simulate(loose_slider_crank(2e-3, 0.03))
    stage = Stage(run, (640, 360))
    for record in (0, run.time.size // 2, run.time.size - 1):
        rows, columns = np.nonzero((stage.image(record) < 240).any(axis=2))
        expected = stage.camera.pixels(machine_mesh(run).frame(record)[0])
        drawn = np.array([[columns.min(), rows.min()], [columns.max() + 1, rows.max() + 1]])
        # lines of edges are wider than they, and a corner may cover too little of a pixel
        assert drawn == pytest.approx(np.array([expected.min(axis=0), expected.max(axis=0)]), abs=2.0)


def test_a_roof_that_presses_is_drawn_where_it_is() -> None:
    scenario = replace(ideal_rise(1e-3), drive=Held(), duration=0.1)
    tip = scenario.linkage.points["tip"]
    descent = CubicStep(stroke=0.05, start=0.0, end=0.1)
    roof = Roof(body="canopy", point=tip.point, descent=descent, stiffness=1e3, gap=0.2)
    stage = Stage(simulate(replace(scenario, loads={"roof": roof})), SIZE)
    top = max(shape.mesh.bounds[1, 1] for shape in stage.look.of("canopy"))
    assert stage.slabs[-1][[0, -1]] == pytest.approx([top + 0.2, top + 0.15])


def test_arrows_are_the_force_on_the_journal_in_one_scale(bouncing: Result) -> None:
    times = Times(bouncing.time[:1], 1e-3, 1.0, (0.0, 0.2))
    painter, (pin, *_) = Painter(bouncing, SIZE, PIN, times), pin_views(bouncing, PIN)
    usual = np.quantile(pin.size[pin.closed], 0.97)
    inner = np.flatnonzero((pin.size > 0.3 * usual) & (pin.size < 1.5 * usual))
    assert inner.size
    arrows = np.array([painter.arrow_of(pin, record) for record in inner])
    scale = np.hypot(*arrows[0]) / pin.size[inner[0]]
    # on the link, which has the journal
    force = np.column_stack([bouncing[f"pin.{PIN}.force_{axis}"] for axis in "xy"])
    assert arrows == pytest.approx(scale * force[inner])


# --- files ---


def test_frames_and_a_gif(bouncing: Result, tmp_path: Path) -> None:
    written = render(bouncing, tmp_path / "run_frames", size=SIZE)
    assert [path.name for path in written.frames] == [f"frame_{n:04d}.png" for n in range(6)]  # 0 to 0.2 s
    for path in written.frames:
        with Image.open(path) as frame:
            assert frame.size == SIZE
    assert written.movie == tmp_path / "run.gif"
    with Image.open(written.movie) as movie:
        assert (movie.n_frames, movie.size) == (6, SIZE)
        length = 0.0
        for n in range(movie.n_frames):
            movie.seek(n)
            length += movie.info["duration"]
        assert length == 240.0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["run.gif", "run_frames"]


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"frames_per_second": 60.0}, "frames_per_second = 60"),
        ({"speed": 1e-5}, "frames from"),
        ({"after": -1.0}, "after = -1 s: allowed: 0 to 0.2 s"),
        ({"after": 0.1, "until": 0.05}, "later than"),
        ({"size": (321, 180)}, "width = 321"),
        ({"pin": "knee"}, "no such pin; allowed: rear_base"),
    ],
)
def test_what_cannot_be_is_refused_before_anything_is_written(
    bouncing: Result, tmp_path: Path, wrong: dict[str, object], said: str
) -> None:
    with pytest.raises(InputError, match=said):
        render(bouncing, tmp_path / "f", **{"size": SIZE, **wrong})  # type: ignore[arg-type]
    assert not list(tmp_path.iterdir())


def test_the_command_writes_beside_the_run_and_keeps_pictures_of_others(
    bouncing: Result, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = bouncing.save(tmp_path / "with_clearance.h5")
    frames = tmp_path / "with_clearance_frames"
    frames.mkdir()
    Image.new("RGB", (2, 2)).save(frames / "frame_0099.png")  # of another program
    for until in ("0.08", "0.04"):
        assert main(["render", str(path), "--size", "320x180", "--until", until]) == 0
    assert {one.name for one in tmp_path.iterdir()} == {path.name, frames.name, "with_clearance.gif"}
    assert {one.name for one in frames.iterdir()} == {f"frame_{n:04d}.png" for n in (0, 1, 99)}
    assert "2 frames" in capsys.readouterr().out


# --- the journal and the force on it, by motions and forces that are known ---

SCENARIO = loose_support(1.5)
BEARING = SCENARIO.clearance_pins[PIN].contact.bearing
TIME = np.arange(101) * 0.01


def view(x: float, y: float, force: tuple[float, float], bore: str = "first") -> PinView:
    """A journal that stays at a place [m], with a force of the first body on the second [N]."""
    pin = replace(SCENARIO.clearance_pins[PIN], bore=bore)
    here = np.ones_like(TIME)
    motion = dict.fromkeys(("angle", "velocity_x", "velocity_y", "angular_velocity"), (0.0 * TIME, ""))
    motion |= {"x": (2.0 + TIME, "m"), "y": (here, "m")}
    result = synthetic.journal(
        replace(SCENARIO, pins={PIN: pin}), TIME, x * here, y * here,
        **{f"rear_link__{name}": channel for name, channel in motion.items()},
        **{f"pin__{PIN}__force_{axis}": (one * here, "N") for axis, one in zip("xy", force, strict=True)},
    )  # fmt: skip
    (found,) = pin_views(result)
    return found


@pytest.mark.parametrize(("bore", "sign", "carrier"), [("first", 1.0, "ground"), ("second", -1.0, "rear_link")])
def test_the_force_is_that_on_the_journal(bore: str, sign: float, carrier: str) -> None:
    found = view(1e-3, 0.5e-3, (300.0, -400.0), bore)
    assert found.force[0] == pytest.approx([sign * 300.0, sign * -400.0])
    assert found.size[0] == pytest.approx(500.0)
    assert found.pin.bore.body == carrier
    assert found.closed.all()
    # it is where the bore is: with the ground, or with the link, which moves forward by 1 m
    assert found.path[-1] - found.path[0] == pytest.approx([float(bore == "second"), 0.0, 0.0])


def test_the_clearance_is_enlarged_so_that_a_journal_in_contact_touches_the_bore() -> None:
    found = view(-0.6 * BEARING.clearance, 0.8 * BEARING.clearance, (0.0, 0.0))
    # 0.2 of the bore's radius is 8.7 times the clearance: 10 are shown
    assert found.enlargement == 10.0
    place, journal = found.enlarged(0, 1.0)
    assert place == pytest.approx(10.0 * BEARING.clearance / BEARING.bore_radius * np.array([-0.6, 0.8]))
    assert np.hypot(*place) + journal == pytest.approx(1.0)
