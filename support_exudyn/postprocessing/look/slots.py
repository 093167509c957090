"""Guides with clearance as they look: two walls on the body that carries them, a block or a pin between."""

import math
from collections.abc import Iterator

from shapely.affinity import rotate, translate
from shapely.geometry import MultiPoint, Point, Polygon, box

from support_exudyn.model.guides import Guide
from support_exudyn.model.linkage import Slide
from support_exudyn.postprocessing.look.shapes import ROUND

WALL = 0.5  # height of a wall, of the slot's


def slot_walls(slide: Slide, guide: Guide, length: float) -> list[Polygon]:
    """Both walls of a guide in the start posture, about its point; none if it has no clearance.

    length: of the guide [m], or that of the block and as much again if that is more.
    """
    found = []
    for part in list(guide.contacts().values())[:1]:
        half, slot = max(0.5 * length, 2.0 * abs(part.point[0])), part.contact.bearing.size
        high = WALL * 2.0 * slot
        low = (part.middle + slot, part.middle - slot - high)
        found = [_placed(box(-half, y, half, y + high), slide) for y in low]
    return found


def sliding_block(slide: Slide, guide: Guide) -> Iterator[Polygon]:
    """What slides in a guide with clearance: a block, or a pin; nothing if it has none."""
    parts = list(guide.contacts().values())
    if not parts:
        return
    whole = MultiPoint([part.point for part in parts]).convex_hull
    radius = parts[0].contact.bearing.contact_arms(0.0)[1]
    yield _placed(whole.buffer(radius, quad_segs=ROUND) if radius else whole, slide)


def _placed(shape: Polygon, slide: Slide) -> Polygon:
    """A shape in the axes of a guide, about its point, in the start posture."""
    turned = rotate(shape, math.degrees(slide.direction), origin=Point(0.0, 0.0))
    return translate(turned, *slide.point)
