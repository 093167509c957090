"""Parts of frames by motions and forces that are known: records, where the journal is, which way arrows go."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from PIL import Image
from PIL.ImageColor import getrgb

from support_exudyn import Result
from support_exudyn.postprocessing.figures.style import CONTACT, FLIGHT
from support_exudyn.postprocessing.render.canvas import Canvas
from support_exudyn.postprocessing.render.frame import JOURNAL, RING, Inset
from support_exudyn.postprocessing.render.pin_views import PinView, pin_views
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
