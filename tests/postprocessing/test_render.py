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
from PIL.ImageColor import getrgb

from studies.common.paper_machine import clearance_rise, ideal_rise
from support_exudyn import CubicStep, Held, Result, simulate
from support_exudyn.__main__ import main
from support_exudyn.model.loads.roofs import Roof
from support_exudyn.postprocessing.export.meshes import machine_mesh
from support_exudyn.postprocessing.figures.style import CONTACT, FLIGHT
from support_exudyn.postprocessing.render import render, still
from support_exudyn.postprocessing.render.canvas import INK, Canvas
from support_exudyn.postprocessing.render.frame import JOURNAL, RING, Inset
from support_exudyn.postprocessing.render.pin_views import PinView, pin_views
from support_exudyn.postprocessing.render.scene import RenderedScene
from support_exudyn.postprocessing.render.stage import Camera, MeshItem, Stage, direction_of_view
from tests import synthetic
from tests.cases.run_cases import PIN, loose_support
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
    frames = tmp_path / "with_clearance_frames"
    frames.mkdir()
    Image.new("RGB", (2, 2)).save(frames / "frame_0099.png")  # of another program
    for until in ("0.08", "0.04"):
        assert main(["render", str(path), "--size", "320x180", "--until", until]) == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "with_clearance.gif",
        "with_clearance.h5",
        "with_clearance_frames",
    ]
    names = ["frame_0000.png", "frame_0001.png", "frame_0099.png"]
    assert sorted(path.name for path in frames.iterdir()) == names
    assert "2 frames" in capsys.readouterr().out


# --- parts of frames by motions and forces that are known ---

SCENARIO = loose_support(1.5)
BEARING = SCENARIO.clearance_pins[PIN].contact.bearing
TIME = np.arange(101) * 0.01


def pixels_of(picture: Image.Image, colour: str) -> np.ndarray:
    """Columns and rows of the middles of the pixels that have just this colour."""
    found = np.argwhere((np.asarray(picture) == np.array(getrgb(colour))).all(axis=-1))
    return found[:, ::-1] + 0.5


def pressed(x: float, y: float, force: tuple[float, float], bore: str = "first") -> Result:
    """A journal that stays at a place [m], with a force of the first body on the second [N]."""
    pin = replace(SCENARIO.clearance_pins[PIN], bore=bore)
    here = np.ones_like(TIME)
    link = {
        f"rear_link__{name}": (0.0 * TIME, "m") for name in ("velocity_x", "velocity_y", "angular_velocity")
    }
    return synthetic.journal(
        replace(SCENARIO, pins={PIN: pin}), TIME, x * here, y * here,
        rear_link__x=(2.0 + TIME, "m"), rear_link__y=(1.0 + 0.0 * TIME, "m"),
        rear_link__angle=(0.0 * TIME, "rad"), **link,
        **{f"pin__{PIN}__force_{axis}": (one * here, "N") for axis, one in zip("xy", force, strict=True)},
    )  # fmt: skip


def view(*arguments: Any) -> PinView:
    (found,) = pin_views(pressed(*arguments))
    return found


# --- the journal and the force on it ---


@pytest.mark.parametrize(("bore", "sign", "carrier"), [("first", 1.0, "ground"), ("second", -1.0, "rear_link")])
def test_the_force_is_that_on_the_journal(bore: str, sign: float, carrier: str) -> None:
    found = view(1e-3, 0.5e-3, (300.0, -400.0), bore)
    assert found.force[0] == pytest.approx([sign * 300.0, sign * -400.0])
    assert found.size[0] == pytest.approx(500.0)
    assert found.pin.bore.body == carrier
    assert found.eccentricity[0] == pytest.approx([1e-3, 0.5e-3])
    assert found.closed.all()
    # it is where the bore is: with the ground, or with the link, which moves forward by 1 m
    assert found.path[-1] - found.path[0] == pytest.approx([float(bore == "second"), 0.0, 0.0])


BOX = (0, 0, 286, 286)


def drawn(shown: PinView, force: tuple[float, float] = (0.0, 0.0)) -> tuple[Inset, Image.Image]:
    """The inset at record 0, with an arrow [pixels]."""
    sheet = Canvas(286, 286)
    found = Inset(sheet, BOX, shown, 1.0)
    sheet.hold()
    found.draw(0, 0, force)
    picture = Image.fromarray(sheet.frame())
    picture.paste("#ffffff", (180, 262, 286, 286))  # the word in the corner, of the same colour
    return found, picture


RADIUS = 0.5 * (286 - 62) / RING  # of the bore in the picture
PIXELS = (
    10.0 * RADIUS / BEARING.bore_radius
)  # 0.2 of the bore's radius is 8.7 times the clearance: 10 are shown


@pytest.mark.parametrize(("x", "y"), [(1e-3, 0.0), (0.0, 1e-3), (-0.6e-3, 0.8e-3)])
def test_the_journal_is_where_it_is_with_its_clearance_enlarged(x: float, y: float) -> None:
    found, picture = drawn(view(x, y, (0.0, 0.0)))
    assert found.title == "clearance \u00d7 10"
    mark = pixels_of(picture, FLIGHT).mean(axis=0)
    # forward is to the right, up is up; the mark's middle is rounded to pixels
    assert mark - found.centre == pytest.approx([x * PIXELS, -y * PIXELS], abs=0.6)
    low, high = (f(pixels_of(picture, JOURNAL), axis=0) for f in (np.min, np.max))
    wide = 2.0 * (RADIUS - PIXELS * BEARING.clearance)
    assert high - low + 1.0 == pytest.approx([wide, wide], abs=2.5)  # smooth edges have other colours
    assert 0.5 * (low + high) == pytest.approx(mark, abs=1.0)


@pytest.mark.parametrize(("x", "y"), [(1.0, 0.0), (0.0, -1.0), (-0.6, 0.8)])
def test_the_arrow_goes_from_the_wall_that_is_touched_into_the_bore(x: float, y: float) -> None:
    deep = 1.01 * BEARING.clearance
    found, picture = drawn(view(deep * x, deep * y, (-1.0, 0.0)), (-60.0 * x, 60.0 * y))
    assert not len(pixels_of(picture, FLIGHT))
    towards = np.array([x, -y])  # the wall, in the picture
    ahead = (pixels_of(picture, CONTACT) - found.centre) @ towards
    # from the wall, around which is a dot of 6 pixels with a rim, 60 pixels inwards, where its tip is thin; the
    # mark of the journal's centre ends 26 pixels from the middle
    assert ahead.max() == pytest.approx(RADIUS + 5.0, abs=2.0)
    assert ahead[ahead > 27.0].min() == pytest.approx(RADIUS - 60.0, abs=4.0)
    aside = (pixels_of(picture, CONTACT) - found.centre) @ np.array([-towards[1], towards[0]])
    assert np.abs(aside[ahead > RADIUS - 55.0]).max() < 12.0
