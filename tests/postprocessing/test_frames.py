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
from support_exudyn.postprocessing.figures.units import said_beside
from support_exudyn.postprocessing.render import movie, panels
from support_exudyn.postprocessing.render.movie import moments
from support_exudyn.postprocessing.render.panels import (
    Bore,
    Inset,
    PinView,
    Strip,
    pin_view,
    round_down,
    round_up,
    said,
    usual,
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


def test_frames_are_as_many_a_second_as_was_asked_for() -> None:
    found = moments(TIME, None, None, 10.0, 2.0)
    assert found.times == pytest.approx([0.0, 0.2, 0.4, 0.6, 0.8, 1.0])


def test_a_trail_is_as_long_in_the_movie_at_any_speed() -> None:
    found = moments(TIME, 0.2, 0.6, 25.0, 0.5)
    # 0.25 s of the movie are 0.125 s of the run: from 0.4 s to the first record after 0.275 s
    assert found.back(10, 0.25) == 28
    assert found.back(3, 0.25) == 20  # no farther than the first frame


@pytest.mark.parametrize(("speed", "decimals"), [(1.0, 3), (0.025, 3), (0.0025, 4), (2.5e-6, 7)])
def test_times_are_printed_so_that_they_differ(speed: float, decimals: int) -> None:
    assert moments(TIME, 0.0, 40 * speed * 0.01, 25.0, speed).decimals == decimals


# --- scales ---


@pytest.mark.parametrize(
    ("number", "up", "down"),
    [
        (1.0, 1.0, 1.0),
        (1.1, 2.0, 1.0),
        (4.9, 5.0, 2.0),
        (60.0, 100.0, 50.0),
        (0.03, 0.05, 0.02),
        (0.0, 1.0, 1.0),
    ],
)
def test_scales_are_round(number: float, up: float, down: float) -> None:
    assert (round_up(number), round_down(number)) == (pytest.approx(up), pytest.approx(down))


def test_the_usual_force_is_that_which_few_exceed() -> None:
    assert usual(np.concatenate([np.zeros(500), np.arange(1.0, 102.0)])) == pytest.approx(98.0)
    assert usual(np.zeros(3)) == 1.0
    assert said(12000.0) == "12 000"
    assert said(0.5) == "0.5"


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


def test_the_trail_has_the_colours_of_what_it_was() -> None:
    shown = view(0.0, 0.0, (0.0, 0.0))
    assert shown.bore is not None
    # forward from 1 mm behind, in contact in the second half; then it is back in the middle, in flight
    x = np.where(TIME < 1.0, 2e-3 * TIME - 1e-3, 0.0)
    bore = replace(shown.bore, eccentricity=np.column_stack([x, 0.0 * x]), closed=(TIME > 0.5) & (TIME < 0.99))
    picture, found = inset_of(bore, 98)
    row = round(found.centre[1])
    flight = pixels_of(picture, FLIGHT)
    trail = flight[np.abs(flight[:, 1] - row) < 3]
    assert len(trail)
    assert trail[:, 0].max() < found.centre[0] + 2.0  # behind is to the left
    assert trail[:, 0].min() == pytest.approx(found.centre[0] - 1e-3 * PIXELS, abs=2.0)


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


def test_a_contact_of_a_single_record_is_seen() -> None:
    hit = np.arange(TIME.size) == 50
    _, sheet = shown_strip(np.where(hit, 10e3, 0.0), hit, 0.0, 1.0)
    inside = Image.fromarray(sheet.frame()[AXES[1] : AXES[3], AXES[0] : AXES[2]])
    contact = pixels_of(inside, CONTACT)
    assert len(contact)
    assert contact[:, 0].mean() == pytest.approx(250.0, abs=2.0)
    assert contact[:, 1].min() < 15.0


def test_the_cursor_is_at_its_time_and_force() -> None:
    found, sheet = shown_strip(np.full_like(TIME, 10e3), TIME >= 0.0, 0.2, 0.7)
    before = sheet.frame()
    found.cursor(sheet, 0.4, 5.4e3)  # half of the axis, which ends at 10.8 kN
    after = sheet.frame()
    changed = Image.fromarray(np.where(before == after, 255, after))
    assert np.array_equal(sheet.frame(), before)  # it is not there on the next frame
    dark = pixels_of(changed, INK)
    assert dark[:, 0].mean() == pytest.approx(60 + 0.4 * 500, abs=1.0)
    wide = [row for row in np.unique(dark[:, 1]) if np.count_nonzero(dark[:, 1] == row) >= 6]
    assert np.mean(wide) == pytest.approx(80.0, abs=1.5)  # the dot


@pytest.mark.parametrize(("peak", "unit", "top"), [(40.0, "N", 43.2), (10e3, "kN", 10.8)])
def test_small_forces_are_shown_in_newtons(peak: float, unit: str, top: float) -> None:
    _, sheet = shown_strip(np.full_like(TIME, peak), TIME >= 0.0, 0.0, 1.0)
    assert f"force [{unit}] over time [s]" in [text.get_text() for text in sheet.axes.texts]
    assert sheet.axes.figure is not None
    assert sheet.axes.figure.axes[1].get_ylim() == pytest.approx((0.0, top))


@pytest.mark.parametrize(
    ("force", "peak", "text"),
    [
        (40.0, 90.0, "40.0 N"),
        (40.0, 9e4, "40.0 N"),
        (60.0, 9e4, "0.1 kN"),
        (0.0, 9e4, "0.0 kN"),
        (5e4, 9e4, "50.0 kN"),
    ],
)
def test_no_force_is_said_to_be_nought(force: float, peak: float, text: str) -> None:
    assert said_beside(force, "N", peak) == text


def test_what_is_cut_off_is_said() -> None:
    _, sheet = shown_strip(np.where(TIME == 0.5, 90e3, 10e3), TIME >= 0.0, 0.0, 1.0)
    assert "cut off at 12.5 kN" in [text.get_text() for text in sheet.axes.texts]
    assert sheet.axes.figure is not None
    (_, axes) = sheet.axes.figure.axes
    said_there = [text.get_text() for text in axes.get_yticklabels() if text.get_position()[1] < 12.5]
    assert said_there == ["0", "5", "10"]


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
