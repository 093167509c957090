"""Frames and movies of short runs, small so that they are quick."""

from __future__ import annotations

import subprocess
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from PIL import Image

from studies.common.paper_machine import clearance_rise, ideal_rise
from support_exudyn import CubicStep, Held, Result, simulate
from support_exudyn.__main__ import main
from support_exudyn.model.loads.roofs import Roof
from support_exudyn.postprocessing.export.meshes import machine_mesh
from support_exudyn.postprocessing.render import render, still
from support_exudyn.postprocessing.render.canvas import INK, Canvas
from support_exudyn.postprocessing.render.scene import RenderedScene
from support_exudyn.postprocessing.render.stage import Camera, MeshItem, Stage, direction_of_view
from user_forces import InputError

SIZE = (320, 180)
WITH_CLEARANCE = "rear_base"


@pytest.fixture(scope="module")
def bouncing() -> Result:
    """A journal that falls and bounces."""
    return simulate(replace(clearance_rise(1.5, 0.25, 5e-4), duration=0.2, record_period=1e-3))


@pytest.fixture(scope="module")
def spatial() -> Result:
    return simulate(replace(clearance_rise(1.5, 0.25, 1e-3), dimensions=3, duration=0.05))


# --- what is seen ---


def test_the_camera_sees_points_where_the_ray_tracer_draws_them() -> None:
    size = (320, 180)
    camera = Camera(direction_of_view(), (0.3, 0.2, -0.4), 4.0, *size)
    cube = MeshItem(trimesh.creation.box((0.05, 0.05, 0.05)), (1.0, 0.0, 0.0))
    stage = Stage([cube], camera)
    for point in ((0.3, 0.2, -0.4), (1.0, 0.2, 0.0), (0.0, 1.0, 0.0), (0.3, 0.0, 0.7)):
        picture = stage.image([(np.array(point), np.eye(3))]).astype(int)
        rows, columns = np.nonzero(picture[:, :, 1] < 200)
        # half a pixel: what a middle of so few pixels can be known to
        assert (columns.mean() + 0.5, rows.mean() + 0.5) == pytest.approx(
            camera.pixels(np.array([point]))[0], abs=0.5
        )


def test_a_roof_that_presses_is_drawn_where_it_is() -> None:
    scenario = replace(ideal_rise(1e-3), drive=Held(), duration=0.1)
    tip = scenario.linkage.points["tip"]
    roof = Roof(
        body="canopy",
        point=tip.point,
        descent=CubicStep(stroke=0.05, start=0.0, end=0.1),
        stiffness=1e3,
        gap=0.2,
    )
    run = simulate(replace(scenario, loads={"roof": roof}))
    scene = RenderedScene(run)
    top = max(shape.mesh.bounds[1, 1] for shape in scene.look.of("canopy"))
    assert scene.roof(0) == pytest.approx(top + 0.2)
    assert scene.roof(run.time.size - 1) == pytest.approx(top + 0.15)
    assert scene.surroundings is not None


def test_surfaces_are_put_where_the_exported_mesh_has_them(bouncing: Result, spatial: Result) -> None:
    for run in (bouncing, spatial):
        scene, record = RenderedScene(run), run.time.size - 1
        expected = machine_mesh(run).frame(record)[0]
        placed = [
            mesh_item.mesh.vertices @ turn.T + place
            for mesh_item, (place, turn) in zip(scene.items(), scene.places(record), strict=True)
        ]
        # rounding of places of some metres
        assert np.concatenate(placed)[: len(expected)] == pytest.approx(expected, abs=1e-12)


def painted(
    run: Result, time: float, size: tuple[int, int], monkeypatch: pytest.MonkeyPatch
) -> tuple[list[np.ndarray], list[str]]:
    """Arrows and words of a still: arrows of the scale, in the machine, in the bore; not that of "forward"."""
    arrows: list[np.ndarray] = []
    words: list[str] = []
    drawn, written = Canvas.arrow, Canvas.write

    def arrow(sheet: Canvas, tail: Any, tip: Any, colour: str, thick: float) -> None:
        if colour != INK:
            arrows.append(np.subtract(tip, tail))
        drawn(sheet, tail, tip, colour, thick)

    def write(sheet: Canvas, place: Any, text: str, *rest: Any, **others: Any) -> Any:
        words.append(text)
        return written(sheet, place, text, *rest, **others)

    monkeypatch.setattr(Canvas, "arrow", arrow)
    monkeypatch.setattr(Canvas, "write", write)
    still(run, time, size=size)
    return arrows, words


