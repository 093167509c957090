"""Parts of frames by motions and forces that are known: records, where the journal is, which way arrows go."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image
from PIL.ImageColor import getrgb

from support_exudyn import Result
from support_exudyn.postprocessing.figures.selection import nearest
from support_exudyn.postprocessing.figures.style import CONTACT, FLIGHT
from support_exudyn.postprocessing.render import movie, panels
from support_exudyn.postprocessing.render.movie import moments
from support_exudyn.postprocessing.render.panels import (
    Bore,
    Inset,
    PinView,
    Strip,
    pin_view,
)
from support_exudyn.postprocessing.render.sheet import INK, Canvas
from support_exudyn.postprocessing.render.stage import fitted
from tests import synthetic
from tests.cases.run_cases import PIN, loose_support

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
    found = pin_view(pressed(*arguments))
    assert found is not None
    return found


# --- which records ---


def test_a_frame_shows_the_record_next_to_it() -> None:
    found = nearest(np.array([0.0, 1.0, 2.0, 4.0]), np.array([0.0, 0.4, 0.6, 1.6, 2.9, 3.1, 4.0]))
    assert found.tolist() == [0, 0, 1, 2, 2, 3, 3]


@pytest.mark.parametrize(
    ("speed", "frames", "pace"), [(1.0, 11, ""), (0.5, 21, "2 \u00d7 slower"), (4.0, 3, "4 \u00d7 faster")]
)
def test_speed_is_seconds_of_the_run_in_one_of_the_movie(speed: float, frames: int, pace: str) -> None:
    found = moments(TIME, 0.2, 0.6, 25.0, speed)
    assert found.times == pytest.approx(0.2 + 0.04 * speed * np.arange(frames))
    assert TIME[found.records] == pytest.approx(found.times)
    assert found.pace == pace


# --- scales ---


# --- camera ---

place = st.tuples(*(st.floats(-3.0, 3.0) for _ in "xyz"))


@given(st.lists(place, min_size=2, max_size=8), st.tuples(*(st.integers(0, 60) for _ in "ltrb")))
def test_all_points_are_within_the_margins_as_large_as_they_can_be(
    points: list[tuple[float, float, float]], margins: tuple[int, int, int, int]
) -> None:
    camera = fitted(np.array(points), 640, 360, margins)
    context = camera.pixels(np.array(points))
    left, top, right, bottom = margins
    box = np.array([[left, top], [640 - right, 360 - bottom]])
    low, high = context.min(axis=0), context.max(axis=0)
    # 1e-6 pixels: rounding where all points are one, and the scale is 1e11 pixels to a metre
    margin = 1e-6 * max(1.0, camera.scale * 1e-8)
    assert (low >= box[0] - margin).all()
    assert (high <= box[1] + margin).all()
    assert 0.5 * (low + high) == pytest.approx(box.mean(axis=0), abs=margin)
    if np.ptp(points, axis=0).max() > 1e-3:
        assert ((high - low) / (box[1] - box[0])).max() == pytest.approx(1.0)


# --- the journal and the force on it ---


@pytest.mark.parametrize(("bore", "sign", "carrier"), [("first", 1.0, "ground"), ("second", -1.0, "rear_link")])
def test_the_force_is_that_on_the_journal(bore: str, sign: float, carrier: str) -> None:
    found = view(1e-3, 0.5e-3, (300.0, -400.0), bore)
    assert found.force[0] == pytest.approx([sign * 300.0, sign * -400.0])
    assert found.size[0] == pytest.approx(500.0)
    assert found.bore is not None
    assert found.bore.carrier == carrier
    assert found.bore.eccentricity[0] == pytest.approx([1e-3, 0.5e-3])
    assert found.bore.closed.all()
    # it is where the bore is: with the ground, or with the link, which moves forward by 1 m
    assert found.path[-1] - found.path[0] == pytest.approx([float(bore == "second"), 0.0, 0.0])


BOX = (0, 0, 286, 286)


def inset_of(bore: Bore, record: int, force: tuple[float, float] = (0.0, 0.0)) -> tuple[Image.Image, Inset]:
    """The inset at a record."""
    sheet, found = Canvas(286, 286), Inset(BOX, bore, 1.0)
    found.draw_still(sheet)
    sheet.hold()
    found.draw(sheet, record, 0, force, False)
    return Image.fromarray(sheet.frame()), found


def drawn(shown: PinView, force: tuple[float, float] = (0.0, 0.0)) -> tuple[Inset, Image.Image]:
    """The inset at record 0, with an arrow [pixels]."""
    assert shown.bore is not None
    picture, found = inset_of(shown.bore, 0, force)
    picture.paste("#ffffff", (180, 262, 286, 286))  # the word in the corner, of the same colour
    return found, picture


RADIUS = 0.5 * (286 - 62) / panels.RING  # of the bore in the picture
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
    low, high = (f(pixels_of(picture, panels.JOURNAL), axis=0) for f in (np.min, np.max))
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


# --- force over time ---

AXES = (60, 30, 560, 130)


def shown_strip(force: np.ndarray, closed: np.ndarray, start: float, end: float) -> tuple[Strip, Canvas]:
    known = view(0.0, 0.0, (0.0, 0.0))
    assert known.bore is not None
    pin = replace(known, force=np.column_stack([force, 0.0 * force]), bore=replace(known.bore, closed=closed))
    sheet, found = Canvas(600, 160), Strip(AXES, TIME, pin, start, end, 1.0)
    found.draw_still(sheet)
    sheet.hold()
    return found, sheet


def test_force_is_drawn_over_the_time_that_is_shown() -> None:
    force = np.where(TIME > 0.495, 10e3, 0.0)
    _, sheet = shown_strip(force, TIME > 0.495, 0.2, 0.7)
    inside = sheet.frame()[AXES[1] : AXES[3] + 4, AXES[0] : AXES[2]]
    part = Image.fromarray(inside)
    contact, flight = pixels_of(part, CONTACT), pixels_of(part, FLIGHT)
    # in contact from 0.5 s on, which is at 3/5 of the axis, from the record before on; a pixel of rounding
    assert contact[:, 0].min() == pytest.approx(0.58 * 500, abs=2.0)
    assert contact[:, 0].max() == pytest.approx(500, abs=2.0)
    assert flight[:, 0].max() == pytest.approx(0.58 * 500, abs=2.0)
    assert flight[:, 0].min() == pytest.approx(0.0, abs=2.0)
    # the axis goes to 1.08 of the largest
    assert contact[:, 1].min() == pytest.approx(100.0 * (1.0 - 1.0 / 1.08), abs=2.0)
    assert np.median(flight[:, 1]) == pytest.approx(100.0, abs=2.0)


# --- arrows, and the movie ---


@pytest.mark.parametrize(("x", "y"), [(1.0, 0.0), (0.0, 1.0), (-0.6, 0.8)])
def test_an_arrow_goes_from_tail_to_tip(x: float, y: float) -> None:
    sheet = Canvas(200, 200)
    sheet.hold()
    sheet.arrow((100.0, 100.0), (100.0 + 80.0 * x, 100.0 + 80.0 * y), CONTACT, 8.0)
    picture = sheet.frame()
    # the outermost pixels of the thin tip are not filled by its colour alone, but by more than half
    rows, columns = np.nonzero(np.abs(picture - np.array(getrgb(CONTACT))).max(axis=-1) < 127)
    reached = (np.column_stack((columns, rows)) - 99.5) @ np.array([x, y])
    assert (reached.min(), reached.max()) == (pytest.approx(0.0, abs=1.5), pytest.approx(80.0, abs=2.0))
    found = pixels_of(Image.fromarray(picture), CONTACT) - 100.0
    along, aside = found @ np.array([x, y]), found @ np.array([-y, x])
    head = along > 80.0 - 4.2 * 8.0
    assert np.abs(aside[~head]).max() == pytest.approx(4.0, abs=1.0)  # half of its thickness
    assert np.abs(aside[head]).max() > 10.0
    assert aside.mean() == pytest.approx(0.0, abs=0.3)


def test_colours_with_a_meaning_are_the_same_in_a_gif(tmp_path: Path) -> None:
    frames = []
    for n in range(2):
        pixels = np.random.default_rng(n).integers(0, 255, (40, 160, 3), dtype=np.uint8)
        for k, colour in enumerate((CONTACT, FLIGHT, INK, "#ffffff")):
            pixels[10:30, 40 * k + 10 : 40 * k + 30] = getrgb(colour)
        frames.append(tmp_path / f"frame_{n:04d}.png")
        Image.fromarray(pixels).save(frames[-1])
    movie.write("gif", tmp_path / "a.gif", frames, 10.0, lambda share: None)
    with Image.open(tmp_path / "a.gif") as read:
        for n in range(2):
            read.seek(n)
            picture = np.asarray(read.convert("RGB"))
            assert read.info["duration"] == 100
            for k, colour in enumerate((CONTACT, FLIGHT, INK, "#ffffff")):
                assert (picture[12:28, 40 * k + 12 : 40 * k + 28] == getrgb(colour)).all()