def test_arrows_are_the_force_on_the_journal_in_the_scale_that_is_shown(
    bouncing: Result, monkeypatch: pytest.MonkeyPatch
) -> None:
    size, force = (640, 360), bouncing[f"pin.{WITH_CLEARANCE}.force"]
    usual = np.quantile(force[force > 0.0], 0.97)
    inner = np.flatnonzero((force > 0.3 * usual) & (force < 1.5 * usual))
    assert inner.size
    record = int(inner[0])
    (scale, machine, bore), words = painted(bouncing, float(bouncing.time[record]), size, monkeypatch)
    x, y = (
        bouncing[f"pin.{WITH_CLEARANCE}.force_{axis}"][record] for axis in "xy"
    )  # on the link, which has the journal
    (bar,) = (float(word.removesuffix(" kN")) for word in words if word.endswith(" kN") and "." not in word)
    pixels = scale[0] / (1e3 * bar)  # to a newton
    assert scale[1] == 0.0
    assert bore == pytest.approx([pixels * x, -pixels * y])  # forward is to the right
    view = direction_of_view().apply([x, y, 0.0])
    assert machine == pytest.approx([pixels * view[0], -pixels * view[1]])
    assert f"{force[record] / 1e3:.1f} kN" in words
    assert f"t = {bouncing.time[record]:.3f} s" in words
    assert "the arrow is cut short" not in words


# --- files ---


def test_frames_and_a_gif(bouncing: Result, tmp_path: Path) -> None:
    written = render(bouncing, tmp_path / "run_frames", size=SIZE)
    assert [path.name for path in written.frames] == [f"frame_{n:04d}.png" for n in range(6)]  # 0 to 0.2 s
    for path in written.frames:
        with Image.open(path) as frame:
            assert frame.size == SIZE
    assert written.movie == tmp_path / "run.gif"
    with Image.open(written.movie) as movie:
        assert movie.n_frames == 6
        assert movie.size == SIZE
        length = 0.0
        for n in range(movie.n_frames):
            movie.seek(n)
            length += movie.info["duration"]
        assert length == 240.0
        assert movie.convert("RGB").getpixel((318, 178)) == (255, 255, 255)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["run.gif", "run_frames"]


def test_an_mp4_has_all_frames(bouncing: Result, tmp_path: Path) -> None:
    ffmpeg = pytest.importorskip("imageio_ffmpeg")
    written = render(bouncing, tmp_path / "run_frames", size=SIZE, movie="mp4", until=0.08)
    assert written.movie == tmp_path / "run.mp4"
    words = [ffmpeg.get_ffmpeg_exe(), "-i", str(written.movie), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    decoded = subprocess.run(words, check=True, capture_output=True)
    assert b"320x180" in decoded.stderr
    assert b"25 fps" in decoded.stderr
    pictures = np.frombuffer(decoded.stdout, dtype=np.uint8).reshape(-1, 180, 320, 3)
    assert len(pictures) == 3
    with Image.open(written.frames[-1]) as frame:
        apart = np.abs(np.asarray(frame).astype(int) - pictures[-1]).mean()
    assert apart < 8.0  # of 255: compression


# --- what is refused ---


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"frames_per_second": 0.0}, "frames_per_second = 0"),
        ({"frames_per_second": 60.0}, "of a GIF up to"),
        ({"after": -1.0}, "after = -1 s: allowed: 0 to 0.2 s"),
        ({"after": 0.1, "until": 0.05}, "later than"),
        ({"movie": "avi"}, "'avi': allowed: gif, mp4, none"),
        ({"size": (321, 180)}, "width = 321"),
        ({"pin": "knee"}, "no such pin; allowed: rear_base"),
    ],
)
def test_what_cannot_be_is_refused_before_anything_is_written(
    bouncing: Result, tmp_path: Path, wrong: dict[str, object], said: str
) -> None:
    with pytest.raises(InputError, match=said.replace("(", r"\(")):
        render(bouncing, tmp_path / "f", **{"size": SIZE, **wrong})  # type: ignore[arg-type]
    assert not list(tmp_path.iterdir())


# --- command line ---


def test_the_command_writes_beside_the_run(
    bouncing: Result, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = bouncing.save(tmp_path / "with_clearance.h5")
    assert main(["render", str(path), "--size", "320x180", "--until", "0.04"]) == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "with_clearance.gif",
        "with_clearance.h5",
        "with_clearance_frames",
    ]
    assert sorted(path.name for path in (tmp_path / "with_clearance_frames").iterdir()) == [
        *("frame_0000.png", "frame_0001.png")
    ]
    assert "2 frames" in capsys.readouterr().out
